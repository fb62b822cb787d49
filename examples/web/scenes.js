// scenes.js - the gallery: bodies made here, and their motions. state.js comes after it.

// ---- OBJ texts

// Places and faces, of corners from 0, as OBJ text.
const objOf = (places, faces) => [
  ...places.map((place) => `v ${place.map((x) => +x.toFixed(6)).join(' ')}`),
  ...faces.map((face) => `f ${face.map((corner) => corner + 1).join(' ')}`), ''].join('\n');

// Several bodies as one.
function together(parts) {
  const places = parts.flatMap(([of]) => of);
  let first = 0;
  const faces = parts.flatMap(([of, list]) => {
    const from = first;
    first += of.length;
    return list.map((face) => face.map((corner) => from + corner));
  });
  return objOf(places, faces);
}

// Turns a profile of [radius, z] about z, from its lower end on z to its upper; where `closed`, a
// profile about a hole.
function lathe(profile, sides, closed = false) {
  const places = [];
  const rows = profile.map(([radius, z]) => Array.from({length: sides}, (_, i) => {
    const angle = 2 * Math.PI * i / sides;
    if (radius > 0 || i === 0)
      places.push([radius * Math.cos(angle), radius * Math.sin(angle), z]);
    return places.length - 1;
  }));
  const faces = [];
  for (let row = closed ? 0 : 1; row < rows.length; row++)
    for (let i = 0; i < sides; i++) {
      const [low, high] = [rows.at(row - 1), rows[row]];
      const next = (i + 1) % sides;
      faces.push([...new Set([low[i], low[next], high[next], high[i]])]);
    }
  return [places, faces.filter(({length}) => length > 2)];
}

// A polygon of [x, z], counterclockwise as seen from -y, from y = low to high.
function extrude(polygon, low, high) {
  const n = polygon.length;
  const places = [low, high].flatMap((y) => polygon.map(([x, z]) => [x, y, z]));
  const front = polygon.map((_, i) => i);
  const sides = front.map((i) => [i, n + i, n + (i + 1) % n, (i + 1) % n]);
  return [places, [front, front.map((i) => n + i).reverse(), ...sides]];
}

