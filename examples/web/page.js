// page.js - the page: what is asked, what is shown of the answer, what mouse, fingers and keys do.

performance.mark('script');
const find = (id) => document.getElementById(id);
const encoded = (text) => new TextEncoder().encode(text);

const AT_REST = {position: [0, 0, 0], rotation: [0, 0, 0, 1]};
const FIRST = 0.01;  // tolerance of first contacts, a share of the motion
const GHOSTS = 9;    // start and end among them
const LARGE = 30, SMALL = 0.001;  // metres: bodies beyond these are hardly meant
const UNLIKE = 100;  // and hardly ones that differ by this factor

// Until the next picture is there.
const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

// What stands in the page as base64 of gzip.
async function unpacked(id) {
  const text = find(id).textContent;
  const packed = Uint8Array.fromBase64?.(text) ??  // since 2025, and far faster
    Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const plain = new Response(packed).body.pipeThrough(new DecompressionStream('gzip'));
  return new Response(plain, {headers: {'content-type': 'application/wasm'}});
}

const canvas = find('canvas');
let scene = null;  // comes after the first answer, because a graphics card takes its time
// The first scene's bodies, because to encode them takes longer than all else until an answer.
const bakedBodies = Promise.all(['body-0', 'body-1'].map(async (id) =>
  new Uint8Array(await (await unpacked(id)).arrayBuffer())));
const library = await createLibrary(unpacked('module')).catch((error) => {
  find('verdict-title').textContent = 'Not possible';
  find('verdict-text').textContent = `This browser cannot run the module: ${error.message}`;
  throw error;
});
const baked = await bakedBodies;
performance.mark('module');
const bodies = [{scale: 1}, {scale: 1}];
const motion = [AT_REST, AT_REST];
const view = {yaw: -0.42, pitch: 0.3, distance: 1, target: [0, 0, 0]};
let answer = null;  // null where the question was refused
let closest = null;  // the distance's answer to the same question, where that is free and nothing moves
let current = 'mug';  // of SCENES
let robot = null;  // made when its scene is opened first
let bends = [];  // degrees, of its joints
const isArm = () => current === 'arm';

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
      'They come too close to tell without meeting, one seems to be inside of what is not quite closed, ' +
      'or it is more work than allowed.'];
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
  // Of what is free: where they come nearest, once nothing moves.
  const nearest = closest?.nearest ?? (witness ? answer.nearest : null);
  show('contact-name', answer?.verdict === VERDICT.FREE && !isArm() ? 'nearest at' : 'contact at');
  show('contact-time', timed ? `t = ${contactTime(answer).toFixed(3)}` :
    nearest ? `t = ${nearest.time.toFixed(3)}` : null);
  // Of a robot's hit it is not told whether it is the first.
  show('free-until', known && !(isArm() && timed) ? `t = ${answer.time.low.toFixed(3)}` : null);
  const apart = (closest ?? answer)?.distance.low;
  show('apart', known && apart > 0 && Number.isFinite(apart) ?
    `${+(1000 * apart).toPrecision(closest ? 4 : 2)} mm` : null);
  show('point', nearest ? numbers(nearest.point, 3) : null);
  show('normal', nearest ? numbers(nearest.normal, 2) : null);
  for (const which of [0, 1])
    show(`triangle-${which}`, nearest ? nearest.triangles[which] : null);
}

// How long the page takes until then is what test_page.py prints.
let marked = false;
function markFirst() {
  if (!marked)
    performance.mark('first-answer');
  marked = true;
}

// Of a robot's motion: what hits what, by their names.
function describeArm({verdict, inside, pair}) {
  const named = pair?.map((part) => robot.parts[part].name.replace('_', ' ')).join(' and ');
  if (verdict === VERDICT.FREE)
    return ['free', 'Free', `Proven: none of ${robot.pairs.length} pairs ever meets.`];
  if (verdict === VERDICT.UNDECIDED)
    return ['doubt', 'Undecided', named ? `${named} come too near to tell, or one seems to be inside of what is not quite closed.` : 'Too much work.'];
  return ['hit', 'Hit', inside ? `Proven: of ${named}, one is inside the other.` :
    `Proven: ${named} meet; perhaps not for the first time.`];
}
function askArm() {
  const start = performance.now();
  answer = robot.ask(1);
  markFirst();
  answer.microseconds = 1000 * (performance.now() - start);
  answer.description = describeArm(answer);
  showAnswer();
}

