// The page that lays runs over one another, and the start of either page.

// All keys of some objects, flat: `screen.mesh.a` for nested ones.
function flat(object, before = '') {
  const out = {};
  for (const [key, value] of Object.entries(object || {})) {
    const name = before + key;
    if (value && typeof value === 'object' && !Array.isArray(value)) Object.assign(out, flat(value, `${name}: `));
    else out[name] = value;
  }
  return out;
}

function overlaid(runs, of) {
  return runs.map((run, k) => {
    const xy = of(run);
    return xy && xy[0] && xy[1] && xy[0].length ? { name: run.name, x: xy[0], y: xy[1], ...look(k), width: 2 } : null;
  }).filter(Boolean);
}

function overlayFigure(title, note, runs, of, spec, wide) {
  const series = overlaid(runs, of);
  const to = spec.to && { to: ceiling(series) };
  return series.length ? figure(title, note, (host) => lineChart(host, { title, ...TIME, ...spec, ...to, series }), wide) : null;
}

function resultsTable(runs, names) {
  const has = (get) => runs.some((run) => get(run.summary) !== undefined);
  const at = (...keys) => (s) => keys.reduce((o, key) => (o === undefined || o === null ? undefined : o[key]), s);
  const last = (run, name) => {
    const t = table(run.tables.retained);
    return t.rows && t.column(name) ? t.column(name)[t.rows - 1] : NaN;
  };
  const columns = [
    ['time, s', (run) => num(last(run, 'time_s'))],
    ['retained', (run) => percent(last(run, 'total'))],
    ...names.map((name) => [`retained ${name}`, (run) => percent(last(run, name))]),
    ...[
      ['bridges formed', at('bridges', 'formed'), count],
      ['outside a law’s range', at('bridges', 'outside_law_range'), count],
      ['liquid', at('derived', 'liquid_m3'), (v) => told(v, 'm³')],
      ['liquid imbalance', at('liquid_imbalance'), (v) => num(v, 2)],
      ['largest overlap, share of radius', at('largest_overlap'), (v) => percent(v, 2)],
      ['wall time', at('wall_time_s'), clock],
    ].filter(([, get]) => has(get)).map(([name, get, text]) => [name, (run) => {
      const value = get(run.summary);
      return typeof value === 'number' ? text(value) : '–';
    }]),
  ];
  return grid(['run', ...columns.map(([name]) => name)], runs.map((run) => [run.name, ...columns.map(([, get]) => get(run))]));
}

// A row for each key whose values differ between the runs; nothing where none does.
function differing(runs, all, named) {
  const keys = [...new Set(all.flatMap(Object.keys))].filter((key) => new Set(all.map((o) => JSON.stringify(o[key]))).size > 1);
  if (!keys.length) return null;
  return grid(['', ...runs.map((run) => run.name)], keys.map((key) => {
    const { label, unit } = named(key);
    return [label, ...all.map((o) => told(o[key], unit))];
  }));
}

// What differs between the runs: keys of their scenes, and what follows from these.
function differences(runs) {
  const without = runs.filter((run) => !run.scene).map((run) => run.name);
  const parts = [];
  if (without.length) {
    const all = runs.map(({ summary }) => flat({
      scene: summary.scene, title: summary.title, assumed: summary.assumptions, derived: summary.derived,
    }));
    parts.push(el('p', { class: 'note' }, `Of the assumptions and of what follows from the scenes only: there is no scene.toml of ${without.join(', ')}.`),
      differing(runs, all, named) || el('p', {}, 'Nothing of these.'));
  } else {
    const keys = differing(runs, runs.map((run) => Object.fromEntries(run.scene)), (key) => ({ label: key, unit: '' }));
    parts.push(el('p', { class: 'note' }, 'Keys of the scenes as they were run; – where a scene leaves a key to its default.'),
      keys || el('p', {}, 'The scenes are the same, key by key.'));
    const follows = differing(runs, runs.map(({ summary }) => flat({ derived: summary.derived })), named);
    if (follows) parts.push(el('h3', {}, 'What follows from that'), follows);
  }
  return section('What differs', null, parts);
}

function trompOf(run) {
  const t = table(run.tables.partition);
  if (!t || !t.rows) return null;
  const known = run.classes.filter((c) => c.diameter_mm && t.column(c.name)).sort((a, b) => a.diameter_mm - b.diameter_mm);
  if (known.length < 2) return null;
  return [Float32Array.from(known, (c) => c.diameter_mm), Float32Array.from(known, (c) => t.column(c.name)[t.rows - 1])];
}

function comparePage(data) {
  const { runs } = data;
  const names = [...new Set(runs.flatMap(orderOf))];
  const retained = (name) => (run) => {
    const t = table(run.tables.retained);
    return [t.column('time_s'), t.column(name)];
  };
  const share = { y: 'retained, %', percent: true, from: 0, to: 1.02 };
  const fines = (run) => {
    const t = table(run.tables.liquid);
    if (!t || !t.column('total [m3]')) return null;
    const gone = t.names.filter((name) => name.startsWith('fines')).map((name) => t.column(name));
    return [t.column('time_s'), Float32Array.from(t.column('total [m3]'), (all, k) => gone.reduce((sum, c) => sum + c[k], 0) / all)];
  };
  const alive = (run) => {
    const t = table(run.tables.bridges);
    return t ? [t.column('time_s'), t.column('alive')] : null;
  };
  const charts = [
    overlayFigure('Fraction retained', 'All classes together.', runs, retained('total'), { ...share, tall: 400 }, true),
    ...(names.length > 1 ? names.map((name) => overlayFigure(`Retained of ${name}`, null, runs, retained(name), share)) : []),
    overlayFigure('Partition (Tromp) curves at the end', 'Probability of having passed against diameter.', runs, trompOf,
      { x: 'diameter, mm', xUnit: 'mm', y: 'passed, %', percent: true, from: 0, to: 1.02, points: true }),
    overlayFigure('Liquid gone with the fines', 'Share of all liquid.', runs, fines, { y: 'liquid, %', percent: true, from: 0 }),
    overlayFigure('Bridges alive', null, runs, alive, { y: 'bridges' }),
  ];
  const notes = runs.flatMap((run) => run.notes.map((text) => `${run.name}: ${text}`));
  return [
    el('header', {}, el('p', { class: 'over' }, data.program), el('h1', {}, data.title),
      el('p', { class: 'lead' }, runs.map((run) => run.name).join(', '))),
    section('Results', null, resultsTable(runs, names)),
    el('div', { class: 'charts' }, charts),
    runs.length > 1 ? differences(runs) : null,
    notesSection(notes),
  ];
}

{
  const data = JSON.parse(document.getElementById('data').textContent);
  const host = document.getElementById('page');
  try {
    const parts = data.kind === 'compare' ? comparePage(data) : reportPage(data);
    host.replaceChildren(...parts.filter(Boolean));
  } catch (error) {
    host.append(el('p', { class: 'lead' }, `This page could not be drawn: ${error.message}. The numbers are in the tables beside this file.`));
    throw error;
  }
  // Canvases take their colours when they are drawn: once more when light turns dark.
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    for (const node of host.children) if (node.redraw) node.redraw();
  });
}
