// The page of one run.

const orderOf = (run) => run.classes.map((c) => c.name);

// A column in another unit.
const times = (column, factor) => Float32Array.from(column, (v) => v * factor);

const TIME = { x: 'time, s', xUnit: 's' };

function head(run, program) {
  const s = run.summary;
  const retained = table(run.tables.retained);
  const last = retained.rows - 1;
  const [first, now] = ['particles_above'].map((name) => retained.column(name)).flatMap((c) => [c[0], c[last]]);
  const total = retained.column('total')[last];
  const time = retained.column('time_s')[last];
  const sum = (object) => (object && typeof object === 'object' ? Object.values(object).reduce((a, b) => a + b, 0) : NaN);
  const passed = sum(s.passed);
  const escaped = typeof s.escaped === 'number' ? s.escaped : 0;
  const binned = first - now - escaped;
  const gone = `${count(binned)} of ${count(first)} spheres lay in the collecting bin${escaped ? `, ${count(escaped)} had escaped in another way` : ''}`;
  const sentence = retained.rows
    ? `After ${num(time)} s, ${passed > binned ? `${count(passed)} spheres had passed the screen, ` : ''}${gone}, and ${percent(total)} of the mass was retained.`
    : 'The run has no rows yet.';
  const tile = (value, text) => el('div', { class: 'tile' }, el('b', {}, value), el('span', {}, text));
  const tiles = [];
  if (retained.rows) tiles.push(tile(percent(total), 'of the mass retained'), tile(count(now), escaped ? 'spheres still there' : 'spheres not collected'));
  if (escaped) tiles.push(tile(count(escaped), 'spheres escaped, counted as retained'));
  const bridges = s.bridges || {};
  if (typeof bridges.formed === 'number') tiles.push(tile(count(bridges.formed), 'bridges formed'));
  if (s.derived && typeof s.derived.liquid_m3 === 'number' && s.derived.liquid_m3 > 0) tiles.push(tile(told(s.derived.liquid_m3, 'm³'), 'liquid'));
  if (typeof s.liquid_imbalance === 'number') tiles.push(tile(num(s.liquid_imbalance, 2), 'liquid imbalance'));
  if (typeof s.wall_time_s === 'number') tiles.push(tile(clock(s.wall_time_s), 'wall time'));
  const fault = s.stopped_by_guard;
  const stopped = typeof fault === 'string' ? el('p', { class: 'fault', role: 'alert' }, el('b', {}, 'Stopped: '), fault) : null;
  return el('header', {}, el('p', { class: 'over' }, [program, run.name].join(' · ')),
    el('h1', {}, s.title || run.name), el('p', { class: 'lead' }, sentence), stopped, el('div', { class: 'tiles' }, tiles));
}

function clock(seconds) {
  if (seconds < 90) return `${num(seconds, 3)} s`;
  if (seconds < 5400) return `${num(seconds / 60, 3)} min`;
  return `${num(seconds / 3600, 3)} h`;
}

function classSeries(run, source, column = (name) => source.column(name)) {
  const at = source.column('time_s');
  return run.classes.map((c, k) => ({ name: c.name, x: at, y: column(c.name), ...look(k) })).filter((s) => s.y);
}

// Above a class that took up liquid, more than its first mass can be retained.
const ceiling = (series) => 1.02 * Math.max(1, ...series.map((s) => range([s.y])[1]));

function retainedFigure(run) {
  const t = table(run.tables.retained);
  const series = [{ name: 'total', x: t.column('time_s'), y: t.column('total'), ...TOTAL }, ...classSeries(run, t)];
  const title = 'Fraction retained';
  return figure(title, 'Mass that is not in the collecting bin over the mass at the start: of everything, and of each class with its films. A class that takes up liquid from others can retain more than 100 %.',
    (host) => lineChart(host, { title, ...TIME, y: 'retained, %', percent: true, from: 0, to: ceiling(series), series, tall: 380 }), true);
}

