// The package of npm, from a folder that it is installed in, with mug.obj: what it answers, against what is known by hand, and
// what it refuses. bindings.sh runs it with --expose-gc.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {setTimeout} from 'node:timers/promises';
import {Body, SvcdError, convexHull, heightField, init, parseMesh, sweep} from 'neuralsvcd';

const close = (a, b, to = 2e-3) => assert.ok(Math.abs(a - b) <= to, `${a}, not ${b}`);
const refuses = (code, ask, line) => assert.throws(ask, (error) => (
  error instanceof SvcdError && error.code === code && error.line === line && error.message.length > 5));
const wrong = (says, ask) => assert.throws(ask, (error) => error instanceof TypeError && says.test(error.message));
const still = [0, 0, 0, 1];
const at = (x, y = 0, z = 0) => [x, y, z, ...still];

assert.throws(() => Body.sphere(1), /init/);
assert.equal(init(), init());
await init();

// A ball of 0.5 goes 10 m along x; a cube of side 2 rests at the origin: they touch at x = -1.5.
const ball = Body.sphere(0.5);
const cube = Body.box([1, 1, 1]);
const a = {body: ball, poses: [at(-5), at(5)]};
const b = {body: cube};
const first = sweep({a, b, ask: 'first'});
assert.equal(first.verdict, 'hit');
assert.equal(first.why, null);
assert.equal(first.inside, false);
close(first.time.low, 0.35);
close(first.time.high, 0.35);
assert.ok(first.time.low < first.time.high);
assert.equal(first.contacts.length, 1);
close(first.contacts[0].normal[0], -1);
close(first.contacts[0].point[0], -1);
close(first.contacts[0].time, 0.35);
close(first.safe.a.position[0], -1.5);
assert.deepEqual(first.safe.a.quaternion, still);
assert.deepEqual(first.safe.b, {position: [0, 0, 0], quaternion: still});
assert.equal(first.depth, 0);
assert.ok(first.work > 0);
const exact = sweep({a, b, ask: 'first', toTime: 1e-5}).time;
assert.ok(exact.high - exact.low <= 1.1e-5);
// Poses in other clothes, the same answer.
const objects = [{position: {x: -5, y: 0, z: 0}, quaternion: {x: 0, y: 0, z: 0, w: 1}}, {position: [5, 0, 0], quaternion: still}];
for (const poses of [objects, [...at(-5), ...at(5)], Float32Array.from([...at(-5), ...at(5)])])
  assert.deepEqual(sweep({a: {body: ball, poses}, b, ask: 'first'}), first);
