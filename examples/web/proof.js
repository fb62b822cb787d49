// proof.js - the proof of the answer that is shown, as files to take away.

let proofFiles = null;  // [name, bytes] each; null where there is no proof of the answer

function showProof(why) {
  find('save').disabled = !proofFiles;
  find('save').title = why;
  show('why', proofFiles ? '' : `${why}.`);
  show('save', proofFiles ? `Save the proof, ${proofFiles[0][1].length} bytes` : 'Save the proof');
}

// The numbers of a pose in a problem file, and what its reader takes them for.
const written = ({position, rotation}) => [...position, ...rotation].map((x) => +x.toPrecision(9));
function asRead(numbers) {
  const rotation = numbers.slice(3);
  const length = Math.sqrt(rotation.reduce((sum, x) => sum + x * x, 0));
  return {position: numbers.slice(0, 3), rotation: rotation.map((x) => x / length)};
}

// What a proof holds of a body: its file, or, of another format, the same mesh as OBJ.
function objFile({format, file, positions, indices}) {
  if (format === 'OBJ')
    return file;
  const lines = [];
  for (let i = 0; i < positions.length; i += 3)
    lines.push(`v ${[...positions.subarray(i, i + 3)].map((x) => +x.toPrecision(9)).join(' ')}`);
  for (let i = 0; i < indices.length; i += 3)
    lines.push(`f ${[...indices.subarray(i, i + 3)].map((corner) => corner + 1).join(' ')}`);
  return encoded(`${lines.join('\n')}\n`);
}

function proveArm() {
  if (answer.verdict !== VERDICT.FREE)
    return 'Only a free motion has a proof to save';
  try {
    proofFiles = robot.prove();
  } catch (error) {
    return error.message;
  }
  return 'proof.tar: the robot, its motion and a certificate of each pair, for build/verify';
}

// Makes it, and says what it is, or why there is none.
function prove() {
  if (isArm())
    return proveArm();
  if (answer?.by !== BY.PROOF || answer.verdict === VERDICT.UNDECIDED)
    return 'Only what is proven, free or a hit, can be saved';
  const poses = motion.map(written);
  const asked = {...question(), motion: poses.map(asRead)};
  let made;
  try {
    made = library.certify(asked);
  } catch (error) {
    return error.message;
  }
  if (made.verdict !== answer.verdict)
    return made.verdict ? 'They come so near that a certificate says the contrary' :
      made.why === WHY.WORK ? 'A certificate is more work than allowed' :
        'They touch, or come too near for a certificate';
  const [a, b] = asked.scales;
  const clearance = asked.clearance ? ` --clearance ${asked.clearance}` : '';
  const lines = [`nsvcd-problems 1  # build/verify proof/proof.txt proof${clearance}`,
    ...bodies.map(({name}, i) => `mesh ${'AB'[i]} ${'ab'[i]}.obj  # ${name.replace(/\s/g, ' ')}`),
    `problem proof A ${a} B ${b}  0 0 0  0 0 0 1  -1 nan 2`,
    ...poses.map((numbers) => numbers.join(' '))];
  proofFiles = [['proof.cert', made.bytes], ['proof.txt', encoded(`${lines.join('\n')}\n`)],
    ['a.obj', objFile(bodies[0])], ['b.obj', objFile(bodies[1])]];
  return 'proof.tar: a certificate for build/verify, the motion and both meshes. That of a hit ' +
    'proves one, not that it is the first';
}

// A tar file of a folder, proof.
function pack(files) {
  const blocks = files.flatMap(([name, bytes]) => {
    const header = new Uint8Array(512);
    const put = (at, text) => header.set(encoded(text), at);
    const octal = (number, digits) => number.toString(8).padStart(digits, '0');
    put(0, `proof/${name}`);
    put(100, '0000644\x000000000\x000000000\0');  // mode, user, group
    put(124, `${octal(bytes.length, 11)}\0${octal(Math.floor(Date.now() / 1000), 11)}\0`);
    put(148, '        0');  // the sum, as if blank, and that it is a file
    put(257, 'ustar\x0000');
    put(148, `${octal(header.reduce((sum, byte) => sum + byte), 6)}\0`);
    return [header, bytes, new Uint8Array(-bytes.length & 511)];
  });
  return new Blob([...blocks, new Uint8Array(1024)]);
}

function save() {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(pack(proofFiles));
  link.download = 'proof.tar';
  link.click();
  const clearance = isArm() || !question().clearance ? '' : ` --clearance ${question().clearance}`;
  showCopied('Anyone can check it. In a clone of the repository, with proof.tar in it:',
    `cc -O2 examples/verify/verify.c -lm -o verify\ntar xf proof.tar\n./verify proof/${
      isArm() ? 'arm' : 'proof'}.txt proof${clearance}`);
  setTimeout(URL.revokeObjectURL, 60000, link.href);
}
