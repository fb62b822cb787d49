// trade.js - trade.html: a handle along the front, what is missed there, a chart, and a picture of a
// motion that is missed. It comes after trade_answers.js.

const ROUNDS = 4;  // in which times are measured: the least counts
let setting = 2;   // of SETTINGS
let shown = null;  // the number of the motion in the picture
let ready = false;  // the set's motions are made

// One after the other: first what every setting says, then how long it takes.
async function work(mine) {
  if (known[set].measured)
    return;
  for (let which = 0; which < SETTINGS.length; which++) {
    answer(which);
    showNumbers();
    await pause();
    if (mine !== job)
      return;
  }
  for (let round = 0; round < ROUNDS; round++)
    for (const which of SETTINGS.keys()) {
      await measure(which, mine);
      if (mine !== job)
        return;
      showNumbers();
    }
  known[set].measured = true;
  performance.mark('measured');
}

// ---- words

const show = (id, text) => {
  find(id).textContent = text;
};
const percent = (share) => share < 0.001 ? 'less than 0.1\u00a0%' :
  `${(100 * share).toPrecision(share < 0.095 ? 1 : 2)}\u00a0%`;
const micro = (time) => time === null ? '…' : time.toPrecision(time < 100 ? 2 : 3);
const of = (some, what) => `${some || 'none'} of ${COUNT / 2} ${what}`;

function subject({kind, name}) {
  return {samples: name, thicker: `${name},`, network: `The ${name},`, proof: 'The proof'}[kind];
}
const BY_DEFINITION = `By definition: here a motion hits if the proof says so. Whether that is right was
  measured <a href="https://github.com/OWNER/neuralsvcd.h/blob/main/tests/bench/RESULTS.md#on-every-set"
  >against exact labels</a>.`;
function showSummary() {
  const {kind, samples} = SETTINGS[setting];
  const {missed, alarms, time} = answer(setting);
  const said = document.createElement('b');
  said.textContent = of(missed.length, 'hits');
  said.className = missed.length ? '' : 'none';
  const verb = samples ? 'miss' : 'misses';
  // Nothing is missed, but at a price: that is no lesser half.
  const alarmed = document.createElement('b');
  alarmed.textContent = `${alarms.length} false alarm${alarms.length > 1 ? 's' : ''}`;
  const isPriced = !missed.length && alarms.length > 0;
  find('summary').replaceChildren(`${subject(SETTINGS[setting])} ${verb} `, said,
    ...isPriced ? [', with ', alarmed] : []);
  find('summary').className = missed.length || alarms.length ? '' : 'right';
  const others = kind === 'proof' ? BY_DEFINITION :
    `False alarms: <strong>${of(alarms.length, 'free motions')}</strong>.`;
  find('rest').innerHTML = `${others}
    <strong><span id="time">${micro(time)}</span> µs</strong> a motion, in this browser<span id="slower"
    ></span>.`;
  showSlower();
}
// The handle goes from fast to sure, and yet its right end may take less time than what is before it.
function showSlower() {
  const times = answers().map((a) => a?.time);
  const isKnown = SETTINGS[setting].kind === 'proof' && times.every((time) => time);
  const slower = isKnown ? times.filter((time) => time > times[setting]).length : 0;
  show('slower', slower ? `: of the ${times.length - 1} ways that are less sure, ${slower} take${
    slower > 1 ? '' : 's'} longer` : '');
}

// What the picture shows, in a sentence.
function sentence(it) {
  const {kind, samples} = SETTINGS[setting];
  if (!it.gaps)
    return `This one is free: never nearer than ${(1000 * it.distance).toPrecision(2)} mm${
      it.isWrong ? `, and ${subject(SETTINGS[setting]).replace(/^The/, 'the')} ${
        samples ? 'say it hits' : 'says it hits'}` : ''}.`;
  const from = `first at ${percent(it.time)} of the motion`;
  if (!it.isWrong)
    return `This one is found: it touches ${from}.`;
  if (!samples)
    return `This one touches ${from}, for ${percent(it.share)} of it. The ${kind} says it is free.`;
  const [gap, ...more] = it.gaps;
  const others = more.length ? `, and in ${more.length} more gap${more.length > 1 ? 's' : ''}` : '';
  return `This one touches between sample ${gap + 1} and ${gap + 2}${others}, for ${
    percent(it.share)} of the motion.`;
}

