// trade.js - the page of the trade: what each method says of trade.c's motions, how long that takes
// here, and a picture of one that it gets wrong. It comes after scene.js.

const find = (id) => document.getElementById(id);

// As trade.c has them.
const MESHES = 3;
const SETS = [
  {name: 'Plate past rack', kind: 'thin and fast', story: 'A plate flies past a dish rack'},
  {name: 'Mug past mug', kind: 'in the open', story: 'A mug flies past a mug'},
  {name: 'Mug through rack', kind: 'in a hollow', story: 'A mug moves through a dish rack'},
  {name: 'Plate into slot', kind: 'a close fit', story: 'A plate is put into a slot of a dish rack'},
];
// As neuralsvcd.h has them.
const HIT = 2;
const [FIRST, DISTANCE] = [1, 2];
const SIZES = ['tiny', 'small', 'base'];
const AT_REST = {position: [0, 0, 0], rotation: [0, 0, 0, 1]};

// From fast to sure.
const THICKER = 0.002;  // metres
const SETTINGS = [
  ...[4, 8, 16, 32, 64, 128].map((samples) =>
    ({kind: 'samples', samples, near: 0, stop: samples, name: `${samples} samples`})),
  ...[16, 64].map((samples) => ({kind: 'thicker', samples, near: THICKER, stop: samples,
    name: `${samples} samples, ${1000 * THICKER} mm thicker`})),
  ...SIZES.map((size, i) => ({kind: 'network', model: i + 1, stop: size, name: `network, ${size}`})),
  {kind: 'proof', model: 0, stop: '', name: 'proof'},
];
const KINDS = {samples: ['samples of a motion', 'samples'],
  thicker: [`${1000 * THICKER} mm thicker`, `+${1000 * THICKER} mm`], network: ['network', 'network'],
  proof: ['proof', 'proof']};

const CHUNK = 12;  // milliseconds that work may take before hands and eyes get their turn
const GHOSTS = 9;  // of a method without samples

// ---- the module

// What stands in the page as base64 of gzip.
async function unpacked(id) {
  const packed = await fetch(`data:;base64,${find(id).textContent.trim()}`);
  const plain = packed.body.pipeThrough(new DecompressionStream('gzip'));
  return new Response(plain, {headers: {'content-type': 'application/wasm'}});
}
const c = (await WebAssembly.instantiateStreaming(unpacked('module')).catch((error) => {
  find('error').textContent = `This browser cannot run the module: ${error.message}`;
  throw error;
})).instance.exports;
// Views are made anew each time: those of memory that has grown are void.
const floats = (at, count) => new Float32Array(c.memory.buffer, at, count);
const words = (at, count) => new Uint32Array(c.memory.buffer, at, count);
const bytes = (at, count) => new Uint8Array(c.memory.buffer, at, count);
const COUNT = c.trade_count();
const TRIAL = 60;  // bytes of a trial

function check(result) {
  if (!result)
    return;
  const text = bytes(c.trade_result_string(result), 200).slice();
  throw new Error(new TextDecoder().decode(text.slice(0, text.indexOf(0))));
}
function readMeshes() {
  for (let i = 0; i < MESHES; i++) {
    const text = new TextEncoder().encode(find(`mesh-${i}`).textContent);
    const at = c.trade_text(text.length);
    bytes(at, text.length).set(text);
    check(c.trade_read(i, at, text.length));
  }
}
// nsvcd_mesh of A (0) or B (1), copied.
function mesh(which) {
  const [positions, indices, vertices, triangles] = words(c.trade_mesh(which), 4);
  return {positions: floats(positions, 3 * vertices).slice(),
    indices: words(indices, 3 * triangles).slice()};
}
const pose = (f) => ({position: [...f.slice(0, 3)], rotation: [...f.slice(3, 7)]});
const motionOf = (i) =>
  [0, 28].map((past) => pose(floats(c.trade_trials() + TRIAL * i + past, 7)));
