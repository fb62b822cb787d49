// throw.js - the page where one throws things: throw.c's room at 60 Hz, what is shown of it, what
// mouse, fingers and keys do. It comes after scene.js.

const find = (id) => document.getElementById(id);

// As throw.c has them.
const KINDS = ['mug', 'bowl', 'torus', 'box', 'chair', 'bottle', 'gear', 'knot', 'boulder'];
const [WALKER, ROOM, FLOOR, WALLS, BUILT] = [9, 10, 11, 12, 13];
const NOTHING = 0xffffffff;

const STEP = 1 / 60;
const LATE = 5;       // steps before a picture, at most: then all goes slower
const SPEED = 14;     // metres a second: of throwing
const WALKING = 1.6;  // and of walking
const AHEAD = 2.5;    // metres from the eye: where things start
const AT_REST = {position: [0, 0, 0], rotation: [0, 0, 0, 1]};
const COLOURS = ['#d9534f', '#e8973a', '#8e63ce', '#4f86d9', '#b07a4a', '#3fa66b', '#7d8794',
  '#d46aa6', '#8f8b66'];
const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

// ---- the module

const bytes = Uint8Array.from(atob(find('module').textContent.trim()), (c) => c.charCodeAt(0));
const c = (await WebAssembly.instantiate(bytes).catch((error) => {
  find('error').textContent = `This browser cannot run the module: ${error.message}`;
  throw error;
})).instance.exports;
// Views are made anew each time: those of memory that has grown are void.
const floats = (at, count) => new Float32Array(c.memory.buffer, at, count);
const words = (at, count) => new Uint32Array(c.memory.buffer, at, count);

function check(result) {
  if (!result)
    return;
  const text = new Uint8Array(c.memory.buffer, c.throw_result_string(result), 200);
  throw new Error(new TextDecoder().decode(text.slice(0, text.indexOf(0))));
}
function mesh(which) {  // shapes_mesh
  const [positions, indices, vertices, triangles] = words(c.throw_mesh(which), 4);
  return {positions: Float32Array.from(new Float64Array(c.memory.buffer, positions, 3 * vertices)),
    indices: words(indices, 3 * triangles).slice()};
}
// The walker and what was thrown.
function things() {
  const list = [];
  for (let i = 0; i < c.throw_count(); i++) {  // thing
    const at = c.throw_things() + c.throw_size() * i;
    const [kind, asleep] = words(at, 2);
    const pose = floats(at + 8, 7);
    if (kind !== NOTHING && kind !== ROOM)
      list.push({kind, asleep: asleep !== 0,
        pose: {position: [...pose.slice(0, 3)], rotation: [...pose.slice(3, 7)]}});
  }
  return list;
}

// ---- showing

const canvas = find('canvas');
const scene = createScene(canvas);
const view = {yaw: -Math.PI / 2, pitch: 0.5, zoom: 1, target: [0, 0, 0.1]};
const aim = [0.5, 0.45];  // where space throws, shares of the picture
let room;                 // the mesh
let colours;

function readColours() {
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  colours = [...COLOURS, '#2457d6', '', ...dark ? ['#3d4653', '#56616f', '#76849a'] :
    ['#dfe4ea', '#c3ccd8', '#8fa0b5']];
  colours = colours.map(rgb);
}
// So far away that the room fits into the picture.
function camera() {
  const aspect = canvas.clientWidth / canvas.clientHeight;
  const distance = view.zoom * Math.max(11.5, 1 + 4.3 / FIELD / aspect);
  return cameraOf({...view, distance}, canvas.clientWidth, canvas.clientHeight);
}
let drawn = '';  // all that a picture is made of
function draw(list) {
  const from = camera();
  const wanted = JSON.stringify([view, aim, from.width, from.height, devicePixelRatio, colours, list]);
  if (wanted === drawn)
    return;
  drawn = wanted;
  find('aim').style.left = `${aim[0] * from.width}px`;
  find('aim').style.top = `${aim[1] * from.height}px`;
  if (!scene)
    return;
  const size = [from.width, from.height].map((pixels) => Math.round(pixels * devicePixelRatio));
  if (canvas.width !== size[0] || canvas.height !== size[1])  // what is set is cleared
    [canvas.width, canvas.height] = size;
  const pale = (colour) => colour.map((x, i) => 0.45 * x + 0.55 * colours[WALLS][i]);
  const solids = [FLOOR, WALLS, BUILT].map((kind) => ({kind, pose: AT_REST})).concat(list);
  scene.draw(from, solids.map(({kind, pose, asleep}) => ({mesh: kind, pose, size: 1, alpha: 1,
    colour: asleep ? pale(colours[kind]) : colours[kind]})), [], []);
}

