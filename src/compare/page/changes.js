// What changed since an earlier report.
'use strict';

function showChanges(changes, report) {
  if (changes === null) return;
  byId('changes-section').hidden = false;
  byId('conditions').append(...changes.conditions.map((condition) => element('li', {class: 'warning'},
      `${condition[0].toUpperCase()}${condition.slice(1)}.`)));
  byId('conditions').hidden = changes.conditions.length === 0;

  const quantities = [
    {title: 'Wrong pixels', value: (r) => r.error.wrong, text: format.count},
    {title: 'Milliseconds', value: (r) => r.milliseconds.median, text: format.milliseconds},
    {title: 'MB', value: (r) => r.memory_bytes, text: format.megabytes},
  ];
  const relative = (before, after) => {
    if (before === after) return element('span', {class: 'none'}, 'same');
    if (before === 0) return element('span', {class: 'worse'}, 'from none');
    const percent = 100 * (after - before) / before;
    const digits = Math.abs(percent) < 10 ? 1 : 0;
    return element('span', {class: percent < 0 ? 'better' : 'worse'},
        `${percent < 0 ? '−' : '+'}${Math.abs(percent).toLocaleString('en-US', {maximumFractionDigits: digits})}%`);
  };
  const cells = (quantity, before, after) => {
    const text = (result) => result ? quantity.text(quantity.value(result)) : '–';
    return [element('td', {class: 'figure starts-group'}, text(before)), element('td', {class: 'figure'}, text(after)),
      element('td', {class: 'figure'}, before && after ? relative(quantity.value(before), quantity.value(after)) : '')];
  };
  const rows = changes.pairs.map((pair) => {
    const before = pair.before === null ? null : changes.before.results[pair.before];
    const after = pair.after === null ? null : report.results[pair.after];
    const state = before === null ? 'new' : after === null ? 'gone' : null;
    return element('tr', {class: 'result'}, element('th', {scope: 'row', class: 'name'},
        element('span', {class: 'technique'}, breakable((after || before).technique)),
        state && element('span', {class: `badge ${state}`}, state)),
        quantities.map((quantity) => cells(quantity, before, after)));
  });
  byId('changes').append(
      element('thead', {},
          element('tr', {class: 'over'}, element('th', {rowspan: 2, scope: 'col', class: 'name'}, 'Technique'),
              quantities.map((quantity) => element('th', {colspan: 3, scope: 'colgroup', class: 'starts-group'}, quantity.title))),
          element('tr', {}, quantities.map(() => ['before', 'now', 'change'].map((title, i) =>
            element('th', {scope: 'col', class: `figure${i === 0 ? ' starts-group' : ''}`}, title))))),
      element('tbody', {}, rows));
}
