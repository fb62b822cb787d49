// trade_answers.js - what each method says of trade.c's motions, and how long that takes here: the
// half of trade.html that shows nothing. It comes after scene.js and unpack.js, trade.js after it.

// As trade.c has them.
const MESHES = ['mug', 'dish_rack', 'plate'];
const SETS = [
  {name: 'Plate past rack', kind: 'thin and fast', story: 'A plate flies past a dish rack',
    meshes: [2, 1]},
  {name: 'Mug past mug', kind: 'in the open', story: 'A mug flies past a mug', meshes: [0, 0]},
  {name: 'Mug through rack', kind: 'in a hollow', story: 'A mug flies through a dish rack',
    meshes: [0, 1]},
  {name: 'Plate into slot', kind: 'a close fit', story: 'A plate is put into a slot of a dish rack',
    meshes: [2, 1]},
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
  ...SIZES.map((size, i) =>
    ({kind: 'network', model: i + 1, stop: size, name: `network, ${size}`})),
  {kind: 'proof', model: 0, stop: '', name: 'proof'},
];
// What they are called where there is room, and where there is little.
const KINDS = {
  samples: ['samples of a motion', 'samples'],
  thicker: [`${1000 * THICKER} mm thicker`, `+${1000 * THICKER} mm`],
  network: ['network', 'network'],
  proof: ['proof', 'proof'],
};

const CHUNK = 12;   // milliseconds of work before hands and eyes get their turn
const MAKING = 60;  // the same where there is nothing to be seen yet

// ---- the module

const c = (await WebAssembly.instantiateStreaming(unpacked('module')).catch((error) => {
  find('summary').textContent = 'Not possible';
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
const hasRead = MESHES.map(() => false);
function readMesh(i) {
  if (hasRead[i])
    return;
  const text = new TextEncoder().encode(find(`mesh-${i}`).textContent);
  const at = c.trade_text(text.length);
  bytes(at, text.length).set(text);
  check(c.trade_read(i, at, text.length));
  hasRead[i] = true;
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
  return {hits: w[0] === HIT, time: from + (to - from) * f[kind === FIRST ? 5 : 87], distance: f[6],
    point: [...f.slice(80, 83)], triangles: [w[88], w[89]]};
}

// ---- what is known: of each set its motions, and of each setting what it says of them

const known = SETS.map(() => ({trials: null, answers: SETTINGS.map(() => null)}));
let set = 0;
let job = 0;  // the number of the work that goes on behind; it ends when there is a later one
const answers = () => known[set].answers;
const counts = ({missed, alarms}) => missed.length + alarms.length;

const pause = () => new Promise((resolve) => setTimeout(resolve));

// Resolves to false if another set was chosen meanwhile.
async function makeMotions(mine) {
  SETS[set].meshes.forEach(readMesh);
  c.trade_choose(set);
  const trials = () => bytes(c.trade_trials(), TRIAL * COUNT);
  if (known[set].trials) {
    trials().set(known[set].trials);
    return true;
  }
  for (let i = 0; i < COUNT;) {
    for (const end = performance.now() + MAKING; i < COUNT && performance.now() < end; i++)
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
  ask(SETTINGS[which], 0, 0);  // encodes what the network needs
  const start = performance.now();
  ask(SETTINGS[which], 0, COUNT);
  const took = performance.now() - start;
  const said = bytes(c.trade_said(), COUNT).slice();
  const all = Array.from(said, (_, i) => i);
  const missed = all.filter((i) => isHit(i) && !said[i]).map((i) => missedBy(SETTINGS[which], i));
  const alarms = all.filter((i) => !isHit(i) && said[i])
    .map((i) => ({i, ...look(i, 0, 1, DISTANCE)}));
  missed.sort((a, b) => a.gaps.length - b.gaps.length || b.share - a.share);
  alarms.sort((a, b) => b.distance - a.distance);
  return answers()[which] = {missed, alarms, took, time: null};
}

// Of a hit: the gaps between samples in which it touches, the share of the motion from the first to the
// last touch in these, and the first contact. A method without samples has but one gap.
function missedBy({samples}, i) {
  const parts = samples ? samples - 1 : 1;
  const gaps = [];
  let share = 0;
  let contact = null;
  for (let at = 0; at < parts; at = gaps.at(-1) + 1) {
    const touch = look(i, at / parts, 1, FIRST);
    if (!touch.hits)
      break;
    const gap = Math.min(parts - 1, Math.max(at, Math.floor(touch.time * parts)));
    const last = look(i, (gap + 1) / parts, gap / parts, FIRST);
    share += Math.max(0, last.time - touch.time);
    contact ??= touch;
    gaps.push(gap);
  }
  return {i, parts, gaps, share, ...contact};
}

// Microseconds of a motion, the least so far. It is measured in pieces, so that the page stays awake,
// but in none that are too short for a browser's clock.
async function measure(which, mine) {
  const {took} = answer(which);
  const step = Math.min(COUNT, Math.max(10, Math.floor(COUNT * CHUNK / took)));
  const times = Math.max(1, Math.ceil(CHUNK / took));
  let total = 0;
  for (let from = 0; from < COUNT; from += step) {
    const start = performance.now();
    for (let i = 0; i < times; i++)
      ask(SETTINGS[which], from, Math.min(COUNT, from + step));
    total += (performance.now() - start) / times;
    await pause();
    if (mine !== job)
      return;
  }
  answers()[which].time = Math.min(answers()[which].time ?? Infinity, 1000 * total / COUNT);
}

// The motions as a problem file, see examples/FORMATS.md.
function problems() {
  const names = SETS[set].meshes.map((i) => MESHES[i]);
  const lines = ['nsvcd-problems 1'];
  for (const name of new Set(names))
    lines.push(`mesh ${name} ${name}.obj`);
  for (let i = 0; i < COUNT; i++) {
    const label = Number(isHit(i));
    lines.push(`problem ${i} ${names[0]} 1 ${names[1]} 1  0 0 0  0 0 0 1  ${label} nan 2`);
    for (const {position, rotation} of motionOf(i))
      lines.push([...position, ...rotation].map((x) => x.toPrecision(9)).join(' '));
  }
  return `${lines.join('\n')}\n`;
}
