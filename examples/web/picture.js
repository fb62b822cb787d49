// picture.js - what is drawn of a question and its answer.

const COLOURS =
  ['free', 'hit', 'doubt', 'inside', 'grid', 'body-b', 'witness-a', 'witness-b'];
const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of COLOURS) {
    const hex = parseInt(style.getPropertyValue(`--${name}`).trim().slice(1), 16);
    colours[name] = [hex >> 16, hex >> 8 & 255, hex & 255].map((x) => x / 255);
  }
}

const poseAt = (t) => between(...motion, t);
// In the world: the centre of A's sphere at a pose.
const centreAt = (pose) => apply(pose, bodies[0].scale, bodies[0].centre);
const camera = () => cameraOf(view, canvas.clientWidth, canvas.clientHeight);

// A's colour at a time: green as far as it is proven free.
function colourAt(t) {
  const proven = answer && !isOpinion(answer) && t < answer.time.low;
  if (isAny(answer) && t < answer.time.high - 0.001)  // nothing is known of it; the slider's step
    return colours['body-b'];
  return proven ? colours.free : colours[answer?.description[0] ?? 'doubt'];
}

function armThings(time, alpha) {
  const poses = robot.poses(time);
  return robot.parts.map(({moves}, i) => ({
    mesh: `part-${i}`, pose: poses[i], size: 1, alpha,
    colour: moves ? colourAt(time) : colours['body-b'],
  }));
}

const bodyB = (alpha) =>
  ({mesh: 'body-1', pose: AT_REST, size: bodies[1].scale, colour: colours['body-b'], alpha});
function ghosts(time) {
  if (isArm())
    return [0, 1].flatMap((end) => armThings(end, 0.2).filter((_, i) => robot.parts[i].moves));
  const list = answer?.inside ? [bodyB(0.4)] : [];
  for (let i = 0; i < GHOSTS; i++) {
    const t = i / (GHOSTS - 1);
    const end = i === 0 || i === GHOSTS - 1;
    if (Math.abs(t - time) > 0.01)
      list.push({
        mesh: 'body-0', pose: poseAt(t), size: bodies[0].scale, colour: colourAt(t),
        alpha: end ? 0.5 : 0.16,
      });
  }
  if (closest)
    list.push({mesh: 'body-0', pose: poseAt(closest.nearest.time), size: bodies[0].scale,
      colour: colours.free, alpha: 0.5});
  return list;
}

// What meets, A (0) or B (1), and its pose at a time.
function sideAt(which, time) {
  if (!isArm())
    return {...bodies[which], pose: which ? AT_REST : poseAt(time)};
  const part = answer.pair[which];
  return {...robot.parts[part], scale: 1, pose: robot.poses(time)[part]};
}

// The witness: two triangles with their edges, the point where they meet, and the normal; or, of
// what stays apart, where it is nearest: two triangles, two points and a line between these.
function marks() {
  const contact = shownContact();
  if (!contact)
    return [];
  const list = [];
  const {point, normal, triangles, time, gap = 0} = contact;
  for (const which of [1, 0]) {
    const side = sideAt(which, time);
    scene.loadTriangle(which, side, triangles[which]);
    for (const mesh of ['triangle', 'edges'])
      list.push({
        mesh: `${mesh}-${which}`, pose: side.pose, size: side.scale,
        colour: colours[which ? 'witness-b' : 'witness-a'], alpha: 1,
      });
  }
  const pixel = metresPerPixel(camera(), point);
  const turn = normal[2] < -0.9999 ? [1, 0, 0, 0] :
    normalized([...cross([0, 0, 1], normal), 1 + normal[2]]);
  const pose = {position: point, rotation: turn};
  const colour = colours['witness-a'];
  if (isWitnessed(answer))
    list.push({mesh: 'arrow', pose, size: 80 * pixel, colour, alpha: 1});
  const ends = gap > 0 ? [point, add(point, scaled(normal, gap))] : [point];
  scene.loadLines('gap', ends);
  list.push({mesh: 'gap', pose: AT_REST, size: 1, colour, alpha: 1});
  for (const position of ends)
    list.push({mesh: 'ball', pose: {...AT_REST, position}, size: 3 * pixel, colour, alpha: 1});
  return list;
}

