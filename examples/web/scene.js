// scene.js - draws two bodies, ghosts of one of them and marks, with WebGL 2; finds what is under
// the pointer. The half of the page that knows nothing of the library. state.js comes after it.
//
// A pose is {position: [x, y, z], rotation: [x, y, z, w]}; a body's point is scaled, turned, moved.

// ---- vectors and quaternions

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const length = (a) => Math.hypot(...a);
const unit = (a) => scaled(a, 1 / (length(a) || 1));

const conjugate = (q) => [-q[0], -q[1], -q[2], q[3]];
const normalized = (q) => q.map((c) => c / Math.hypot(...q));
const aboutAxis = (axis, angle) => [...scaled(axis, Math.sin(angle / 2)), Math.cos(angle / 2)];
function multiply(a, b) {  // the rotation by b, then by a
  const v = add(cross(a, b), add(scaled(b, a[3]), scaled(a, b[3])));
  return [...v, a[3] * b[3] - dot(a, b)];
}
function rotate(q, a) {
  const half = add(cross(q, a), scaled(a, q[3]));
  return add(a, scaled(cross(q, half), 2));
}
const apply = (pose, scale, a) => add(rotate(pose.rotation, scaled(a, scale)), pose.position);

// Between two poses as the library has it: positions linear, rotations slerped on the shorter arc.
function between(from, to, t) {
  const a = from.rotation;
  let b = to.rotation;
  let cosine = a.reduce((sum, c, i) => sum + c * b[i], 0);
  if (cosine < 0) {
    b = b.map((c) => -c);
    cosine = -cosine;
  }
  const angle = Math.acos(Math.min(1, cosine));
  const [u, v] = angle < 1e-3 ? [1 - t, t] : [Math.sin((1 - t) * angle), Math.sin(t * angle)];
  return {
    position: add(scaled(from.position, 1 - t), scaled(to.position, t)),
    rotation: normalized(a.map((c, i) => u * c + v * b[i])),
  };
}

// ---- meshes

// Corners that share a place share a normal, unless their faces meet at a crease.
const CREASE = Math.cos(0.7);

// Of each face: its normal by its area, and of unit length.
function faceNormals(positions, indices) {
  const normals = [];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * indices[i + k];
      return [positions[at], positions[at + 1], positions[at + 2]];
    });
    const normal = cross(subtract(b, a), subtract(c, a));
    normals.push({normal, unit: unit(normal)});
  }
  return normals;
}

// Faces about each place; `places` has the place of each vertex.
function facesByPlace(positions, indices) {
  const known = new Map();
  const places = new Uint32Array(positions.length / 3);
  for (let v = 0; v < places.length; v++) {
    const key = `${positions[3 * v]} ${positions[3 * v + 1]} ${positions[3 * v + 2]}`;
    if (!known.has(key))
      known.set(key, known.size);
    places[v] = known.get(key);
  }
  const faces = Array.from(known, () => []);
  indices.forEach((vertex, corner) => faces[places[vertex]].push(Math.floor(corner / 3)));
  return {places, faces};
}

// Positions and normals of all corners, one after the other.
function cornersOf(positions, indices) {
  const normals = faceNormals(positions, indices);
  const {places, faces} = facesByPlace(positions, indices);
  const out = new Float32Array(6 * indices.length);
  indices.forEach((vertex, corner) => {
    const own = normals[Math.floor(corner / 3)];
    let sum = [0, 0, 0];
    for (const face of faces[places[vertex]])
      if (dot(own.unit, normals[face].unit) >= CREASE)
        sum = add(sum, normals[face].normal);
    out.set(positions.subarray(3 * vertex, 3 * vertex + 3), 6 * corner);
    out.set(unit(sum), 6 * corner + 3);
  });
  return out;
}