// Before a file is answered about that is hardly in metres.
function askUnit(which) {
  const [scale, why] = unitsOffer(which) ?? [bodies[which].scale, ''];
  answer = null;
  showVerdict('doubt', 'In which unit?', `${bodies[which].name} would be ${
    +extentOf(bodies[which]).toPrecision(3)} m long. ${why.split(':')[0].split('?')[0]}.`);
  show('unit-use', `Use the scale ${scale}`);
  showAnswer();
}

function ask(milliseconds, batches) {
  if (isArm())
    return askArm();
  const doubted = bodies.findIndex(({unsure}) => unsure);
  find('unit').hidden = doubted < 0;
  if (doubted >= 0)
    return askUnit(doubted);
  const asked = question();
  try {
    const start = performance.now();
    library.sweep(asked, 1);
    const taken = performance.now() - start;
    answer = library.answer();
    markFirst();
    answer.description = describe(answer, asked);
    batch = Math.max(1, Math.min(batch, Math.ceil(milliseconds / taken)));
    answer.microseconds = taken > 10 ? 1000 * taken : microseconds(asked, milliseconds, batches);
  } catch (error) {
    answer = null;
    showVerdict('doubt', 'Not answered', error.message);
  }
  showAnswer();
}

// How near they come, where they are proven free; else null. It takes longer than to know that.
function measure() {
  if (isArm() || answer?.verdict !== VERDICT.FREE || answer.by !== BY.PROOF)
    return null;
  try {
    const found = library.distance(question());
    return found.verdict === VERDICT.FREE && found.distance.high < Infinity ? found : null;
  } catch (error) {
    return null;  // the answer stands without it
  }
}

// ---- the proof, to take away

let proofFiles = null;  // [name, bytes] each; null where there is no proof of the answer

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

// What a proof holds of a body: its file, or, of another format, the same mesh as OBJ.
function objFile({format, file, positions, indices}) {
  if (format === 'OBJ')
    return file;
  const lines = [];
  for (let i = 0; i < positions.length; i += 3)
    lines.push(`v ${[...positions.subarray(i, i + 3)].map((x) => +x.toPrecision(9)).join(' ')}`);
  for (let i = 0; i < indices.length; i += 3)
    lines.push(`f ${[...indices.subarray(i, i + 3)].map((corner) => corner + 1).join(' ')}`);
  return encoded(`${lines.join('\n')}\n`);
}

function proveArm() {
  if (answer.verdict !== VERDICT.FREE)
    return 'Only a motion that is free can be saved with its proof';
  try {
    proofFiles = robot.prove();
  } catch (error) {
    return error.message;
  }
  return 'proof.tar: the robot, its motion and a certificate of each pair, for build/verify';
}

// Makes it, and says what it is, or why there is none.
function prove() {
  if (isArm())
    return proveArm();
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
    ['a.obj', objFile(bodies[0])], ['b.obj', objFile(bodies[1])]];
  return 'proof.tar: a certificate for build/verify, the motion and both meshes. That of a hit ' +
    'proves one, not that it is the first';
}

// Where a file is that the page shows: the first scene's are in the repository, the others' in a proof.
const pathOf = ({name, dropped}, which) => dropped ? name :
  current === 'mug' ? `examples/assets/${name}` : `${'ab'[which]}.obj`;

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
  show('copied', `Anyone can check it, without this library: cc -O2 examples/verify/verify.c -lm -o verify; tar xf proof.tar; ./verify ${
    isArm() ? 'arm.txt .' : `proof.txt .${question().clearance ? ` --clearance ${question().clearance}` : ''}`}`);
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

