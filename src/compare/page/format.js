// Numbers as text, and elements out of data. Text always goes in as text nodes, so that no name in a report is ever markup.
'use strict';

const format = {
  count: (value) => value.toLocaleString('en-US'),
  percent: (fraction) => format.fixed(100 * fraction, 3),
  /** A share in running text: as many digits as it deserves. */
  share: (fraction) => `${format.significant(100 * fraction, 3)}%`,
  milliseconds: (value) => format.fixed(value, 2),
  megabytes: (bytes) => format.fixed(bytes / 1e6, 1),
  bytes: (bytes) => bytes < 1e3 ? `${bytes} B` : bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} KB`
      : `${format.megabytes(bytes)} MB`,
  /** Fixed decimals, but a value that is not zero never reads as zero. */
  fixed(value, decimals) {
    const least = 0.5 * 10 ** -decimals;
    if (value > 0 && value < least) return `<${(10 ** -decimals).toFixed(decimals)}`;
    return value.toLocaleString('en-US', {minimumFractionDigits: decimals, maximumFractionDigits: decimals});
  },
  significant: (value, digits) => value.toLocaleString('en-US', {maximumSignificantDigits: digits}),
  vector: (v) => `(${v.map((x) => x.toLocaleString('en-US', {maximumFractionDigits: 3})).join(', ')})`,
};

/** A new element; attributes whose value is false, null or undefined are left out, `on...` ones are listeners. */
function element(name, attributes = {}, ...children) {
  const node = name.startsWith('svg:') ? document.createElementNS('http://www.w3.org/2000/svg', name.slice(4))
      : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(key, value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

/** A spec's text that may break at its separators, and only there if that suffices. */
function breakable(spec) {
  return spec.split(/(?<=[/,()])|(?=@)/).flatMap((part, i) => i === 0 ? [part] : [element('wbr'), part]);
}

const byId = (id) => document.getElementById(id);

/** The ray-traced reference can be run as a technique: it takes part in no contest. */
const isTruth = (result) => /^ray($|[@,])/.test(result.spec);

/** Results that compete for being best. */
const contestants = (results) => results.filter((result) => !isTruth(result));
