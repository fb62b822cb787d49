// page.js - the page: what is asked, what is shown of the answer, what mouse, fingers and keys do.

const find = (id) => document.getElementById(id);
const bytesOf = (id) =>
  Uint8Array.from(atob(find(id).textContent.trim()), (letter) => letter.charCodeAt(0));

const AT_REST = {position: [0, 0, 0], rotation: [0, 0, 0, 1]};
const FIRST = 0.01;  // tolerance of first contacts, a share of the motion
const GHOSTS = 9;    // start and end among them
const CARRIED = [    // the mug, from beside the dish rack into it
  {position: [0.04, -0.4, 0.08], rotation: normalized([0.42, -0.3, -0.48, 0.7])},
  {position: [0, 0, 0.02], rotation: [0, 0, -Math.SQRT1_2, Math.SQRT1_2]},
];

const canvas = find('canvas');
const scene = createScene(canvas);
const library = await createLibrary(bytesOf('module')).catch((error) => {
  find('verdict-title').textContent = 'Not possible';
  find('verdict-text').textContent = `This browser cannot run the module: ${error.message}`;
  throw error;
});
const bodies = [{scale: 1}, {scale: 1}];
const motion = structuredClone(CARRIED);
const view = {yaw: -0.42, pitch: 0.3, distance: 1, target: [0, 0, 0]};
let answer = null;  // null where the question was refused

// ---- asking

function question() {
  const method = document.querySelector('[name=method]:checked').value;
  const proof = method === 'proof';
  return {
    motion,
    scales: bodies.map(({scale}) => scale),
    first: proof && find('first').checked ? FIRST : 0,
    clearance: proof ? find('clearance').value / 1000 : 0,
    method,
  };
}

// The median of some batches. A batch takes so many milliseconds, because browsers round the clock
// to 0.1 ms; and no more, or something else would run in most of them.
let batch = 1;
function microseconds(asked, milliseconds, batches) {
  for (;;) {
    const size = batch;
    const times = Array.from({length: batches}, () => {
      const start = performance.now();
      library.sweep(asked, size);
      return performance.now() - start;
    });
    const median = times.sort((a, b) => a - b)[batches >> 1];
    batch = Math.ceil(size * Math.min(8, 1.2 * milliseconds / Math.max(median, 0.05)));
    if (median >= milliseconds)
      return 1000 * median / size;
  }
}

// What an answer is called, what it means, and the colour that it is drawn in.
function describe(answer, {method, clearance}) {
  const near = `${1000 * clearance} mm`;
  const opinion = `The network's opinion, logit ${answer.opinion.logit.toFixed(1)}: no proof.`;
  if (answer.inside)
    return ['inside', 'Inside', `At the start one is inside the other${
      method === 'proof' ? '' : ', the network\'s method estimates'}.`];
  if (answer.verdict === VERDICT.UNDECIDED)
    return ['doubt', 'Undecided',
      'They come too close to tell without meeting, or it is more work than allowed.'];
  const hits = answer.verdict === VERDICT.HIT;
  if (answer.by === BY.NETWORK)
    return hits ? ['hit', 'Probably hits', opinion] : ['free', 'Probably free', opinion];
  if (hits && clearance > 0)
    return ['hit', `Closer than ${near}`, 'Proven: these two triangles come as close.'];
  if (hits)
    return ['hit', 'Hit', 'Proven: these two triangles meet.'];
  if (clearance > 0)
    return ['free', 'Free', `Certified: never closer than ${near}, rotation included.`];
  return ['free', 'Free', 'Certified: the surfaces never meet, rotation included.'];
}
// Is it that the network thinks so, and no more?
const isOpinion = (answer) => answer?.by === BY.NETWORK && !answer.inside;
// Are there two triangles that prove a hit?
const isWitnessed = (answer) =>
  answer?.verdict === VERDICT.HIT && answer.by === BY.PROOF && !answer.inside;
// When they hit, or come too near to tell; where they are free, the end.
const contactTime = ({verdict, time, nearest}) =>
  verdict === VERDICT.UNDECIDED ? nearest.time : time.high;

