// Line charts: axes with units, direct labels, dashes and markers besides colour, a read-out for
// pointer and arrow keys.

const DASHES = ['', '7 4', '2 3', '9 3 2 3', '4 2', '12 4', '1 4', '6 2 1 2 1 2'];
const MARKS = ['circle', 'square', 'triangle', 'diamond', 'cross', 'plus', 'down', 'ring'];

// How the k-th of several series looks. From the ninth on colours come again, with other dashes
// and marks.
function look(k) {
  const round = Math.floor(k / 8);
  return { color: `var(--c${k % 8})`, dash: DASHES[(k + 3 * round) % 8], mark: MARKS[(k + round) % 8] };
}

const TOTAL = { color: 'var(--ink)', dash: '', mark: '', width: 2.6 };

function mark(kind, x, y, color, r = 3.6) {
  const at = (points) => svg('polygon', {
    points: points.map(([a, b]) => `${(x + a * r).toFixed(1)},${(y + b * r).toFixed(1)}`).join(' '),
    fill: color,
  });
  const strokes = (d) => svg('path', { d, stroke: color, 'stroke-width': 1.8, fill: 'none' });
  switch (kind) {
    case 'circle': return svg('circle', { cx: x, cy: y, r: r * 0.95, fill: color });
    case 'ring': return svg('circle', { cx: x, cy: y, r, fill: 'var(--paper)', stroke: color, 'stroke-width': 1.6 });
    case 'square': return at([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
    case 'triangle': return at([[0, -1.2], [1.1, 0.8], [-1.1, 0.8]]);
    case 'down': return at([[0, 1.2], [1.1, -0.8], [-1.1, -0.8]]);
    case 'diamond': return at([[0, -1.25], [1.25, 0], [0, 1.25], [-1.25, 0]]);
    case 'cross': return strokes(`M${x - r} ${y - r}l${2 * r} ${2 * r}M${x - r} ${y + r}l${2 * r} ${-2 * r}`);
    case 'plus': return strokes(`M${x - 1.2 * r} ${y}h${2.4 * r}M${x} ${y - 1.2 * r}v${2.4 * r}`);
    default: return svg('g');
  }
}

// Round ticks between two numbers, about `wanted` of them.
function ticks(low, high, wanted) {
  const rough = (high - low) / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 2.5, 5, 10].find((k) => k * power >= rough * 0.999);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) out.push(k * step);
  return out;
}

function powers(low, high) {
  const out = [];
  for (let p = Math.ceil(Math.log10(low) - 1e-9); p <= Math.log10(high) + 1e-9; p += 1) out.push(10 ** p);
  while (out.length > 6) for (let k = out.length - 2; k >= 0; k -= 2) out.splice(k, 1);
  return out;
}

// Least and greatest finite number of some columns.
function range(columns) {
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    for (const v of column) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return low > high ? [0, 1] : [low, high];
}

const shorten = (text) => (text.length > 24 ? `${text.slice(0, 23)}…` : text);

// Room, scales and axes of a chart of some width; shared by lines and areas.
function frame(host, spec, x, y) {
  const width = spec.square || Math.max(260, Math.round(host.clientWidth || 600));
  const wide = width >= 520;
  const height = spec.square || Math.round(Math.max(230, Math.min(spec.tall || 330, width * (wide ? 0.56 : 0.72))));
  const words = Math.max(0, ...(spec.labels || []).map((text) => widthOf(shorten(text))));
  const yTicks = spec.log ? powers(...y) : ticks(...y, height / 52);
  const text = (v) => num(spec.percent ? 100 * v : v, 6);
  const box = {
    left: 14 + 7 * Math.max(...yTicks.map((v) => text(v).length), 2),
    right: wide && words ? Math.ceil(16 + words) : 14,
    top: 30, bottom: 40, width, height, wide,
  };
  if (spec.square) box.height = width - box.left - box.right + box.top + box.bottom;
  const inner = [width - box.left - box.right, box.height - box.top - box.bottom];
  const sx = (v) => box.left + ((v - x[0]) / (x[1] - x[0] || 1)) * inner[0];
  const lift = spec.log ? Math.log10 : (v) => v;
  const sy = (v) => box.height - box.bottom - ((lift(v) - lift(y[0])) / (lift(y[1]) - lift(y[0]) || 1)) * inner[1];
  const root = svg('svg', {
    viewBox: `0 0 ${width} ${box.height}`, width, height: box.height, role: 'img', tabindex: 0,
    'aria-label': `${spec.title}: ${spec.y} against ${spec.x}.${spec.square ? '' : ' Arrow keys read values.'}`,
  });
  for (const v of yTicks) {
    const at = Math.round(sy(v)) + 0.5;
    root.append(
      svg('line', { x1: box.left, x2: width - box.right, y1: at, y2: at, class: v === 0 ? 'axis' : 'rule' }),
      svg('text', { x: box.left - 8, y: at + 4, class: 'tick', 'text-anchor': 'end' }, text(v)),
    );
  }
  for (const v of ticks(...x, inner[0] / (wide ? 84 : 64))) {
    const at = Math.round(sx(v)) + 0.5;
    root.append(
      svg('line', { x1: at, x2: at, y1: box.height - box.bottom, y2: box.height - box.bottom + 5, class: 'axis' }),
      svg('text', { x: at, y: box.height - box.bottom + 18, class: 'tick', 'text-anchor': 'middle' }, num(v, 6)),
    );
  }
  root.append(
    svg('line', {
      x1: box.left, x2: width - box.right, y1: box.height - box.bottom + 0.5, y2: box.height - box.bottom + 0.5, class: 'axis',
    }),
    svg('text', { x: 2, y: 14, class: 'name' }, spec.y),
    svg('text', { x: width - box.right, y: box.height - 5, class: 'name', 'text-anchor': 'end' }, spec.x),
  );
  return { root, box, sx, sy };
}