const isHit = (i) => words(c.trade_trials() + TRIAL * i + 56, 1)[0] === 1;

function ask({samples, near, model}, from, to) {
  if (samples)
    c.trade_ask_samples(samples, near, from, to);
  else
    check(c.trade_ask(model, from, to));
}

// The library's answer about a part of a motion, which may go backwards; times are the motion's.
function look(i, from, to, kind) {
  const motion = motionOf(i);
  const ends = [from, to].map((t) => between(...motion, t));
  floats(c.trade_motion(), 14).set(
    ends.flatMap(({position, rotation}) => [...position, ...rotation]));
  check(c.trade_look(kind));
  const f = floats(c.trade_answer(), 102);  // nsvcd_answer
  const w = words(c.trade_answer(), 102);
  const time = (t) => from + (to - from) * t;
  return {hits: w[0] === HIT, first: time(f[5]), distance: f[6], time: time(f[87]),
    point: [...f.slice(80, 83)], triangles: [w[88], w[89]]};
}

// ---- what is known: of each set its motions, and of each setting what it says of them

const known = SETS.map(() => ({trials: null, answers: SETTINGS.map(() => null)}));
let set = 0;
let setting = 2;
let shown = null;  // the number of the motion in the picture
let job = 0;       // the number of the work that goes on behind; it ends when there is a later one
const answers = () => known[set].answers;
const counts = ({missed, alarms}) => missed.length + alarms.length;

const pause = () => new Promise((resolve) => setTimeout(resolve));

// Resolves to false if another set was chosen meanwhile.
async function makeMotions(mine) {
  c.trade_choose(set);
  const trials = () => bytes(c.trade_trials(), TRIAL * COUNT);
  if (known[set].trials) {
    trials().set(known[set].trials);
    return true;
  }
  for (let i = 0; i < COUNT;) {
    for (const end = performance.now() + CHUNK; i < COUNT && performance.now() < end; i++)
      c.trade_make(i, i + 1);
    await pause();
    if (mine !== job)
      return false;
  }
  known[set].trials = trials().slice();
  return true;
}

// All about one setting but the time that it takes.
function answer(which) {
  if (answers()[which])
    return answers()[which];
  const start = performance.now();
  ask(SETTINGS[which], 0, COUNT);
  const took = performance.now() - start;
  const said = bytes(c.trade_said(), COUNT).slice();
  const all = Array.from(said, (_, i) => i);
  const missed = all.filter((i) => isHit(i) && !said[i]).map((i) => missedBy(SETTINGS[which], i));
  const alarms = all.filter((i) => !isHit(i) && said[i])
    .map((i) => ({i, ...look(i, 0, 1, DISTANCE)}));
  missed.sort((a, b) => b.share - a.share);
  alarms.sort((a, b) => b.distance - a.distance);
  return answers()[which] = {missed, alarms, took, time: null};
}

// Of a hit: the gaps between samples in which it touches, the share of the motion from the first touch
// to the last one in these, and the first contact. A method without samples has but one gap.
function missedBy({samples}, i) {
  const parts = samples ? samples - 1 : 1;
  const gaps = [];
  let share = 0;
  let contact = null;
  for (let at = 0; at < parts; at = gaps.at(-1) + 1) {
    const touch = look(i, at / parts, 1, FIRST);
    if (!touch.hits)
      break;
    const gap = Math.min(parts - 1, Math.max(at, Math.floor(touch.first * parts)));
    const last = look(i, (gap + 1) / parts, gap / parts, FIRST);
    share += Math.max(0, last.first - touch.first);
    contact ??= {...touch, last: last.first};
    gaps.push(gap);
  }
  return {i, parts, gaps, share, ...contact};
}