// Of the last 60 steps.
const times = [];
const asked = [];
const met = [];
let steps = 0;
let overlaps = 0;  // ever
function remember(list, value) {
  list.push(value);
  if (list.length > 60)
    list.shift();
}
const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
const show = (id, text) => {
  find(id).textContent = text;
};
function showFigures(list) {
  const thrown = list.filter(({kind}) => kind < WALKER);
  show('step-time', [...times].sort((a, b) => a - b)[times.length >> 1].toFixed(1));
  show('questions', mean(asked).toFixed(0));
  show('contacts', mean(met).toFixed(0));
  show('count', thrown.length);
  show('asleep', thrown.filter(({asleep}) => asleep).length);
  show('overlaps', overlaps);
  const place = list.find(({kind}) => kind === WALKER).pose.position;
  show('walker', `at ${place.map((x) => x.toFixed(2)).join(', ')}.`);
}

// ---- playing

const held = new Map();  // by what is held down: to the right and away from the eye
function walk() {
  const {right, back} = camera();
  const away = unit([-back[0], -back[1], 0]);
  let way = [0, 0, 0];
  for (const [x, y] of held.values())
    way = add(way, add(scaled(right, x), scaled(away, y)));
  c.throw_walk(...scaled(unit(way), WALKING).slice(0, 2));
}
function step() {
  const before = words(c.throw_counts(), 2).slice();
  const start = performance.now();
  check(c.throw_step(STEP));
  remember(times, performance.now() - start);
  const after = words(c.throw_counts(), 2);
  remember(asked, after[0] - before[0]);
  remember(met, after[1] - before[1]);
  steps++;
  if (steps % 60 === 0)
    overlaps += c.throw_overlaps();
}

let left = 0;  // seconds to be played
let last = performance.now();
let shown = -1;
function frame(now) {
  left = Math.min(left + Math.max(0, now - last) / 1000, LATE * STEP);
  last = now;
  walk();
  for (; left > 0.9 * STEP; left -= STEP)  // or a clock that trembles would skip steps
    step();
  const list = things();
  draw(list);
  if (steps && Math.floor(steps / 15) !== shown)
    showFigures(list);
  shown = Math.floor(steps / 15);
  requestAnimationFrame(frame);
}

const chosen = () => KINDS.indexOf(document.querySelector('[name=kind]:checked').value);
// To where one aims, by the way that a thing takes which falls.
function throwThing() {
  const from = camera();
  const ray = rayThrough(from, aim[0] * from.width, aim[1] * from.height);
  const start = add(from.eye, scaled(ray, AHEAD));
  const seconds = Math.min(rayMeets(room, AT_REST, 1, start, ray), 25) / SPEED;
  const velocity = add(scaled(ray, SPEED), [0, 0, 9.81 * seconds / 2]);
  const done = c.throw_thing(chosen(), ...start, ...velocity);
  show('error', done ? '' : 'Something is in the way there.');
  setTimeout(show, 1500, 'error', '');
}
function reset() {
  check(c.throw_init());
  for (let i = 0; i < 12; i++)
    c.throw_thing(i % KINDS.length, -0.5 + i % 3, 0.2 - 0.9 * (Math.floor(i / 3) % 2),
      1.2 + Math.floor(i / 6), 0, 0, 0);
}

// ---- hands

