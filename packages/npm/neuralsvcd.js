// SPDX-License-Identifier: MIT
// neuralsvcd.js - neuralsvcd.h for node and browsers. neuralsvcd.d.ts says what it does; wasm.js, which is built, holds
// the module (glue.c) and the names of its result codes. Structs are read and written as words of four bytes.
import {codes, wasm} from './wasm.js';

let c;  // the module's exports
let workspace;  // enough for any question
let workspaceSize;
let starting;
let addressOf;  // of a Body, in the module's memory

// Views are made anew each time: those of memory that has grown are void.
const floats = (at, count) => new Float32Array(c.memory.buffer, at, count);
const words = (at, count) => new Uint32Array(c.memory.buffer, at, count);
function text(at) {
  const bytes = new Uint8Array(c.memory.buffer, at);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

export class SvcdError extends Error {
  constructor(code, message, line) {
    super(line ? `line ${line}: ${message}` : message);
    this.name = 'SvcdError';
    this.code = code;
    this.line = line || undefined;
  }
}

function check(result) {
  if (result)
    throw new SvcdError(codes[result], text(c.nsvcd_result_string(result)));
}

function allocate(bytes) {
  const at = c.malloc(Math.max(bytes, 8));
  if (!at)
    check(codes.indexOf('MEMORY'));
  return at;
}

export function init() {
  starting ??= start();
  return starting;
}

async function start() {
  const packed = Uint8Array.from(atob(wasm), (char) => char.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  const {instance} = await WebAssembly.instantiate(await new Response(stream).arrayBuffer());
  instance.exports._initialize?.();
  c = instance.exports;
  check(c.nsvcd_self_test());
  workspaceSize = c.nsvcd_sweep_workspace_size(0);
  workspace = allocate(workspaceSize);
}

// Runs `body` with functions that place zeros and copies of typed arrays in the module's memory until it ends.
function withMemory(body) {
  if (!c)
    throw new Error('neuralsvcd: await init() first');
  const taken = [];
  const room = (bytes) => {
    taken.push(allocate(bytes));
    new Uint8Array(c.memory.buffer, taken.at(-1), bytes).fill(0);
    return taken.at(-1);
  };
  const copy = (array) => {
    const at = room(array.byteLength);
    new Uint8Array(c.memory.buffer).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
    return at;
  };
  try {
    return body(room, copy);
  } finally {
    taken.forEach((at) => c.free(at));
  }
}

// ---- what is given

// A misspelt option must not be a default.
function known(what, options, names) {
  if (typeof options !== 'object' || options === null)
    throw new TypeError(`${what} must be an object`);
  const other = Object.keys(options).find((name) => !names.includes(name));
  if (other !== undefined)
    throw new TypeError(`${what} has no '${other}', but ${names.join(', ')}`);
}

function number(what, value) {
  if (typeof value !== 'number')
    throw new TypeError(`${what} must be a number`);
  return value;
}

function size(what, value) {
  if (!Number.isInteger(value) || value < 0 || value > 0xffffffff)
    throw new TypeError(`${what} must be a whole number, not negative`);
  return value;
}

// As many numbers: an array, or an object that has x, y, z, w. hint: which ones.
function vector(what, value, count, hint = '') {
  const isIterable = typeof value?.[Symbol.iterator] === 'function';
  const numbers = isIterable ? [...value] : ['x', 'y', 'z', 'w'].slice(0, count).map((name) => value?.[name]);
  if (numbers.length !== count || !numbers.every((each) => typeof each === 'number'))
    throw new TypeError(`${what} must be ${count} numbers${hint}`);
  return numbers;
}

function float32(what, array, multiple, hint = '') {
  const isArray = Array.isArray(array) || ArrayBuffer.isView(array) && !(array instanceof DataView);
  if (!isArray || array.length % multiple || Array.isArray(array) && !array.every((each) => typeof each === 'number'))
    throw new TypeError(`${what} must be an array of numbers, ${multiple} each${hint}`);
  return array instanceof Float32Array ? array : Float32Array.from(array);
}

function uint32(what, array, multiple) {
  if (array instanceof Uint32Array && array.length % multiple === 0)
    return array;
  const numbers = float32(what, array, multiple) && Array.from(array);
  return Uint32Array.from(numbers, (each) => size(`each of ${what}`, each));
}

function bytesOf(what, data) {
  if (typeof data === 'string')
    return new TextEncoder().encode(data);
  if (ArrayBuffer.isView(data))
    return new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
  if (data instanceof ArrayBuffer)
    return new Uint8Array(data);
  throw new TypeError(`${what} must be an ArrayBuffer or a typed array`);
}

// ---- meshes

// nsvcd_mesh, copied and freed.
function takeMesh(at) {
  const [positions, indices, vertices, triangles] = words(at, 4);
  const mesh = {positions: floats(positions, 3 * vertices).slice(), indices: words(indices, 3 * triangles).slice()};
  c.nsvcd_mesh_free(at, 0);
  return mesh;
}

// The limits are those of svcd and Python.
function warnOfSize({positions}, scale, name) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  const extent = Math.max(...high.map((most, axis) => most - low[axis]));
  if (extent >= 0.001 && extent <= 30)
    return;
  const rounded = (number) => Number(number.toPrecision(4));
  const question = extent > 30 ? 'are these millimetres?' : 'is it too small by a thousand?';
  const better = rounded(extent > 30 ? scale / 1000 : scale * 1000);
  console.warn(`${name || 'neuralsvcd'}: a body of ${rounded(extent)} m: ${question} try {scale: ${better}}`);
}

export function parseMesh(data, options = {}) {
  known('options', options, ['name', 'scale', 'origin', 'quiet']);
  const {name = '', scale = 1, origin = [0, 0, 0], quiet = false} = options;
  const bytes = bytesOf('data', data);
  const numbers = [0, ...vector('origin', origin, 3), number('scale', scale)];  // 0: the format, which is found
  const parsed = withMemory((room, copy) => {
    const mesh = room(16);
    const fault = room(12);
    const named = copy(new TextEncoder().encode(`${name}\0`));
    if (!c.mesh_parse(named, copy(bytes), bytes.length, copy(Float64Array.from(numbers)), mesh, fault)) {
      if (typeof data === 'string' && /^.{0,300}\.\w+$/.test(data))
        throw new TypeError('data is one short line: a file name? readFileSync(...) reads it');
      const [format, line, reason] = words(fault, 3);
      throw new SvcdError('SYNTAX', `${text(format)}: ${text(reason)}`, line);
    }
    return takeMesh(mesh);
  });
  if (!quiet)
    warnOfSize(parsed, scale, name);
  return parsed;
}

export function convexHull(points) {
  const given = float32('points', points, 3);
  return withMemory((room, copy) => {
    const mesh = room(16);
    check(c.nsvcd_mesh_hull(copy(given), given.length / 3, 0, mesh));
    return takeMesh(mesh);
  });
}

export function heightField(heights, rows, columns, step) {
  const given = float32('heights', heights, 1);
  if (given.length !== size('rows', rows) * size('columns', columns))
    throw new TypeError('heights must be rows * columns numbers');
  const steps = Float32Array.from(vector('step', step, 2));
  return withMemory((room, copy) => {
    const mesh = room(16);
    check(c.nsvcd_mesh_of_heights(copy(given), rows, columns, copy(steps), 0, mesh));
    return takeMesh(mesh);
  });
}

// ---- bodies

const registry = new FinalizationRegistry((at) => c.free(at));
const BODY_OPTIONS = ['patches', 'patchRadius', 'convexRadius', 'open', 'coarse'];
const ADOPTED = Symbol('adopted');  // the constructor is given a body, not a mesh

function encodeMesh(mesh, options) {
  known('options', options, BODY_OPTIONS);
  const {patches = 0, patchRadius = 0, convexRadius = 0, open = false, coarse = false} = options;
  if (mesh?.attributes)
    throw new TypeError('a geometry of three.js is no mesh: give '
      + '{positions: g.attributes.position.array, indices: g.index?.array}');
  known('the mesh', mesh ?? {}, ['positions', 'indices']);
  const positions = float32('positions', mesh?.positions, 3);
  const indices = mesh.indices ? uint32('indices', mesh.indices, 3)
                               : Uint32Array.from({length: positions.length / 3}, (_, i) => i);
  return encoded((out, room, copy) => {
    const at = room(4 * 10);
    words(at, 1)[0] = size('patches', patches);
    floats(at + 4, 2).set([number('patchRadius', patchRadius), number('convexRadius', convexRadius)]);
    words(at, 10)[3] = open ? 1 : 0;
    words(at, 10)[6] = coarse ? 1 : 0;
    const given = room(16);
    const arrays = [copy(positions), copy(indices)];
    words(given, 4).set([...arrays, positions.length / 3, indices.length / 3]);
    return c.nsvcd_encode(given, at, 0, 0, 0, out);
  });
}

// What encode writes to its first argument: a body.
function encoded(encode) {
  return withMemory((room, copy) => {
    const out = room(4);
    check(encode(out, room, copy));
    return words(out, 1)[0];
  });
}

export class Body {
  #at;
  #facts;

  constructor(mesh, options = {}) {
    this.#at = mesh?.[ADOPTED] ?? encodeMesh(mesh, options);
    registry.register(this, this.#at, this);
  }
  static #adopt(at) {
    return new Body({[ADOPTED]: at});
  }
  static sphere(radius) {
    return Body.#adopt(encoded((out) => c.nsvcd_encode_sphere(number('radius', radius), 0, out)));
  }
  static capsule(from, to, radius) {
    const ends = [vector('from', from, 3), vector('to', to, 3)].map((end) => Float32Array.from(end));
    return Body.#adopt(encoded((out, room, copy) => (
      c.nsvcd_encode_capsule(copy(ends[0]), copy(ends[1]), number('radius', radius), 0, out))));
  }
  static box(half, convexRadius = 0) {
    const given = Float32Array.from(vector('half', half, 3));
    return Body.#adopt(encoded((out, room, copy) => (
      c.nsvcd_encode_box(copy(given), number('convexRadius', convexRadius), 0, out))));
  }
  static cloud(points, radius) {
    const given = float32('points', points, 3);
    return Body.#adopt(encoded((out, room, copy) => (
      c.nsvcd_encode_cloud(copy(given), given.length / 3, number('radius', radius), 0, out))));
  }
  static fromBytes(data) {
    const bytes = bytesOf('bytes', data);
    return Body.#adopt(encoded((out) => {
      const at = allocate(bytes.length);
      new Uint8Array(c.memory.buffer).set(bytes, at);
      const result = c.nsvcd_body_load(at, bytes.length, out);
      if (result)
        c.free(at);
      return result;
    }));
  }
  toBytes() {
    const at = addressOf(this);
    return new Uint8Array(c.memory.buffer).slice(at, at + this.facts.size);
  }
  get facts() {
    this.#facts ??= withMemory((room) => {
      const at = room(4 * 25);
      c.nsvcd_body_describe(at, addressOf(this));
      const w = words(at, 25);
      const f = floats(at, 25);
      return Object.freeze({
        size: w[0], patches: w[1], centre: [...f.slice(2, 5)], radius: f[5], extent: f[6],
        low: [...f.slice(7, 10)], high: [...f.slice(10, 13)], meanPatchRadius: f[13], triangles: w[14],
        storedTriangles: w[15], quantizationError: f[16], convexRadius: f[17], components: w[21],
        openComponents: w[22], openEdges: w[23], open: w[24] !== 0,
      });
    });
    return this.#facts;
  }
  dispose() {
    if (!this.#at)
      return;
    registry.unregister(this);
    c.free(this.#at);
    this.#at = 0;
  }
  static {
    addressOf = (body) => {
      if (!(body instanceof Body))
        throw new TypeError('body must be a Body: new Body(mesh)');
      if (!body.#at)
        throw new Error('neuralsvcd: the body was disposed of');
      return body.#at;
    };
  }
}

// ---- questions

const ASKS = ['hit', 'first', 'distance'];
const VERDICTS = ['undecided', 'free', 'hit'];
const WHYS = [null, 'too near', 'work', 'open'];
const NO_TRIANGLE = 0xffffffff;
const MOVER = ['body', 'poses', 'times', 'scale', 'pivot'];
// Where nsvcd_question has them.
const LENGTHS = {to: 17, toTime: 18, clearance: 19, slop: 20, tolerance: 21};
const FLAGS = {manifold: 22, surfaces: 31};
const COUNTS = {work: 24, segments: 25};
const QUESTION = ['a', 'b', 'ask', ...Object.keys({...LENGTHS, ...FLAGS, ...COUNTS})];

function posesOf(poses) {
  const hint = ': x y z and quaternion x y z w';
  if (poses?.length === 0)
    throw new TypeError('poses is empty: leave it out for a body that rests at the origin');
  if (ArrayBuffer.isView(poses) || typeof poses?.[0] === 'number')
    return float32('poses', poses, 7, hint);
  if (!Array.isArray(poses))
    throw new TypeError('poses must be an array');
  return Float32Array.from(poses.flatMap((pose) => (
    pose?.position ? [...vector('position', pose.position, 3), ...vector('quaternion', pose.quaternion, 4)]
                   : vector('a pose', pose, 7, hint))));
}

// nsvcd_mover, written at `at`.
function writeMover(at, what, mover, copy) {
  if (mover instanceof Body)
    throw new TypeError(`${what} is a body: write ${what}: {body: ...}`);
  known(what, mover, MOVER);
  const {body, poses, times, scale = 1, pivot = [0, 0, 0]} = mover;
  const given = poses === undefined ? [] : posesOf(poses);
  const count = given.length / 7;
  const timed = times && float32('times', times, 1);
  if (timed && timed.length !== count)
    throw new TypeError('times must be as many as poses');
  const numbers = [number('scale', scale), ...vector('pivot', pivot, 3)];
  const w = [addressOf(body), count ? copy(given) : 0, count, timed && count ? copy(timed) : 0];
  words(at, 4).set(w);
  floats(at + 16, 4).set(numbers);
}

function writeQuestion(at, question, copy) {
  known('the question', question, QUESTION);
  const {a, b, ask = 'hit', ...options} = question;
  if (!ASKS.includes(ask))
    throw new TypeError(`ask must be one of ${ASKS.join(', ')}`);
  writeMover(at, 'a', a, copy);
  writeMover(at + 32, 'b', b, copy);
  words(at, 17)[16] = ASKS.indexOf(ask);
  for (const [name, value] of Object.entries(options)) {
    if (value === undefined)
      continue;
    if (name in LENGTHS)
      floats(at, 34)[LENGTHS[name]] = number(name, value);
    else if (name in FLAGS)
      words(at, 34)[FLAGS[name]] = value ? 1 : 0;
    else
      words(at, 34)[COUNTS[name]] = size(name, value);
  }
}

const triangle = (number) => (number === NO_TRIANGLE ? null : number);

// nsvcd_contact.
function contactAt(at) {
  const f = floats(at, 13);
  const w = words(at, 13);
  return {
    point: [...f.slice(0, 3)], normal: [...f.slice(3, 6)], gap: f[6], time: f[7],
    triangleA: triangle(w[8]), triangleB: triangle(w[9]), patchA: w[10], patchB: w[11], id: w[12],
  };
}

// nsvcd_answer.
function answerAt(at) {
  const f = floats(at, 102);
  const w = words(at, 102);
  const pose = (n) => ({position: [...f.slice(n, n + 3)], quaternion: [...f.slice(n + 3, n + 7)]});
  return {
    verdict: VERDICTS[w[0]],
    why: WHYS[w[2]],
    inside: w[3] !== 0,
    time: {low: f[4], high: f[5]},
    distance: {low: f[6], high: f[7]},
    safe: {time: f[8], a: pose(9), b: pose(16)},
    depth: f[23],
    pushOut: [...f.slice(24, 27)],
    contacts: Array.from({length: w[27]}, (_, i) => contactAt(at + 4 * (28 + 13 * i))),
    nearest: contactAt(at + 4 * 80),
    work: w[101],
  };
}

export function sweep(question) {
  return withMemory((room, copy) => {
    const asked = room(4 * 34);
    const answer = room(4 * 102);
    writeQuestion(asked, question, copy);
    check(c.nsvcd_sweep(asked, workspace, workspaceSize, answer));
    return answerAt(answer);
  });
}
