// library.js - neuralsvcd.h as web.c exports it, for JavaScript. state.js comes after it.

const METHODS = {proof: 1, network: 2};  // nsvcd_method
const VERDICT = {UNDECIDED: 0, FREE: 1, HIT: 2};  // nsvcd_verdict
const BY = {PROOF: 0, NETWORK: 1};  // nsvcd_by
const WHY = {NOTHING: 0, TOO_NEAR: 1, WORK: 2, OPEN: 3};  // nsvcd_why

// Compiles the module, from a promise of a Response. What it returns throws an Error, with `line`
// of a file, where the library says no.
async function createLibrary(response) {
  const {instance} = await WebAssembly.instantiateStreaming(response);
  const c = instance.exports;
  // Views are made anew each time: those of memory that has grown are void.
  const floats = (at, count) => new Float32Array(c.memory.buffer, at, count);
  const words = (at, count) => new Uint32Array(c.memory.buffer, at, count);
  const doubles = (at, count) => new Float64Array(c.memory.buffer, at, count);
  const text = (at) => {
    const from = new Uint8Array(c.memory.buffer, at);
    return new TextDecoder().decode(from.slice(0, from.indexOf(0)));
  };
  const check = (result) => {
    if (result)
      throw new Error(text(c.web_result_string(result)));
  };

  // Bytes for the module, which gives them back.
  function give(bytes) {
    const at = c.web_text(bytes.length);
    if (!at)
      throw new Error('out of memory');
    new Uint8Array(c.memory.buffer).set(bytes, at);
    return at;
  }

  // Body 0 or 1, from a file: OBJ, STL, PLY or GLB; which of them it is.
  // baked: null, or the body that `svcd encode` makes of it.
  function encode(which, name, file, baked) {
    const named = give(new TextEncoder().encode(`${name}\0`));
    const body = baked ? give(baked) : 0;
    if (c.web_encode(which, named, give(file), file.length, body, baked?.length ?? 0))
      throw Object.assign(new Error(text(c.web_fault_reason())), {line: c.web_fault_line()});
    return text(c.web_fault_format());
  }
  const findings = (which) => text(c.web_findings(which)).split('\n').filter((line) => line);
  // nsvcd_mesh, copied.
  const mesh = (which) => meshAt(c.web_mesh(which));
  function meshAt(at) {
    const [positions, indices, vertices, triangles] = words(at, 4);
    return {positions: floats(positions, 3 * vertices).slice(),
      indices: words(indices, 3 * triangles).slice()};
  }
  // nsvcd_body_facts.
  function facts(which) {
    const at = c.web_facts(which);
    const [size, patches] = words(at, 2);
    return {size, patches, centre: [...floats(at + 8, 3)], radius: floats(at + 20, 1)[0]};
  }
  function setMotion(motion) {
    const poses = motion.flatMap(({position, rotation}) => [...position, ...rotation]);
    floats(c.web_motion(), 14).set(poses);
  }
  // Asks so many times; answer() is the last one's.
  function sweep({motion, scales, first, clearance, method}, times) {
    setMotion(motion);
    check(c.web_sweep(...scales, first, clearance, METHODS[method], times));
  }
  // Asks how near they come, where they are free: an answer of its own.
  function distance({motion, scales}) {
    setMotion(motion);
    check(c.web_distance(...scales));
    return answerAt(c.web_nearest());
  }
  const answer = () => answerAt(c.web_answer());
  // nsvcd_answer.
  function answerAt(at) {
    const f = floats(at, 102);
    const w = words(at, 102);
    return {
      verdict: w[0],
      by: w[1],
      inside: w[3] !== 0,
      time: {low: f[4], high: f[5]},
      distance: {low: f[6], high: f[7]},
      nearest: {
        point: [...f.slice(80, 83)], normal: [...f.slice(83, 86)],
        gap: f[86],
        time: f[87],
        triangles: [w[88], w[89]],
      },
      opinion: {logit: f[94]},
    };
  }
  // nsvcd_certificate of the last answer, and its bytes, copied.
  function certify({motion, scales, clearance}) {
    setMotion(motion);
    check(c.web_certify(...scales, clearance));
    return certificate();
  }
  function certificate() {
    const w = words(c.web_certificate(), 7);
    const at = c.web_proof();
    return {verdict: w[0], why: w[1], bytes: new Uint8Array(c.memory.buffer).slice(at, at + w[6])};
  }

  // ---- a robot, by arm.h

  const joint = (numbers) => check(c.arm_joint(...numbers));
  const part = (link, obj) => check(c.arm_part(link, give(obj), obj.length));
  const pair = (a, b) => check(c.arm_pair(a, b));
  // A motion between two configurations: Bezier pieces of joints in time, proven free.
  function plan(ends) {
    ends.forEach((end, i) => doubles(c.arm_end(i), end.length).set(end));
    check(c.arm_plan());
    const pieces = c.arm_pieces();
    const degree = c.arm_degree();
    const count = (pieces * degree + 1) * ends[0].length;
    return {pieces, degree, times: doubles(c.arm_times(), pieces + 1).slice(),
      points: doubles(c.arm_points(), count).slice()};
  }
  const setPoints = (points) => doubles(c.arm_points(), points.length).set(points);
  function placeParts(time, count) {
    const f = floats(c.arm_place(time), 7 * count);
    return Array.from({length: count}, (_, i) => (
      {position: [...f.slice(7 * i, 7 * i + 3)], rotation: [...f.slice(7 * i + 3, 7 * i + 7)]}));
  }
  // nsvcd_check_answer of the last of so many checks.
  function checkMotion(times) {
    check(c.arm_check(times));
    const at = c.arm_checked();
    const w = words(at, 17);
    const f = floats(at, 17);
    return {verdict: w[0], pair: w[2], piece: w[3], share: doubles(at + 16, 1)[0],
      point: [...f.slice(6, 9)], normal: [...f.slice(9, 12)], triangles: [w[14], w[15]]};
  }
  function certifyPair(n) {
    check(c.arm_certify(n));
    return certificate();
  }
  const robot = {joint, part, pair, plan, setPoints, placeParts, checkMotion, certifyPair,
    mesh: (n) => meshAt(c.arm_mesh(n))};
  return {encode, findings, mesh, facts, sweep, distance, answer, certify, robot};
}
