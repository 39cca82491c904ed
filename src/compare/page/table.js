// All figures of all techniques; sortable, and each row opens to its stages, memory and counters.
'use strict';

/** @returns columns: `value` sorts and finds the best (the least), `text` is shown; null values come last. */
function tableColumns(results) {
  const plain = results.find((result) => result.spec.startsWith('uniform/depth/hard') && result.milliseconds.median > 0);
  const hasFlicker = results.some((result) => result.error.flicker !== null);
  const interior = (result) => result.error.interior_false_shadow + result.error.interior_false_lit;
  const columns = [
    {title: 'Wrong', unit: '%', value: (r) => r.error.fraction, text: format.percent},
    {title: 'Boundary', unit: '%', value: (r) => r.error.boundary_fraction, text: format.percent,
      about: 'wrong within 3 pixels of a true shadow edge'},
    {title: 'False shadow', unit: 'px', value: (r) => r.error.false_shadow, text: format.count,
      about: 'lit in truth, dark here'},
    {title: 'False lit', unit: 'px', value: (r) => r.error.false_lit, text: format.count,
      about: 'dark in truth, lit here'},
    {title: 'Interior', unit: 'px', value: interior, text: format.count,
      about: 'wrong more than 3 pixels from every true edge'},
    {title: 'Oracle', unit: '%', value: (r) => r.error.oracle_fraction, text: format.percent,
      about: 'differs from a ray through the texel it looks up'},
    {title: 'Mean abs.', unit: '0–1', value: (r) => r.error.mean_absolute, text: (v) => format.fixed(v, 4),
      about: 'mean difference from the supersampled truth'},
    hasFlicker && {title: 'Flicker', unit: '%', value: (r) => r.error.flicker, text: format.percent,
      about: 'points that change between right and wrong from frame to frame'},
    {title: 'Technique', unit: 'ms', value: (r) => r.milliseconds.median, text: format.milliseconds, starts: true,
      about: 'map and look-up, median'},
    {title: 'Frame', unit: 'ms', value: (r) => r.frame_milliseconds.median, text: format.milliseconds,
      about: 'with the camera pass, median'},
    plain && {title: 'Time', unit: `× ${plain.technique}`, value: (r) => r.milliseconds.median / plain.milliseconds.median,
      text: format.milliseconds, about: `technique's milliseconds over those of ${plain.technique}`, ratio: true},
    {title: 'Memory', unit: 'MB', value: (r) => r.memory_bytes, text: format.megabytes, starts: true},
  ];
  return columns.filter(Boolean);
}

class ResultTable {
  #table = byId('results');
  #columns;
  #rows;
  #sorted = {column: null, ascending: true};

  constructor(results, viewable, onShow) {
    this.#columns = [{title: 'Technique', value: (r) => r.technique, name: true}, ...tableColumns(results)];
    this.#rows = results.map((result, index) => ({result, body: this.#body(result, index, viewable(index) ? onShow : null)}));
    this.#table.append(this.#head(), ...this.#rows.map((row) => row.body));
    this.#emphasiseBest();
  }

