// Stacked areas, told apart by colour, by pattern and by name.

let patterns = 0;

// A fill of one colour: plain, or with strokes of the paper's colour over it.
function fill(root, color, kind) {
  if (kind === 'plain') return color;
  patterns += 1;
  const id = `fill${patterns}`;
  const shapes = {
    hatch: ['M-2 2L2 -2M0 8L8 0M6 10L10 6', 2.2],
    dots: ['M2 2h.01M6 6h.01', 2.6],
    bars: ['M0 2H8M0 6H8', 1.4],
    cross: ['M0 4H8M4 0V8', 1],
  };
  const [d, width] = shapes[kind];
  root.prepend(svg('defs', {}, svg('pattern', { id, width: 8, height: 8, patternUnits: 'userSpaceOnUse' },
    svg('rect', { width: 8, height: 8, style: `fill:${color}` }),
    svg('path', { d, style: 'stroke:var(--paper)', 'stroke-width': width, 'stroke-linecap': 'round', fill: 'none' }))));
  return `url(#${id})`;
}

// spec: { title, x, y, xUnit, at: column, bands: [{ name, values, color, kind }] }, bottom first.
function stackChart(host, spec) {
  const n = spec.at.length;
  const tops = [];
  let base = new Float64Array(n);
  for (const band of spec.bands) {
    const top = base.map((v, k) => v + (band.values[k] || 0));
    tops.push([base, top]);
    base = top;
  }
  const x = range([spec.at]);
  const y = [0, range([base])[1] * 1.04 || 1];
  const drawn = frame(host, { ...spec, labels: spec.bands.map((b) => b.name) }, x, y);
  const { root, box, sx, sy } = drawn;
  const point = (column) => (k) => `${sx(spec.at[k]).toFixed(1)} ${sy(column[k]).toFixed(1)}`;
  const order = [...Array(n).keys()];
  const styles = [];
  const labels = [];
  spec.bands.forEach((band, b) => {
    const [low, top] = tops[b];
    const paint = fill(root, band.color, band.kind);
    styles.push({ name: band.name, color: band.color, fill: paint });
    const there = order.map(point(top)).join('L');
    const back = order.slice().reverse().map(point(low)).join('L');
    root.append(svg('path', { d: `M${there}L${back}Z`, style: `fill:${paint}`, class: 'band' }));
    if (top[n - 1] - low[n - 1] > 0) {
      labels.push({ y: sy((low[n - 1] + top[n - 1]) / 2), text: band.name, color: 'var(--ink)' });
    }
  });
  if (box.wide) endLabels(root, box, labels);
  host.replaceChildren(root, legend(styles));
  readOut(host, drawn, spec.at, (k) => [
    el('div', { class: 'at' }, `time ${num(spec.at[k])} ${spec.xUnit}`),
    ...spec.bands.map((band, b) => tipRow(styles[b], band.name, num(band.values[k]))).reverse(),
    el('div', { class: 'row sum' }, el('span', {}, 'all'), el('b', {}, num(base[k]))),
  ]);
}