function showMotion() {
  const {list, at, it} = current();
  show('number', list.length ? `${at < 0 ? '–' : at + 1} of ${list.length} wrong` : 'none wrong');
  find('previous').disabled = find('next').disabled = list.length < 2 && at >= 0 || !list.length;
  show('this', sentence(it));
  find('this').dataset.motion = it.i;
  const key = !it.gaps ? [['free', 'free']] : it.isWrong && it.parts > 1 ?
    [['free', 'samples, all free'], ['hit', 'missed between them']] :
    [['free', 'free'], ['hit', 'touching']];
  find('key').innerHTML = key.map(([colour, words]) =>
    `<span><i style="background: var(--${colour})"></i>${words}</span>`).join('');
}

// For screen readers, when hands rest: else they would be told of every stop.
let telling = 0;
function tell() {
  clearTimeout(telling);
  telling = setTimeout(() =>
    show('status', `${find('summary').textContent}. ${find('this').textContent}`), 600);
}

// ---- the chart and the table

const BOX = {left: 52, right: 352, top: 8, none: 34, first: 48, bottom: 204};
let points = [];  // of the chart: {which, x, y}

function axes() {
  const times = answers().map((a) => a?.time).filter((time) => time);
  const low = Math.floor(Math.log10(Math.min(1, ...times) / 1.2));
  const high = Math.ceil(Math.log10(Math.max(10, ...times) * 1.2));
  const x = (time) => BOX.left + (BOX.right - BOX.left) * (Math.log10(time) - low) / (high - low);
  const y = (wrong) => !wrong ? (BOX.top + BOX.none) / 2 :
    BOX.first + (BOX.bottom - BOX.first) * Math.log10(wrong) / Math.log10(COUNT);
  return {x, y, decades: Array.from({length: high - low + 1}, (_, i) => 10 ** (low + i))};
}
const svgText = (x, y, text, more = '') => `<text x="${x}" y="${y}" ${more}>${text}</text>`;

function frameOf({x, y, decades}) {
  const {left, right, top, none, bottom} = BOX;
  let out = `<path class="none" d="M${left} ${top}H${right}V${none}H${left}Z"/>
    <path class="frame" d="M${left} ${top}H${right}V${bottom}H${left}Z"/>`;
  for (const time of decades) {
    const anchor = time === decades[0] ? 'start' : time === decades.at(-1) ? 'end' : 'middle';
    out += `<path class="frame" d="M${x(time)} ${top}V${bottom}"/>` + svgText(x(time), bottom + 16,
      time < 1000 ? `${time} µs` : `${time / 1000} ms`, `text-anchor="${anchor}"`);
  }
  for (let wrong = 1; wrong < COUNT; wrong *= 10)
    out += `<path class="frame" d="M${left} ${y(wrong)}H${right}"/>` +
      svgText(left - 6, y(wrong) + 4, wrong, 'text-anchor="end"');
  return out + svgText(left - 6, y(0) + 4, 'none', 'text-anchor="end"') +
    svgText((left + right) / 2, bottom + 31, 'time of a motion', 'text-anchor="middle"') +
    svgText(14, (BOX.first + bottom) / 2, `wrong of ${COUNT}`,
      `text-anchor="middle" transform="rotate(-90 14 ${(BOX.first + bottom) / 2})"`);
}

function drawChart() {
  const {x, y, decades} = axes();
  points = answers().flatMap((a, which) =>
    a?.time ? [{which, x: x(a.time), y: y(counts(a))}] : []);
  let out = frameOf({x, y, decades});
  for (const kind of Object.keys(KINDS)) {
    const mine = points.filter(({which}) => SETTINGS[which].kind === kind);
    const colour = `var(--${kind})`;
    if (mine.length > 1)
      out += `<path d="M${mine.map((p) => `${p.x} ${p.y}`).join('L')}" stroke="${colour}"/>`;
    for (const p of mine)
      out += `<circle cx="${p.x}" cy="${p.y}" r="${kind === 'proof' ? 6 : 4}" fill="${colour}"
        ><title>${SETTINGS[p.which].name}</title></circle>`;
  }
  const here = points.find(({which}) => which === setting);
  if (here) {
    const isLeft = here.x < (BOX.left + BOX.right) / 2;
    out += `<circle class="chosen" cx="${here.x}" cy="${here.y}" r="10"/>` +
      svgText(here.x + (isLeft ? 8 : -8), here.y + (here.y < BOX.first + 20 ? 22 : -13),
        SETTINGS[setting].name, `class="chosen" text-anchor="${isLeft ? 'start' : 'end'}"`);
  }
  find('chart').innerHTML = out;
}

