// copy.js - the question that the page shows, as text for a terminal, for Python, for C; what is copied.
// state.js comes after it.

// asked: of the page's question. files: A's and B's paths. Each of these runs as it is, where the files are.
const AS_TEXT = {
  svcd: ({motion, scales, first, clearance, method}, files) => {
    const quoted = files.map((file) => /^[\w./-]+$/.test(file) ? file : `'${file.replaceAll("'", "'\\''")}'`);
    const [from, to] = motion.map((pose) => shortPose(pose).join(','));
    return [`svcd sweep ${quoted.join(' ')} --from=${from} --to=${to}`,
      scales.some((scale) => scale !== 1) && `--scale ${scales.join()}`, `--first ${first}`,
      clearance > 0 && `--clearance ${clearance}`, method === 'network' && '--method network',
    ].filter((word) => word).join(' ');
  },
  Python: ({motion, scales, first, clearance, method}, files) => {
    const options = [first > 0 && `ask="first", to_time=${first}`, clearance > 0 && `clearance=${clearance}`,
      method === 'network' && 'method="network"'].filter((word) => word);
    const body = (i) => `${'ab'[i]} = nsvcd.Body(${JSON.stringify(files[i])}${
      scales[i] === 1 ? '' : `, scale=${scales[i]}`}${method === 'network' ? ', latents=True' : ''})`;
    return ['import neuralsvcd as nsvcd', '', body(0), body(1),
      `path = [${motion.map((pose) => `[${shortPose(pose).join(', ')}]`).join(',\n        ')}]`,
      `answer = nsvcd.sweep(${['a', 'b', 'path', ...options].join(', ')})`,
      'print(answer.verdict, answer.time.high)'].join('\n');
  },
  C: ({motion, scales, first, clearance, method}, files) => {
    const float = (x) => Number.isInteger(x) ? `${x}` : `${x}f`;
    const pose = ({position, rotation}) => `{{${position.map(float).join(', ')}}, {${rotation.map(float).join(', ')}}}`;
    const [from, to] = motion.map(shortPose).map((n) => pose({position: n.slice(0, 3), rotation: n.slice(3)}));
    const set = (name, value, isSet = true) => isSet ? [`  question.${name} = ${value};`] : [];
    return ['#define NEURALSVCD_IMPLEMENTATION', '#include "neuralsvcd.h"', '#include <stdio.h>',
      '#include <stdlib.h>', '', 'static const nsvcd_body *load(const char *path) {',
      '  nsvcd_encode_options options = {0};', '  nsvcd_mesh mesh;', '  const nsvcd_body *body = NULL;',
      `  options.latents = ${Number(method === 'network')};`,
      '  nsvcd_result result = nsvcd_mesh_load(path, NULL, NULL, &mesh, NULL);',
      '  if (!result) result = nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body);',
      '  if (result) fprintf(stderr, "%s: %s\\n", path, nsvcd_result_string(result)), exit(1);',
      '  return body;', '}', '', 'int main(void) {', `  const nsvcd_pose path[2] = {${from},`,
      `                              ${to}};`, '  const size_t size = nsvcd_sweep_workspace_size(NULL);',
      '  nsvcd_question question = {0};', '  nsvcd_answer answer;',
      ...set('a.body', `load(${JSON.stringify(files[0])})`), ...set('a.poses', 'path'), ...set('a.count', 2),
      ...set('a.scale', float(scales[0]), scales[0] !== 1), ...set('b.body', `load(${JSON.stringify(files[1])})`),
      ...set('b.scale', float(scales[1]), scales[1] !== 1),
      ...set('ask', 'NSVCD_ASK_FIRST', first > 0), ...set('to_time', float(first), first > 0),
      ...set('clearance', float(clearance), clearance > 0),
      ...set('method', 'NSVCD_METHOD_NETWORK', method === 'network'),
      '  const nsvcd_result result = nsvcd_sweep(&question, malloc(size), size, &answer);',
      '  if (result) return fprintf(stderr, "%s\\n", nsvcd_result_string(result)), 1;',
      '  printf("%s, t = %.4f\\n", nsvcd_verdict_string(answer.verdict), answer.time.high);', '  return 0;', '}',
    ].join('\n');
  },
};
const shortPose = ({position, rotation}) => [...position, ...rotation].map((x) => +x.toPrecision(7));

// Where a file is that the page shows, and whose it is: the first scene's are in the repository, the others'
// in a proof.
const pathOf = ({name, dropped}, which) => dropped ? name :
  current === 'mug' ? `examples/assets/${name}` : `${'ab'[which]}.obj`;
const originOf = ({dropped}) => dropped ? 'yours' : current === 'mug' ? 'the repository' : 'a saved proof';
function folderOf(bodies) {
  const [a, b] = bodies.map(originOf);
  const [mine, other] = bodies.map(pathOf);
  if (a !== b)
    return `a folder with ${mine} (${a}) and ${other} (${b})`;
  if (a === 'yours')
    return 'the folder of your files';
  return a === 'the repository' ? `the folder of ${a}` : 'the folder of a.obj and b.obj: save the proof first';
}

// Says something below the buttons, and shows a text there that can be selected; until the motion changes.
function showCopied(said, text = '') {
  show('copied', said);
  find('copied-text').hidden = !text;
  find('copied-text').textContent = text;
}
// Resolves to whether the browser has taken it.
const copy = async (text) => {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch (error) {
    return false;  // no permission, or a page that was not loaded from a safe place
  }
};
async function copyQuestion(language) {
  const text = AS_TEXT[language](question(), bodies.map(pathOf));
  const folder = folderOf(bodies);
  showCopied(await copy(text) ? `Copied, for ${folder}.` :
    `The browser did not let it be copied; select it here. It is for ${folder}.`, text);
}
async function copyLink() {
  writeLink();
  const link = location.href;
  const dropped = bodies.filter(({dropped}) => dropped && !isArm()).map(({name}) => name);
  const warning = dropped.length ?
    ` A link holds no files: who opens it has to drop ${dropped.join(' and ')} there.` : '';
  notify((await copy(link) ? 'The link is copied, and stands in the address bar.' :
    'The browser did not let the link be copied; it stands in the address bar.') + warning);
}
// C reads these two formats; svcd and Python read all four.
function showLanguages() {
  const other = bodies.map(({format}) => format).find((format) => !['OBJ', 'STL'].includes(format));
  document.querySelector('#copies [value=C]').disabled = Boolean(other);
  show('no-c', other ? `C reads OBJ and STL, not ${other}.` : '');
}