// Passages per second in bins of a round width.
function rateFigure(run) {
  const retained = table(run.tables.retained);
  const at = retained.column('time_s');
  const end = at[at.length - 1];
  const start = at[0];
  if (!(end > start)) return null;
  const above = retained.column('particles_above');
  // About a dozen passages to a bin, so that the steps are not mere chance.
  const wanted = Math.max(6, Math.min(40, (above[0] - above[above.length - 1]) / 12));
  const [zero, step] = ticks(0, end - start, wanted);
  const width = step - zero;
  const bins = Math.max(1, Math.ceil((end - start) / width - 1e-6));
  const edges = Float32Array.from({ length: bins + 1 }, (_, k) => Math.min(end, start + k * width));
  const rate = (add) => {
    const sums = new Float32Array(bins + 1);
    add((time, n) => {
      const k = Math.min(bins - 1, Math.max(0, Math.floor((time - start) / width + 1e-6)));
      sums[k] += n / (edges[k + 1] - edges[k]);
    });
    sums[bins] = sums[bins - 1];
    return sums;
  };
  const passages = table(run.tables.passages);
  const series = [];
  if (passages) {
    const [when, of] = [passages.column('time_s'), passages.column('class')];
    run.classes.forEach((c, k) => {
      const y = rate((put) => when.forEach((time, row) => { if (of[row] === k) put(time, 1); }));
      if (y.some((v) => v > 0)) series.push({ name: c.name, x: edges, y, step: true, ...look(k) });
    });
  } else {
    const y = rate((put) => above.forEach((n, row) => { if (row) put(at[row] - 1e-4 * width, above[row - 1] - n); }));
    series.push({ name: 'all classes', x: edges, y, step: true, ...TOTAL });
  }
  if (!series.length) return null;
  const title = 'Passage rate';
  return figure(title, `Spheres passing per second, counted over ${num(width)} s.`,
    (host) => lineChart(host, { title, ...TIME, y: 'passages, 1/s', series }));
}

function trompFigure(run) {
  const t = table(run.tables.partition);
  if (!t || !t.rows) return null;
  const known = run.classes.map((c, k) => ({ ...c, k })).filter((c) => c.diameter_mm && t.column(c.name));
  if (known.length < 2) return null;
  known.sort((a, b) => a.diameter_mm - b.diameter_mm);
  const x = Float32Array.from(known, (c) => c.diameter_mm);
  const row = (k) => Float32Array.from(known, (c) => t.column(c.name)[k]);
  const at = t.column('time_s');
  const last = t.rows - 1;
  const rows = [...new Set([Math.round(last / 4), Math.round(last / 2), last])].filter((k) => k > 0 || last === 0);
  const series = rows.map((k, order) => ({
    name: `${num(at[k], 3)} s`, x, y: row(k), ...(k === last ? { ...TOTAL, mark: 'circle' } : look(order)),
  }));
  const get = (name) => (t.column(name) ? t.column(name)[last] : NaN);
  const cut = get('cut_size_mm');
  const verticals = Number.isFinite(cut) ? [{ x: cut, text: `cut size ${num(cut, 3)} mm` }] : [];
  const imperfection = get('imperfection');
  const title = 'Partition (Tromp) curve';
  const found = Number.isFinite(cut)
    ? ' The cut size is where the straight line between two classes crosses one half: with few classes it is rough, and can lie above the aperture.'
    : ' No cut size: the curve does not cross one half.';
  const steep = Number.isFinite(imperfection)
    ? ` Imperfection ${num(imperfection, 3)}: half the distance between the diameters that pass with 25 and 75 %, found in the same way, over the cut size.` : '';
  const note = `Probability of having passed against diameter.${found}${steep}`;
  return figure(title, note, (host) => lineChart(host, {
    title, x: 'diameter, mm', xUnit: 'mm', y: 'passed, %', percent: true, from: 0, to: 1.02, points: true, verticals, series,
  }));
}

// Bands of the liquid: above by class, on fines, on walls, in bridges.
function liquidBands(run, t, factor) {
  const bands = [];
  const walls = ['#8a8f98', '#b08968', '#7f9172', '#a28fb0', '#c2a878', '#6f8fa6'];
  let wall = 0;
  for (const name of t.names) {
    if (!name.endsWith(' [m3]') || name === 'total [m3]') continue;
    const short = name.slice(0, -5);
    const values = times(t.column(name), factor);
    const of = run.classes.findIndex((c) => short === `above ${c.name}` || short === `fines ${c.name}`);
    if (short === 'bridges') bands.push({ name: 'in bridges', values, color: 'var(--bridge)', kind: 'cross', rank: 1 });
    else if (of >= 0 && short.startsWith('above ')) bands.push({ name: `on ${run.classes[of].name}`, values, color: `var(--c${of % 8})`, kind: 'plain', rank: 0 });
    else if (of >= 0 || short === 'fines') bands.push({ name: of >= 0 ? `gone with ${run.classes[of].name}` : 'gone with fines', values, color: of >= 0 ? `var(--c${of % 8})` : 'var(--soft)', kind: 'hatch', rank: 3 });
    else {
      bands.push({ name: short, values, color: walls[wall % walls.length], kind: wall % 2 ? 'bars' : 'dots', rank: 2 });
      wall += 1;
    }
  }
  bands.sort((a, b) => a.rank - b.rank);
  return bands.filter((b) => b.values.some((v) => v > 0));
}

