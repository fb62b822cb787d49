// links.js - opens scenes, and the page's state as a link has it.

// A file of the gallery: text that is made, or that stands in the page, behind a line's end.
const sourceOf = (source) =>
  encoded(typeof source === 'string' ? find(source).textContent.slice(1) : source());

function openScene(name) {
  const {files, scales = [1, 1]} = SCENES[name];
  if (name === 'arm' && !robot)
    makeRobot();
  current = name;
  document.body.dataset.scene = name;
  files?.forEach(([file, source, body], which) => {
    loadBody(which, file, sourceOf(source), baked[body]);
    Object.assign(bodies[which], {scale: scales[which], dropped: false, unsure: false});
    find(`drop-${which}`).querySelector('.error').textContent = '';
  });
  showCopied('');
  if (files)
    bodies.forEach((_, which) => showBody(which));
  find('follow').checked = true;
  refit();
}

// Are the bodies and the motion still those of the scene?
function isScenes() {
  const {motion: own, scales = [1, 1]} = SCENES[current];
  const same = (a, b) => a.every((x, k) => Math.abs(x - b[k]) < 1e-6);
  return isArm() ? bends.every((x) => x === 0) :
    bodies.every(({dropped, scale}, i) => !dropped && scale === scales[i]) &&
    motion.every(({position, rotation}, i) =>
      same(position, own[i].position) && same(rotation, own[i].rotation));
}
function showScene() {
  const own = isScenes();
  for (const link of document.querySelectorAll('#gallery a'))
    link.ariaCurrent = own && link.hash === `#v=1&scene=${current}` ? 'true' : null;
  show('note', own ? SCENES[current].note : isArm() ? 'The arm\'s motion, bent, and asked about anew.' :
    `${bodies[0].name} moves, ${bodies[1].name} rests.`);
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
  return {name, method, poses, files: ['a', 'b'].map((key) => words.get(key)),
    bend: read('bend', 6, -60, 60), scales: read('scales', 2, 1e-6, 1e6),
    first: read('first', 1, 0, 1) ?? [1], clearance: read('clearance', 1, 0, 1e6) ?? [0]};
}

// What a link says that names files, until they are dropped.
let wanted = null;
const isWanted = () => wanted?.files.every((file, which) =>
  !file || bodies[which].dropped && bodies[which].name === file);
function openLink(hash) {
  const link = readLink(hash);
  const files = link.files.filter((file) => file).map((file) => `“${file.slice(0, 40)}”`).join(' and ');
  openScene(link.name);
  wanted = files ? link : null;
  if (!wanted)
    return applyLink(link);
  notify(`This link was made with ${files}, and no link holds a file: drop it again, and its motion ` +
    'follows.');
}
function applyLink({method, poses, bend, scales, first, clearance}) {
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
