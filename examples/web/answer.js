// answer.js - shows an answer in words and numbers, asks for it, and for how near they come.

const numbers = (list, digits) => list.map((x) => x.toFixed(digits)).join(', ');
function show(id, text) {
  find(id).textContent = text ?? '–';
}
function showTime(us) {
  show('microseconds', us === null ? null : us > 1000 ? `${(us / 1000).toPrecision(3)} ms` :
    `${us < 10 ? us.toFixed(1) : us.toFixed(0)} µs`);
}
function showVerdict(kind, title, text) {
  find('verdict').dataset.kind = kind;
  show('verdict-title', title);
  show('verdict-text', text);
}

function showAnswer() {
  const known = answer && !isOpinion(answer);
  const timed = answer?.verdict === VERDICT.HIT && !answer.inside;
  if (answer)
    showVerdict(...answer.description);
  showTime(answer && answer.microseconds);
  const nearest = shownContact();
  show('contact-name', answer?.verdict === VERDICT.FREE && !isArm() ? 'nearest at' :
    isOpinion(answer) ? 'guessed at' : isAny(answer) ? 'a contact at' : 'contact at');
  show('contact-time', timed ? `t = ${contactTime(answer).toFixed(3)}` :
    nearest ? `t = ${nearest.time.toFixed(3)}` : null);
  show('free-until', known && !isAny(answer) ? `t = ${answer.time.low.toFixed(3)}` : null);
  const apart = (closest ?? answer)?.distance.low;
  show('apart', known && apart > 0 && Number.isFinite(apart) ?
    `${+(1000 * apart).toPrecision(closest ? 4 : 2)} mm` : null);
  show('point', nearest ? numbers(nearest.point, 3) : null);
  show('normal', nearest ? numbers(nearest.normal, 2) : null);
  for (const which of [0, 1]) {
    show(`triangle-${which}`, nearest ? `${isArm() ? 'triangle ' : ''}${nearest.triangles[which]}` : null);
    show(`side-${which}`, isArm() ? nearest && nameOf(answer.pair[which]) : 'AB'[which]);
  }
  // A robot's: its rows stay where they are, or its sliders would jump.
  for (const row of document.querySelectorAll('#verdict dd'))
    row.style.visibility = row.previousElementSibling.style.visibility =
      isArm() && row.textContent === '–' ? 'hidden' : '';
}
const nameOf = (part) => robot.parts[part].name.replace('_', ' ');

// For a screen reader, once nothing moves, and only what is new.
function say() {
  const read = (id) => find(id).textContent;
  const text = [`${read('verdict-title')}. ${read('verdict-text')}`,
    shownContact() && ` ${read('contact-name')} ${read('contact-time')}.`,
    closest && ` Apart by ${read('apart')}.`].filter((word) => word).join('');
  if (read('said') !== text)
    show('said', text);
}

// How long the page takes until then is what test_page.py prints.
let marked = false;
function markFirst() {
  if (!marked)
    performance.mark('first-answer');
  marked = true;
}

// Of a robot's motion: what hits what, by their names.
function describeArm({verdict, inside, pair}) {
  const named = pair?.map(nameOf).join(' and ');
  if (verdict === VERDICT.FREE)
    return ['free', 'Free', `Proven: none of ${robot.pairs.length} pairs ever meets.`];
  if (verdict === VERDICT.UNDECIDED)
    return ['doubt', 'Undecided', named ? `${named} come too near to tell, or one seems to be inside of what is not quite closed.` : 'Too much work.'];
  return ['hit', 'Hit', inside ? `Proven: of ${named}, one is inside the other.` :
    `Proven: ${named} meet; perhaps not for the first time.`];
}
function askArm() {
  const times = [];
  for (const end = performance.now() + 8; times.length < 5 && (!times.length || performance.now() < end);) {
    const start = performance.now();
    answer = robot.ask(1);
    times.push(performance.now() - start);
    markFirst();
  }
  answer.microseconds = 1000 * times.sort((a, b) => a - b)[times.length >> 1];
  answer.description = describeArm(answer);
  showAnswer();
}

// Before a file is answered about that is hardly in metres.
function askUnit(which) {
  const [scale, why] = unitsOffer(which) ?? [bodies[which].scale, ''];
  answer = null;
  showVerdict('doubt', 'In which unit?', `${bodies[which].name} would be ${
    +extentOf(bodies[which]).toPrecision(3)} m long. ${why.split(':')[0].split('?')[0]}.`);
  show('unit-use', `Use the scale ${scale}`);
  showAnswer();
}

function ask(milliseconds, batches) {
  const doubted = isArm() ? -1 : bodies.findIndex(({unsure}) => unsure);
  find('unit').hidden = doubted < 0;
  if (isArm())
    return askArm();
  if (doubted >= 0)
    return askUnit(doubted);
  const asked = question();
  try {
    const start = performance.now();
    library.sweep(asked, 1);
    const taken = performance.now() - start;
    answer = library.answer();
    markFirst();
    answer.first = asked.first;
    answer.description = describe(answer, asked);
    batch = Math.max(1, Math.min(batch, Math.ceil(milliseconds / taken)));
    answer.microseconds = taken > 10 ? 1000 * taken : microseconds(asked, milliseconds, batches);
  } catch (error) {
    answer = null;
    showVerdict('doubt', 'Not answered', error.message);
  }
  showAnswer();
}

// How near they come, where they are proven free; else null. It takes longer than to know that.
function measure() {
  if (isArm() || answer?.verdict !== VERDICT.FREE || answer.by !== BY.PROOF)
    return null;
  try {
    const found = library.distance(question());
    return found.verdict === VERDICT.FREE && found.distance.high < Infinity ? found : null;
  } catch (error) {
    return null;  // the answer stands without it
  }
}