// Three quarters of the time for the first half of the way; half as large; both move.
close(sweep({a: {body: ball, poses: [at(-5), at(0), at(5)], times: [0, 0.75, 1]}, b, ask: 'first'}).time.high, 0.75 * 0.7);
close(sweep({a: {...a, scale: 2}, b, ask: 'first'}).time.high, 0.3);
close(sweep({a: {body: ball, poses: [at(-5), at(0)]}, b: {body: cube, poses: [at(0), at(-5)]}, ask: 'first'}).time.high, 0.35);
close(sweep({a, b, ask: 'first', clearance: 0.5}).time.high, 0.3);
// Turned by 180 degrees about z about a pivot at x = 1, which stays: its centre goes from 0 to 2.
const turn = {body: ball, poses: [at(0), [2, 0, 0, 0, 0, 1, 0]], pivot: [1, 0, 0]};
close(sweep({a: turn, b: {body: ball, poses: [at(2)]}, ask: 'first'}).time.high, 2 / 3);
// Past it, at a distance of half a metre; above it, at rest; inside it.
const past = {body: ball, poses: [at(-5, 2), at(5, 2)]};
const distance = sweep({a: past, b, ask: 'distance', to: 1e-3});
assert.equal(distance.verdict, 'free');
close(distance.distance.low, 0.5);
close(distance.distance.high, 0.5);
close(distance.nearest.gap, 0.5);
assert.deepEqual(distance.time, {low: 1, high: 1});
assert.equal(sweep({a: past, b, clearance: 0.6}).verdict, 'hit');
const inside = {body: Body.box([0.1, 0.1, 0.1])};
assert.equal(sweep({a: inside, b}).inside, true);
assert.equal(sweep({a: inside, b, surfaces: true}).verdict, 'free');
const rests = {body: cube, poses: [at(0, 0, 1.99), at(0, 0, 3)]};
const deep = sweep({a: rests, b, ask: 'first'});
assert.ok(deep.depth > 0);
assert.equal(deep.contacts[0].time, 0);
const leaves = sweep({a: rests, b, ask: 'first', slop: 0.02});
assert.equal(leaves.verdict, 'free');
close(leaves.depth, 0.01);
close(leaves.pushOut[2], 0.015, 0.006);
const lands = sweep({a: {body: cube, poses: [at(0, 0, 5), at(0, 0, 0)]}, b, ask: 'first', manifold: true}).contacts;
assert.equal(new Set(lands.map(({id}) => id)).size, 4);
const capsule = Body.capsule([0, 0, -1], {x: 0, y: 0, z: 1}, 0.25);
close(sweep({a: {body: capsule, poses: [at(-5), at(5)]}, b: {body: Body.cloud([0, 0, 1, 0, 0, 9], 0.25)}, ask: 'first'}).time.high, 0.45);