function armThings(time, alpha) {
  const poses = robot.poses(time);
  return robot.parts.map(({moves}, i) => ({
    mesh: `part-${i}`, pose: poses[i], size: 1, alpha,
    colour: moves ? colourAt(time) : colours['body-b'],
  }));
}

function ghosts(time) {
  if (isArm())
    return [0, 1].flatMap((end) => armThings(end, 0.2).filter((_, i) => robot.parts[i].moves));
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

// What meets, A (0) or B (1), and its pose at a time.
function sideAt(which, time) {
  if (!isArm())
    return {...bodies[which], pose: which ? AT_REST : poseAt(time)};
  const part = answer.pair[which];
  return {...robot.parts[part], scale: 1, pose: robot.poses(time)[part]};
}

// The witness: two triangles with their edges, the point where they meet, and the normal.
function marks() {
  if (!isWitnessed(answer))
    return [];
  const list = [];
  const {point, normal, triangles, time} = answer.nearest;
  for (const which of [1, 0]) {
    const {positions, indices, scale, pose} = sideAt(which, time);
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * indices[3 * triangles[which] + k];
      return [...positions.subarray(at, at + 3)];
    });
    scene.loadMesh(`triangle-${which}`,
      {positions: new Float32Array([a, b, c].flat()), indices: new Uint32Array([0, 1, 2])});
    scene.loadLines(`edges-${which}`, [a, b, b, c, c, a]);
    for (const mesh of ['triangle', 'edges'])
      list.push({
        mesh: `${mesh}-${which}`, pose, size: scale,
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
  const at = isWitnessed(answer) && toScreen(from, answer.nearest.point);
  find('contact').hidden = !at;
  if (at) {
    find('contact').style.left = `${at[0]}px`;
    find('contact').style.top = `${at[1]}px`;
  }
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
    {mesh: 'body-1', pose: AT_REST, size: bodies[1].scale, colour: colours['body-b'], alpha: 1},
    {mesh: 'body-0', pose: poseAt(time), size: bodies[0].scale, colour: colourAt(time), alpha: 1},
  ];
  scene.draw(from, solids, ghosts(time), marks());
}

// ---- playing it

let playing = 0;
function play() {
  cancelAnimationFrame(playing);
  const begin = performance.now();
  const end = find('follow').checked && answer ? contactTime(answer) : 1;
  find('follow').checked = false;
  const step = (now) => {
    const time = Math.min(end, Math.max(0, now - begin) / 3000);
    find('time').value = time;
    find('follow').checked = time === end;
    changed(false);
    playing = time < end ? requestAnimationFrame(step) : 0;
  };
  playing = requestAnimationFrame(step);
}
function stopPlaying() {
  cancelAnimationFrame(playing);
  playing = 0;
}

// ---- when something changes

let asking = false;  // the question has changed
let waiting = false;
let settled = 0;
// Nothing moves any more: there is time to look at the clock. Again, because a browser compiles
// what it runs often once more.
function settle(rounds) {
  if (rounds === 0)
    return;
  ask(1.5, 31);
  if (rounds > 1)
    settled = setTimeout(settle, 250, rounds - 1);
}
function frame() {
  waiting = false;
  if (asking) {
    closest = null;
    ask(1, 3);
    proofFiles = null;
    showProof('Not while it moves');
    clearTimeout(settled);
    settled = setTimeout(() => {
      showProof(prove());
      writeLink();
      closest = measure();
      settle(isArm() ? 0 : 3);
    }, 250);
  }
  asking = false;
  if (find('follow').checked)
    find('time').value = answer ? contactTime(answer) : 1;
  show('time-text', Number(find('time').value).toFixed(3));
  draw();
}
function changed(isQuestion) {
  if (isQuestion && playing) {
    stopPlaying();
    find('follow').checked = true;
  }
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

// Of a robot, at its ends and midway; but for the floor, which is larger than the rest.
const armCorners = () => [0, 0.25, 0.5, 0.75, 1].flatMap((share) => {
  const poses = robot.poses(share);
  return robot.parts.flatMap((part, i) =>
    length(subtract(part.high, part.low)) > 2 ? [] : corners(part, poses[i]));
});

// So near that B, and A at both ends, just fit into the picture. Its size is known only when the
// page has been laid out: with the answer in it, once.
function resetView() {
  const {yaw = -0.42, pitch = 0.3} = SCENES[current];
  Object.assign(view, {yaw, pitch, fitted: false});
  changed(false);
}
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

// The scene's own motion, or, of other bodies, one past B's centre.
function resetMotion() {
  if (isArm()) {
    setBends(robot.joints.map(() => 0));
    return;
  }
  const {motion: own, scales = [1, 1]} = SCENES[current];
  const known = bodies.every(({dropped, scale}, i) => !dropped && scale === scales[i]);
  const [a, b] = bodies.map(({centre, scale}) => scaled(centre, scale));
  const reach = 1.2 * (bodies[0].radius * bodies[0].scale + bodies[1].radius * bodies[1].scale);
  const ends = [-reach, reach].map((y) =>
    ({position: add(subtract(b, a), [0, y, 0]), rotation: [0, 0, 0, 1]}));
  motion.splice(0, 2, ...structuredClone(known ? own : ends));
  motionChanged();
}

function refit() {
  if (scene && !isArm())
    loadGround();
  resetMotion();
  resetView();
}

// ---- bodies

const extentOf = ({low, high, scale}) => scale * Math.max(...subtract(high, low));

// A scale that is likely meant, and why; null where the size may be right.
function unitsOffer(which) {
  const [mine, other] = [extentOf(bodies[which]), extentOf(bodies[1 - which])];
  const to = (factor) => +(bodies[which].scale * factor).toPrecision(6);
  if (mine > LARGE || mine > UNLIKE * other && other >= SMALL)
    return [to(0.001), `These look like millimetres: use ${to(0.001)}`];
  return mine > 0 && mine < SMALL ? [to(1000), `Too small by a thousand? Use ${to(1000)}`] : null;
}

function showBody(which) {
  const {low, high, scale, name, format, indices, patches, size} = bodies[which];
  const drop = find(`drop-${which}`);
  const part = (selector) => drop.querySelector(selector);
  const extent = scaled(subtract(high, low), scale).map((x) => +x.toPrecision(3)).join(' × ');
  part('.name').textContent = `${'AB'[which]}: ${name}`;
  part('.facts').textContent =
    `${format}, ${indices.length / 3} triangles, ${patches} patches, ${Math.round(size / 1000)} KB`;
  part('.size').textContent = `${extent} m`;
  part('.scale').value = scale;
  const offer = unitsOffer(which);
  part('.units').hidden = !offer;
  part('.units').textContent = offer?.[1] ?? '';
}

function notify(text) {
  show('notice', text);
  find('notice').hidden = !text;
}

// Takes a file, its bytes, for a body; where it is refused, the old one stays, and why is told.
function loadBody(which, name, bytes, body = null) {
  const format = library.encode(which, name, bytes, body);
  const mesh = library.mesh(which);
  Object.assign(bodies[which], mesh, library.facts(which), boxOf(mesh), {name, format, file: bytes});
  scene?.loadMesh(`body-${which}`, mesh);
  showFindings(which);
}

// What `svcd info` warns of, once the answer is seen: to look for it takes longer than to answer.
async function showFindings(which) {
  const list = find(`drop-${which}`).querySelector('.findings');
  list.replaceChildren();
  await painted();
  list.replaceChildren(...library.findings(which).map((line) => {
    const item = document.createElement('li');
    item.textContent = line.split('; try --')[0];  // options of `svcd`, which a page has none of
    return item;
  }));
}

function boxOf({positions, indices}) {
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((x) => -x);
  for (const vertex of indices)
    for (let k = 0; k < 3; k++) {
      const x = positions[3 * vertex + k];
      low[k] = Math.min(low[k], x);
      high[k] = Math.max(high[k], x);
    }
  return {low, high};
}

// What is wrong with a file, and where.
function faultOf(name, bytes, error) {
  if (!error.line)
    return `${name}: ${error.message}`;
  const line = new TextDecoder().decode(bytes).split('\n')[error.line - 1] ?? '';
  return `${name}, line ${error.line}: ${error.message}: “${line.trim().slice(0, 60)}”`;
}

async function loadFile(which, file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const drop = find(`drop-${which}`);
  drop.querySelector('.facts').textContent = `reading ${file.name} ...`;
  await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
  let fault = '';
  try {
    loadBody(which, file.name, bytes);
    Object.assign(bodies[which], {scale: 1, dropped: true});
    refit();
  } catch (error) {
    fault = faultOf(file.name, bytes, error);
  }
  drop.querySelector('.error').textContent = fault;
  return fault;
}

// One file becomes that body, two become A and B.
async function loadFiles(which, files) {
  const list = [...files];
  if (list.length === 0)
    return;
  if (isArm())
    openScene('mug');
  const faults = list.length > 2 ? ['Of more than two files the first two are taken'] : [];
  for (const [i, file] of list.slice(0, 2).entries()) {
    const at = list.length === 1 ? which : i;
    faults.push(await loadFile(at, file));
    bodies[at].unsure = faults.at(-1) === '' && unitsOffer(at) !== null;
  }
  bodies.forEach((body, i) => body.unsure &&= unitsOffer(i) !== null);  // beside the other one
  changed(true);
  bodies.forEach((_, i) => showBody(i));
  if (bodies.some(({dropped}) => dropped))
    show('note', `${bodies[0].name} moves, ${bodies[1].name} rests.`);
  notify(faults.filter((fault) => fault).join('. '));
}

// Which body a file becomes that is dropped there: the one that is under it, else the first one
// that has not been dropped.
function bodyAt(event) {
  const card = event.target.closest?.('.drop');
  const under = event.target.closest?.('#view') && !isArm() ?
    bodyUnder(event.clientX, event.clientY) : null;
  if (card)
    return Number(card.id.slice(-1));
  return under ?? (!isArm() && bodies[0].dropped && !bodies[1].dropped ? 1 : 0);
}
function dragOver(event) {
  const two = event.dataTransfer?.items.length > 1;
  find('dropping').hidden = false;
  show('dropping', two ? 'The first becomes A, the second B' : `Becomes ${'AB'[bodyAt(event)]}`);
}
const dragEnd = () => {
  find('dropping').hidden = true;
};

function setScale(which, scale) {
  Object.assign(bodies[which], {scale, unsure: false});
  bodies.forEach((_, i) => showBody(i));
  if (scene)
    loadGround();
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
    const typed = target.value;  // 0. is on the way to 0.001
    setScale(which, Number(typed) || bodies[which].scale);
    target.value = typed;
    changed(true);
  });
  drop.querySelector('.units').addEventListener('click', () => {
    setScale(which, unitsOffer(which)[0]);
    refit();
  });
}

