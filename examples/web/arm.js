// arm.js - a robot among obstacles: a planned motion that hands can bend, its verdict, its proof.
// What the robot is stands in a planning file, examples/FORMATS.md, and its meshes. state.js comes
// after it.

const ARM_FILES = 'arm-files';  // the element that has them: `== NAME` before each

function readFiles(text) {
  const files = new Map();
  for (const part of text.trim().split(/^== /m).slice(1)) {
    const end = part.indexOf('\n');
    files.set(part.slice(0, end), part.slice(end + 1));
  }
  return files;
}

// Names of joints, parts and pairs are numbers for the module. Obstacles lie where their meshes do,
// as urdf.py writes them.
function nameRobot(robot, files) {
  const joints = [];
  const parts = [];
  const pairs = [];
  const lines = files.get('arm.txt').split('\n').map((line) => line.trim().split(/\s+/));
  for (const [word, ...f] of lines) {
    if (word === 'joint') {
      const kind = ['revolute', 'continuous', 'prismatic'].indexOf(f[12]);
      const numbers = f.slice(2, 12).map(Number);
      robot.joint([kind, joints.indexOf(f[1]) + 1, ...numbers, ...f.slice(13, 17).map(Number)]);
      joints.push(f[0]);
    } else if (word === 'body' || word === 'obstacle') {
      const [name, link, mesh] = word === 'body' ? f : [f[0], 'world', f[1]];
      parts.push({name, moves: link !== 'world', obstacle: word === 'obstacle'});
      robot.part(joints.indexOf(link) + 1, new TextEncoder().encode(files.get(mesh)));
    } else if (word === 'pair') {
      pairs.push(f.map((name) => parts.findIndex((part) => part.name === name)));
    }
  }
  parts.forEach(({obstacle, moves}, a) => parts.forEach((part, b) => {
    if (moves && !obstacle && part.obstacle)
      pairs.push([a, b]);
  }));
  pairs.forEach(([a, b]) => robot.pair(a, b));
  const plan = lines.find(([word]) => word === 'plan').slice(3).map(Number);
  const ends = [plan.slice(0, joints.length), plan.slice(joints.length)];
  return {joints, parts, pairs, ends};
}

// The robot, planned; bend() moves the middle of its motion, and leaves both ends where they are.
function createArm(robot) {
  const files = readFiles(document.getElementById(ARM_FILES).textContent);
  const {joints, parts, pairs, ends} = nameRobot(robot, files);
  const way = robot.plan(ends);
  const duration = way.times.at(-1);
  const rows = way.pieces * way.degree;
  let points = way.points;
  parts.forEach((part, i) => Object.assign(part, robot.mesh(i)));

  // By so many radians each.
  function bend(by) {
    points = way.points.map((value, i) => {
      const share = Math.floor(i / joints.length) / rows;
      return value + by[i % joints.length] * Math.sin(Math.PI * share) ** 2;
    });
    points.set(way.points.subarray(-joints.length), points.length - joints.length);
    robot.setPoints(points);
  }
  // At a share of the motion, [0,1].
  const poses = (share) => robot.placeParts(share * duration, parts.length);

  // As library.js has an answer, with the names of the parts that meet.
  function ask(times) {
    const found = robot.checkMotion(times);
    const hit = found.verdict === VERDICT.HIT;
    const named = found.verdict !== VERDICT.FREE && pairs[found.pair];
    const {piece, share} = found;
    const [from, to] = [way.times[piece], way.times[piece + 1]];
    const at = named ? (from * (1 - share) + to * share) / duration : 1;
    return {
      verdict: found.verdict,
      by: BY.PROOF,
      inside: hit && found.triangles[0] === 0xffffffff,
      time: {low: found.verdict === VERDICT.FREE ? 1 : 0, high: at},
      distance: {low: 0},
      nearest: {point: found.point, normal: found.normal, time: at, triangles: found.triangles},
      pair: named || null,
    };
  }

  // Files of the proof that it is free, for build/verify; throws where there is none.
  function prove() {
    const chunks = [];
    const put = (size, set) => {
      const view = new DataView(new ArrayBuffer(size));
      set(view);
      chunks.push(new Uint8Array(view.buffer));
    };
    const word = (n) => put(4, (view) => view.setUint32(0, n, true));
    const number = (x) => put(8, (view) => view.setFloat64(0, x, true));
    chunks.push(new TextEncoder().encode('NSVM'));
    [way.pieces, way.degree, joints.length].forEach(word);
    way.times.forEach(number);
    points.forEach(number);
    word(pairs.length);
    pairs.forEach(([a, b], n) => {
      const {verdict, bytes} = robot.certifyPair(n);
      if (verdict !== VERDICT.FREE)
        throw new Error(`No certificate for ${parts[a].name} and ${parts[b].name}`);
      word(bytes.length);
      chunks.push(bytes);
    });
    const bytes = new Uint8Array(chunks.reduce((sum, {length}) => sum + length, 0));
    chunks.reduce((at, chunk) => (bytes.set(chunk, at), at + chunk.length), 0);
    const texts = [...files].map(([name, text]) => [name, new TextEncoder().encode(text)]);
    return [['up.cert', bytes], ...texts];
  }
  return {joints, parts, pairs, bend, poses, ask, prove};
}