function liquidFigure(run) {
  const t = table(run.tables.liquid);
  if (!t || t.rows < 2) return null;
  const most = range(t.names.map((name, k) => (name.endsWith('[m3]') ? t.columns[k] : [])))[1];
  const [factor, unit] = scaleOf('m³', most);
  const bands = liquidBands(run, t, 1 / factor);
  if (!bands.length) return null;
  const title = 'Where the liquid is';
  return figure(title, 'Plain: on spheres not collected; crossed: in bridges; dotted and barred: on walls; hatched: gone with collected spheres.',
    (host) => stackChart(host, { title, ...TIME, y: `liquid, ${unit}`, at: t.column('time_s'), bands, tall: 400 }), true);
}

function bridgesFigures(run) {
  const t = table(run.tables.bridges);
  if (!t || t.rows < 2) return [];
  const x = t.column('time_s');
  const pick = (names) => names.map(([column, name, k]) => ({ name, x, y: t.column(column), ...(k < 0 ? TOTAL : look(k)) })).filter((s) => s.y);
  const alive = pick([['alive', 'all', -1], ['alive_wall', 'to walls', 0]]);
  const sums = pick([['formed', 'formed', 0], ['ruptured', 'ruptured', 1], ['extrapolated', 'outside a law’s range', 2]]);
  const volume = t.column('mean_v_star');
  const out = [];
  const chart = (title, note, y, series) => {
    if (series.length) out.push(figure(title, note, (host) => lineChart(host, { title, ...TIME, y, series })));
  };
  chart('Bridges alive', volume ? `Their mean reduced volume V* is ${num(volume[t.rows - 1], 3)} at the end.` : null, 'bridges', alive);
  chart('Bridges so far', 'Formed and ruptured since the start, and those formed outside the range in which a law was measured.', 'bridges', sums);
  return out;
}

function peggingFigure(run) {
  const t = table(run.tables.pegging);
  if (!t || t.rows < 2) return null;
  const x = t.column('time_s');
  const all = t.column('apertures');
  if (all && !all.some((v) => v > 0)) return null;
  const share = (column) => Float32Array.from(column, (v, k) => (all ? v / all[k] : v));
  const series = [];
  if (t.column('blocked')) series.push({ name: 'blocked', x, y: share(t.column('blocked')), ...TOTAL });
  series.push(...classSeries(run, t).map((s) => ({ ...s, y: share(s.y) })).filter((s) => s.y.some((v) => v > 0)));
  const title = 'Pegging';
  return figure(title, all ? `Share of the ${count(all[t.rows - 1])} apertures with a sphere stuck in them, and by its class.` : null,
    (host) => lineChart(host, { title, ...TIME, y: all ? 'blocked, %' : 'blocked', percent: Boolean(all), from: 0, series }));
}

const ENERGY = 'Of the spheres still there. The curves are no balance: what the moving walls put in, what contacts and drags take out '
  + '(dissipated, in the physics budget) and what leaves with spheres are not among them.';

function energyFigure(run) {
  const t = table(run.tables.energy);
  if (!t || t.rows < 2) return null;
  const names = t.names.filter((name) => name !== 'time_s');
  const columns = names.map((name) => t.column(name));
  if (!columns.some((column) => column.some(Number.isFinite))) return null;
  const [low, high] = range(columns);
  const joules = names.every((name) => /_j$/i.test(name));
  const [factor, unit] = joules ? scaleOf('J', Math.max(Math.abs(low), Math.abs(high))) : [1, ''];
  const series = names.map((name, k) => ({
    name: joules ? named(name).label : name.replaceAll('_', ' '), x: t.column('time_s'), y: times(columns[k], 1 / factor), ...look(k),
  }));
  const title = 'Energy';
  return figure(title, ENERGY, (host) => lineChart(host, { title, ...TIME, y: unit ? `energy, ${unit}` : 'energy', series }));
}