const box = ([x, y, z], [u, v, w]) => extrude([[x, z], [u, z], [u, w], [x, w]], y, v);
// Upright and square, about [x, y], through these heights.
function bar([x, y], half, heights) {
  const around = [[-half, -half], [half, -half], [half, half], [-half, half]];
  const places = heights.flatMap((z) => around.map(([u, v]) => [x + u, y + v, z]));
  const top = places.length - 4;
  const faces = [[3, 2, 1, 0], [top, top + 1, top + 2, top + 3]];
  for (let low = 0; low < top; low += 4)
    for (let i = 0; i < 4; i++) {
      const next = (i + 1) % 4;
      faces.push([low + i, low + next, low + 4 + next, low + 4 + i]);
    }
  return [places, faces];
}
// All of it, or an arc with both its ends.
function circle(radius, count, from = 0, to = 2 * Math.PI) {
  return Array.from({length: count}, (_, i) => {
    const angle = from + (to - from) * i / (to - from < 6 ? count - 1 : count);
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

function capsule(radius, height) {  // stands on z = 0
  const quarter = Math.PI / 2;
  const end = (z, from) => circle(radius, 7, from, from + quarter).map(([r, up]) =>
    [r < 1e-9 ? 0 : r, z + up]);
  return together([lathe([...end(radius, -quarter), ...end(height - radius, 0)], 24)]);
}
function stairs(steps, run, rise) {
  const outline = [[0, 0], [(steps + 2) * run, 0], [(steps + 2) * run, steps * rise]];
  for (let i = steps; i > 0; i--)
    outline.push([(i - 1) * run, i * rise], ...i > 1 ? [[(i - 1) * run, (i - 1) * rise]] : []);
  return together([extrude(outline, -0.7, 0.7)]);
}
function ring(radius, thickness) {  // in the plane of x and z
  const [places, faces] = lathe(circle(thickness, 12).map(([r, z]) => [radius + r, z]), 48, true);
  return objOf(places.map(([x, y, z]) => [x, -z, y]), faces);
}
function key() {  // its hole at the origin, about z; millimetres
  const bow = lathe([[6, -1.2], [13, -1.2], [13, 1.2], [6, 1.2]], 40, true);
  const bit = (x) => box([x, -8, -1], [x + 4, -2, 1]);
  return together([bow, box([12, -3, -1], [52, 3, 1]), bit(38), bit(46)]);
}
function grating(bars, pitch, thick) {  // in the plane of y and z
  const half = bars * pitch / 2;
  // Of short pieces: a long triangle is one patch, which is near to all of a motion.
  const upright = Array.from({length: bars + 1}, (_, i) => i * pitch - half).map((y) =>
    bar([0, y], thick / 2, Array.from({length: bars + 1}, (_, k) => k * pitch - half)));
  const frame = [-half - 0.01, half].map((z) =>
    box([-0.005, -half - 0.005, z], [0.005, half + 0.005, z + 0.01]));
  return together([...upright, ...frame]);
}
const needle = () => {  // along x, of short pieces as well
  const shaft = Array.from({length: 12}, (_, i) => [0.002, -0.115 + i * 0.015]);
  const point = [1, 2, 3].map((i) => [0.0005 * (4 - i), 0.05 + 0.0175 * i]);
  const [places, faces] = lathe([[0, -0.12], ...shaft, ...point, [0, 0.12]], 12);
  return objOf(places.map(([x, y, z]) => [z, x, y]), faces);
};

// ---- the scenes

const turnedBy = (axis, degrees) => aboutAxis(axis, degrees * Math.PI / 180);
const still = [0, 0, 0, 1];
// A ring that hangs in a key's hole, turned about that hole.
const hanging = (degrees) => {
  const rotation = turnedBy([0, 0, 1], degrees);
  return {position: rotate(rotation, [-0.01, 0, 0]), rotation};
};

// files: A's and B's, [name, what makes its text or the id of an element that has it, which of the
// baked bodies is its], and their scales.
const SCENES = {
  mug: {
    note: 'A mug is carried into a dish rack.',
    files: [['mug.obj', 'mesh-0', 0], ['dish_rack.obj', 'mesh-1', 1]],
    motion: [
      {position: [0.04, -0.4, 0.08], rotation: normalized([0.42, -0.3, -0.48, 0.7])},
      {position: [0, 0, 0.02], rotation: [0, 0, -Math.SQRT1_2, Math.SQRT1_2]},
    ],
  },
  stairs: {
    note: 'A character, which is a capsule, walks up stairs: which step stops it, and when?',
    files: [['character.obj', () => capsule(0.3, 1.8)], ['stairs.obj', () => stairs(6, 0.3, 0.17)]],
    motion: [{position: [-1, 0, 0.05], rotation: still},
      {position: [1.4, 0.1, 0.7], rotation: still}],
    yaw: -1.1,
  },
  arm: {
    note: 'An arm moves between two compartments of a shelf: planned here, and proven free.',
    yaw: -2.5,
  },
  ring: {
    note: 'A ring in the hole of a key swings round: their boxes overlap, surfaces never meet.',
    files: [['ring.obj', () => ring(10, 1.2)], ['key.obj', key]],
    scales: [0.001, 0.001],
    motion: [hanging(-35), hanging(35)],
    yaw: -1.2,
    pitch: 0.7,
  },
  needle: {
    note: 'A needle at 100 m/s, at bars of 2 mm: from one picture of a game to the next, 1/60 s.',
    files: [['needle.obj', needle], ['grating.obj', () => grating(12, 0.02, 0.002)]],
    motion: [{position: [-0.835, -0.04, 0.02], rotation: still},
      {position: [0.835, 0.04, -0.02], rotation: still}],
    yaw: -1.0,
  },
};