// ---- showing the answer

const numbers = (list, digits) => list.map((x) => x.toFixed(digits)).join(', ');
function show(id, text) {
  find(id).textContent = text ?? '–';
}
function showTime(us) {
  show('microseconds', us === null ? null : `${us < 10 ? us.toFixed(1) : us.toFixed(0)} µs`);
}
function showVerdict(kind, title, text) {
  find('verdict').dataset.kind = kind;
  if (find('verdict-title').textContent !== title)  // read aloud only where it changes
    show('verdict-title', title);
  show('verdict-text', text);
}

function showAnswer() {
  const witness = isWitnessed(answer);
  const known = answer && !isOpinion(answer);
  const timed = answer?.verdict === VERDICT.HIT && !answer.inside;
  if (answer)
    showVerdict(...answer.description);
  showTime(answer && answer.microseconds);
  show('contact-time', timed ? `t = ${contactTime(answer).toFixed(3)}` : null);
  show('free-until', known ? `t = ${answer.time.low.toFixed(3)}` : null);
  show('apart', known && answer.distance.low > 0 && Number.isFinite(answer.distance.low) ?
    `${(1000 * answer.distance.low).toPrecision(2)} mm` : null);
  show('point', witness ? numbers(answer.nearest.point, 3) : null);
  show('normal', witness ? numbers(answer.nearest.normal, 2) : null);
  for (const which of [0, 1])
    show(`triangle-${which}`, witness ? answer.nearest.triangles[which] : null);
}

function ask(milliseconds, batches) {
  const asked = question();
  try {
    const start = performance.now();
    library.sweep(asked, 1);
    const taken = performance.now() - start;
    answer = library.answer();
    answer.description = describe(answer, asked);
    batch = Math.max(1, Math.min(batch, Math.ceil(milliseconds / taken)));
    answer.microseconds = taken > 10 ? 1000 * taken : microseconds(asked, milliseconds, batches);
  } catch (error) {
    answer = null;
    showVerdict('doubt', 'Not answered', error.message);
  }
  showAnswer();
}

// ---- the proof, to take away

let proofFiles = null;  // [name, bytes] each; null where there is no proof of the answer

const encoded = (text) => new TextEncoder().encode(text);

function showProof(why) {
  find('save').disabled = !proofFiles;
  find('save').title = why;
  show('save', proofFiles ? `Save the proof, ${proofFiles[0][1].length} bytes` : 'Save the proof');
}

// The numbers of a pose in a problem file, and what its reader takes them for.
const written = ({position, rotation}) => [...position, ...rotation].map((x) => +x.toPrecision(9));
function asRead(numbers) {
  const rotation = numbers.slice(3);
  const length = Math.sqrt(rotation.reduce((sum, x) => sum + x * x, 0));
  return {position: numbers.slice(0, 3), rotation: rotation.map((x) => x / length)};
}

// Makes it, and says what it is, or why there is none.
function prove() {
  if (answer?.by !== BY.PROOF || answer.verdict === VERDICT.UNDECIDED)
    return 'Only what is proven, free or a hit, can be saved';
  const poses = motion.map(written);
  const asked = {...question(), motion: poses.map(asRead)};
  let made;
  try {
    made = library.certify(asked);
  } catch (error) {
    return error.message;
  }
  if (made.verdict !== answer.verdict)
    return made.verdict ? 'They come so near that a certificate says the contrary' :
      made.why === WHY.WORK ? 'A certificate is more work than allowed' :
        'They touch, or come too near for a certificate';
  const [a, b] = asked.scales;
  const clearance = asked.clearance ? ` --clearance ${asked.clearance}` : '';
  const lines = [`nsvcd-problems 1  # build/verify proof.txt .${clearance}`,
    ...bodies.map(({name}, i) => `mesh ${'AB'[i]} ${'ab'[i]}.obj  # ${name.replace(/\s/g, ' ')}`),
    `problem proof A ${a} B ${b}  0 0 0  0 0 0 1  -1 nan 2`,
    ...poses.map((numbers) => numbers.join(' '))];
  proofFiles = [['proof.cert', made.bytes], ['proof.txt', encoded(`${lines.join('\n')}\n`)],
    ['a.obj', bodies[0].obj], ['b.obj', bodies[1].obj]];
  return 'proof.tar: a certificate for build/verify, the motion and both meshes. That of a hit ' +
    'proves one, not that it is the first';
}