// Labels at the right end of lines, moved apart where they would overlap.
function endLabels(root, box, labels) {
  const gap = 15;
  labels.sort((a, b) => a.y - b.y);
  for (let k = 0; k < labels.length; k += 1) {
    const above = k ? labels[k - 1].at + gap : box.top + 4;
    labels[k].at = Math.max(labels[k].y, above);
  }
  let floor = box.height - box.bottom + 4;
  for (let k = labels.length - 1; k >= 0; k -= 1) {
    labels[k].at = Math.min(labels[k].at, floor);
    floor = labels[k].at - gap;
  }
  const x = box.width - box.right;
  for (const { y, at, text, color } of labels) {
    root.append(
      svg('path', { d: `M${x + 2} ${y}L${x + 9} ${at}`, class: 'lead' }),
      svg('text', { x: x + 12, y: at + 4, class: 'end', style: `fill:${color}` }, shorten(text)),
    );
  }
}

// Swatches that show colour, dash and marker, or the fill of an area.
function swatch(style) {
  const box = svg('svg', { width: 30, height: 12, viewBox: '0 0 30 12', 'aria-hidden': 'true' });
  if (style.fill) {
    box.append(svg('rect', { x: 1, y: 1, width: 28, height: 10, fill: style.fill, stroke: style.color }));
    return box;
  }
  box.append(
    svg('line', {
      x1: 0, x2: 30, y1: 6, y2: 6, stroke: style.color, 'stroke-width': style.width || 1.8, 'stroke-dasharray': style.dash,
    }),
    mark(style.mark, 15, 6, style.color),
  );
  return box;
}

function legend(series) {
  return el('ul', { class: 'legend' }, series.map((s) => el('li', {}, swatch(s), s.name)));
}

// A line and a box that follow the pointer, or the arrow keys, along x.
function readOut(host, drawn, xs, rows) {
  const { root, box, sx } = drawn;
  const line = svg('line', { y1: box.top, y2: box.height - box.bottom, class: 'cursor', visibility: 'hidden' });
  const tip = el('div', { class: 'tip', role: 'status', hidden: true });
  root.append(line);
  host.append(tip);
  let index = -1;
  const show = (k) => {
    index = Math.max(0, Math.min(xs.length - 1, k));
    const at = sx(xs[index]);
    line.setAttribute('x1', at);
    line.setAttribute('x2', at);
    line.setAttribute('visibility', 'visible');
    tip.replaceChildren(...rows(index));
    tip.hidden = false;
    const late = at > 0.6 * box.width || at + 14 + tip.offsetWidth > box.width;
    const left = late ? at - tip.offsetWidth - 14 : at + 14;
    tip.style.left = `${Math.max(0, left)}px`;
    tip.style.top = `${box.top}px`;
  };
  const hide = () => {
    line.setAttribute('visibility', 'hidden');
    tip.hidden = true;
    index = -1;
  };
  root.addEventListener('pointermove', (event) => {
    const bounds = root.getBoundingClientRect();
    const x = ((event.clientX - bounds.left) / bounds.width) * box.width;
    let best = 0;
    for (let k = 1; k < xs.length; k += 1) {
      if (Math.abs(sx(xs[k]) - x) < Math.abs(sx(xs[best]) - x)) best = k;
    }
    show(best);
  });
  root.addEventListener('pointerleave', hide);
  root.addEventListener('blur', hide);
  root.addEventListener('keydown', (event) => {
    const jump = Math.max(1, Math.round(xs.length / 60));
    const to = {
      ArrowRight: index + jump, ArrowLeft: (index < 0 ? xs.length : index) - jump, Home: 0, End: xs.length - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    show(to);
  });
}

// The entry of a rising column nearest to a number; none where it lies outside.
function nearest(column, value) {
  let low = 0;
  let high = column.length - 1;
  if (high < 0) return -1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (column[middle] < value) low = middle + 1;
    else high = middle;
  }
  if (low > 0 && Math.abs(column[low - 1] - value) < Math.abs(column[low] - value)) low -= 1;
  const step = column.length > 1 ? (column[column.length - 1] - column[0]) / (column.length - 1) : 1;
  return Math.abs(column[low] - value) <= 0.75 * Math.abs(step) ? low : -1;
}