function showNumbers() {
  find('rows').innerHTML = answers().map((a, which) => {
    const current = which === setting ? ' aria-current="true"' : '';
    const cells = [micro(a?.time ?? null), a?.missed.length ?? '…', a?.alarms.length ?? '…'];
    return `<tr${current}><th scope="row">${SETTINGS[which].name}</th>${
      cells.map((cell) => `<td>${cell}</td>`).join('')}</tr>`;
  }).join('');
  show('time', micro(answers()[setting]?.time ?? null));
  showSlower();
  drawChart();
}

// ---- the picture

const canvas = find('canvas');
const view = {yaw: 0, pitch: 0.35, zoom: 1, target: [0, 0, 0], size: 1};
const GHOSTS = 9;  // of a method without samples
let scene = null;  // comes after the first answer
let bodies = [];   // A and B: meshes, their middles and radii
const colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['free', 'hit', 'doubt', 'grid', 'body-b', 'witness-a', 'witness-b']) {
    const hex = parseInt(style.getPropertyValue(`--${name}`).trim().slice(1), 16);
    colours[name] = [hex >> 16, hex >> 8 & 255, hex & 255].map((x) => x / 255);
  }
}

// The motion in the picture, what is known of it, and its place among those that are wrong.
function current() {
  const {missed, alarms} = answer(setting);
  const list = [...missed, ...alarms];
  const at = list.findIndex(({i}) => i === shown);
  if (at >= 0)
    return {list, at, it: {...list[at], isWrong: true}};
  const it = isHit(shown) ? missedBy({}, shown) : {i: shown, ...look(shown, 0, 1, DISTANCE)};
  return {list, at, it: {...it, isWrong: false}};
}

function loadBodies() {
  bodies = [0, 1].map(mesh);
  for (const body of bodies) {
    const {positions} = body;
    const [low, high] = [[...positions.slice(0, 3)], [...positions.slice(0, 3)]];
    positions.forEach((x, k) => {
      low[k % 3] = Math.min(low[k % 3], x);
      high[k % 3] = Math.max(high[k % 3], x);
    });
    body.middle = scaled(add(low, high), 0.5);
    body.radius = length(subtract(high, low)) / 2;
  }
  for (let which = 0; scene && which < 2; which++)
    scene.loadMesh(`body-${which}`, bodies[which]);
}

// From that side of the motion on which the contact is, and so near that one sees the gap between two
// samples.
function aimView() {
  const {it} = current();
  const motion = motionOf(it.i);
  const way = subtract(motion[1].position, motion[0].position);
  const time = it.time;
  const middle = apply(between(...motion, time), 1, bodies[0].middle);
  const aside = Math.atan2(way[1], way[0]) - Math.PI / 2 + 0.4;
  const [x, y] = subtract(it.point, bodies[1].middle);
  view.yaw = x * Math.cos(aside) + y * Math.sin(aside) < 0 ? aside + Math.PI : aside;
  view.pitch = 0.3;
  view.zoom = 1;
  view.target = scaled(add(middle, it.point), 0.5);
  view.size = bodies[0].radius + length(way) / Math.max(4, it.parts ?? 0) / 2;
}
function camera() {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const distance = view.zoom * 1.15 * view.size / FIELD / Math.min(1, width / height);
  return cameraOf({...view, distance}, width, height);
}