// A tar file.
function pack(files) {
  const blocks = files.flatMap(([name, bytes]) => {
    const header = new Uint8Array(512);
    const put = (at, text) => header.set(encoded(text), at);
    const octal = (number, digits) => number.toString(8).padStart(digits, '0');
    put(0, name);
    put(100, '0000644\x000000000\x000000000\0');  // mode, user, group
    put(124, `${octal(bytes.length, 11)}\0${octal(Math.floor(Date.now() / 1000), 11)}\0`);
    put(148, '        0');  // the sum, as if blank, and that it is a file
    put(257, 'ustar\x0000');
    put(148, `${octal(header.reduce((sum, byte) => sum + byte), 6)}\0`);
    return [header, bytes, new Uint8Array(-bytes.length & 511)];
  });
  return new Blob([...blocks, new Uint8Array(1024)]);
}

function save() {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(pack(proofFiles));
  link.download = 'proof.tar';
  link.click();
  setTimeout(URL.revokeObjectURL, 60000, link.href);
}

// ---- drawing

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
  return proven ? colours.free : colours[answer?.description[0] ?? 'doubt'];
}

function ghosts(time) {
  const list = [];
  for (let i = 0; i < GHOSTS; i++) {
    const t = i / (GHOSTS - 1);
    const end = i === 0 || i === GHOSTS - 1;
    if (Math.abs(t - time) > 0.01)
      list.push({
        mesh: 'body-0', pose: poseAt(t), size: bodies[0].scale, colour: colourAt(t),
        alpha: end ? 0.5 : 0.16,
      });
  }
  return list;
}

// The witness: two triangles with their edges, the point where they meet, and the normal.
function marks() {
  if (!isWitnessed(answer))
    return [];
  const list = [];
  const {point, normal, triangles, time} = answer.nearest;
  for (const which of [1, 0]) {
    const {positions, indices, scale} = bodies[which];
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * indices[3 * triangles[which] + k];
      return [...positions.subarray(at, at + 3)];
    });
    scene.loadMesh(`triangle-${which}`,
      {positions: new Float32Array([a, b, c].flat()), indices: new Uint32Array([0, 1, 2])});
    scene.loadLines(`edges-${which}`, [a, b, b, c, c, a]);
    for (const mesh of ['triangle', 'edges'])
      list.push({
        mesh: `${mesh}-${which}`, pose: which ? AT_REST : poseAt(time), size: scale,
        colour: colours[which ? 'witness-b' : 'witness-a'], alpha: 1,
      });
  }
  const pixel = metresPerPixel(camera(), point);
  const turn = normal[2] < -0.9999 ? [1, 0, 0, 0] :
    normalized([...cross([0, 0, 1], normal), 1 + normal[2]]);
  const pose = {position: point, rotation: turn};
  const colour = colours['witness-a'];
  list.push({mesh: 'arrow', pose, size: 80 * pixel, colour, alpha: 1});
  list.push({mesh: 'ball', pose, size: 3 * pixel, colour, alpha: 1});
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
  const points = Array.from({length: 80}, (_, i) => centreAt(poseAt(i / 79)));
  scene.loadLines('path', points);  // every other line: dashes
}

function placeGrips(from) {
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
  const at = isWitnessed(answer) && toScreen(from, answer.nearest.point);
  find('contact').hidden = !at;
  if (at) {
    find('contact').style.left = `${at[0]}px`;
    find('contact').style.top = `${at[1]}px`;
  }
}

