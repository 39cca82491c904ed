// The report's pictures, put together on demand: a technique's picture may hold only what differs from the truth's, and errors
// lie over the truth in grey. The last few stay decoded.
'use strict';

/** What one pixel's error is, as `Pictures.errors` gives it, and its colours in the difference pictures. */
const errorKinds = [
  {name: ''},
  {name: 'false shadow', color: [230, 38, 52]},
  {name: 'false lit', color: [33, 118, 255]},
];

class Pictures {
  #data;
  #size;
  #cache = new Map();

  constructor(data, size) {
    this.#data = data;
    this.#size = size;
  }

  /** Whether there is a picture of `side` ('truth' or the index of a result) in `mode` ('image', 'mask', 'difference'). */
  has(side, mode) {
    if (mode === 'difference') return side === 'truth' ? this.#data.truth.image !== null : this.#of(side).difference !== null;
    return this.#of(side)[mode] !== null;
  }

  hasAny(side) {
    return ['image', 'mask', 'difference'].some((mode) => this.has(side, mode));
  }

  /**
   * `base`: a canvas of the report's size; `overlays`: what to draw over it, each half as large as the one before. Null where
   * there is no such picture.
   */
  get(side, mode) {
    if (!this.has(side, mode)) return Promise.resolve(null);
    const key = `${side} ${mode}`;
    const picture = this.#cache.get(key) || this.#compose(side, mode);
    this.#cache.delete(key);
    this.#cache.set(key, picture);
    while (this.#cache.size > 8) this.#cache.delete(this.#cache.keys().next().value);
    return picture;
  }

  /** A technique's visibility, 0..255, row by row; null without a mask. */
  async visibility(side) {
    const picture = await this.get(side, 'mask');
    if (picture === null) return null;
    const {data} = this.#read(picture.base);
    const visibility = new Uint8Array(data.length / 4);
    for (let i = 0; i < visibility.length; ++i) visibility[i] = data[4 * i];
    return visibility;
  }

  /** Where the technique is wrong: an index into `errorKinds` a pixel. Null without a difference picture. */
  async errors(side) {
    if (side === 'truth' || !this.has(side, 'difference')) return null;
    const {data} = this.#read(await this.#decode(this.#of(side).difference));
    const errors = new Uint8Array(data.length / 4);
    for (let i = 0; i < errors.length; ++i) {
      if (data[4 * i + 3] < 128) continue;
      const redness = data[4 * i] - data[4 * i + 2];
      errors[i] = redness > 60 ? 1 : redness < -60 ? 2 : 0;
    }
    return errors;
  }

  #of(side) {
    return side === 'truth' ? this.#data.truth : this.#data.results[side];
  }

  async #decode(picture) {
    const image = new Image();
    image.src = picture.uri;
    await image.decode();
    return image;
  }

  #canvas(...layers) {
    const canvas = element('canvas', this.#size);
    for (const layer of layers) canvas.getContext('2d').drawImage(layer, 0, 0, canvas.width, canvas.height);
    return canvas;
  }

  #read(image) {
    const context = element('canvas', this.#size).getContext('2d', {willReadFrequently: true});
    context.drawImage(image, 0, 0, this.#size.width, this.#size.height);
    return context.getImageData(0, 0, this.#size.width, this.#size.height);
  }

  async #compose(side, mode) {
    if (mode === 'difference') {
      return {base: await this.#greyTruth(), overlays: side === 'truth' ? [] : errorPyramid(await this.errors(side), this.#size)};
    }
    const picture = this.#of(side)[mode];
    const layers = [await this.#decode(picture)];
    if (picture.over_truth) layers.unshift((await this.get('truth', mode)).base);
    return {base: this.#canvas(...layers), overlays: []};
  }

  /** Grey, and of less contrast than the truth: red and blue must stand out on it. */
  async #greyTruth() {
    const canvas = this.#canvas();
    const context = canvas.getContext('2d');
    if (!this.has('truth', 'image')) {
      context.fillStyle = '#808080';
      context.fillRect(0, 0, canvas.width, canvas.height);
      return canvas;
    }
    const image = this.#read(await this.#decode(this.#data.truth.image));
    const pixels = image.data;
    for (let i = 0; i < pixels.length; i += 4) {
      const grey = 0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2];
      pixels[i] = pixels[i + 1] = pixels[i + 2] = 48 + 0.72 * grey;
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }
}

/**
 * The errors as canvases, each half as large as the one before and wrong wherever one of its four pixels was: however small the
 * picture is shown, a single wrong pixel stays to be seen.
 */
function errorPyramid(errors, {width, height}) {
  const levels = [];
  while (levels.length < 5) {
    const image = new ImageData(width, height);
    for (let i = 0; i < errors.length; ++i) {
      if (errors[i] !== 0) image.data.set([...errorKinds[errors[i]].color, 255], 4 * i);
    }
    const canvas = element('canvas', {width, height});
    canvas.getContext('2d').putImageData(image, 0, 0);
    levels.push(canvas);

    const [halfWidth, halfHeight] = [Math.ceil(width / 2), Math.ceil(height / 2)];
    const half = new Uint8Array(halfWidth * halfHeight);
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) half[(y >> 1) * halfWidth + (x >> 1)] ||= errors[y * width + x];
    }
    [errors, width, height] = [half, halfWidth, halfHeight];
  }
  return levels;
}

/**
 * The windows with the most errors, worst first, none overlapping another.
 * @returns {{x: number, y: number, size: number, wrong: number}[]}
 */
function worstRegions(errors, {width, height}, count = 5) {
  const size = Math.max(8, Math.round(width / 14));
  // sums[(x, y)] = errors left of and above (x, y).
  const stride = width + 1;
  const sums = new Uint32Array(stride * (height + 1));
  const fillSums = () => {
    for (let y = 0; y < height; ++y) {
      let row = 0;
      for (let x = 0; x < width; ++x) {
        row += errors[y * width + x] !== 0;
        sums[(y + 1) * stride + x + 1] = sums[y * stride + x + 1] + row;
      }
    }
  };
  const regions = [];
  const step = Math.max(1, Math.floor(size / 8));
  const w = Math.min(size, width), h = Math.min(size, height);
  fillSums();
  while (regions.length < count) {
    let best = {wrong: 0};
    for (let y = 0; y + h <= height; y += step) {
      for (let x = 0; x + w <= width; x += step) {
        if (regions.some((r) => Math.abs(r.x - x) < size && Math.abs(r.y - y) < size)) continue;
        const wrong = sums[(y + h) * stride + x + w] - sums[y * stride + x + w] - sums[(y + h) * stride + x]
            + sums[y * stride + x];
        if (wrong > best.wrong) best = {x, y, size, wrong};
      }
    }
    if (best.wrong === 0) break;
    regions.push(best);
  }
  return regions;
}