function turnView(x, y) {
  view.yaw -= 0.006 * x;
  view.pitch = Math.min(1.5, Math.max(0.1, view.pitch + 0.006 * y));
}
let pressed = null;  // where, and whether it has moved since
function pointerDown(event) {
  if (!event.isPrimary || event.button !== 0)
    return;
  canvas.setPointerCapture(event.pointerId);
  pressed = {x: event.clientX, y: event.clientY, moved: false};
}
function pointerMove(event) {
  if (!event.isPrimary)
    return;
  if (!pressed?.moved)
    [aim[0], aim[1]] = [event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight];
  if (!pressed)
    return;
  const [x, y] = [event.clientX - pressed.x, event.clientY - pressed.y];
  if (!pressed.moved && Math.hypot(x, y) < 8)
    return;
  turnView(x, y);
  pressed = {x: event.clientX, y: event.clientY, moved: true};
}
function pointerUp(event) {
  pointerMove(event);
  if (pressed && !pressed.moved)
    throwThing();
  pressed = null;
}

const WAYS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
  KeyA: [-1, 0], KeyD: [1, 0], KeyW: [0, 1], KeyS: [0, -1]};
function keyDown(event) {
  if (event.ctrlKey || event.metaKey || event.altKey)
    return;
  const own = event.target.closest('button, input, a');  // what has keys of its own
  const kind = find('kinds').querySelectorAll('input')[event.key - 1];
  const turn = {KeyQ: 12, KeyE: -12}[event.code];
  if (WAYS[event.code] && !(own?.type === 'radio' && event.code.startsWith('Arrow')))
    held.set(event.code, WAYS[event.code]);
  else if (kind)
    kind.checked = true;
  else if (event.key === ' ' && !(own && own.type !== 'radio'))
    throwThing();
  else if (turn)
    turnView(turn, 0);
  else if (event.code === 'KeyR' && !event.repeat)
    reset();
  else
    return;
  event.preventDefault();
}

function makeKinds() {
  KINDS.forEach((name, i) => {
    const label = document.createElement('label');
    label.innerHTML = `<input type="radio" name="kind" value="${name}">${name}`;
    label.style.setProperty('--kind', COLOURS[i]);
    label.title = `key ${i + 1}`;
    find('kinds').append(label);
  });
  find('kinds').querySelector('input').checked = true;
}
// For fingers; keys have arrows.
function makePad() {
  for (const [name, sign] of [['Up', '↑'], ['Left', '←'], ['Down', '↓'], ['Right', '→']]) {
    const button = document.createElement('button');
    button.textContent = sign;
    button.tabIndex = -1;
    button.setAttribute('aria-label', `walk ${name.toLowerCase()}`);
    button.style.gridArea = name.toLowerCase();
    button.addEventListener('pointerdown', () => held.set(name, WAYS[`Arrow${name}`]));
    for (const end of ['pointerup', 'pointercancel', 'pointerleave'])
      button.addEventListener(end, () => held.delete(name));
    find('pad').append(button);
  }
}
function listen() {
  canvas.addEventListener('pointerdown', pointerDown);
  canvas.addEventListener('pointermove', pointerMove);
  canvas.addEventListener('pointerup', pointerUp);
  canvas.addEventListener('pointercancel', () => {
    pressed = null;
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    view.zoom = Math.min(3, Math.max(0.3, view.zoom * Math.exp(0.001 * event.deltaY)));
  }, {passive: false});
  addEventListener('keydown', keyDown);
  addEventListener('keyup', (event) => held.delete(event.code));
  addEventListener('blur', () => held.clear());
  find('throw').addEventListener('click', throwThing);
  find('reset').addEventListener('click', reset);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', readColours);
}

makeKinds();
makePad();
readColours();
reset();
room = mesh(ROOM);
for (let kind = 0; scene && kind <= BUILT; kind++)
  if (kind !== ROOM)
    scene.loadMesh(kind, mesh(kind));
if (!scene)
  find('view').append('This browser has no WebGL 2: no picture.');
listen();
requestAnimationFrame(frame);