// ---- scenes, and links to them

// A file of the gallery: text that is made, or that stands in the page, behind a line's end.
const sourceOf = (source) =>
  encoded(typeof source === 'string' ? find(source).textContent.slice(1) : source());

function openScene(name) {
  const {files, scales = [1, 1], note} = SCENES[name];
  if (name === 'arm' && !robot)
    makeRobot();
  current = name;
  document.body.dataset.scene = name;
  files?.forEach(([file, source, body], which) => {
    loadBody(which, file, sourceOf(source), baked[body]);
    Object.assign(bodies[which], {scale: scales[which], dropped: false, unsure: false});
    find(`drop-${which}`).querySelector('.error').textContent = '';
  });
  show('copied', '');
  if (files)
    bodies.forEach((_, which) => showBody(which));
  for (const link of document.querySelectorAll('#gallery a'))
    link.toggleAttribute('aria-current', link.hash === `#v=1&scene=${name}`);
  show('note', note);
  find('follow').checked = true;
  refit();
}

function makeRobot() {
  robot = createArm(library.robot);
  robot.parts.forEach((part, i) => {
    Object.assign(part, boxOf(part), {scale: 1});
    scene?.loadMesh(`part-${i}`, part);
  });
  find('bends').replaceChildren(...robot.joints.map((joint, i) => {
    const row = find('bend').content.cloneNode(true).firstElementChild;
    row.querySelector('span').textContent = joint.replace('_', ' ');
    row.querySelector('input').addEventListener('input', ({target}) =>
      setBends(bends.with(i, Number(target.value))));
    return row;
  }));
}
function setBends(degrees) {
  bends = degrees;
  robot.bend(bends.map((x) => x * Math.PI / 180));
  [...find('bends').children].forEach((row, i) => {
    row.querySelector('input').value = bends[i];
    row.querySelector('output').textContent = `${bends[i]}°`;
  });
  changed(true);
}

