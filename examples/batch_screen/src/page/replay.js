// The replay: top and side view of some moments of the run on two canvases.

const SHADES = 28;
// From dry to wet: sand to deep water; its lightness falls all the way.
const WATER = [[233, 215, 176], [160, 200, 190], [72, 155, 190], [28, 96, 168], [16, 38, 104]];

function water(share) {
  const at = Math.min(0.9999, Math.max(0, share)) * (WATER.length - 1);
  const [a, b] = [WATER[Math.floor(at)], WATER[Math.floor(at) + 1]];
  return a.map((v, k) => Math.round(v + (b[k] - v) * (at - Math.floor(at))));
}

function colorOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function rgb(hex) {
  return [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
}

// A small picture of a lit sphere.
function sphere(radius, [r, g, b]) {
  const size = Math.max(2, Math.ceil(2 * radius) + 2);
  const canvas = el('canvas', { width: size, height: size });
  const context = canvas.getContext('2d');
  const c = size / 2;
  const tone = (k, add) => `rgb(${[r, g, b].map((v) => Math.round(Math.min(255, v * k + add))).join(' ')})`;
  const light = context.createRadialGradient(c - 0.35 * radius, c - 0.4 * radius, 0.1 * radius, c, c, radius);
  light.addColorStop(0, tone(0.8, 75));
  light.addColorStop(0.45, tone(1, 0));
  light.addColorStop(1, tone(0.62, 0));
  context.fillStyle = radius > 2 ? light : tone(1, 0);
  context.beginPath();
  context.arc(c, c, Math.max(0.7, radius), 0, 2 * Math.PI);
  context.fill();
  return canvas;
}

// Frames of the packed replay: { time, total, counts, x, y, z: 16-bit shares, film: 8-bit shares }.
function unpack(packed) {
  const buffer = bytesOf(packed.data).buffer;
  let at = 0;
  return packed.frames.map(({ time, counts }) => {
    const total = counts.reduce((a, b) => a + b, 0);
    const axis = (k) => new Uint16Array(buffer, at + 2 * k * total, total);
    const out = { time, counts, total, x: axis(0), y: axis(1), z: axis(2), film: new Uint8Array(buffer, at + 6 * total, total) };
    at += 7 * total + (total % 2);
    return out;
  });
}

// Indices of a column in rising order, by buckets: depth in a picture needs no more.
function byDepth(column, backwards) {
  const starts = new Uint32Array(1025);
  const bucket = (v) => (backwards ? 1023 - (v >> 6) : v >> 6);
  for (const v of column) starts[bucket(v) + 1] += 1;
  for (let k = 1; k < 1025; k += 1) starts[k] += starts[k - 1];
  const order = new Uint32Array(column.length);
  for (let k = 0; k < column.length; k += 1) {
    const b = bucket(column[k]);
    order[starts[b]] = k;
    starts[b] += 1;
  }
  return order;
}

// Of discs in order from the nearest, those not wholly behind nearer ones, on a grid of small cells.
class Cover {
  constructor(width, height, cell) {
    this.cell = cell;
    this.columns = Math.ceil(width / cell) + 1;
    this.rows = Math.ceil(height / cell) + 1;
    this.taken = new Uint8Array(this.columns * this.rows);
  }

  // Whether some of a disc can be seen; what it hides is taken from then on.
  seen(x, y, r) {
    const { cell, columns, taken } = this;
    const [left, top] = [Math.max(0, Math.floor((x - r) / cell)), Math.max(0, Math.floor((y - r) / cell))];
    const right = Math.min(columns - 1, Math.floor((x + r) / cell));
    const bottom = Math.min(this.rows - 1, Math.floor((y + r) / cell));
    let free = false;
    for (let j = top; j <= bottom; j += 1) {
      const dy = Math.max(Math.abs(j * cell - y), Math.abs((j + 1) * cell - y));
      for (let i = left; i <= right; i += 1) {
        const at = j * columns + i;
        if (taken[at]) continue;
        free = true;
        const dx = Math.max(Math.abs(i * cell - x), Math.abs((i + 1) * cell - x));
        if (dx * dx + dy * dy <= r * r) taken[at] = 1;
      }
    }
    return free;
  }
}

// Wires, frame and impact plate as the scene has them, m; parts from files are not drawn.
function apparatus(run) {
  const scene = new Map(run.scene || []);
  const mm = (key) => 1e-3 * scene.get(key);
  const radius = 0.5 * mm('screen.diameter_mm');
  const wire = mm('screen.wire_diameter_mm');
  const housed = scene.has('housing.plate_angle_deg');
  if (!(radius > 0)) return null;
  const replaced = new Set(run.scene.filter(([key]) => /^parts\[\d+\]\.name$/.test(key)).map(([, name]) => name));
  const depth = housed ? 0.01 + 0.5 * wire : mm('screen.collect_below_mm') + 0.02;
  const out = { radius, wire, wires: [] };
  if (!replaced.has('wires')) {
    const pitch = mm('screen.aperture_mm') + wire;
    for (let at = 0.5 * pitch; at < radius; at += pitch) out.wires.push(-at, at);
  }
  if (!replaced.has('frame')) out.frame = [-depth, mm('screen.height_mm') + 0.05];
  if (housed && !replaced.has('impact plate')) {
    const [start, high] = [-(radius + 0.002), -depth - mm('housing.plate_gap_mm')];
    const end = -start + mm('housing.outlet_length_mm');
    out.plate = [[start, high], [end, high - (end - start) * Math.tan((scene.get('housing.plate_angle_deg') * Math.PI) / 180)]];
  }
  return out;
}

class View {
  // across, up, deep: axes as indices of x, y, z; `toward` is true if greater depth is nearer.
  constructor(replay, across, up, deep, toward) {
    Object.assign(this, { replay, across, up, deep, toward });
    this.canvas = el('canvas', { class: 'view', role: 'img' });
  }

  span(axis) {
    const [low, high] = this.replay.bounds[axis];
    return [low - this.replay.margin, high + this.replay.margin];
  }

  // Size in pixels of the page for a scale in pixels per metre.
  resize(scale, sharpness) {
    const [left, right] = this.span(this.across);
    const [low, high] = this.span(this.up);
    this.scale = scale * sharpness;
    this.sharp = sharpness;
    const width = Math.ceil((right - left) * scale) + 54;
    const height = Math.ceil((high - low) * scale) + 34;
    this.canvas.width = width * sharpness;
    this.canvas.height = height * sharpness;
    this.canvas.style.width = `${width}px`;
    this.place = (axis, v) => (axis === this.across
      ? (v - left) * this.scale + 38 * sharpness : (high - v) * this.scale + 4 * sharpness);
  }

  draw(frame, sprites, shades) {
    const context = this.canvas.getContext('2d');
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.axes(context);
    this.walls(context);
    const columns = [frame.x, frame.y, frame.z];
    const [px, py] = [this.across, this.up].map((axis) => {
      const [low, high] = this.replay.bounds[axis];
      const [a, b] = [this.place(axis, low), this.place(axis, high)];
      return (q) => a + ((b - a) * q) / 65535;
    });
    const ends = [];
    frame.counts.reduce((sum, n) => { ends.push(sum + n); return sum + n; }, 0);
    const radii = this.replay.radii.map((r) => r * this.scale);
    const cover = new Cover(this.canvas.width, this.canvas.height, Math.max(2, 0.3 * Math.min(...radii)));
    const [xs, ys] = [columns[this.across], columns[this.up]];
    const shown = [];
    for (const k of byDepth(columns[this.deep], this.toward)) {
      let of = 0;
      while (k >= ends[of]) of += 1;
      const [x, y] = [px(xs[k]), py(ys[k])];
      if (cover.seen(x, y, radii[of])) shown.push([k, of, x, y]);
    }
    for (const [k, of, x, y] of shown.reverse()) {
      const picture = sprites[of][shades ? Math.min(SHADES - 1, Math.floor((frame.film[k] * SHADES) / 256)) : 0];
      context.drawImage(picture, x - picture.width / 2, y - picture.height / 2);
    }
  }

  // Behind the spheres: lines of the apparatus at rest, as far as the picture goes.
  walls(context) {
    const walls = this.replay.walls;
    if (!walls) return;
    const [x, y] = [(v) => this.place(this.across, v), (v) => this.place(this.up, v)];
    const [[left, right], [low, high]] = [this.span(this.across), this.span(this.up)];
    context.save();
    context.beginPath();
    context.rect(x(left), y(high), x(right) - x(left), y(low) - y(high));
    context.clip();
    context.strokeStyle = colorOf('--line');
    const line = (...points) => {
      context.beginPath();
      points.forEach(([a, b]) => context.lineTo(x(a), y(b)));
      context.stroke();
    };
    const { radius, wires, wire, frame, plate } = walls;
    if (this.up === 2) {
      context.fillStyle = colorOf('--line');
      for (const at of wires) {
        context.beginPath();
        context.arc(x(at), y(0), Math.max(1, 0.5 * wire * this.scale), 0, 2 * Math.PI);
        context.fill();
      }
      context.lineWidth = 2 * this.sharp;
      if (frame) [-radius, radius].forEach((at) => line([at, frame[0]], [at, frame[1]]));
      if (plate) line(...plate);
    } else {
      context.lineWidth = Math.max(1, wire * this.scale);
      for (const at of wires) {
        const half = Math.sqrt(radius * radius - at * at);
        line([at, -half], [at, half]);
        line([-half, at], [half, at]);
      }
      context.lineWidth = 2 * this.sharp;
      context.beginPath();
      context.arc(x(0), y(0), radius * this.scale, 0, 2 * Math.PI);
      if (frame) context.stroke();
    }
    context.restore();
  }

  axes(context) {
    const s = this.sharp;
    const [ink, rule] = [colorOf('--soft'), colorOf('--rule')];
    context.font = `${11 * s}px system-ui, sans-serif`;
    context.lineWidth = s;
    const [left, right] = this.span(this.across);
    const [low, high] = this.span(this.up);
    const floor = this.place(this.up, low);
    const start = this.place(this.across, left);
    context.strokeStyle = rule;
    context.strokeRect(start, this.place(this.up, high), this.place(this.across, right) - start, floor - this.place(this.up, high));
    context.fillStyle = ink;
    context.textAlign = 'center';
    const wanted = (a, b, pixels) => ticks(1e3 * a, 1e3 * b, ((b - a) * this.scale) / s / pixels);
    for (const v of wanted(left, right, 60)) {
      context.fillText(num(v, 6), this.place(this.across, 1e-3 * v), floor + 13 * s);
    }
    context.textAlign = 'right';
    for (const v of wanted(low, high, 40)) {
      context.fillText(num(v, 6), start - 5 * s, this.place(this.up, 1e-3 * v) + 4 * s);
    }
    const names = ['x', 'y', 'z'];
    context.fillText(`${names[this.across]}, mm`, this.place(this.across, right), floor + 27 * s);
    context.textAlign = 'left';
    context.fillText(`${names[this.up]}, mm`, start + 6 * s, this.place(this.up, high) + 14 * s);
    if (this.up === 2 && low < 0 && high > 0) {
      context.setLineDash([5 * s, 4 * s]);
      context.strokeStyle = ink;
      context.beginPath();
      context.moveTo(start, this.place(2, 0));
      context.lineTo(this.place(this.across, right), this.place(2, 0));
      context.stroke();
      context.setLineDash([]);
    }
  }
}

function replaySection(run) {
  const packed = run.replay;
  const frames = unpack(packed);
  const radii = run.classes.map((c) => (c.diameter_mm ? 0.5e-3 * c.diameter_mm : 1.5e-3));
  const replay = { bounds: packed.bounds, margin: Math.max(...radii), radii, walls: apparatus(run) };
  const views = [new View(replay, 0, 1, 2, true), new View(replay, 0, 2, 1, false)];
  const state = { index: 0, by: 'film', playing: 0, sprites: null };
  const filmed = frames.some((f) => f.film.some((v) => v > 0));
  if (!filmed) state.by = 'class';

  const said = el('output', { class: 'said' });
  const slider = el('input', {
    type: 'range', min: 0, max: frames.length - 1, value: 0, step: 1, 'aria-label': 'moment of the replay',
    oninput: () => { stop(); go(Number(slider.value)); },
  });
  const button = el('button', { type: 'button', onclick: () => (state.playing ? stop() : play()) }, 'Play');
  const key = el('div', { class: 'key' });
  const host = el('div', { class: 'views' }, [['Top view', views[0]], ['Side view', views[1]]]
    .map(([name, view]) => el('figure', {}, el('figcaption', {}, el('h3', {}, name)), view.canvas)));
  const choice = (value, text) => el('label', {}, el('input', {
    type: 'radio', name: 'by', value, checked: state.by === value,
    onchange: () => { state.by = value; state.sprites = null; draw(); },
  }), text);
  const controls = el('div', { class: 'controls' }, button, slider, said,
    filmed ? el('fieldset', {}, el('legend', {}, 'Colour'), choice('film', 'film thickness'), choice('class', 'class')) : null);

  function sprites() {
    const sharp = views[0].scale;
    return radii.map((radius, k) => (state.by === 'film'
      ? Array.from({ length: SHADES }, (_, b) => sphere(radius * sharp, water((b + 0.5) / SHADES)))
      : [sphere(radius * sharp, rgb(colorOf(`--c${k % 8}`)))]));
  }

  function keys() {
    if (state.by === 'class') {
      key.replaceChildren(...run.classes.map((c, k) => el('span', {}, el('i', { class: 'dot', style: `background:var(--c${k % 8})` }), c.name)));
      return;
    }
    const stops = [0, 0.25, 0.5, 0.75, 1].map((v) => `rgb(${water(v).join(' ')})`).join(',');
    key.replaceChildren(el('span', {}, 'film 0'), el('i', { class: 'ramp', style: `background:linear-gradient(90deg,${stops})` }),
      el('span', {}, `${told(packed.film_max, 'm')} and more`));
  }

  function draw() {
    const frame = frames[state.index];
    if (!views[0].scale) return;
    if (!state.sprites) {
      state.sprites = sprites();
      keys();
    }
    for (const view of views) view.draw(frame, state.sprites, state.by === 'film');
    const text = `t = ${frame.time.toFixed(3)} s · ${count(frame.total)} particles`;
    said.textContent = text;
    slider.setAttribute('aria-valuetext', text);
    views.forEach((view, k) => view.canvas.setAttribute('aria-label', `${k ? 'side' : 'top'} view, ${text}`));
  }

  function go(index) {
    state.index = Math.max(0, Math.min(frames.length - 1, index));
    slider.value = state.index;
    draw();
  }

  function play() {
    if (state.index === frames.length - 1) go(0);
    button.textContent = 'Pause';
    state.playing = setInterval(() => {
      if (state.index === frames.length - 1) stop();
      else go(state.index + 1);
    }, 120);
  }

  function stop() {
    clearInterval(state.playing);
    state.playing = 0;
    button.textContent = 'Play';
  }

  function resize() {
    const both = host.clientWidth;
    if (!both) return;
    const column = both >= 700 ? (both - 28) / 2 : both;
    const span = (axis) => packed.bounds[axis][1] - packed.bounds[axis][0] + 2 * replay.margin;
    const scale = Math.min((column - 56) / span(0), 640 / Math.max(span(1), span(2)));
    const sharp = Math.min(2, window.devicePixelRatio || 1);
    for (const view of views) view.resize(scale, sharp);
    state.sprites = null;
    draw();
  }

  let width = 0;
  new ResizeObserver(() => {
    if (host.clientWidth !== width) {
      width = host.clientWidth;
      resize();
    }
  }).observe(host);
  const node = section('Replay', `The spheres not yet collected at some moments; the dashed line of the side view is the height of the wires at rest${replay.walls ? '; wires, frame and impact plate are drawn where they rest' : ''}. Between two moments the screen has shaken several times: this is a series of pictures, not a film.`,
    controls, key, host);
  node.redraw = () => { state.sprites = null; draw(); };
  return node;
}