// Two triangles, and the point where they meet or are nearest.
function marks(from, {triangles, point}, poses) {
  const list = [];
  for (const which of [1, 0]) {
    scene.loadTriangle(which, bodies[which], triangles[which]);
    for (const mesh of ['triangle', 'edges'])
      list.push({mesh: `${mesh}-${which}`, pose: poses[which], size: 1, alpha: 1,
        colour: colours[which ? 'witness-b' : 'witness-a']});
  }
  list.push({mesh: 'ball', pose: {...AT_REST, position: point}, alpha: 1,
    size: 3 * metresPerPixel(from, point), colour: colours['witness-a']});
  return list;
}
// Samples; those on both sides of the contact are plainer than the others.
function ghosts(it, motion, time) {
  const parts = it.isWrong && it.parts > 1 ? it.parts : GHOSTS - 1;
  const colourAt = (t) => colours[it.gaps && parts !== it.parts && t > time && t < time + it.share ?
    'hit' : 'free'];
  const times = Array.from({length: parts + 1}, (_, k) => k / parts);
  return times.filter((t) => Math.abs(t - time) > 0.003).map((t) => ({
    mesh: 'body-0', pose: between(...motion, t), size: 1, colour: colourAt(t),
    alpha: Math.abs(t - time) * parts <= 1 ? 0.5 : 0.13,
  }));
}

function place(id, at) {
  find(id).hidden = !at || !scene;
  if (at)
    [find(id).style.left, find(id).style.top] = at.map((x) => `${x}px`);
}
// The numbers of the samples before and after the contact, above them; apart, if need be.
function labelSamples(from, {isWrong, parts, gaps}, motion) {
  const isSampled = isWrong && parts > 1;
  const places = ['before', 'after'].map((id, after) => {
    const pose = between(...motion, isSampled ? (gaps[0] + after) / parts : 0);
    const middle = apply(pose, 1, bodies[0].middle);
    const at = toScreen(from, add(middle, scaled(from.up, 0.75 * bodies[0].radius)));
    show(id, isSampled && at ? gaps[0] + 1 + after : '');
    return at;
  });
  if (places.every(Boolean)) {
    const short = Math.max(0, 26 - Math.abs(places[1][0] - places[0][0])) / 2;
    places[0][0] -= short;
    places[1][0] += short;
    places.forEach((at) => {
      at[1] = Math.max(22, Math.min(places[0][1], places[1][1]));
    });
  }
  place('before', places[0]);
  place('after', places[1]);
}

function draw() {
  if (!ready)
    return;
  const {it} = current();
  const from = camera();
  const at = toScreen(from, it.point);
  const motion = motionOf(it.i);
  const time = it.time;
  const moved = between(...motion, time);
  place('ring', at);
  labelSamples(from, it, motion);
  if (!scene)
    return;
  const size = [from.width, from.height].map((pixels) => Math.round(pixels * devicePixelRatio));
  if (canvas.width !== size[0] || canvas.height !== size[1])  // what is set is cleared
    [canvas.width, canvas.height] = size;
  scene.draw(from, [
    {mesh: 'body-1', pose: AT_REST, size: 1, colour: colours['body-b'], alpha: 1},
    {mesh: 'body-0', pose: moved, size: 1, colour: colours[it.gaps ? 'hit' : 'free'], alpha: 1},
  ], ghosts(it, motion, time), marks(from, it, [moved, AT_REST]));
}
let drawing = 0;
function redraw() {
  drawing ||= requestAnimationFrame(() => {
    drawing = 0;
    draw();
  });
}

// ---- what is chosen

// Another setting shows the same motion, if it is wrong about that as well, or about none.
function choose(which) {
  setting = which;
  find('setting').value = which;
  find('setting').setAttribute('aria-valuetext', SETTINGS[which].name);
  find('stops').querySelectorAll('[data-which]').forEach((stop) =>
    stop.classList.toggle('chosen', Number(stop.dataset.which) === which));
  if (!ready)
    return;
  const {list, at} = current();
  if (at < 0 && list.length)
    shown = list[0].i;
  showAll();
}
function showAll() {
  showSummary();
  showMotion();
  showNumbers();
  tell();
  aimView();
  redraw();
}
function step(by) {
  if (!ready)
    return;
  const {list, at} = current();
  shown = list[(Math.max(at, -1) + by + list.length) % list.length].i;
  showAll();
}
async function chooseSet(which) {
  const mine = ++job;
  set = which;
  ready = false;
  show('story', `${SETS[set].story}, ${COUNT} times; ${COUNT / 2} times they touch.`);
  show('summary', 'Making the motions');
  if (!await makeMotions(mine))
    return;
  ready = true;
  shown = 1;
  loadBodies();
  choose(setting);
  performance.mark('first-answer');
  URL.revokeObjectURL(find('save').href);
  find('save').href = URL.createObjectURL(new Blob([problems()]));
  if (!scene)
    startDrawing();
  await pause();
  await work(mine);
}

