// state.js - what the page holds: the library, two bodies, a motion, an answer; what is asked of it,
// and what an answer is called. The rooms after it show that and change it.

const encoded = (text) => new TextEncoder().encode(text);

const AT_REST = {position: [0, 0, 0], rotation: [0, 0, 0, 1]};
const FIRST = 0.01;  // tolerance of first contacts, a share of the motion
const GHOSTS = 9;    // start and end among them
const LARGE = 30, SMALL = 0.001;  // metres: bodies beyond these are hardly meant
const UNLIKE = 100;  // and hardly ones that differ by this factor

// Until the next picture is there.
const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

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
let closest = null;  // the distance's answer to the same question, once nothing moves
let current = 'mug';  // of SCENES
let robot = null;  // made when its scene is opened first
let bends = [];  // degrees, of its joints
const isArm = () => current === 'arm';

// ---- sizes

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

const extentOf = ({low, high, scale}) => scale * Math.max(...subtract(high, low));

// A scale that is likely meant, and why; null where the size may be right.
function unitsOffer(which) {
  const [mine, other] = [extentOf(bodies[which]), extentOf(bodies[1 - which])];
  const to = (factor) => +(bodies[which].scale * factor).toPrecision(6);
  if (mine > LARGE || mine > UNLIKE * other && other >= SMALL)
    return [to(0.001), `These look like millimetres: use ${to(0.001)}`];
  return mine > 0 && mine < SMALL ? [to(1000), `Too small by a thousand? Use ${to(1000)}`] : null;
}

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
function describe(answer, {method, clearance, first}) {
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
  const more = first > 0 ? '' : '; perhaps not for the first time';
  if (answer.by === BY.NETWORK)
    return hits ? ['hit', 'Probably hits', opinion] : ['free', 'Probably free', opinion];
  if (hits && clearance > 0)
    return ['hit', `Closer than ${near}`, `Proven: these two triangles come as close${more}.`];
  if (hits)
    return ['hit', 'Hit', `Proven: these two triangles meet${more}.`];
  if (clearance > 0)
    return ['free', 'Free', `Certified: never closer than ${near}, rotation included.`];
  return ['free', 'Free', 'Certified: the surfaces never meet, rotation included.'];
}
// Is it that the network thinks so, and no more?
const isOpinion = (answer) => answer?.by === BY.NETWORK && !answer.inside;
// Is it a hit that something earlier may precede?
const isAny = (answer) =>
  answer?.verdict === VERDICT.HIT && answer.by === BY.PROOF && !answer.inside && !answer.first;
// Are there two triangles that prove a hit?
const isWitnessed = (answer) =>
  answer?.verdict === VERDICT.HIT && answer.by === BY.PROOF && !answer.inside;
// Where they meet, or come nearest: {point, normal, time, triangles, gap}; null: not known.
const shownContact = () => closest?.nearest ?? (isWitnessed(answer) ? answer.nearest : null);
// When they hit, or come too near to tell; where they are free, the end.
const contactTime = ({verdict, time, nearest}) =>
  verdict === VERDICT.UNDECIDED ? nearest.time : time.high;