// Microseconds of a motion: the least of three runs. It is measured in pieces, so that the page stays
// awake, but in none that are too short for a browser's clock.
async function measure(which, mine) {
  const {took} = answer(which);
  const step = Math.min(COUNT, Math.max(10, Math.floor(COUNT * CHUNK / took)));
  const times = Math.max(1, Math.ceil(CHUNK / took));
  let total = 0;
  for (let from = 0; from < COUNT; from += step) {
    const to = Math.min(COUNT, from + step);
    let least = Infinity;
    for (let run = 0; run < 3; run++) {
      const start = performance.now();
      for (let i = 0; i < times; i++)
        ask(SETTINGS[which], from, to);
      least = Math.min(least, (performance.now() - start) / times);
      await pause();
      if (mine !== job)
        return;
    }
    total += least;
  }
  answers()[which].time = 1000 * total / COUNT;
}

// One after the other: first what every setting says, then how long it takes.
async function work(mine) {
  for (let which = 0; which < SETTINGS.length; which++) {
    answer(which);
    showNumbers();
    await pause();
    if (mine !== job)
      return;
  }
  const first = [setting, ...SETTINGS.keys()];
  for (const which of first) {
    if (answers()[which].time === null)
      await measure(which, mine);
    if (mine !== job)
      return;
    showNumbers();
  }
}

// ---- words

const show = (id, text) => {
  find(id).textContent = text;
};
const percent = (share) => share < 0.001 ? 'less than 0.1 %' : `${(100 * share).toPrecision(share < 0.1 ? 1 : 2)} %`;
const micro = (time) => time === null ? '…' : time.toPrecision(time < 100 ? 2 : 3);
const of = (some, what) => `${some || 'none'} of ${COUNT / 2} ${what}`;

function subject({kind, name}) {
  return kind === 'network' ? `The ${name},` : kind === 'proof' ? 'The proof' : `${name[0].toUpperCase()}${name.slice(1)}`;
}
function showSummary() {
  const {kind, samples} = SETTINGS[setting];
  const {missed, alarms, time} = answer(setting);
  const said = document.createElement('b');
  said.textContent = of(missed.length, 'hits');
  find('summary').replaceChildren(`${subject(SETTINGS[setting])} ${samples ? 'miss' : 'misses'} `, said);
  find('summary').className = missed.length ? '' : 'right';
  find('rest').innerHTML = (kind === 'proof' ? `By definition: here a motion hits if the proof says so. Whether that is
      right was measured <a href="https://github.com/OWNER/neuralsvcd.h/blob/main/tests/bench/RESULTS.md#on-every-set"
      >against exact labels</a>.` :
    `False alarms: <strong>${of(alarms.length, 'free motions')}</strong>.`) +
    ` <strong><span id="time">${micro(time)}</span> µs</strong> a motion, in this browser.`;
}

// What the picture shows, in a sentence.
function sentence(it) {
  const {kind, samples} = SETTINGS[setting];
  if (!it)
    return '';
  if (it.gaps === undefined)
    return `This one is free: never nearer than ${(1000 * it.distance).toPrecision(2)} mm.`;
  const from = `first at ${percent(it.first)} of the motion`;
  if (!it.isWrong)
    return `This one is found: it touches ${from}.`;
  if (!samples)
    return `This one touches ${from}, for ${percent(it.share)} of it. The ${kind} takes it for free.`;
  const [gap, ...more] = it.gaps;
  const others = more.length > 1 ? `, and in ${more.length} more gaps` : more.length ? ', and in one more gap' : '';
  return `This one touches between sample ${gap + 1} and ${gap + 2}${others}, for ${percent(it.share)} of the motion.`;
}

function showMotion() {
  const {list, at, it} = current();
  show('number', list.length ? `${at < 0 ? '–' : at + 1} of ${list.length} wrong` : 'none wrong');
  find('previous').disabled = find('next').disabled = list.length < 2 && at >= 0 || !list.length;
  show('this', sentence(it));
  const key = it?.gaps === undefined ? [['free', 'free']] : it.isWrong && SETTINGS[setting].samples ?
    [['free', 'samples, all free'], ['hit', 'missed between them']] : [['free', 'before'], ['hit', 'contact']];
  find('key').innerHTML = key.map(([colour, words]) =>
    `<span><i style="background: var(--${colour})"></i>${words}</span>`).join('');
}