  #head() {
    const cells = this.#columns.map((column) => {
      const button = element('button', {type: 'button', onclick: () => this.#sort(column)},
          element('span', {}, column.title), column.unit ? element('small', {}, column.unit) : null);
      column.header = element('th', {scope: 'col', class: this.#cellClass(column), 'aria-sort': 'none',
        title: column.about}, button);
      return column.header;
    });
    return element('thead', {}, element('tr', {}, cells));
  }

  #cellClass(column) {
    return [column.name ? 'name' : 'figure', column.starts ? 'starts-group' : ''].filter(Boolean).join(' ');
  }

  #body(result, index, onShow) {
    const id = `details-${index}`;
    const details = element('tr', {class: 'details', id, hidden: ''},
        element('td', {colspan: this.#columns.length}, resultDetails(result)));
    const toggle = element('button', {type: 'button', class: 'toggle', 'aria-expanded': 'false', 'aria-controls': id,
      'aria-label': `Details of ${result.technique}`, onclick: () => {
        details.hidden = !details.hidden;
        toggle.setAttribute('aria-expanded', String(!details.hidden));
      }}, '▸');
    const label = onShow === null ? element('span', {class: 'technique'}, breakable(result.technique))
        : element('button', {type: 'button', class: 'technique', title: 'Show it in the viewer',
          onclick: () => onShow(index)}, breakable(result.technique));
    const spec = result.spec && result.spec !== result.technique ? element('small', {class: 'spec'}, breakable(result.spec)) : null;
    const cells = this.#columns.map((column) => {
      if (column.name) {
        return element('th', {scope: 'row', class: 'name'},
            element('div', {class: 'name-cell'}, toggle, element('div', {}, label, spec)));
      }
      const value = column.value(result);
      return element('td', {class: this.#cellClass(column)},
          value === null ? element('span', {class: 'none', title: 'does not apply'}, '–') : column.text(value));
    });
    return element('tbody', {}, element('tr', {class: 'result'}, cells), details);
  }

  #emphasiseBest() {
    this.#columns.forEach((column, c) => {
      if (column.name || column.ratio) return;
      const field = this.#rows.filter(({result}) => !isTruth(result) && column.value(result) !== null);
      const values = field.map(({result}) => column.value(result));
      const best = Math.min(...values);
      // What most of them reach distinguishes nobody.
      if (2 * values.filter((value) => value === best).length > values.length) return;
      for (const {result, body} of field) {
        if (column.value(result) !== best) continue;
        const cell = body.rows[0].cells[c];
        cell.classList.add('best');
        cell.append(element('span', {class: 'visually-hidden'}, ' (best)'));
      }
    });
  }

  #sort(column) {
    const ascending = this.#sorted.column === column ? !this.#sorted.ascending : true;
    this.#sorted = {column, ascending};
    for (const other of this.#columns) other.header.setAttribute('aria-sort', 'none');
    column.header.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
    const compare = (a, b) => {
      const [x, y] = [column.value(a.result), column.value(b.result)];
      if (x === null || y === null) return (x === null) - (y === null);
      const order = column.name ? x.localeCompare(y, 'en', {numeric: true}) : x - y;
      return ascending ? order : -order;
    };
    this.#table.append(...[...this.#rows].sort(compare).map((row) => row.body));
  }
}

/** What a row opens to. */
function resultDetails(result) {
  const {error, milliseconds} = result;
  const bars = (entries, text) => {
    const most = Math.max(...entries.map(([, value]) => value), Number.MIN_VALUE);
    return element('ul', {class: 'bars'}, entries.map(([name, value]) => {
      const bar = element('i', {});
      bar.style.width = `${100 * value / most}%`;
      return element('li', {}, element('span', {}, name), element('b', {}, text(value)), bar);
    }));
  };
  const list = (entries) => element('dl', {class: 'pairs'}, entries.map(([name, value]) =>
    element('div', {}, element('dt', {}, name), element('dd', {}, value))));
  const block = (title, content) => element('div', {class: 'block'}, element('h3', {}, title), content);
  const counter = (value) => (Array.isArray(value) ? value : [value])
      .map((x) => x.toLocaleString('en-US', {maximumFractionDigits: 4})).join(' × ');

  const stages = milliseconds.stages.map((stage) => [stage.name, stage.median]);
  const memory = result.memory.map((allocation) => [allocation.name, allocation.bytes]);
  const counters = Object.entries(result.counters).map(([name, value]) => [name.replaceAll('_', ' '), counter(value)]);
  return element('div', {class: 'blocks'},
      stages.length ? block('Time by stage', bars(stages, (v) => `${format.fixed(v, 3)} ms`)) : null,
      memory.length ? block('Memory', bars(memory, format.bytes)) : null,
      counters.length ? block('Counters', list(counters)) : null,
      block('More figures', list([
        ['spec', element('code', {}, breakable(result.spec))],
        ['wrong pixels', `${format.count(error.wrong)} of ${format.count(error.compared)}`],
        ['pixel match', `${format.percent(error.match)}%`],
        ['interior false shadow', format.count(error.interior_false_shadow)],
        ['interior false lit', format.count(error.interior_false_lit)],
        ['true edge pixels', format.count(error.edge_pixels)],
        ['fastest, slowest', `${format.milliseconds(milliseconds.min)}, ${format.milliseconds(milliseconds.max)} ms`],
      ])));
}