function tipRow(style, name, value) {
  return el('div', { class: 'row' }, swatch(style), el('span', {}, name), el('b', {}, value));
}

function linePath(s, sx, sy) {
  let d = '';
  let pen = false;
  for (let k = 0; k < s.x.length; k += 1) {
    const good = Number.isFinite(s.y[k]) && !(s.floor && s.y[k] <= 0);
    if (good) {
      const [x, y] = [sx(s.x[k]).toFixed(1), sy(s.y[k]).toFixed(1)];
      d += pen ? (s.step ? `H${x}V${y}` : `L${x} ${y}`) : `M${x} ${y}`;
    }
    pen = good;
  }
  return d;
}

// A chart of lines. spec: { title, x, y, series: [{ name, x, y, color, dash, mark, width, step }],
// from, to, percent, log, verticals: [{ x, text }], tall, points }.
function lineChart(host, spec) {
  const series = spec.series.filter((s) => s.y.some(Number.isFinite));
  if (!series.length) return;
  const x = spec.across || range(series.map((s) => s.x));
  let y = range(series.map((s) => (spec.log ? s.y.filter((v) => v > 0) : s.y)));
  if (spec.log) {
    y = [10 ** Math.floor(Math.log10(y[0])), 10 ** Math.ceil(Math.log10(y[1]))];
  } else {
    const from = spec.from === undefined ? Math.min(0, y[0]) : spec.from;
    const to = spec.to === undefined ? (y[1] > from ? y[1] + 0.06 * (y[1] - from) : from + 1) : spec.to;
    y = [from, to];
  }
  const labelled = series.filter((s) => !s.quiet);
  const drawn = frame(host, { ...spec, labels: labelled.map((s) => s.name) }, x, y);
  const { root, box, sx, sy } = drawn;
  const labels = [];
  for (const { x: at, text } of spec.verticals || []) {
    const px = sx(at);
    const flip = px > box.width - box.right - 90;
    root.append(
      svg('line', { x1: px, x2: px, y1: box.top, y2: box.height - box.bottom, class: 'mark' }),
      svg('text', { x: px + (flip ? -5 : 5), y: box.top + 11, class: 'tick', 'text-anchor': flip ? 'end' : 'start' }, text),
    );
  }
  series.forEach((s, order) => {
    root.append(svg('path', {
      d: linePath({ ...s, floor: spec.log }, sx, sy), fill: 'none', stroke: s.color,
      'stroke-width': s.width || 1.8, 'stroke-dasharray': s.dash, 'stroke-linejoin': 'round', opacity: s.quiet ? 0.55 : 1,
    }));
    const gap = spec.points ? 1 : Math.max(1, Math.floor(s.x.length / 6));
    const start = spec.points ? 0 : Math.floor(((order + 0.5) * gap) / series.length);
    for (let k = start; k < s.x.length; k += gap) {
      if (Number.isFinite(s.y[k]) && !(spec.log && s.y[k] <= 0)) root.append(mark(s.mark, sx(s.x[k]), sy(s.y[k]), s.color));
    }
    let last = s.y.length - 1;
    while (last >= 0 && !Number.isFinite(s.y[last])) last -= 1;
    if (last >= 0 && !s.quiet && (!spec.log || s.y[last] > 0)) {
      labels.push({ y: sy(s.y[last]), text: s.name, color: s.color });
    }
  });
  if (box.wide && labels.length > 1) endLabels(root, box, labels);
  host.replaceChildren(root);
  if (!box.wide && series.length > 1) host.append(legend(labelled));
  const longest = series.reduce((a, b) => (b.x.length > a.x.length ? b : a));
  readOut(host, drawn, longest.x, (k) => {
    const at = longest.x[k];
    const rows = labelled.map((s) => {
      const j = s.x === longest.x ? k : nearest(s.x, at);
      const v = j < 0 ? NaN : s.y[j];
      return tipRow(s, s.name, spec.percent ? percent(v, 4) : num(v));
    });
    return [el('div', { class: 'at' }, `${spec.x.split(',')[0]} ${num(at)}${spec.xUnit ? ` ${spec.xUnit}` : ''}`), ...rows];
  });
}

// A figure whose chart is drawn again when its width changes.
function figure(title, note, draw, wide) {
  const host = el('div', { class: 'chart' });
  const node = el('figure', { class: wide ? 'wide' : null }, el('figcaption', {}, el('h3', {}, title), note ? el('p', {}, note) : null), host);
  let drawnAt = 0;
  new ResizeObserver(() => {
    if (host.clientWidth && host.clientWidth !== drawnAt) {
      drawnAt = host.clientWidth;
      draw(host);
    }
  }).observe(host);
  node.redraw = () => draw(host);
  return node;
}
