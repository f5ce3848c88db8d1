// Elements, numbers and units. All text goes in as text, never as markup.

const SVG = 'http://www.w3.org/2000/svg';

function el(tag, attributes, ...children) {
  const node = document.createElement(tag);
  return dress(node, attributes, children);
}

function svg(tag, attributes, ...children) {
  const node = document.createElementNS(SVG, tag);
  return dress(node, attributes, children);
}

function dress(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== false) node.append(child);
  }
  return node;
}

// Width of a text in pixels, in the font of chart labels.
const ruler = document.createElement('canvas').getContext('2d');

function widthOf(text) {
  ruler.font = `600 12.5px ${getComputedStyle(document.body).fontFamily}`;
  return ruler.measureText(text).width;
}

// Base64 of little-endian bytes.
function bytesOf(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; k += 1) bytes[k] = raw.charCodeAt(k);
  return bytes;
}

// A table as { names, rows, column(name), columns }.
function table(packed) {
  if (!packed) return null;
  const floats = new Float32Array(bytesOf(packed.data).buffer);
  const columns = packed.names.map((_, k) => floats.subarray(k * packed.rows, (k + 1) * packed.rows));
  const column = (name) => columns[packed.names.indexOf(name)];
  return { names: packed.names, rows: packed.rows, columns, column };
}

const SUPER = { '-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹' };

// A number with `digits` significant digits, in words a reader likes: 12 340, 0.0123, 1.2 × 10⁻⁷.
function num(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e7) {
    const [mantissa, power] = value.toExponential(digits - 1).split('e');
    const short = mantissa.includes('.') ? mantissa.replace(/\.?0+$/, '') : mantissa;
    const up = [...String(Number(power))].map((c) => SUPER[c]).join('');
    return `${short.replace('-', '−')} × 10${up}`;
  }
  const whole = Math.floor(Math.log10(size)) + 1;
  const fixed = value.toFixed(Math.max(0, Math.min(12, digits - whole)));
  const short = fixed.includes('.') ? fixed.replace(/\.?0+$/, '') : fixed;
  return thin(short.replace('-', '−'));
}

// Thin spaces between thousands, from five digits on.
function thin(text) {
  const [whole, rest] = text.split('.');
  const spaced = whole.replace('−', '').length > 4
    ? whole.replace(/\B(?=(\d{3})+$)/g, '\u202f') : whole;
  return rest === undefined ? spaced : `${spaced}.${rest}`;
}

const count = (value) => (typeof value === 'number' ? thin(String(Math.round(value))) : '–');
const percent = (value, digits = 3) => `${num(100 * value, digits)} %`;

// Units by the last words of a key, longest first.
const UNITS = [
  ['kg_m3', 'kg/m³'], ['n_m', 'N/m'], ['m_s', 'm/s'], ['pa_s', 'Pa s'], ['percent', '%'],
  ['deg', '°'], ['mm', 'mm'], ['um', 'µm'], ['m3', 'm³'], ['m2', 'm²'], ['ml', 'ml'], ['ul', 'µl'],
  ['kg', 'kg'], ['hz', 'Hz'], ['pa', 'Pa'], ['mpa', 'MPa'], ['j', 'J'], ['g', 'g'], ['m', 'm'],
  ['s', 's'],
];

// { label, unit } of a key such as `screen_diameter_mm`.
function named(key) {
  for (const [suffix, unit] of UNITS) {
    const end = `_${suffix}`;
    if (key.toLowerCase().endsWith(end) && key.length > end.length) {
      return { label: key.slice(0, -end.length).replaceAll('_', ' '), unit };
    }
  }
  return { label: key.replaceAll('_', ' '), unit: '' };
}

// Scales that bring a number of a unit near one.
const PREFIXED = {
  s: [[1, 's'], [1e-3, 'ms'], [1e-6, 'µs'], [1e-9, 'ns']],
  m: [[1, 'm'], [1e-3, 'mm'], [1e-6, 'µm'], [1e-9, 'nm']],
  'm³': [[1e-3, 'l'], [1e-6, 'ml'], [1e-9, 'µl'], [1e-12, 'nl']],
  kg: [[1, 'kg'], [1e-3, 'g'], [1e-6, 'mg']],
  J: [[1, 'J'], [1e-3, 'mJ'], [1e-6, 'µJ'], [1e-9, 'nJ']],
};

function scaleOf(unit, size) {
  const known = PREFIXED[unit];
  if (!known) return [1, unit];
  return known.find(([factor]) => size >= factor) || known[known.length - 1];
}

// A value of a summary as text, whatever it is.
function told(value, unit = '', order = []) {
  if (typeof value === 'number') {
    if (!PREFIXED[unit] || value === 0) return `${num(value)}${unit ? `\u00a0${unit}` : ''}`;
    const [factor, name] = scaleOf(unit, Math.abs(value));
    return `${num(value / factor)}\u00a0${name}`;
  }
  if (Array.isArray(value)) {
    const bare = value.map((v) => told(v)).join(', ');
    return unit && value.every((v) => typeof v === 'number') ? `${bare}\u00a0${unit}` : bare;
  }
  if (value && typeof value === 'object') {
    const keys = Object.keys(value);
    const rank = (key) => (order.includes(key) ? order.indexOf(key) : order.length);
    keys.sort((a, b) => rank(a) - rank(b));
    return keys.map((key) => `${key}: ${told(value[key], unit)}`).join('; ');
  }
  if (value === null || value === undefined) return '–';
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return String(value);
}

// A table of cells; the first column names the rows.
function grid(head, rows, total) {
  const cell = (tag) => (text, k) => el(tag, k ? { class: 'n' } : { scope: tag === 'th' ? 'col' : null }, text);
  const line = (row) => el('tr', {}, el('th', { scope: 'row' }, row[0]),
    row.slice(1).map((text) => el('td', { class: 'n' }, text)));
  return el('div', { class: 'scroll', tabindex: 0 }, el('table', {},
    el('thead', {}, el('tr', {}, head.map((text) => text.replace(', ', ',\u00a0')).map(cell('th')))),
    el('tbody', {}, rows.map(line)),
    total ? el('tfoot', {}, line(total)) : null));
}

function section(title, note, ...children) {
  return el('section', {}, el('h2', {}, title), note ? el('p', { class: 'note' }, note) : null, children);
}