function draw() {
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
  const solids = [
    {mesh: 'ground', pose: AT_REST, size: 1, colour: colours.grid, alpha: 1},
    {mesh: 'path', pose: AT_REST, size: 1, colour: colourAt(1), alpha: 1},
    {mesh: 'body-1', pose: AT_REST, size: bodies[1].scale, colour: colours['body-b'], alpha: 1},
    {mesh: 'body-0', pose: poseAt(time), size: bodies[0].scale, colour: colourAt(time), alpha: 1},
  ];
  scene.draw(from, solids, ghosts(time), marks());
}

// ---- when something changes

let asking = false;  // the question has changed
let waiting = false;
let settled = 0;
// Nothing moves any more: there is time to look at the clock. Again, because a browser compiles
// what it runs often once more.
function settle(rounds) {
  ask(1.5, 31);
  if (rounds > 1)
    settled = setTimeout(settle, 250, rounds - 1);
}
function frame() {
  waiting = false;
  if (asking) {
    ask(1, 3);
    proofFiles = null;
    showProof('Not while it moves');
    clearTimeout(settled);
    settled = setTimeout(() => {
      showProof(prove());
      settle(3);
    }, 250);
  }
  asking = false;
  if (find('follow').checked)
    find('time').value = answer ? contactTime(answer) : 1;
  show('time-text', Number(find('time').value).toFixed(3));
  draw();
}
function changed(isQuestion) {
  asking ||= isQuestion;
  if (!waiting)
    requestAnimationFrame(frame);
  waiting = true;
}
function motionChanged() {
  motion.forEach(({position, rotation}, i) => {
    find(`pose-${i}`).value = [...position, ...rotation].map((x) => +x.toFixed(6)).join(' ');
  });
  changed(true);
}

// In the world: the corners of a body's box.
const corners = ({low, high, scale}, pose) => [0, 1, 2, 3, 4, 5, 6, 7].map((corner) =>
  apply(pose, scale, low.map((x, k) => corner >> k & 1 ? high[k] : x)));

// So near that B, and A at both ends, just fit into the picture.
function resetView() {
  Object.assign(view, {yaw: -0.42, pitch: 0.3});
  const {right, up, back, aspect} = camera();
  const points = [...motion.flatMap((pose) => corners(bodies[0], pose)),
    ...corners(bodies[1], AT_REST)];
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
  changed(false);
}

// The assets' own motion, or one past B's centre.
function resetMotion() {
  const known = bodies.every(({name, scale}, i) =>
    scale === 1 && name === find(`mesh-${i}`).dataset.name);
  const [a, b] = bodies.map(({centre, scale}) => scaled(centre, scale));
  const reach = 1.2 * (bodies[0].radius * bodies[0].scale + bodies[1].radius * bodies[1].scale);
  const ends = [-reach, reach].map((y) =>
    ({position: add(subtract(b, a), [0, y, 0]), rotation: [0, 0, 0, 1]}));
  motion.splice(0, 2, ...structuredClone(known ? CARRIED : ends));
  motionChanged();
}

// ---- bodies

function showBody(which) {
  const {low, high, scale, name, indices, patches, size} = bodies[which];
  const drop = find(`drop-${which}`);
  const extent = scaled(subtract(high, low), scale).map((x) => x.toFixed(3)).join(' × ');
  drop.querySelector('.name').textContent = `${'AB'[which]}: ${name}`;
  drop.querySelector('.facts').textContent =
    `${indices.length / 3} triangles, ${patches} patches, ${Math.round(size / 1000)} KB`;
  drop.querySelector('.size').textContent = `${extent} m`;
}