// Where spheres passed, seen from above.
function placesFigure(run) {
  const t = table(run.tables.passages);
  if (!t || t.rows < 1) return null;
  const [x, y, of] = ['x_m', 'y_m', 'class'].map((name) => t.column(name));
  if (!x || !y || !of) return null;
  const { diameter_mm: wide } = run.summary.screen || {};
  const reach = Math.max(...range([x, y]).map(Math.abs), 1e-6);
  const screen = 0.5e-3 * wide >= reach ? 0.5e-3 * wide : 0;
  const edge = 1.08 * Math.max(reach, screen);
  const draw = (host) => {
    const size = Math.min(host.clientWidth, 380);
    const axis = { x: 'x, mm', y: 'y, mm', title: 'Where spheres passed' };
    const drawn = frame(host, { ...axis, square: size }, [-1e3 * edge, 1e3 * edge], [-1e3 * edge, 1e3 * edge]);
    const { root, sx, sy } = drawn;
    if (screen) {
      root.append(svg('ellipse', { cx: sx(0), cy: sy(0), rx: sx(1e3 * screen) - sx(0), ry: sy(0) - sy(1e3 * screen), class: 'outline' }));
    }
    const step = Math.ceil(t.rows / 4000);
    for (let row = 0; row < t.rows; row += step) {
      const k = Math.max(0, of[row]);
      const { color, mark: kind } = look(k);
      root.append(mark(kind, +sx(1e3 * x[row]).toFixed(1), +sy(1e3 * y[row]).toFixed(1), color, 2.4));
    }
    const seen = new Set(of);
    host.replaceChildren(root, legend(run.classes.map((c, k) => ({ name: c.name, ...look(k), dash: '0 99', k })).filter((s) => seen.has(s.k))));
  };
  return figure('Where spheres passed', `Seen from above${screen ? '; the circle is the frame' : ''}.`, draw);
}

function bars(rows, total, unit) {
  const most = Math.max(...rows.map(([, v]) => v));
  return el('table', { class: 'bars' }, el('tbody', {}, rows.map(([name, value]) => el('tr', {},
    el('th', { scope: 'row' }, name),
    el('td', { class: 'bar' }, el('i', { style: `width:${((100 * value) / most).toFixed(1)}%` })),
    el('td', { class: 'n' }, unit(value)), el('td', { class: 'n' }, percent(value / total, 2))))));
}

function splitFigure(run) {
  const split = run.summary.time_split_s;
  if (!split || typeof split !== 'object') return null;
  const rows = Object.entries(split).filter(([, v]) => typeof v === 'number' && v >= 0).map(([k, v]) => [k.replaceAll('_', ' '), v]);
  const known = rows.reduce((sum, [, v]) => sum + v, 0);
  const wall = run.summary.wall_time_s;
  if (!(known > 0)) return null;
  if (typeof wall === 'number' && wall > 1.005 * known) rows.push(['everything else', wall - known]);
  rows.sort((a, b) => b[1] - a[1]);
  const total = rows.reduce((sum, [, v]) => sum + v, 0);
  const { steps } = run.summary;
  const speed = steps && wall ? ` ${num((1e6 * wall) / steps, 3)} µs per step.` : '';
  return el('figure', {}, el('figcaption', {}, el('h3', {}, 'Where the time went'), el('p', {}, `${typeof wall === 'number' ? `${clock(wall)} of wall time.` : ''}${speed} What runs in parallel is summed over the threads.`.trim())), bars(rows, total, clock));
}

function finalSection(run) {
  const s = run.summary;
  const of = (object, name) => (object && typeof object === 'object' ? object[name] : undefined);
  const started = (c) => {
    const listed = Array.isArray(s.classes) ? s.classes.find((k) => k && k.name === c.name) : null;
    return listed && typeof listed.count === 'number' ? listed.count : of(of(s.derived, 'particles'), c.name);
  };
  const t = table(run.tables.retained);
  const lastOf = (name) => (t.rows && t.column(name) ? t.column(name)[t.rows - 1] : NaN);
  const columns = [
    ['at the start', started, count],
    ['passed the screen', (c) => of(s.passed, c.name), count],
    ['collected', (c) => of(s.collected, c.name), count],
    ...(s.escaped ? [['escaped', (c) => of(s.escaped_by_class, c.name), count]] : []),
    [s.escaped ? 'still there' : 'not collected', (c) => of(s.above, c.name), count],
    ['liquid on those not collected, µl', (c) => 1e9 * of(of(s.liquid_m3, 'above'), c.name), num],
  ].map(([name, get, text]) => [name, run.classes.map(get), text])
    .filter(([, values]) => values.some((v) => v >= 0) && values.every(Number.isFinite));
  const retained = (c) => of(of(s.fraction_retained, 'by_class'), c.name) ?? lastOf(c.name);
  const rows = run.classes.map((c, k) => [c.name, c.diameter_mm ? num(c.diameter_mm) : '–',
    ...columns.map(([, values, text]) => text(values[k])), percent(retained(c), 4)]);
  const all = ['all', '', ...columns.map(([, values, text]) => text(values.reduce((a, b) => a + b, 0))),
    percent(of(s.fraction_retained, 'total') ?? lastOf('total'), 4)];
  const parts = [grid(['class', 'diameter, mm', ...columns.map(([name]) => name), 'mass retained'], rows, all)];
  const divisions = divisionsTable(run.liquid_final);
  if (divisions) parts.push(el('h3', {}, 'The liquid at the end'), el('p', { class: 'note' }, 'Live bridges are split as if they broke now.'), divisions);
  const forces = forcesTable(s.physics_budget);
  if (forces) parts.push(el('h3', {}, 'Physics budget'), forces);
  const budget = budgetTable(s.budget, orderOf(run));
  if (budget) parts.push(el('h3', {}, 'Physics budget'), el('p', { class: 'note' }, BUDGET), budget);
  return section('At the end', null, parts);
}