// For screen readers, when hands rest: else they would be told of every stop.
let telling = 0;
function tell() {
  clearTimeout(telling);
  telling = setTimeout(() => show('status', `${find('summary').textContent}. ${find('this').textContent}`), 600);
}

// ---- the chart and the table

const BOX = {left: 52, right: 352, top: 8, none: 34, first: 48, bottom: 218};
let points = [];  // of the chart: {which, x, y}

function axes() {
  const times = answers().map((a) => a?.time).filter((time) => time);
  const low = Math.floor(Math.log10(Math.min(1, ...times) / 1.2));
  const high = Math.ceil(Math.log10(Math.max(10, ...times) * 1.2));
  const x = (time) => BOX.left + (BOX.right - BOX.left) * (Math.log10(time) - low) / (high - low);
  const y = (wrong) => wrong ? BOX.first + (BOX.bottom - BOX.first) * Math.log10(wrong) / Math.log10(COUNT) :
    (BOX.top + BOX.none) / 2;
  return {x, y, decades: Array.from({length: high - low + 1}, (_, i) => 10 ** (low + i))};
}
const svgText = (x, y, text, more = '') => `<text x="${x}" y="${y}" ${more}>${text}</text>`;

function frameOf({x, y, decades}) {
  const {left, right, top, none, bottom} = BOX;
  let out = `<rect class="none" x="${left}" y="${top}" width="${right - left}" height="${none - top}"/>
    <rect class="frame" x="${left}" y="${top}" width="${right - left}" height="${bottom - top}"/>`;
  for (const time of decades)
    out += `<path class="frame" d="M${x(time)} ${top}V${bottom}"/>` +
      svgText(x(time), bottom + 16, time < 1000 ? `${time} µs` : `${time / 1000} ms`, `text-anchor="${
        time === decades[0] ? 'start' : time === decades.at(-1) ? 'end' : 'middle'}"`);
  for (let wrong = 1; wrong < COUNT; wrong *= 10)
    out += `<path class="frame" d="M${left} ${y(wrong)}H${right}"/>` +
      svgText(left - 6, y(wrong) + 4, wrong, 'text-anchor="end"');
  return out + svgText(left - 6, y(0) + 4, 'none', 'text-anchor="end"') +
    svgText((left + right) / 2, bottom + 31, 'time of a motion', 'text-anchor="middle"') +
    svgText(14, (BOX.first + bottom) / 2, `wrong of ${COUNT}`,
      `text-anchor="middle" transform="rotate(-90 14 ${(BOX.first + bottom) / 2})"`);
}

function drawChart() {
  const {x, y, decades} = axes();
  points = answers().flatMap((a, which) =>
    a?.time ? [{which, x: x(a.time), y: y(counts(a))}] : []);
  let out = frameOf({x, y, decades});
  for (const kind of Object.keys(KINDS)) {
    const mine = points.filter(({which}) => SETTINGS[which].kind === kind);
    const colour = `var(--${kind})`;
    if (mine.length > 1)
      out += `<path d="M${mine.map((p) => `${p.x} ${p.y}`).join('L')}" stroke="${colour}" stroke-width="1.6"/>`;
    for (const p of mine)
      out += `<circle cx="${p.x}" cy="${p.y}" r="${kind === 'proof' ? 6 : 4}" fill="${colour}"
        ><title>${SETTINGS[p.which].name}</title></circle>`;
  }
  const here = points.find(({which}) => which === setting);
  if (here) {
    const isLeft = here.x < (BOX.left + BOX.right) / 2;
    out += `<circle cx="${here.x}" cy="${here.y}" r="10" fill="none" stroke="var(--accent)" stroke-width="3"/>` +
      svgText(here.x + (isLeft ? 15 : -15), here.y + (here.y > BOX.bottom - 12 ? -12 : here.y < BOX.none ? 4 : 16),
        SETTINGS[setting].name, `class="chosen" text-anchor="${isLeft ? 'start' : 'end'}"`);
  }
  find('chart').innerHTML = out;
}