// Takes an OBJ file, its bytes, for a body; where it is refused, the old one stays.
function loadBody(which, name, bytes) {
  const message = find(`drop-${which}`).querySelector('.error');
  message.textContent = '';
  try {
    library.encode(which, bytes);
  } catch (error) {
    const line = error.line ? new TextDecoder().decode(bytes).split('\n')[error.line - 1] : '';
    message.textContent = error.line ?
      `${name}, line ${error.line}: ${error.message}: “${line.trim().slice(0, 60)}”` :
      `${name}: ${error.message}`;
    showBody(which);
    return;
  }
  const mesh = library.mesh(which);
  const extreme = (pick, start) => [0, 1, 2].map((k) => {
    let most = start;
    for (let i = k; i < mesh.positions.length; i += 3)
      most = pick(most, mesh.positions[i]);
    return most;
  });
  Object.assign(bodies[which], mesh, library.facts(which),
    {name, obj: bytes, low: extreme(Math.min, Infinity), high: extreme(Math.max, -Infinity)});
  scene?.loadMesh(`body-${which}`, mesh);
  showBody(which);
  if (bodies.every(({indices}) => indices)) {
    if (scene)
      loadGround();
    resetMotion();
    resetView();
  }
}

async function loadFiles(which, files) {
  for (const [i, file] of [...files].slice(0, 2).entries()) {
    const to = (which + i) % 2;
    const bytes = new Uint8Array(await file.arrayBuffer());
    find(`drop-${to}`).querySelector('.facts').textContent = `reading ${file.name} ...`;
    await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
    loadBody(to, file.name, bytes);
  }
}

function makeDrop(which) {
  const drop = find(`drop-${which}`);
  drop.append(find('drop').content.cloneNode(true));
  drop.querySelector('[type=file]').addEventListener('change', ({target}) => {
    loadFiles(which, target.files).then(() => {
      target.value = '';  // the same file again is a change
    });
  });
  drop.querySelector('.scale').addEventListener('input', ({target}) => {
    bodies[which].scale = Number(target.value) || bodies[which].scale;  // 0. is on the way to 0.001
    showBody(which);
    if (scene)
      loadGround();
    changed(true);
  });
  drop.addEventListener('dragover', () => drop.classList.add('over'));
  drop.addEventListener('dragleave', () => drop.classList.remove('over'));
  drop.addEventListener('drop', (event) => {
    drop.classList.remove('over');
    loadFiles(which, event.dataTransfer.files);
  });
}

// ---- moving the start and the end, and the view

const movePose = (pose, by) => {
  pose.position = add(pose.position, by);
};
function turnPose(pose, axis, angle) {  // about the body's centre
  const centre = centreAt(pose);
  pose.rotation = normalized(multiply(aboutAxis(axis, angle), pose.rotation));
  pose.position = add(pose.position, subtract(centre, centreAt(pose)));
}
// By so many pixels to the right and downwards.
function dragPose(pose, x, y, turning) {
  const {right, up} = camera();
  const step = metresPerPixel(camera(), centreAt(pose));
  if (turning) {
    turnPose(pose, up, 0.01 * x);
    turnPose(pose, right, 0.01 * y);
  } else {
    movePose(pose, add(scaled(right, step * x), scaled(up, -step * y)));
  }
  motionChanged();
}
function turnView(x, y) {
  view.yaw -= 0.008 * x;
  view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch + 0.008 * y));
  changed(false);
}
function shiftView(x, y) {
  const {right, up} = camera();
  const step = metresPerPixel(camera(), view.target);
  view.target = add(view.target, add(scaled(right, -step * x), scaled(up, step * y)));
  changed(false);
}
function zoom(factor) {
  view.distance = Math.min(1e7, Math.max(1e-7, view.distance * factor));
  changed(false);
}

// 0 or 1: A's start or end is nearest under a point of the picture; else null.
function poseUnder(x, y) {
  const from = camera();
  const ray = rayThrough(from, x, y);
  const meets = (body, pose) => rayMeets(body, pose, body.scale, from.eye, ray);
  const ends = motion.map((pose) => meets(bodies[0], pose));
  const end = ends[0] < ends[1] ? 0 : 1;
  return ends[end] < meets(bodies[1], AT_REST) ? end : null;
}

const turning = (event) =>
  event.shiftKey !== (document.querySelector('[name=drag]:checked').value === 'turn');