// Squares on the level of B's lowest point.
function loadGround() {
  const {low, high, scale} = bodies[1];
  const step = scale * Math.max(high[0] - low[0], high[1] - low[1]) / 4 || scale;
  const z = scale * low[2];
  const lines = [];
  for (let i = -10; i <= 10; i++) {
    lines.push([i * step, -10 * step, z], [i * step, 10 * step, z]);
    lines.push([-10 * step, i * step, z], [10 * step, i * step, z]);
  }
  scene.loadLines('ground', lines);
}

function loadPath() {
  const points = Array.from({length: 80}, (_, i) => isArm() ?
    robot.poses(i / 79)[robot.parts.findLastIndex(({moves}) => moves)].position :
    centreAt(poseAt(i / 79)));
  scene.loadLines('path', points);  // every other line: dashes
}

function placeGrips(from) {
  if (isArm())
    return;
  const places = motion.map((pose) => toScreen(from, centreAt(pose)));
  motion.forEach((pose, i) => {
    const grip = find(`grip-${i}`);
    const at = places[i];
    grip.hidden = !at;
    if (!at)
      return;
    const lift = bodies[0].radius * bodies[0].scale / metresPerPixel(from, centreAt(pose));
    const other = places[1 - i] ?? [Infinity, Infinity];
    const below = i === 1 && Math.hypot(at[0] - other[0], at[1] - other[1]) < 50;
    const top = at[1] + (below ? 1 : -1) * (lift + 10);
    grip.style.left = `${Math.min(Math.max(at[0], 30), from.width - 30)}px`;
    grip.style.top = `${Math.min(Math.max(top, 18), from.height - 18)}px`;
  });
}

function placeContact(from) {
  const contact = shownContact();
  const at = contact && toScreen(from, add(contact.point, scaled(contact.normal, (contact.gap ?? 0) / 2)));
  find('contact').hidden = !at;
  if (at) {
    find('contact').style.left = `${at[0]}px`;
    find('contact').style.top = `${at[1]}px`;
  }
}

// In the world: the corners of a body's box.
const corners = ({low, high, scale}, pose) => [0, 1, 2, 3, 4, 5, 6, 7].map((corner) =>
  apply(pose, scale, low.map((x, k) => corner >> k & 1 ? high[k] : x)));

// Of a robot, at its ends and midway; but for the floor, which is larger than the rest.
const armCorners = () => [0, 0.25, 0.5, 0.75, 1].flatMap((share) => {
  const poses = robot.poses(share);
  return robot.parts.flatMap((part, i) =>
    length(subtract(part.high, part.low)) > 2 ? [] : corners(part, poses[i]));
});

// So near that B, and A at both ends, just fit into the picture. Its size is known only when the
// page has been laid out: with the answer in it, once.
function fitView() {
  view.fitted = true;
  const {right, up, back, aspect} = camera();
  const points = isArm() ? armCorners() :
    [...motion.flatMap((pose) => corners(bodies[0], pose)), ...corners(bodies[1], AT_REST)];
  const middle = (axis) => {
    const along = points.map((point) => dot(point, axis));
    return scaled(axis, (Math.min(...along) + Math.max(...along)) / 2);
  };
  view.target = add(middle(right), add(middle(up), middle(back)));
  view.distance = Math.max(...points.map((point) => {
    const to = subtract(point, view.target);
    const across = Math.max(Math.abs(dot(to, right)) / aspect, Math.abs(dot(to, up)));
    return 1.2 * across / FIELD + dot(to, back);
  }));
}

function draw() {
  if (!view.fitted)
    fitView();
  const time = Number(find('time').value);
  const from = camera();
  placeGrips(from);
  placeContact(from);
  if (!scene)
    return;
  const size = [from.width, from.height].map((pixels) => Math.round(pixels * devicePixelRatio));
  if (canvas.width !== size[0] || canvas.height !== size[1])  // what is set is cleared
    [canvas.width, canvas.height] = size;
  loadPath();
  const path = {mesh: 'path', pose: AT_REST, size: 1, colour: colourAt(1), alpha: 1};
  const solids = isArm() ? [path, ...armThings(time, 1)] : [
    {mesh: 'ground', pose: AT_REST, size: 1, colour: colours.grid, alpha: 1},
    path,
    ...answer?.inside ? [] : [bodyB(1)],  // else it is a ghost, since it may hide A
    {mesh: 'body-0', pose: poseAt(time), size: bodies[0].scale, colour: colourAt(time), alpha: 1},
  ];
  scene.draw(from, solids, ghosts(time), marks());
}
