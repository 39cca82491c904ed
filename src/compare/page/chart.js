// Error (logarithmic) against milliseconds, memory as a disc's area; the line is the Pareto front. Drawn anew for each width, so
// that its text keeps its size.
'use strict';

/** A scale from values to pixels, with ticks. Logarithmic, or linear from zero. */
function axisScale(values, from, to, logarithmic) {
  if (!logarithmic) {
    const most = Math.max(...values) * 1.08 || 1;
    const raw = most / 6, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 2.5, 5, 10].find((m) => m * power >= raw);
    const ticks = [];
    for (let i = 0; i * step <= most; ++i) ticks.push(i * step);
    return {at: (v) => from + (to - from) * v / most, ticks};
  }
  const [low, high] = [Math.min(...values) / 1.6, Math.max(...values) * 1.6];
  const decades = Math.log10(high / low);
  const steps = decades > 2.5 ? [1] : decades > 1.2 ? [1, 3] : decades > 0.8 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 8];
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power) {
    for (const step of steps) {
      const tick = step * 10 ** power;
      if (tick >= low && tick <= high) ticks.push(tick);
    }
  }
  return {at: (v) => from + (to - from) * Math.log(v / low) / Math.log(high / low), ticks};
}

/** Where labels go: each beside its disc at the first of 24 places that covers nothing; null where all are taken. */
function placeLabels(points, frame, obstacles, measure) {
  const taken = [...obstacles, ...points.map(({x, y, r}) => ({left: x - r, right: x + r, top: y - r, bottom: y + r}))];
  const overlap = (a, b) => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left))
      * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
  const directions = [[1, 0], [-1, 0], [0, -1], [0, 1], [0.8, -0.6], [-0.8, -0.6], [0.8, 0.6], [-0.8, 0.6]];
  return points.map((point) => {
    const width = measure(point.label), height = 14;
    for (const distance of [5, 16, 30]) {
      for (const [dx, dy] of directions) {
        const reach = point.r + distance;
        const [x, y] = [point.x + dx * reach, point.y + dy * (reach + 4)];
        const left = dx > 0 ? x : dx < 0 ? x - width : x - width / 2;
        const box = {left, right: left + width, top: y - height / 2, bottom: y + height / 2};
        const inside = box.left >= frame.left && box.right <= frame.right && box.top >= frame.top && box.bottom <= frame.bottom;
        if (!inside || taken.some((other) => overlap(box, other) > 0)) continue;
        taken.push(box);
        return {x: left, y: y + 4, leader: distance > 5 ? {x: x - dx * 2, y: y - dy * 2} : null};
      }
    }
    return null;
  });
}

class ScatterChart {
  #results;
  #box = byId('chart');
  #tip = element('div', {class: 'tip', role: 'status', hidden: ''});
  #onShow;

  constructor(results, onShow) {
    this.#results = contestants(results).filter((result) => result.milliseconds.median > 0);
    this.#onShow = onShow;
    if (this.#results.length < 2) return;
    byId('chart-section').hidden = false;
    new ResizeObserver(() => this.#draw()).observe(this.#box);
  }

  static family(result) {
    const first = result.spec.split(/[/@,]/)[0];
    return ['uniform', 'perspective', 'cascaded', 'rectilinear', 'paged', 'precomputed'].includes(first) ? first : 'other';
  }

  #draw() {
    const width = this.#box.clientWidth;
    if (width === 0) return;
    const phone = width < 560;
    const height = phone ? 380 : 480;
    const frame = {left: phone ? 46 : 64, right: width - 12, top: 14, bottom: height - 48};
    const times = this.#results.map((r) => r.milliseconds.median);
    const errors = this.#results.map((r) => r.error.fraction).filter((f) => f > 0);
    const hasZero = errors.length < this.#results.length;
    const zeroAt = frame.bottom - 22;
    const x = axisScale(times, frame.left, frame.right, Math.max(...times) > 8 * Math.min(...times));
    const y = errors.length ? axisScale(errors, hasZero ? zeroAt - 30 : frame.bottom, frame.top, true)
        : {at: () => zeroAt, ticks: []};
    const most = Math.max(...this.#results.map((r) => r.memory_bytes), 1);
    const radius = (bytes) => Math.max(4, (phone ? 20 : 30) * Math.sqrt(bytes / most));
    const points = this.#results.map((result) => ({result, label: result.technique, x: x.at(result.milliseconds.median),
      y: result.error.fraction > 0 ? y.at(result.error.fraction) : zeroAt, r: radius(result.memory_bytes)}));

    const svg = element('svg:svg', {viewBox: `0 0 ${width} ${height}`, width, height, role: 'group',
      'aria-label': 'Wrong pixels against milliseconds, one disc a technique'});
    const front = ScatterChart.#front(points);
    const path = front.map((p, i) => i === 0 ? `M${p.x} ${p.y}` : `H${p.x}V${p.y}`).join('');
    svg.append(...this.#axes(frame, x, y, hasZero ? zeroAt : null, height), element('svg:path', {d: path, class: 'front'}),
        ...this.#marks(points, frame, front));
    this.#box.replaceChildren(svg, this.#legend(), this.#tip);
    this.#tip.hidden = true;
  }

