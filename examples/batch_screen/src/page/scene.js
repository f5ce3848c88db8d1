// What was run: the scene, what follows from it, what it assumes.

// Names and values of an object, as a list.
function facts(object, order, badge) {
  return el('dl', {}, Object.entries(object).map(([key, value]) => {
    const { label, unit } = named(key);
    return el('div', {}, el('dt', {}, label, badge ? el('em', {}, badge) : null), el('dd', {}, told(value, unit, order)));
  }));
}

// What a reader asks first: screen, motion, liquid, laws.
function sceneFacts(run) {
  const scene = new Map(run.scene);
  const rows = [];
  const get = (key) => scene.get(key);
  const row = (label, ...cells) => {
    const known = cells.filter(([key]) => get(key) !== undefined).map(([key, unit, before]) => [before, told(get(key), unit)].filter(Boolean).join(' '));
    if (known.length) rows.push([label, known.join(', ')]);
  };
  row('screen', ['screen.aperture_mm', 'mm', 'aperture'], ['screen.wire_diameter_mm', 'mm', 'wires of'], ['screen.diameter_mm', 'mm', 'diameter']);
  row('motion', ['motion.frequency', 'Hz'], ['motion.amplitude_mm', 'mm', 'amplitude x, y, z'], ['motion.phase_deg', '°', 'phase']);
  for (let k = 0; get(`motion.terms[${k}].frequency`) !== undefined; k += 1) {
    row('and', [`motion.terms[${k}].frequency`, 'Hz'], [`motion.terms[${k}].amplitude_mm`, 'mm', 'amplitude']);
  }
  if (get('liquid.moisture_percent') === undefined) rows.push(['liquid', 'none: a dry run']);
  row('moisture', ['liquid.moisture_percent', '% of the dry mass']);
  row('liquid', ['liquid.viscosity', 'Pa s', 'viscosity'], ['liquid.surface_tension', 'N/m', 'surface tension'], ['liquid.density', 'kg/m³']);
  row('capillary force', ['liquid.capillary', ''], ['liquid.capillary_wall', '', 'to walls']);
  row('normal drag', ['liquid.normal_drag', ''], ['liquid.drag', '']);
  row('tangential drag', ['liquid.tangential_drag', ''], ['liquid.tangential_drag_wall', '', 'to walls']);
  row('rupture', ['liquid.rupture', ''], ['liquid.rupture_wall', '', 'to walls'], ['liquid.dynamic_rupture', '', 'dynamic']);
  row('transfer', ['liquid.transfer', '']);
  row('contact stiffness', ['contact.stiffness', 'N/m']);
  const pairs = run.scene.filter(([key]) => /^contacts\[\d+\]\.between$/.test(key));
  row('friction', ...pairs.map(([key, between]) => [key.replace('between', 'friction'), '', [].concat(between).join(' with ')]));
  row('bed', ['packing.from', '', 'from'], ['seed', '', 'seed']);
  row('time', ['time', 's'], ['time_step', 's', 'step of']);
  return rows;
}

const list = (rows) => el('dl', {}, rows.map(([name, text]) => el('div', {}, el('dt', {}, name), el('dd', {}, text))));

function wholeScene(run) {
  const name = run.summary.scene;
  return el('details', {}, el('summary', {}, 'All values of the scene'),
    el('p', { class: 'note' }, `As they were run${name ? `: the scene ${name} with what the command line and the program decided` : ''}; also in scene.toml beside this file.`),
    el('dl', { class: 'keys' }, run.scene.map(([key, value]) => el('div', {}, el('dt', {}, key), el('dd', {}, told(value))))));
}

function sceneSection(run) {
  const { summary } = run;
  const blocks = [];
  const given = run.scene ? sceneFacts(run) : null;
  const block = (title, note, body) => blocks.push(el('div', { class: 'block' }, el('h3', {}, title), note ? el('p', {}, note) : null, body));
  const derived = { ...(summary.derived || {}) };
  const shown = { steps: 'steps', threads: 'threads', escaped: 'spheres escaped' };
  for (const [key, label] of Object.entries(shown)) if (key in summary) derived[label] = summary[key];
  if (typeof summary.largest_overlap === 'number') derived['largest overlap, share of a radius'] = percent(summary.largest_overlap);
  if (given) block('The scene', null, list(given));
  if (Object.keys(derived).length) block('What follows from the scene', null, facts(derived, orderOf(run)));
  const assumptions = summary.assumptions;
  if (assumptions && typeof assumptions === 'object' && Object.keys(assumptions).length) {
    const body = Array.isArray(assumptions)
      ? el('ul', { class: 'plain' }, assumptions.map((text) => el('li', {}, el('em', {}, 'assumed'), ' ', told(text))))
      : facts(assumptions, orderOf(run), 'assumed');
    block('Assumptions', 'Not given by a source; the results depend on them.', body);
  }
  return blocks.length ? el('section', {}, el('div', { class: 'pair' }, blocks), given ? wholeScene(run) : null) : null;
}