// A file, what is made of it, and less work than it takes.
const text = readFileSync('mug.obj');
const mesh = parseMesh(text, {name: 'mug.obj'});
const mug = new Body(mesh);
assert.equal(mug.facts.triangles, mesh.indices.length / 3);
assert.equal(mug.facts.openComponents, 0);
assert.equal(mug.facts.open, false);
close(mug.facts.high[2], Math.max(...mesh.positions.filter((_, i) => i % 3 === 2)));
close(parseMesh(text, {scale: 10, origin: [0, 0, 1]}).positions[2], 10 * (mesh.positions[2] - 1), 1e-5);
assert.deepEqual(parseMesh(text.toString()), mesh);
const falls = {a: {body: mug, poses: [at(0, 0, 0.5), at(0, 0, 0)]}, b: {body: Body.fromBytes(mug.toBytes())}, ask: 'first'};
close(sweep(falls).time.high, 0.81, 0.01);
const unknown = sweep({...falls, work: 1});
assert.deepEqual([unknown.verdict, unknown.why], ['undecided', 'work']);
assert.equal(sweep({a: {body: mug, poses: [at(0, 0, 0.5), at(0, 0, 0.3)]}, b: {body: mug}}).nearest.triangleA, null);
const soup = Float32Array.from(mesh.indices).length && Float32Array.from([...mesh.indices].flatMap((i) => [...mesh.positions.slice(3 * i, 3 * i + 3)]));
assert.equal(new Body({positions: soup}).facts.triangles, mug.facts.triangles);
assert.equal(new Body({positions: mesh.positions, indices: Uint16Array.from(mesh.indices)}, {patches: 16}).facts.patches, 16);
assert.ok(new Body(mesh, {coarse: true}).facts.quantizationError > 0);
close(new Body(mesh, {convexRadius: 0.01}).facts.convexRadius, 0.01);
assert.ok(new Body(mesh, {patchRadius: 0.005}).facts.patches > mug.facts.patches);
const stl = new Uint8Array(84 + 50);
new DataView(stl.buffer).setUint32(80, 1, true);
[0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, i) => new DataView(stl.buffer).setFloat32(96 + 4 * i, x, true));
assert.deepEqual([...parseMesh(stl.buffer).positions], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
const ply = 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n' +
  'property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';
assert.deepEqual([...parseMesh(ply).indices], [0, 1, 2]);
const corners = [];
for (let i = 0; i < 8; i++)
  corners.push(i & 1, i >> 1 & 1, i >> 2);
assert.equal(convexHull([...corners, 0.5, 0.5, 0.5]).indices.length, 36);
// A cube with its corner at 1, 2, 3, without its last two triangles, and a tetrahedron.
const cubeMesh = convexHull(corners);
const shifted = Array.from(cubeMesh.positions, (x, i) => x + i % 3 + 1);
const two = new Body({positions: [...shifted, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1],
  indices: [...cubeMesh.indices.slice(0, 30), 8, 10, 9, 8, 9, 11, 9, 10, 11, 8, 11, 10]});
const {facts} = two;
assert.deepEqual([facts.triangles, facts.components, facts.openComponents], [14, 2, 1]);
assert.ok(facts.openEdges >= 4 && facts.openEdges <= 6 && facts.storedTriangles > 14 && facts.size === two.toBytes().length);
facts.low.forEach((x) => close(x, 0));
facts.high.forEach((x, i) => close(x, i + 2));
close(facts.extent, Math.hypot(2, 3, 4), 0.05);
assert.ok(facts.radius < facts.extent && facts.meanPatchRadius < facts.radius / 4 && facts.meanPatchRadius > 0.01);
assert.equal(new Body({positions: shifted, indices: cubeMesh.indices}).facts.components, 1);
// The third of three triangles, by the only one of another body.
const one = new Body({positions: [0, 0, 0, 0.1, 0, 0, 0, 0.1, 0]});
const three = new Body({positions: [0, 0, 1].flatMap((z, i) => [5 * i, 0, z, 5 * i + 1, 0, z, 5 * i, 1, z])});
const touched = sweep({a: {body: one, poses: [at(10.2, 0.2, 3), at(10.2, 0.2, -3)]}, b: {body: three}, ask: 'first'}).contacts[0];
assert.deepEqual([touched.triangleA, touched.triangleB, touched.patchA], [0, 2, 0]);
close(touched.point[2], 1);
assert.ok(touched.patchB > 0);
const field = heightField([0, 1, 2, NaN], 2, 2, [0.5, 3]);
assert.deepEqual([...field.positions], [0, 0, 0, 0.5, 0, 1, 0, 3, 2]);

// What is refused, in the library's words or by type.
refuses('SYNTAX', () => parseMesh('v 0 0 0\nf 1 2\n'), 2);
refuses('SYNTAX', () => parseMesh('glTF....'));
assert.throws(() => parseMesh('', {name: 'a.fbx'}), /OBJ, STL, PLY and GLB/);
refuses('INDEX', () => new Body({positions: corners, indices: [0, 1, 99]}));
refuses('EMPTY', () => new Body({positions: [], indices: []}));
refuses('NUMBER', () => new Body({positions: [0, 0, 0, 1, 0, NaN, 0, 1, 0]}));
refuses('RADIUS', () => Body.sphere(-1));
refuses('BODY', () => Body.fromBytes(new Uint8Array(1000)));
refuses('QUATERNION', () => sweep({a: {body: ball, poses: [[0, 0, 0, 0, 0, 0, 2]]}, b}));
refuses('TIMES', () => sweep({a: {...a, times: [0, 0.5]}, b}));
refuses('CLEARANCE', () => sweep({a, b, clearance: -1}));
refuses('SLOP', () => sweep({a, b, slop: -1}));
refuses('TOLERANCE', () => sweep({a, b, tolerance: -1}));
refuses('SEGMENTS', () => sweep({a, b, segments: 7}));
refuses('TO', () => sweep({a, b, to: 1}));
refuses('SCALE', () => sweep({a: {...a, scale: -1}, b}));
refuses('SAME', () => sweep({a: b, b}));
wrong(/clearence/, () => sweep({a, b, clearence: 1}));
wrong(/clearance/, () => sweep({a, b, clearance: '1'}));
wrong(/pose/, () => sweep({a: {...a, pose: at(0)}, b}));
wrong(/ask/, () => sweep({a, b, ask: 'last'}));
wrong(/poses/, () => sweep({a: {body: ball, poses: [1, 2, 3]}, b}));
wrong(/poses/, () => sweep({a: {body: ball, poses: objects[0]}, b}));
wrong(/quaternion/, () => sweep({a: {body: ball, poses: [{position: [0, 0, 0]}]}, b}));
wrong(/a pose must be 7 numbers: x y z and quaternion x y z w/, () => sweep({a: {body: ball, poses: [[0, 0, 2], [0, 0, 0]]}, b}));
wrong(/7 each: x y z and quaternion x y z w/, () => sweep({a: {body: ball, poses: [0, 0, 2]}, b}));
wrong(/poses is empty: leave it out/, () => sweep({a, b: {body: cube, poses: []}}));
wrong(/poses is empty/, () => sweep({a, b: {body: cube, poses: new Float32Array()}}));
wrong(/a is a body: write a: \{body: \.\.\.\}/, () => sweep({a: ball, b}));
wrong(/times/, () => sweep({a: {...a, times: [0, 0.5, 1]}, b}));
wrong(/work/, () => sweep({a, b, work: -1}));
wrong(/new Body\(mesh\)/, () => sweep({a: {body: mesh}, b}));
wrong(/indices/, () => new Body({positions: corners, indices: [0, 1, 1.5]}));
wrong(/indices/, () => new Body({positions: corners, indices: [0, 1, -1]}));
wrong(/positions/, () => new Body({positions: [0, 0]}));
wrong(/positions/, () => new Body(undefined));
wrong(/convex/, () => new Body(mesh, {convex: 1}));
wrong(/no 'index', but positions, indices/, () => new Body({positions: corners, index: [0, 1, 2]}));
wrong(/no 'vertices'/, () => new Body({vertices: corners, faces: [0, 1, 2]}));
wrong(/g\.attributes\.position\.array/, () => new Body({attributes: {position: {array: corners}}, index: null}));
wrong(/data/, () => parseMesh(3));
wrong(/file name\? readFileSync/, () => parseMesh('mug.obj'));
wrong(/file name\? readFileSync/, () => parseMesh('parts/A 1.stl', {name: 'A 1.stl'}));

// A warning for each file that is too large or too small, not at the limits.
const warnings = [];
const {warn} = console;
console.warn = (line) => warnings.push(line);
const ofSide = (side, options) => parseMesh(`v 0 0 0\nv ${side} 0 0\nv 0 ${side / 2} 0\nf 1 2 3\n`, options);
ofSide(80, {name: 'cup.obj'});
ofSide(0.5, {scale: 0.001});
[30, 0.001, 1].forEach((side) => ofSide(side));
ofSide(80, {quiet: true});
ofSide(80, {scale: 0.001});
console.warn = warn;
assert.deepEqual(warnings, ['cup.obj: a body of 80 m: are these millimetres? try {scale: 0.001}',
  'neuralsvcd: a body of 0.0005 m: is it too small by a thousand? try {scale: 1}']);

// More bodies than memory has room for, freed at once or when collected.
const large = new Body(heightField(Float32Array.from({length: 250 * 250}, (_, i) => Math.sin(i)), 250, 250, [1, 1]), {open: true}).toBytes();
const times = Math.ceil(2 ** 32 / large.length);
for (let i = 0; i < times; i++)
  Body.fromBytes(large).dispose();
for (let i = 0; i < times; i++) {
  Body.fromBytes(large);
  if (i % 50 === 0) {
    globalThis.gc();
    await setTimeout(0);
  }
}
ball.dispose();
ball.dispose();
assert.throws(() => sweep({a, b}), /disposed/);
assert.throws(() => ball.toBytes(), /disposed/);
console.log(`bindings: npm: answers, files, errors; ${2 * times} bodies of ${(large.length / 1e6).toFixed(1)} MB freed`);
