// bodies.js - bodies from files: dropped, chosen or of a scene; what is shown of them.

function showBody(which) {
  const {low, high, scale, name, format, indices, patches, size} = bodies[which];
  const drop = find(`drop-${which}`);
  const part = (selector) => drop.querySelector(selector);
  const extent = scaled(subtract(high, low), scale).map((x) => +x.toPrecision(3)).join(' × ');
  part('.name').textContent = `${'AB'[which]}: ${name}`;
  part('.facts').textContent =
    `${format}, ${indices.length / 3} triangles, ${patches} patches, ${Math.round(size / 1000)} KB`;
  part('.size').textContent = `${extent} m`;
  part('.scale').value = scale;
  const offer = unitsOffer(which);
  part('.units').hidden = !offer;
  part('.units').textContent = offer?.[1] ?? '';
  showLanguages();
}

function notify(text) {
  show('notice', text);
  find('notice').hidden = !text;
}

// Takes a file, its bytes, for a body; where it is refused, the old one stays, and why is told.
function loadBody(which, name, bytes, body = null) {
  const format = library.encode(which, name, bytes, body);
  const mesh = library.mesh(which);
  Object.assign(bodies[which], mesh, library.facts(which), boxOf(mesh), {name, format, file: bytes});
  scene?.loadMesh(`body-${which}`, mesh);
  showFindings(which);
}

// What `svcd info` warns of, once the answer is seen: to look for it takes longer than to answer.
async function showFindings(which) {
  const list = find(`drop-${which}`).querySelector('.findings');
  list.replaceChildren();
  await painted();
  list.replaceChildren(...library.findings(which).map((line) => {
    const item = document.createElement('li');
    item.textContent = line.split(/;? try --| \(say --/)[0];  // options of `svcd`, which a page has none of
    return item;
  }));
}

// What is wrong with a file, and where.
function faultOf(name, bytes, error) {
  if (!/\.(obj|stl|ply|glb)$/i.test(name))
    return `${name}: it is none of OBJ, STL, PLY and GLB, the formats that are read`;
  if (!error.line)
    return `${name}: ${error.message}`;
  const line = new TextDecoder().decode(bytes).split('\n')[error.line - 1] ?? '';
  return `${name}, line ${error.line}: ${error.message}: “${line.trim().slice(0, 60)}”`;
}

async function loadFile(which, file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const drop = find(`drop-${which}`);
  drop.querySelector('.facts').textContent = `reading ${file.name} ...`;
  await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
  let fault = '';
  try {
    if (!bytes.length)
      throw new Error('the file is empty');
    loadBody(which, file.name, bytes);
    Object.assign(bodies[which], {scale: 1, dropped: true});
    refit();
  } catch (error) {
    fault = faultOf(file.name, bytes, error);
  }
  drop.querySelector('.error').textContent = fault;
  return fault;
}

// One file becomes that body, two become A and B.
async function loadFiles(which, files) {
  const list = [...files];
  if (list.length === 0)
    return;
  if (isArm())
    openScene('mug');
  const faults = list.length > 2 ? ['Of more than two files the first two are taken'] : [];
  for (const [i, file] of list.slice(0, 2).entries()) {
    const named = wanted?.files.indexOf(file.name) ?? -1;
    const at = named >= 0 ? named : list.length === 1 ? which : i;
    faults.push(await loadFile(at, file));
    bodies[at].unsure = faults.at(-1) === '' && unitsOffer(at) !== null;
  }
  bodies.forEach((body, i) => body.unsure &&= unitsOffer(i) !== null);  // beside the other one
  if (isWanted())
    try {
      applyLink(wanted);
      wanted = null;
    } catch (error) {
      resetMotion();
      faults.push(`The link's motion is not taken: ${error.message}`);
    }
  changed(true);
  bodies.forEach((_, i) => showBody(i));
  notify(faults.filter((fault) => fault).join('. '));
}

// Which body a file becomes that is dropped there: the one that is under it, else the first one
// that has not been dropped.
function bodyAt(event) {
  const card = event.target.closest?.('.drop');
  const under = event.target.closest?.('#view') && !isArm() ?
    bodyUnder(event.clientX, event.clientY) : null;
  if (card)
    return Number(card.id.slice(-1));
  return under ?? (!isArm() && bodies[0].dropped && !bodies[1].dropped ? 1 : 0);
}
function dragOver(event) {
  const two = event.dataTransfer?.items.length > 1;
  find('dropping').hidden = false;
  show('dropping', two ? 'The first becomes A, the second B' : `Becomes ${'AB'[bodyAt(event)]}`);
}
const dragEnd = () => {
  find('dropping').hidden = true;
};

function setScale(which, scale) {
  Object.assign(bodies[which], {scale, unsure: false});
  bodies.forEach((_, i) => showBody(i));
  if (scene)
    loadGround();
}

function makeDrop(which) {
  const drop = find(`drop-${which}`);
  drop.append(find('drop').content.cloneNode(true));
  drop.querySelector('[type=file]').addEventListener('change', ({target}) => {
    loadFiles(which, target.files).then(() => {
      target.value = '';  // the same file again is a change
    });
  });
  drop.querySelector('.scale').addEventListener('input', ({target}) => {
    const typed = target.value;  // 0. is on the way to 0.001
    setScale(which, Number(typed) || bodies[which].scale);
    target.value = typed;
    changed(true);
  });
  drop.querySelector('.units').addEventListener('click', () => {
    setScale(which, unitsOffer(which)[0]);
    refit();
  });
}
