// The viewer: two pictures under one view, a divider between them.
'use strict';

class Viewer {
  static #invitation = 'Point at a pixel, or tap it, to read its visibility.';
  #report;
  #pictures;
  #view;
  #wipe = 0.5;
  #sides = {left: 'truth', right: 'truth'};
  #mode = 'image';
  #drawn = {left: null, right: null};
  #frame = 0;
  #request = 0;
  #pointers = new Map();
  #drag = null;
  #worst = {side: null, regions: [], next: 0};
  #probe = null;
  #pressed = null;
  #hintTimer = 0;

  constructor(report, pictures) {
    this.#report = report;
    this.#pictures = pictures;
    this.#view = new View(report.image);
    this.#fillSides();
    this.#listen();
    new ResizeObserver(() => this.#resize()).observe(byId('stage'));
    this.#resize();
    this.#load();
  }

  /** Shows `side` on the left and brings the viewer into sight. */
  show(side) {
    if (this.#sides.right === side) this.#sides.right = this.#sides.left;
    this.#sides.left = side;
    this.#load();
    byId('viewer-section').scrollIntoView({behavior: matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth'});
  }

  #name(side) {
    return side === 'truth' ? 'Truth (ray traced)' : this.#report.results[side].technique;
  }

  #fillSides() {
    const sides = ['truth', ...this.#report.results.keys()].filter((side) => this.#pictures.hasAny(side));
    for (const id of ['left-side', 'right-side']) {
      byId(id).append(...sides.map((side) => element('option', {value: side}, this.#name(side))));
    }
    this.#sides.left = sides.find((side) => side !== 'truth') ?? sides[0];
    this.#sides.right = sides.find((side) => side !== this.#sides.left) ?? sides[0];
    byId('stage').style.setProperty('--picture-ratio', this.#report.image.width / this.#report.image.height);
    for (const input of document.querySelectorAll('#modes input')) {
      input.disabled = !sides.some((side) => this.#pictures.has(side, input.value));
    }
    const usable = [...document.querySelectorAll('#modes input')].find((input) => !input.disabled);
    usable.checked = true;
    this.#mode = usable.value;
    byId('worst-region').disabled = !sides.some((side) => side !== 'truth' && this.#pictures.has(side, 'difference'));
  }

  async #load() {
    const request = ++this.#request;
    byId('left-side').value = this.#sides.left;
    byId('right-side').value = this.#sides.right;
    byId('left-tag').textContent = this.#name(this.#sides.left);
    byId('right-tag').textContent = this.#name(this.#sides.right);
    byId('difference-legend').hidden = this.#mode !== 'difference';
    const [left, right] = await Promise.all([this.#pictures.get(this.#sides.left, this.#mode),
      this.#pictures.get(this.#sides.right, this.#mode)]);
    if (request !== this.#request) return;
    this.#drawn = {left, right};
    if (left === null) byId('left-tag').append(': no such picture');
    if (right === null) byId('right-tag').append(': no such picture');
    this.#probe = null;
    byId('readout').textContent = Viewer.#invitation;
    byId('canvas').setAttribute('aria-label', `${this.#name(this.#sides.left)} left of the divider, `
        + `${this.#name(this.#sides.right)} right of it`);
    this.#redraw();
  }

  #resize() {
    const {width, height} = byId('stage').getBoundingClientRect();
    if (width === 0) return;
    this.#view.resize(width, height);
    this.#redraw();
  }

  #redraw() {
    cancelAnimationFrame(this.#frame);
    this.#frame = requestAnimationFrame(() => this.#paint());
  }

  #paint() {
    const view = this.#view;
    const canvas = byId('canvas');
    const ratio = window.devicePixelRatio || 1;
    const width = Math.round(view.stage.width * ratio), height = Math.round(view.stage.height * ratio);
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];

    const context = canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    const scale = view.scale * ratio;
    context.imageSmoothingEnabled = scale < 2;
    context.imageSmoothingQuality = 'high';
    const divider = Math.round(this.#wipe * width);
    const paintSide = (picture, from, to) => {
      if (picture === null || to <= from) return;
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, height);
      context.clip();
      context.setTransform(scale, 0, 0, scale, Math.round(view.x * ratio), Math.round(view.y * ratio));
      context.drawImage(picture.base, 0, 0);
      if (picture.overlays.length > 0) {
        // The level whose pixels are at least one of the screen's.
        const level = Math.max(0, Math.min(picture.overlays.length - 1, Math.ceil(-Math.log2(scale) - 0.001)));
        const overlay = picture.overlays[level];
        context.imageSmoothingEnabled = false;
        context.drawImage(overlay, 0, 0, overlay.width * 2 ** level, overlay.height * 2 ** level);
      }
      context.restore();
    };
    paintSide(this.#drawn.left, 0, divider);
    paintSide(this.#drawn.right, divider, width);

    byId('wipe').style.left = `${100 * this.#wipe}%`;
    byId('wipe').setAttribute('aria-valuenow', Math.round(100 * this.#wipe));
    byId('zoom-level').textContent = `${format.significant(100 * scale, scale < 1 ? 2 : 3)}%`;
    byId('stage').classList.toggle('zoomed', !view.fits);
    byId('zoom-out').disabled = view.fits;
    byId('left-tag').classList.toggle('faded', this.#wipe < 0.12);
    byId('right-tag').classList.toggle('faded', this.#wipe > 0.88);
  }

  #setWipe(share) {
    this.#wipe = Math.max(0, Math.min(1, share));
    this.#redraw();
  }

  #zoom(factor, x = this.#view.stage.width / 2, y = this.#view.stage.height / 2) {
    this.#view.zoomAt(x, y, factor);
    this.#redraw();
  }

  #fit() {
    this.#view.fit();
    this.#redraw();
  }

  /** The worst places of the left technique (or the right one, beside the truth), one after the other. */
  async #showWorst() {
    const side = [this.#sides.left, this.#sides.right].find((s) => s !== 'truth' && this.#pictures.has(s, 'difference'));
    if (side === undefined) return;
    if (this.#worst.side !== side) {
      const errors = await this.#pictures.errors(side);
      this.#worst = {side, regions: worstRegions(errors, this.#report.image), next: 0};
    }
    const {regions} = this.#worst;
    if (regions.length === 0) {
      byId('readout').textContent = `${this.#name(side)} has no wrong pixel.`;
      return;
    }
    const index = this.#worst.next;
    const region = regions[index];
    this.#worst.next = (index + 1) % regions.length;
    const scale = 0.9 * Math.min(this.#view.stage.width, this.#view.stage.height) / region.size;
    this.#view.centerOn(region.x + region.size / 2, region.y + region.size / 2, scale);
    this.#redraw();
    byId('readout').textContent = `${this.#name(side)}: place ${index + 1} of ${regions.length} by error, `
        + `${format.count(region.wrong)} wrong pixels within ${region.size} × ${region.size}`;
  }

  // The pixel under the pointer.

  async #readPixel(position) {
    const {x, y} = this.#view.toPicture(position.x, position.y);
    const {width, height} = this.#report.image;
    const [column, row] = [Math.floor(x), Math.floor(y)];
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    if (this.#probe === null) {
      const sides = [...new Set([this.#sides.left, this.#sides.right])];
      this.#probe = Promise.all(sides.map(async (side) => ({side, visibility: await this.#pictures.visibility(side),
        errors: await this.#pictures.errors(side)})));
    }
    const probe = this.#probe;
    const read = await probe;
    if (probe !== this.#probe) return;
    const i = row * width + column;
    const parts = read.filter(({visibility}) => visibility !== null).map(({side, visibility, errors}) => {
      const kind = errors === null || errors[i] === 0 ? '' : ` (${errorKinds[errors[i]].name})`;
      return `${this.#name(side)} ${format.fixed(visibility[i] / 255, 2)}${kind}`;
    });
    byId('readout').textContent = `Pixel ${column}, ${row}` + (parts.length ? ` · visibility: ${parts.join(' · ')}` : '');
  }

  // Pointers: one drags the divider or pans, two pinch.

  #position(event) {
    const box = byId('stage').getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  }

  #pointerDown(event) {
    if (event.button !== 0) return;
    const stage = byId('stage');
    stage.setPointerCapture(event.pointerId);
    const position = this.#position(event);
    this.#pointers.set(event.pointerId, position);
    this.#pressed = this.#pointers.size === 1 ? position : null;
    if (this.#pointers.size === 1) {
      const reach = event.pointerType === 'mouse' ? 14 : 26;
      const nearWipe = Math.abs(position.x - this.#wipe * this.#view.stage.width) <= reach;
      this.#drag = nearWipe || this.#view.fits ? 'wipe' : 'pan';
      if (this.#drag === 'wipe' && event.pointerType === 'mouse') this.#setWipe(position.x / this.#view.stage.width);
    } else {
      this.#drag = 'pinch';
    }
    stage.classList.toggle('panning', this.#drag === 'pan');
    const focused = this.#drag === 'wipe' ? byId('wipe') : byId('canvas');
    focused.focus({preventScroll: true});
    event.preventDefault();
  }

  #pointerMove(event) {
    const position = this.#position(event);
    const before = this.#pointers.get(event.pointerId);
    if (before === undefined) {
      if (event.pointerType === 'mouse') this.#readPixel(position);
      return;
    }
    if (this.#drag === 'wipe') {
      this.#setWipe(position.x / this.#view.stage.width);
    } else if (this.#drag === 'pan') {
      this.#view.pan(position.x - before.x, position.y - before.y);
      this.#redraw();
    } else if (this.#drag === 'pinch') {
      const other = [...this.#pointers].find(([id]) => id !== event.pointerId)[1];
      const spread = (a) => Math.max(1, Math.hypot(a.x - other.x, a.y - other.y));
      const middle = (a) => ({x: (a.x + other.x) / 2, y: (a.y + other.y) / 2});
      const [from, to] = [middle(before), middle(position)];
      this.#view.zoomAt(from.x, from.y, spread(position) / spread(before));
      this.#view.pan(to.x - from.x, to.y - from.y);
      this.#redraw();
    }
    this.#pointers.set(event.pointerId, position);
  }

  #pointerUp(event) {
    const {x, y} = this.#position(event);
    const tapped = event.type === 'pointerup' && this.#pressed && Math.hypot(x - this.#pressed.x, y - this.#pressed.y) < 6;
    if (tapped && event.pointerType !== 'mouse') this.#readPixel({x, y});
    this.#pointers.delete(event.pointerId);
    if (this.#pointers.size === 1) this.#drag = this.#view.fits ? null : 'pan';
    if (this.#pointers.size === 0) {
      this.#drag = null;
      byId('stage').classList.remove('panning');
    }
  }

  /** The wheel scrolls the page until the viewer is meant: with Ctrl, once it has the focus, or in full screen. */
  #wheel(event) {
    const meant = event.ctrlKey || event.metaKey || byId('viewer').contains(document.activeElement) || document.fullscreenElement;
    if (!meant) {
      byId('wheel-hint').classList.add('shown');
      clearTimeout(this.#hintTimer);
      this.#hintTimer = setTimeout(() => byId('wheel-hint').classList.remove('shown'), 1200);
      return;
    }
    event.preventDefault();
    byId('wheel-hint').classList.remove('shown');
    const lines = event.deltaMode === 0 ? event.deltaY / 40 : event.deltaY;
    const {x, y} = this.#position(event);
    this.#zoom(1.1 ** -Math.max(-6, Math.min(6, lines)), x, y);
  }

  #wipeKey(event) {
    const step = event.shiftKey ? 0.1 : 0.02;
    const targets = {ArrowLeft: this.#wipe - step, ArrowDown: this.#wipe - step, ArrowRight: this.#wipe + step,
      ArrowUp: this.#wipe + step, PageDown: this.#wipe - 0.1, PageUp: this.#wipe + 0.1, Home: 0, End: 1};
    if (!(event.key in targets)) return;
    event.preventDefault();
    event.stopPropagation();
    this.#setWipe(targets[event.key]);
  }

  #stageKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 200 : 50;
    const pan = (dx, dy) => {
      this.#view.pan(dx, dy);
      this.#redraw();
    };
    const actions = {'+': () => this.#zoom(1.25), '=': () => this.#zoom(1.25), '-': () => this.#zoom(0.8),
      '0': () => this.#fit(), w: () => this.#showWorst(), f: () => this.#toggleFullScreen(),
      ArrowLeft: () => pan(step, 0), ArrowRight: () => pan(-step, 0), ArrowUp: () => pan(0, step),
      ArrowDown: () => pan(0, -step)};
    if (!(event.key in actions)) return;
    event.preventDefault();
    actions[event.key]();
  }

  #toggleFullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else byId('viewer').requestFullscreen();
  }

  #listen() {
    const stage = byId('stage');
    const setSide = (which) => (event) => {
      this.#sides[which] = event.target.value === 'truth' ? 'truth' : Number(event.target.value);
      this.#load();
    };
    byId('left-side').addEventListener('change', setSide('left'));
    byId('right-side').addEventListener('change', setSide('right'));
    byId('swap-sides').addEventListener('click', () => {
      this.#sides = {left: this.#sides.right, right: this.#sides.left};
      this.#load();
    });
    byId('modes').addEventListener('change', (event) => {
      this.#mode = event.target.value;
      this.#load();
    });
    byId('zoom-in').addEventListener('click', () => this.#zoom(1.5));
    byId('zoom-out').addEventListener('click', () => this.#zoom(1 / 1.5));
    byId('zoom-fit').addEventListener('click', () => this.#fit());
    byId('worst-region').addEventListener('click', () => this.#showWorst());
    byId('full-screen').addEventListener('click', () => this.#toggleFullScreen());
    byId('full-screen').hidden = !byId('viewer').requestFullscreen;
    byId('wipe').addEventListener('keydown', (event) => this.#wipeKey(event));
    stage.addEventListener('keydown', (event) => this.#stageKey(event));
    stage.addEventListener('pointerdown', (event) => this.#pointerDown(event));
    stage.addEventListener('pointermove', (event) => this.#pointerMove(event));
    stage.addEventListener('pointerup', (event) => this.#pointerUp(event));
    stage.addEventListener('pointercancel', (event) => this.#pointerUp(event));
    stage.addEventListener('wheel', (event) => this.#wheel(event), {passive: false});
    stage.addEventListener('dblclick', (event) => {
      const {x, y} = this.#position(event);
      this.#zoom(event.shiftKey ? 0.5 : 2, x, y);
    });
  }
}
