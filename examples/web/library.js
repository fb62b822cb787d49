// library.js - neuralsvcd.h as web.c exports it, for JavaScript. page.js comes after it.

const METHODS = {proof: 1, network: 2};  // nsvcd_method
const VERDICT = {UNDECIDED: 0, FREE: 1, HIT: 2};  // nsvcd_verdict
const BY = {PROOF: 0, NETWORK: 1};  // nsvcd_by
const WHY = {NOTHING: 0, TOO_NEAR: 1, WORK: 2};  // nsvcd_why

// Compiles the module. What it returns throws an Error with `line` where the library says no.
async function createLibrary(bytes) {
  const {instance} = await WebAssembly.instantiate(bytes);
  const c = instance.exports;
  // Views are made anew each time: those of memory that has grown are void.
  const floats = (at, count) => new Float32Array(c.memory.buffer, at, count);
  const words = (at, count) => new Uint32Array(c.memory.buffer, at, count);
  const text = (at) => {
    const from = new Uint8Array(c.memory.buffer, at);
    return new TextDecoder().decode(from.slice(0, from.indexOf(0)));
  };
  const check = (result, line = 0) => {
    if (result)
      throw Object.assign(new Error(text(c.web_result_string(result))), {line});
  };

  // Body 0 or 1, from the bytes of an OBJ file.
  function encode(which, obj) {
    const at = c.web_text(obj.length);
    if (!at)
      throw new Error('out of memory');
    new Uint8Array(c.memory.buffer).set(obj, at);
    check(c.web_encode(which, at, obj.length), c.web_error_line());
  }
  // nsvcd_mesh, copied.
  function mesh(which) {
    const [positions, indices, vertices, triangles] = words(c.web_mesh(which), 4);
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
  // nsvcd_answer.
  function answer() {
    const at = c.web_answer();
    const f = floats(at, 101);
    const w = words(at, 101);
    return {
      verdict: w[0],
      by: w[1],
      inside: w[3] !== 0,
      time: {low: f[4], high: f[5]},
      distance: {low: f[6], high: f[7]},
      nearest: {
        point: [...f.slice(80, 83)], normal: [...f.slice(83, 86)],
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
    const w = words(c.web_certificate(), 7);
    const at = c.web_proof();
    return {verdict: w[0], why: w[1], bytes: new Uint8Array(c.memory.buffer).slice(at, at + w[6])};
  }
  return {encode, mesh, facts, sweep, answer, certify};
}