  #axes(frame, x, y, zeroAt, height) {
    const text = (attributes, content) => element('svg:text', attributes, content);
    const line = (x1, y1, x2, y2) => element('svg:line', {x1, y1, x2, y2, class: 'grid'});
    const number = (v) => v.toLocaleString('en-US', {maximumSignificantDigits: 3});
    const nodes = [];
    for (const tick of x.ticks) {
      nodes.push(line(x.at(tick), frame.top, x.at(tick), frame.bottom),
          text({x: x.at(tick), y: frame.bottom + 18, class: 'tick', 'text-anchor': 'middle'}, number(tick)));
    }
    for (const tick of y.ticks) {
      nodes.push(line(frame.left, y.at(tick), frame.right, y.at(tick)),
          text({x: frame.left - 7, y: y.at(tick) + 4, class: 'tick', 'text-anchor': 'end'}, `${number(100 * tick)}%`));
    }
    if (zeroAt !== null) {
      nodes.push(line(frame.left, zeroAt, frame.right, zeroAt),
          text({x: frame.left - 7, y: zeroAt + 4, class: 'tick', 'text-anchor': 'end'}, '0'));
    }
    nodes.push(text({x: frame.right, y: height - 8, class: 'axis', 'text-anchor': 'end'}, 'milliseconds, technique alone →'),
        text({x: 0, y: 0, class: 'axis', transform: `translate(${frame.left + 14} ${frame.top + 2}) rotate(-90)`,
          'text-anchor': 'end'}, 'wrong pixels →'));
    return nodes;
  }

  /** Points that no other beats in both time and error, from the fastest to the best. */
  static #front(points) {
    let least = -Infinity;
    return [...points].sort((a, b) => a.x - b.x || b.y - a.y).filter((point) => {
      const better = point.y > least;
      if (better) least = point.y;
      return better;
    });
  }

  #marks(points, frame, front) {
    const context = element('canvas').getContext('2d');
    context.font = '600 12px system-ui, sans-serif';
    // The steps of the front, where no label should lie: along to the next point, then down to it.
    const steps = front.slice(1).flatMap((point, i) => [
      {left: front[i].x, right: point.x, top: front[i].y - 1, bottom: front[i].y + 1},
      {left: point.x - 1, right: point.x + 1, top: front[i].y, bottom: point.y}]);
    const labels = placeLabels(points, frame, steps, (label) => context.measureText(label).width + 4);
    const drawn = points.map((point, i) => ({point, label: labels[i]}));
    // Large discs first, so that no small one is hidden.
    drawn.sort((a, b) => b.point.r - a.point.r);
    return drawn.map(({point, label}) => {
      const {result} = point;
      const show = () => this.#showTip(point);
      const hide = () => { this.#tip.hidden = true; };
      const group = element('svg:g', {class: `mark family-${ScatterChart.family(result)}`, tabindex: 0, role: 'button',
        'aria-label': `${result.technique}: ${format.share(result.error.fraction)} wrong, `
            + `${format.milliseconds(result.milliseconds.median)} ms, ${format.bytes(result.memory_bytes)}`,
        onpointerenter: show, onfocus: show, onclick: show, onblur: hide,
        onpointerleave: (event) => { if (event.pointerType === 'mouse') hide(); },
        ondblclick: () => this.#onShow(result), onkeydown: (event) => {
          if (event.key === 'Enter') this.#onShow(result);
          if (event.key === 'Escape') hide();
        }});
      if (label && label.leader) {
        group.append(element('svg:line', {class: 'leader', x1: point.x, y1: point.y, x2: label.leader.x, y2: label.leader.y}));
      }
      group.append(element('svg:circle', {class: 'reach', cx: point.x, cy: point.y, r: Math.max(14, point.r)}),
          element('svg:circle', {class: 'disc', cx: point.x, cy: point.y, r: point.r}),
          element('svg:circle', {class: 'center', cx: point.x, cy: point.y, r: 2}));
      if (label) group.append(element('svg:text', {class: 'label', x: label.x, y: label.y}, point.label));
      return group;
    });
  }

  #showTip(point) {
    const {result} = point;
    const row = (name, value) => element('div', {}, element('dt', {}, name), element('dd', {}, value));
    this.#tip.replaceChildren(element('strong', {}, result.technique), element('dl', {class: 'pairs'},
        row('wrong', `${format.share(result.error.fraction)} (${format.count(result.error.wrong)} px)`),
        row('boundary', format.share(result.error.boundary_fraction)),
        row('technique', `${format.milliseconds(result.milliseconds.median)} ms`),
        row('frame', `${format.milliseconds(result.frame_milliseconds.median)} ms`),
        row('memory', format.bytes(result.memory_bytes))));
    this.#tip.hidden = false;
    const {offsetWidth, offsetHeight} = this.#tip;
    const left = Math.max(0, Math.min(this.#box.clientWidth - offsetWidth, point.x - offsetWidth / 2));
    const above = point.y - point.r - offsetHeight - 8;
    this.#tip.style.left = `${left}px`;
    this.#tip.style.top = `${above >= 0 ? above : point.y + point.r + 8}px`;
  }

  #legend() {
    const families = [...new Set(this.#results.map(ScatterChart.family))];
    const largest = this.#results.reduce((a, b) => b.memory_bytes > a.memory_bytes ? b : a);
    return element('ul', {class: 'families', 'aria-label': 'Colours and sizes'}, families.map((family) =>
      element('li', {class: `family-${family}`}, element('i', {}), family)),
        element('li', {}, `largest disc: ${format.bytes(largest.memory_bytes)}`));
  }
}