// A surface of revolution about z, by its profile of [radius, z].
function turned(profile, sides = 20) {
  const positions = [];
  const indices = [];
  for (const [radius, z] of profile)
    for (let i = 0; i < sides; i++) {
      const angle = 2 * Math.PI * i / sides;
      positions.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
    }
  for (let row = 0; row + 1 < profile.length; row++)
    for (let i = 0; i < sides; i++) {
      const [a, b] = [row * sides + i, row * sides + (i + 1) % sides];
      indices.push(a, b, b + sides, a, b + sides, a + sides);
    }
  return {positions: new Float32Array(positions), indices: new Uint32Array(indices)};
}
const ARROW = turned([[0, 0], [0.035, 0], [0.035, 0.7], [0.1, 0.7], [0, 1]]);
const BALL = turned(Array.from({length: 11}, (_, i) => {
  const angle = Math.PI * i / 10;
  return [Math.sin(angle), -Math.cos(angle)];
}));

// The distance along a ray at which it meets a mesh, or Infinity. Moeller and Trumbore 1997.
function rayMeets(mesh, pose, scale, origin, direction) {
  const back = conjugate(pose.rotation);
  const from = scaled(rotate(back, subtract(origin, pose.position)), 1 / scale);
  const along = scaled(rotate(back, direction), 1 / scale);
  const {positions, indices} = mesh;
  const vertex = (i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
  let least = Infinity;
  for (let i = 0; i < indices.length; i += 3) {
    const a = vertex(indices[i]);
    const ab = subtract(vertex(indices[i + 1]), a);
    const ac = subtract(vertex(indices[i + 2]), a);
    const p = cross(along, ac);
    const determinant = dot(ab, p);
    const to = subtract(from, a);
    const u = dot(to, p) / determinant;
    const q = cross(to, ab);
    const v = dot(along, q) / determinant;
    const t = dot(ac, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < least)
      least = t;
  }
  return least;
}

// ---- the camera: it looks at `target`, z is up

const FIELD = Math.tan(0.3);  // half the height of the picture, at distance 1

function cameraOf(view, width, height) {
  const {yaw, pitch, distance, target} = view;
  const back = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
  const right = [-Math.sin(yaw), Math.cos(yaw), 0];
  return {
    eye: add(target, scaled(back, distance)),
    back,
    right,
    up: cross(back, right),
    aspect: width / height,
    near: distance / 50,
    far: distance * 50,
    width,
    height,
  };
}

// From the world to the picture, column by column.
function projectionOf(camera) {
  const {eye, back, right, up, near, far, aspect} = camera;
  const x = scaled(right, 1 / (FIELD * aspect));
  const y = scaled(up, 1 / FIELD);
  const z = scaled(back, (near + far) / (near - far));
  const columns = [0, 1, 2].map((i) => [x[i], y[i], z[i], -back[i]]);
  const depth = 2 * near * far / (near - far) - dot(z, eye);
  return new Float32Array([...columns.flat(), -dot(x, eye), -dot(y, eye), depth, dot(back, eye)]);
}

// Where a point is in the picture, pixels; null behind the camera.
function toScreen(camera, point) {
  const a = subtract(point, camera.eye);
  const depth = -dot(a, camera.back);
  if (depth < camera.near)
    return null;
  const half = camera.height / 2 / FIELD / depth;
  return [
    camera.width / 2 + dot(a, camera.right) * half,
    camera.height / 2 - dot(a, camera.up) * half,
  ];
}
const metresPerPixel = (camera, point) =>
  2 * FIELD * Math.abs(dot(subtract(camera.eye, point), camera.back)) / camera.height;

function rayThrough(camera, x, y) {
  const across = (2 * x / camera.width - 1) * FIELD * camera.aspect;
  const upwards = (1 - 2 * y / camera.height) * FIELD;
  const sideways = add(scaled(camera.right, across), scaled(camera.up, upwards));
  return unit(subtract(sideways, camera.back));
}

// ---- WebGL

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 projection;
uniform vec3 place;
uniform vec4 turn;
uniform float size;
out vec3 world;
out vec3 facing;
vec3 turned(vec3 a) {
  return a + 2. * cross(turn.xyz, cross(turn.xyz, a) + turn.w * a);
}
void main() {
  world = turned(size * position) + place;
  facing = turned(normal);
  gl_Position = projection * vec4(world, 1);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 world;
in vec3 facing;
uniform vec3 eye;
uniform vec4 colour;
uniform bool lit;
out vec4 shown;
void main() {
  vec3 view = normalize(eye - world);
  vec3 normal = normalize(facing);
  normal = dot(normal, view) < 0. ? -normal : normal;
  vec3 lamp = normalize(vec3(.3, -.5, .8));
  float light = .5 + .2 * dot(normal, view) + .4 * max(0., dot(normal, lamp));
  shown = vec4(colour.rgb * (lit ? light : 1.), colour.a);
}`;

function buildProgram(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(program));
  return program;
}

// Meshes on the graphics card, by name.
function createMeshes(gl) {
  const meshes = new Map();
  function make() {
    const array = gl.createVertexArray();
    const buffer = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    for (const at of [0, 1]) {
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 24, 12 * at);
    }
    return {array, buffer};
  }
  // Numbers: position and normal of each corner.
  function load(name, corners, mode) {
    const mesh = meshes.get(name) ?? make();
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.DYNAMIC_DRAW);
    meshes.set(name, {...mesh, mode, count: corners.length / 6});
  }
  const loadMesh = (name, {positions, indices}) =>
    load(name, cornersOf(positions, indices), gl.TRIANGLES);
  function loadLines(name, points) {
    load(name, new Float32Array(points.flatMap((a) => [...a, 0, 0, 1])), gl.LINES);
  }
  // One triangle of a mesh: `triangle-NAME`, and its sides, `edges-NAME`.
  function loadTriangle(name, {positions, indices}, triangle) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * indices[3 * triangle + k];
      return [...positions.subarray(at, at + 3)];
    });
    loadMesh(`triangle-${name}`,
      {positions: new Float32Array([a, b, c].flat()), indices: new Uint32Array([0, 1, 2])});
    loadLines(`edges-${name}`, [a, b, b, c, c, a]);
  }
  loadMesh('arrow', ARROW);
  loadMesh('ball', BALL);
  return {get: (name) => meshes.get(name), loadMesh, loadLines, loadTriangle};
}

// What draws on a canvas; null where there is no WebGL 2. A thing to draw is {mesh, pose, size,
// colour, alpha}: the mesh by the name that it was loaded under, the colour as three numbers.
function createScene(canvas) {
  const gl = canvas.getContext('webgl2', {antialias: true, stencil: true});
  if (!gl)
    return null;
  const program = buildProgram(gl);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const meshes = createMeshes(gl);
  gl.useProgram(program);
  gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);

  function drawThing({mesh, pose, size, colour, alpha}) {
    const {array, mode, count} = meshes.get(mesh);
    gl.uniform3fv(uniform('place'), pose.position);
    gl.uniform4fv(uniform('turn'), pose.rotation);
    gl.uniform1f(uniform('size'), size);
    gl.uniform4f(uniform('colour'), ...colour, alpha);
    gl.uniform1i(uniform('lit'), mode === gl.TRIANGLES ? 1 : 0);
    gl.bindVertexArray(array);
    gl.drawArrays(mode, 0, count);
  }

  // Its nearest surface alone, so that it looks like glass and not like what is inside.
  function drawGhost(thing) {
    gl.colorMask(false, false, false, false);
    drawThing(thing);
    gl.colorMask(true, true, true, true);
    drawThing(thing);
  }

  // Solids, then ghosts from the farthest to the nearest, but not before the last of the solids;
  // marks are seen through what hides them.
  function draw(camera, solids, ghosts, marks) {
    const away = ({pose}) => length(subtract(pose.position, camera.eye));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.uniformMatrix4fv(uniform('projection'), false, projectionOf(camera));
    gl.uniform3fv(uniform('eye'), camera.eye);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    solids.forEach((solid, i) => {
      gl.stencilFunc(gl.ALWAYS, i === solids.length - 1 ? 1 : 0, 1);
      drawThing(solid);
    });
    gl.stencilFunc(gl.EQUAL, 0, 1);
    [...ghosts].sort((a, b) => away(b) - away(a)).forEach(drawGhost);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.DEPTH_TEST);
    marks.forEach((mark) => drawThing({...mark, alpha: 0.6 * mark.alpha}));
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(-2, -8);
    marks.forEach(drawThing);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  const {loadMesh, loadLines, loadTriangle} = meshes;
  return {draw, loadMesh, loadLines, loadTriangle};
}