// ---- hands

function makeSets() {
  SETS.forEach(({name, kind}, i) => {
    const label = document.createElement('label');
    label.innerHTML = `<input type="radio" name="set" value="${i}">${name} <span>${kind}</span>`;
    find('sets').append(label);
  });
  find('sets').querySelector('input').checked = true;
}
function makeStops() {
  find('setting').max = SETTINGS.length - 1;
  find('handle').style.setProperty('--stops', SETTINGS.length);
  const stops = SETTINGS.map(({kind, stop}, i) =>
    `<span data-which="${i}"${kind === 'network' ? ' class="long"' : ''}>${stop}</span>`);
  const groups = Object.entries(KINDS).map(([kind, [long, short]]) => {
    const columns = SETTINGS.filter((each) => each.kind === kind).length;
    return `<span class="group" style="border-color: var(--${kind}); grid-column: span ${columns}"
      ><span class="long">${long}</span><span class="short">${short}</span></span>`;
  });
  find('stops').innerHTML = [...stops, ...groups].join('');
  find('legend').innerHTML = Object.entries(KINDS).map(([kind, [long]]) =>
    `<span><i style="background: var(--${kind})"></i>${long}</span>`).join('');
}

function turnView(x, y) {
  view.yaw -= 0.008 * x;
  view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch + 0.008 * y));
  redraw();
}
function zoom(factor) {
  view.zoom = Math.min(10, Math.max(0.05, view.zoom * factor));
  redraw();
}
const pointers = new Map();  // each that is down, and where
function pointerMove(event) {
  const before = pointers.get(event.pointerId);
  if (!before)
    return;
  const now = [event.clientX, event.clientY];
  pointers.set(event.pointerId, now);
  const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
  const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
  if (other)
    zoom(apart(before) / apart(now));
  else
    turnView(now[0] - before[0], now[1] - before[1]);
}
const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
function keyDown(event) {
  const arrow = ARROWS[event.key];
  const factor = {'+': 0.9, '=': 0.9, '-': 1.1}[event.key];
  if (arrow)
    turnView(-12 * arrow[0], -12 * arrow[1]);
  else if (factor)
    zoom(factor);
  else
    return;
  event.preventDefault();
}
// The point of the chart that is nearest to where it is pressed.
function pressChart(event) {
  if (!(event.buttons & 1) || !points.length)
    return;
  const {left, width} = find('chart').getBoundingClientRect();
  const scale = find('chart').viewBox.baseVal.width / width;
  const top = find('chart').getBoundingClientRect().top;
  const [x, y] = [(event.clientX - left) * scale, (event.clientY - top) * scale];
  const away = (p) => Math.hypot(p.x - x, p.y - y);
  const {which} = points.reduce((best, p) => away(p) < away(best) ? p : best);
  if (which !== setting)
    choose(which);
}

function listen() {
  find('setting').addEventListener('input', () => choose(Number(find('setting').value)));
  find('sets').addEventListener('change', ({target}) => chooseSet(Number(target.value)));
  find('stops').addEventListener('click', ({target: {dataset}}) =>
    dataset.which && choose(Number(dataset.which)));
  find('previous').addEventListener('click', () => step(-1));
  find('next').addEventListener('click', () => step(1));
  for (const kind of ['pointerdown', 'pointermove'])
    find('chart').addEventListener(kind, pressChart);
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener('pointermove', pointerMove);
  for (const kind of ['pointerup', 'pointercancel'])
    canvas.addEventListener(kind, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener('keydown', keyDown);
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(Math.exp(0.001 * event.deltaY));
  }, {passive: false});
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    readColours();
    redraw();
  });
}

// When there is a first answer, because a graphics card takes its time.
function startDrawing() {
  scene = createScene(canvas);
  if (!scene)
    find('view').append('This browser has no WebGL 2: numbers, but no picture.');
  loadBodies();
  new ResizeObserver(redraw).observe(canvas);
}

makeSets();
makeStops();
readColours();
listen();
chooseSet(0);
