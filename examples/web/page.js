// page.js - the last room: who listens to what, and the order in which the page begins.

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
    stopPlaying(false);
    find('follow').checked = false;
    changed(false);
  });
  find('follow').addEventListener('input', () => {
    stopPlaying(false);
    changed(false);
  });
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
  find('copy').addEventListener('click', copyLink);
  find('copies').addEventListener('click', ({target}) => target.value && copyQuestion(target.value));
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
  const typed = find(`pose-${i}`).value.trim().split(/[\s,]+/);
  const values = typed.map(Number);
  const before = motion[i];
  motion[i] = {position: values.slice(0, 3), rotation: values.slice(3)};
  try {
    const wrong = typed.find((_, k) => Number.isNaN(values[k]));
    if (wrong !== undefined)
      throw new Error(`“${wrong.slice(0, 40)}” is not a number`);
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