function showNumbers() {
  find('rows').innerHTML = answers().map((a, which) => `<tr${which === setting ? ' aria-current="true"' : ''
  }><th scope="row">${SETTINGS[which].name}</th><td>${micro(a?.time ?? null)}</td><td>${a?.missed.length ?? '…'
  }</td><td>${a?.alarms.length ?? '…'}</td></tr>`).join('');
  show('time', micro(answers()[setting]?.time ?? null));
  drawChart();
}

// ---- the picture

const canvas = find('canvas');
const view = {yaw: 0, pitch: 0.35, zoom: 1, target: [0, 0, 0], size: 1};
let scene = null;  // comes after the first answer
let bodies = [];   // A and B: meshes, and A's middle and radius
const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['free', 'hit', 'doubt', 'grid', 'body-b', 'witness-a', 'witness-b']) {
    const hex = parseInt(style.getPropertyValue(`--${name}`).trim().slice(1), 16);
    colours[name] = [hex >> 16, hex >> 8 & 255, hex & 255].map((x) => x / 255);
  }
}

// The motion in the picture, what is known of it, and its place among those that are wrong.
function current() {
  const {missed, alarms} = answer(setting);
  const list = [...missed, ...alarms];
  const at = list.findIndex(({i}) => i === shown);
  if (at >= 0)
    return {list, at, it: {...list[at], isWrong: true}};
  const it = isHit(shown) ? missedBy({}, shown) : {i: shown, ...look(shown, 0, 1, DISTANCE)};
  return {list, at, it: {...it, isWrong: false}};
}

function loadBodies() {
  bodies = [0, 1].map(mesh);
  const {positions} = bodies[0];
  const [low, high] = [[...positions.slice(0, 3)], [...positions.slice(0, 3)]];
  positions.forEach((x, k) => {
    low[k % 3] = Math.min(low[k % 3], x);
    high[k % 3] = Math.max(high[k % 3], x);
  });
  bodies[0].middle = scaled(add(low, high), 0.5);
  bodies[0].radius = length(subtract(high, low)) / 2;
  for (let which = 0; scene && which < 2; which++)
    scene.loadMesh(`body-${which}`, bodies[which]);
}

// Where the motion goes from left to right, from the side on which the contact is; near enough to see
// the gap between two samples.
function aimView() {
  const {it} = current();
  const motion = motionOf(it.i);
  const way = subtract(motion[1].position, motion[0].position);
  const time = it.first ?? it.time;
  const middle = apply(between(...motion, time), 1, bodies[0].middle);
  view.yaw = Math.atan2(way[1], way[0]) - Math.PI / 2;
  view.pitch = 0.35;
  view.zoom = 1;
  view.target = scaled(add(middle, it.point), 0.5);
  view.size = bodies[0].radius + length(way) / Math.max(4, it.parts ?? 0) / 2;
}
function camera() {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const distance = view.zoom * 1.15 * view.size / FIELD / Math.min(1, width / height);
  return cameraOf({...view, distance}, width, height);
}

// Two triangles, and the point where they meet or are nearest.
function marks(from, {triangles, point}, poses) {
  const list = [];
  for (const which of [1, 0]) {
    const {positions, indices} = bodies[which];
    const [p, q, r] = [0, 1, 2].map((k) => {
      const at = 3 * indices[3 * triangles[which] + k];
      return [...positions.subarray(at, at + 3)];
    });
    scene.loadMesh(`triangle-${which}`,
      {positions: new Float32Array([p, q, r].flat()), indices: new Uint32Array([0, 1, 2])});
    scene.loadLines(`edges-${which}`, [p, q, q, r, r, p]);
    for (const mesh of ['triangle', 'edges'])
      list.push({mesh: `${mesh}-${which}`, pose: poses[which], size: 1, alpha: 1,
        colour: colours[which ? 'witness-b' : 'witness-a']});
  }
  list.push({mesh: 'ball', pose: {...AT_REST, position: point}, size: 3 * metresPerPixel(from, point),
    colour: colours['witness-a'], alpha: 1});
  return list;
}
// Samples; those on both sides of the contact are plainer than the others.
function ghosts(it, motion, time) {
  const parts = it.isWrong && it.parts > 1 ? it.parts : GHOSTS - 1;
  const colourAt = (t) => colours[it.gaps && parts !== it.parts && t > time ? 'hit' : 'free'];
  return Array.from({length: parts + 1}, (_, k) => k / parts).filter((t) => Math.abs(t - time) > 0.003)
    .map((t) => ({mesh: 'body-0', pose: between(...motion, t), size: 1, colour: colourAt(t),
      alpha: Math.abs(t - time) * parts <= 1 ? 0.5 : 0.13}));
}

