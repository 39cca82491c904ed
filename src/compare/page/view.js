// Which part of the pictures is seen: a scale and an offset, both pictures alike. Lengths of the stage are in CSS pixels,
// those of the picture in its own.
'use strict';

class View {
  static closest = 64;

  constructor(picture) {
    this.picture = picture;
    this.stage = {width: 1, height: 1};
    this.scale = 0;
    this.x = 0;
    this.y = 0;
  }

  get fitScale() {
    return Math.min(this.stage.width / this.picture.width, this.stage.height / this.picture.height);
  }

  get fits() {
    return this.scale <= this.fitScale * 1.0001;
  }

  fit() {
    this.scale = this.fitScale;
    this.#keepInside();
  }

  resize(width, height) {
    const wasFit = this.fits;
    const center = this.toPicture(this.stage.width / 2, this.stage.height / 2);
    this.stage = {width, height};
    if (wasFit) this.fit();
    else this.centerOn(center.x, center.y, this.scale);
  }

  /** Magnifies by `factor`; what is under the point (x, y) of the stage stays there. */
  zoomAt(x, y, factor) {
    const fixed = this.toPicture(x, y);
    this.scale = this.#allowed(this.scale * factor);
    this.x = x - fixed.x * this.scale;
    this.y = y - fixed.y * this.scale;
    this.#keepInside();
  }

  pan(dx, dy) {
    this.x += dx;
    this.y += dy;
    this.#keepInside();
  }

  centerOn(x, y, scale) {
    this.scale = this.#allowed(scale);
    this.x = this.stage.width / 2 - x * this.scale;
    this.y = this.stage.height / 2 - y * this.scale;
    this.#keepInside();
  }

  toPicture(x, y) {
    return {x: (x - this.x) / this.scale, y: (y - this.y) / this.scale};
  }

  #allowed(scale) {
    return Math.max(this.fitScale, Math.min(Math.max(View.closest, this.fitScale), scale));
  }

  #keepInside() {
    const inside = (offset, stage, picture) => picture <= stage ? (stage - picture) / 2
        : Math.min(0, Math.max(stage - picture, offset));
    this.scale = this.#allowed(this.scale);
    this.x = inside(this.x, this.stage.width, this.picture.width * this.scale);
    this.y = inside(this.y, this.stage.height, this.picture.height * this.scale);
  }
}