// Where the liquid is at the end, by division and place.
function divisionsTable(rows) {
  if (!Array.isArray(rows) || !rows.length) return null;
  // The table's sums follow what they sum up; here they stand above it. Rounding is shown as 0.
  const [sorted, parts] = [[], []];
  for (const row of rows) {
    if (row[1] === 'all') sorted.push(row, ...parts.splice(0));
    else parts.push(row);
  }
  const texts = sorted.map(([division, place, volume, bridges, share]) => {
    const real = Math.abs(share) > 1e-9;
    return [place === 'all' ? division : `– ${place}`, num(real ? 1e9 * volume : 0), num(real ? 1e9 * bridges : 0), percent(real ? share : 0, 3)];
  });
  return grid(['place', 'liquid, µl', 'of it in bridges, µl', 'share'], texts.slice(0, -1), texts[texts.length - 1]);
}

// What each force has done.
function forcesTable(budget) {
  const forces = budget && Array.isArray(budget.forces) ? budget.forces : [];
  const share = (value) => (typeof value === 'number' ? percent(value, 3) : '–');
  const rows = forces.map((f) => [String(f.force), share(f.share_of_impulse), share(f.of_that_with_walls), share(f.share_of_dissipation), String(f.verdict ?? '')]);
  return rows.length ? grid(['force', 'of the impulse', 'of that with walls', 'of the dissipation', 'verdict'], rows) : null;
}

const BUDGET = 'What each force has done. Impulse: its size summed over all contacts and bridges and over time, as a share of that of all forces; '
  + 'with walls: the part of it that acts between spheres and walls; dissipated: the energy that it took from the motion, as a share of what all took, and by itself; '
  + 'outside law range: the share of the bridges that were formed where the law was not measured.';

// Its columns; the words, which are wide, stand behind the numbers.
const HEADS = {
  force: 'force', impulse_percent: 'impulse', with_walls_percent: 'with walls', dissipated_percent: 'share dissipated',
  dissipated_J: 'energy dissipated', outside_law_range_percent: 'outside law range', verdict: 'verdict',
};

// A list of rows, of objects, or an object: whatever a summary has.
function budgetTable(budget, order) {
  const cell = (value, key) => told(value, key ? named(key).unit : '', order);
  const plain = (value) => value && typeof value === 'object' && !Array.isArray(value);
  if (Array.isArray(budget) && budget.length) {
    if (budget.every(plain)) {
      const keys = [...new Set(budget.flatMap((row) => Object.keys(row)))];
      const known = Object.keys(HEADS);
      const rank = (key) => (known.includes(key) ? known.indexOf(key) : known.length - 1.5);
      keys.sort((a, b) => rank(a) - rank(b));
      const head = (key) => HEADS[key] || named(key).label;
      return grid(keys.map(head), budget.map((row) => keys.map((key) => (key in row ? cell(row[key], key) : ''))));
    }
    const rows = budget.map((row) => (Array.isArray(row) ? row : [row]).map((v) => cell(v)));
    return grid(rows[0].map(() => ''), rows);
  }
  if (plain(budget) && Object.keys(budget).length) {
    return grid(['', ''], Object.entries(budget).map(([key, value]) => [named(key).label, cell(value, key)]));
  }
  return null;
}

function notesSection(notes) {
  return notes.length ? section('About this page', null, el('ul', { class: 'plain' }, notes.map((text) => el('li', {}, text)))) : null;
}

function reportPage(data) {
  const run = data.runs[0];
  const retained = table(run.tables.retained);
  const charts = retained.rows > 1
    ? [retainedFigure(run), rateFigure(run), trompFigure(run), liquidFigure(run), ...bridgesFigures(run), peggingFigure(run), energyFigure(run), placesFigure(run), splitFigure(run)]
    : [splitFigure(run)];
  return [head(run, data.program), sceneSection(run), el('div', { class: 'charts' }, charts),
    run.replay ? replaySection(run) : null, finalSection(run), notesSection(run.notes)];
}
