// hands.js - mouse, fingers and keys move the start, the end and the view.

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