function draw() {
  const {it} = current();
  const from = camera();
  const at = toScreen(from, it.point);
  find('ring').hidden = !at;
  if (at)
    [find('ring').style.left, find('ring').style.top] = at.map((x) => `${x}px`);
  if (!scene)
    return;
  const size = [from.width, from.height].map((pixels) => Math.round(pixels * devicePixelRatio));
  if (canvas.width !== size[0] || canvas.height !== size[1])  // what is set is cleared
    [canvas.width, canvas.height] = size;
  const motion = motionOf(it.i);
  const time = it.first ?? it.time;
  const moved = between(...motion, time);
  scene.draw(from, [
    {mesh: 'body-1', pose: AT_REST, size: 1, colour: colours['body-b'], alpha: 1},
    {mesh: 'body-0', pose: moved, size: 1, colour: colours[it.gaps ? 'hit' : 'free'], alpha: 1},
  ], ghosts(it, motion, time), marks(from, it, [moved, AT_REST]));
}
let drawing = 0;
function redraw() {
  drawing ||= requestAnimationFrame(() => {
    drawing = 0;
    draw();
  });
}

// ---- what is chosen

// Another setting shows the same motion, if it is wrong about that as well, or about none.
function choose(which) {
  setting = which;
  const {list, at} = current();
  if (at < 0 && list.length)
    shown = list[0].i;
  find('setting').value = which;
  find('setting').setAttribute('aria-valuetext', SETTINGS[which].name);
  find('stops').querySelectorAll('[data-which]').forEach((stop) =>
    stop.classList.toggle('chosen', Number(stop.dataset.which) === which));
  showAll(true);
}
function showAll(anew) {
  showSummary();
  showMotion();
  showNumbers();
  tell();
  if (anew)
    aimView();
  redraw();
}
function step(by) {
  const {list, at} = current();
  shown = list[(Math.max(at, -1) + by + list.length) % list.length].i;
  showAll(true);
}
async function chooseSet(which) {
  const mine = ++job;
  set = which;
  show('story', `${SETS[set].story}. Of ${COUNT} motions, half touch something, often for a moment.`);
  show('summary', 'Making the motions');
  if (!await makeMotions(mine))
    return;
  shown = 1;
  loadBodies();
  choose(setting);
  URL.revokeObjectURL(find('save').href);
  find('save').href = URL.createObjectURL(new Blob([problems()]));
  if (!scene)
    startDrawing();
  await pause();
  await work(mine);
}

// The motions as a problem file, see examples/FORMATS.md.
function problems() {
  const names = [['plate', 'dish_rack'], ['mug', 'mug'], ['mug', 'dish_rack'], ['plate', 'dish_rack']][set];
  const lines = ['nsvcd-problems 1', ...[...new Set(names)].map((name) => `mesh ${name} ${name}.obj`)];
  for (let i = 0; i < COUNT; i++) {
    lines.push(`problem ${i} ${names[0]} 1 ${names[1]} 1  0 0 0  0 0 0 1  ${Number(isHit(i))} nan 2`);
    for (const {position, rotation} of motionOf(i))
      lines.push([...position, ...rotation].map((x) => x.toPrecision(9)).join(' '));
  }
  return `${lines.join('\n')}\n`;
}