// The page's state as a link has it.
function writeLink() {
  const words = {v: 1, scene: current};
  if (isArm()) {
    words.bend = bends;
  } else {
    motion.forEach((pose, i) => words[['start', 'end'][i]] = written(pose));
    const {method} = question();
    Object.assign(words, {scales: bodies.map(({scale}) => scale), method,
      first: Number(find('first').checked), clearance: Number(find('clearance').value)});
    bodies.forEach(({dropped, name}, i) => {
      if (dropped)
        words['ab'[i]] = name;
    });
  }
  const text = Object.entries(words).map(([key, value]) =>
    `${key}=${encodeURIComponent(value).replaceAll('%2C', ',')}`);
  history.replaceState(null, '', `#${text.join('&')}`);
}

// What a link says, checked; throws an Error with the reason.
const LINK_WORDS =
  ['v', 'scene', 'bend', 'start', 'end', 'scales', 'method', 'first', 'clearance', 'a', 'b'];
function readLink(hash) {
  const words = new URLSearchParams(hash.slice(1));
  const refuse = (why) => {
    throw new Error(why);
  };
  const short = (text) => `“${text.slice(0, 40)}”`;
  for (const key of words.keys()) {
    if (!LINK_WORDS.includes(key))
      refuse(`${short(key)} means nothing`);
    if (words.getAll(key).length > 1)
      refuse(`${key} is there twice`);
  }
  if (words.get('v') !== '1')
    refuse(`it is of version ${short(words.get('v') ?? '')}, and this page reads 1`);
  const name = words.get('scene') ?? '';
  if (!Object.hasOwn(SCENES, name))
    refuse(`there is no scene ${short(name)}`);
  for (const key of ['a', 'b'])
    if (words.has(key))
      refuse(`${short(words.get(key))} was dropped, and no link holds a file: drop it again`);
  const read = (key, count, low, high) => {
    const list = words.get(key)?.split(',').map((text) => text.trim() ? Number(text) : NaN);
    if (list && (list.length !== count || !list.every((x) => x >= low && x <= high)))
      refuse(`${key} is not ${count} number${count > 1 ? 's' : ''} from ${low} to ${high}`);
    return list;
  };
  const method = words.get('method') ?? 'proof';
  if (!Object.hasOwn(METHODS, method))
    refuse(`there is no method ${short(method)}`);
  const poses = ['start', 'end'].map((key) => read(key, 7, -1e6, 1e6));
  for (const pose of poses)
    if (pose && Math.abs(Math.hypot(...pose.slice(3)) - 1) > 1e-4)
      refuse('a rotation is no quaternion of length 1');
  return {name, method, poses, bend: read('bend', 6, -60, 60), scales: read('scales', 2, 1e-6, 1e6),
    first: read('first', 1, 0, 1) ?? [1], clearance: read('clearance', 1, 0, 1e6) ?? [0]};
}