// Each pointer that is down, and where; `held` is what the first of them has grasped.
const pointers = new Map();
let held = null;
function pointerDown(event) {
  const grip = event.target.closest('.grip');
  event.target.setPointerCapture(event.pointerId);
  if (pointers.size === 0) {
    held = grip ? Number(grip.id.slice(-1)) : poseUnder(event.offsetX, event.offsetY);
    if (event.button !== 0)
      held = null;
  }
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
}
function pointerMove(event) {
  const before = pointers.get(event.pointerId);
  if (!before)
    return;
  const now = [event.clientX, event.clientY];
  const [x, y] = [now[0] - before[0], now[1] - before[1]];
  pointers.set(event.pointerId, now);
  if (pointers.size > 1) {
    const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
    zoom(apart(before) / apart(now));
    shiftView(x / 2, y / 2);
  } else if (held !== null) {
    dragPose(motion[held], x, y, turning(event));
  } else if (event.buttons & 1) {
    turnView(x, y);
  } else {
    shiftView(x, y);
  }
}
const pointerUp = (event) => pointers.delete(event.pointerId);

const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
function keyDown(event) {
  const grip = event.target.closest('.grip');
  const pose = grip && motion[Number(grip.id.slice(-1))];
  const arrow = ARROWS[event.key];
  const depth = {PageUp: -6, PageDown: 6}[event.key];
  const factor = {'+': 0.9, '=': 0.9, '-': 1.1}[event.key];
  if (arrow && pose)
    dragPose(pose, 6 * arrow[0], 6 * arrow[1], turning(event));
  else if (arrow)
    turnView(-12 * arrow[0], -12 * arrow[1]);
  else if (depth && pose)
    movePose(pose, scaled(camera().back, depth * metresPerPixel(camera(), centreAt(pose))));
  else if (factor)
    zoom(factor);
  else
    return;
  event.preventDefault();
  if (depth)
    motionChanged();
}

// ---- all of it

function listen() {
  for (const target of [canvas, find('grip-0'), find('grip-1')]) {
    target.addEventListener('pointerdown', pointerDown);
    target.addEventListener('pointermove', pointerMove);
    target.addEventListener('pointerup', pointerUp);
    target.addEventListener('pointercancel', pointerUp);
    target.addEventListener('keydown', keyDown);
    target.addEventListener('contextmenu', (event) => event.preventDefault());
  }
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(0.001 * event.deltaY));
  }, {passive: false});
  find('time').addEventListener('input', () => {
    find('follow').checked = false;
    changed(false);
  });
  find('follow').addEventListener('input', () => changed(false));
  find('reset-view').addEventListener('click', resetView);
  find('reset-motion').addEventListener('click', resetMotion);
  find('save').addEventListener('click', save);
  find('options').addEventListener('input', () => {
    const proof = question().method === 'proof';
    find('first').disabled = find('clearance').disabled = !proof;
    changed(true);
  });
  motion.forEach((_, i) => find(`pose-${i}`).addEventListener('change', () => typedPose(i)));
  for (const kind of ['dragover', 'drop'])  // a file that misses does not replace the page
    addEventListener(kind, (event) => event.preventDefault());
  new ResizeObserver(() => changed(false)).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    readColours();
    changed(false);
  });
}

// Seven numbers; what the library refuses leaves the pose as it was.
function typedPose(i) {
  const values = find(`pose-${i}`).value.trim().split(/[\s,]+/).map(Number);
  const before = motion[i];
  motion[i] = {position: values.slice(0, 3), rotation: values.slice(3)};
  try {
    if (values.length !== 7)
      throw new Error('seven numbers are needed');
    library.sweep(question(), 1);
    show('pose-error', '');
    changed(true);
  } catch (error) {
    motion[i] = before;
    show('pose-error', error.message);
  }
}

readColours();
listen();
for (const which of [0, 1]) {
  makeDrop(which);
  loadBody(which, find(`mesh-${which}`).dataset.name, bytesOf(`mesh-${which}`));
}
if (!scene)
  find('view').append('This browser has no WebGL 2: answers, but no picture.');