// ---- hands

function makeSets() {
  SETS.forEach(({name, kind}, i) => {
    const label = document.createElement('label');
    label.innerHTML = `<input type="radio" name="set" value="${i}">${name} <span>${kind}</span>`;
    find('sets').append(label);
  });
  find('sets').querySelector('input').checked = true;
}
function makeStops() {
  find('setting').max = SETTINGS.length - 1;
  find('handle').style.setProperty('--stops', SETTINGS.length);
  find('stops').innerHTML = SETTINGS.map(({kind, stop}, i) =>
    `<span data-which="${i}"${kind === 'network' ? ' class="long"' : ''}>${stop}</span>`).join('') +
    Object.entries(KINDS).map(([kind, [long, short]]) => `<span class="group" style="border-color: var(--${kind
    }); grid-column: span ${SETTINGS.filter((s) => s.kind === kind).length}">${
      innerWidth > 860 ? long : short}</span>`).join('');
  find('legend').innerHTML = Object.entries(KINDS).map(([kind, [long]]) =>
    `<span><i style="background: var(--${kind})"></i>${long}</span>`).join('');
}

function turnView(x, y) {
  view.yaw -= 0.008 * x;
  view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch + 0.008 * y));
  redraw();
}
function zoom(factor) {
  view.zoom = Math.min(10, Math.max(0.05, view.zoom * factor));
  redraw();
}
const pointers = new Map();  // each that is down, and where
function pointerMove(event) {
  const before = pointers.get(event.pointerId);
  if (!before)
    return;
  const now = [event.clientX, event.clientY];
  pointers.set(event.pointerId, now);
  const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
  const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
  if (other)
    zoom(apart(before) / apart(now));
  else
    turnView(now[0] - before[0], now[1] - before[1]);
}
const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
function keyDown(event) {
  const arrow = ARROWS[event.key];
  const factor = {'+': 0.9, '=': 0.9, '-': 1.1}[event.key];
  if (arrow)
    turnView(-12 * arrow[0], -12 * arrow[1]);
  else if (factor)
    zoom(factor);
  else
    return;
  event.preventDefault();
}
// The point of the chart that is nearest to where it is pressed.
function pressChart(event) {
  if (!(event.buttons & 1) || !points.length)
    return;
  const {left, width} = find('chart').getBoundingClientRect();
  const scale = find('chart').viewBox.baseVal.width / width;
  const top = find('chart').getBoundingClientRect().top;
  const [x, y] = [(event.clientX - left) * scale, (event.clientY - top) * scale];
  const away = (p) => Math.hypot(p.x - x, p.y - y);
  const {which} = points.reduce((best, p) => away(p) < away(best) ? p : best);
  if (which !== setting)
    choose(which);
}

function listen() {
  find('setting').addEventListener('input', () => choose(Number(find('setting').value)));
  find('sets').addEventListener('change', ({target}) => chooseSet(Number(target.value)));
  find('stops').addEventListener('click', ({target}) => target.dataset.which && choose(Number(target.dataset.which)));
  find('previous').addEventListener('click', () => step(-1));
  find('next').addEventListener('click', () => step(1));
  for (const kind of ['pointerdown', 'pointermove'])
    find('chart').addEventListener(kind, pressChart);
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener('pointermove', pointerMove);
  for (const kind of ['pointerup', 'pointercancel'])
    canvas.addEventListener(kind, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener('keydown', keyDown);
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(0.001 * event.deltaY));
  }, {passive: false});
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    readColours();
    redraw();
  });
}

// When there is a first answer, because a graphics card takes its time.
function startDrawing() {
  scene = createScene(canvas);
  if (!scene)
    find('view').append('This browser has no WebGL 2: numbers, but no picture.');
  loadBodies();
  new ResizeObserver(redraw).observe(canvas);
}

readMeshes();
makeSets();
makeStops();
readColours();
listen();
chooseSet(0);