function openLink(hash) {
  const {name, method, poses, bend, scales, first, clearance} = readLink(hash);
  openScene(name);
  find('first').checked = first[0] === 1;
  find('clearance').value = clearance[0];
  document.querySelector(`[name=method][value=${method}]`).checked = true;
  showOptions();
  if (isArm())
    return bend && setBends(bend);
  scales?.forEach((scale, which) => setScale(which, scale));
  if (scales)
    refit();
  poses.forEach((pose, i) => {
    if (pose)
      motion[i] = {position: pose.slice(0, 3), rotation: pose.slice(3)};
  });
  library.sweep(question(), 1);  // throws what it thinks of these numbers
  motionChanged();
  resetView();
}

// The link that the page was opened with; one that is refused gives way to the first scene.
function openAddress(hash) {
  notify('');
  try {
    openLink(hash.length > 1 ? hash : '#v=1&scene=mug');
  } catch (error) {
    openLink('#v=1&scene=mug');
    notify(`This link is not opened: ${error.message}.`);
  }
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

// 0 or 1: A or B is under a place of the window; null: neither is.
function bodyUnder(x, y) {
  const from = camera();
  const {left, top} = canvas.getBoundingClientRect();
  const ray = rayThrough(from, x - left, y - top);
  const meets = (body, pose) => rayMeets(body, pose, body.scale, from.eye, ray);
  const now = poseAt(Number(find('time').value));
  const a = Math.min(...[...motion, now].map((pose) => meets(bodies[0], pose)));
  const b = meets(bodies[1], AT_REST);
  return a === b ? null : Number(b < a);
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
    if (event.button !== 0 || isArm())
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

// All that there is by now.
function loadScene() {
  bodies.forEach((body, which) => body.indices && scene.loadMesh(`body-${which}`, body));
  robot?.parts.forEach((part, i) => scene.loadMesh(`part-${i}`, part));
  if (!isArm())
    loadGround();
  changed(false);
}

function showOptions() {
  find('first').disabled = find('clearance').disabled = question().method !== 'proof';
}

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
  find('play').addEventListener('click', play);
  find('time').addEventListener('input', () => {
    stopPlaying();
    find('follow').checked = false;
    changed(false);
  });
  find('follow').addEventListener('input', () => changed(false));
  find('reset-view').addEventListener('click', resetView);
  find('reset-motion').addEventListener('click', resetMotion);
  find('save').addEventListener('click', save);
  find('unit-use').addEventListener('click', () => {
    const which = bodies.findIndex(({unsure}) => unsure);
    setScale(which, unitsOffer(which)?.[0] ?? bodies[which].scale);
    refit();
  });
  find('unit-keep').addEventListener('click', () => {
    bodies.find(({unsure}) => unsure).unsure = false;
    changed(true);
  });
  find('options').addEventListener('input', () => {
    showOptions();
    changed(true);
  });
  find('copy').addEventListener('click', async () => {
    writeLink();
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    notify('The link is copied, and stands in the address bar.');
  });
  find('copies').addEventListener('click', async ({target}) => {
    if (!target.value)
      return;
    const text = AS_TEXT[target.value](question(), bodies.map(pathOf));
    await navigator.clipboard?.writeText(text).catch(() => {});
    const isOurs = bodies.every(({dropped}) => !dropped);
    show('copied', `Copied, for the folder of ${current === 'mug' && isOurs ? 'the repository' : isOurs ?
      'a.obj and b.obj of a saved proof' : 'your files'}.`);
    find('copied').dataset.text = text;
  });
  // its own address: by now the page may have written the last state over it
  addEventListener('hashchange', ({newURL}) => openAddress(new URL(newURL).hash));
  addEventListener('dragover', dragOver);
  addEventListener('dragleave', dragEnd);
  addEventListener('drop', (event) => {
    dragEnd();
    loadFiles(bodyAt(event), event.dataTransfer?.files ?? []);
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
for (const which of [0, 1])
  makeDrop(which);
openAddress(location.hash);
frame();
await painted();
performance.mark('seen');
scene = createScene(canvas);
if (scene)
  loadScene();
else
  find('view').append('This browser has no WebGL 2: answers, but no picture.');
