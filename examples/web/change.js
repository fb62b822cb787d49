// change.js - what happens when something changes: a question, before the next picture. Playing, and
// where a scene begins.

// ---- playing it

let playing = 0;
let paused = false;  // on its way: the time stays there
function play() {
  if (playing)
    return stopPlaying(true);
  const end = find('follow').checked && answer ? contactTime(answer) : 1;
  const from = paused ? Number(find('time').value) % end || 0 : 0;
  const begin = performance.now() - 3000 * from;
  const step = (now) => {
    const time = Math.min(end, Math.max(from, (now - begin) / 3000));
    find('time').value = time;
    changed(false);
    if (time < end)
      playing = requestAnimationFrame(step);
    else
      stopPlaying(false);
  };
  playing = requestAnimationFrame(step);
  show('play', 'Pause');
}
function stopPlaying(isPause) {
  cancelAnimationFrame(playing);
  playing = 0;
  paused = isPause;
  show('play', 'Play');
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
    showCopied('');
    showScene();
    clearTimeout(settled);
    settled = setTimeout(() => {
      showProof(prove());
      writeLink();
      closest = measure();
      settle(isArm() ? 1 : 3);
      say();
      changed(false);
    }, 250);
  }
  asking = false;
  if (find('follow').checked && !playing && !paused)
    find('time').value = answer ? contactTime(answer) : 1;
  show('time-text', Number(find('time').value).toFixed(3));
  draw();
}
function changed(isQuestion) {
  if (isQuestion)
    stopPlaying(false);
  asking ||= isQuestion;
  if (!waiting)
    requestAnimationFrame(frame);
  waiting = true;
}
function motionChanged() {
  show('pose-error', '');
  motion.forEach(({position, rotation}, i) => {
    find(`pose-${i}`).value = [...position, ...rotation].map((x) => +x.toFixed(6)).join(' ');
  });
  changed(true);
}

function resetView() {
  const {yaw = -0.42, pitch = 0.3} = SCENES[current];
  Object.assign(view, {yaw, pitch, fitted: false});
  changed(false);
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
