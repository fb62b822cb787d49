// copy.js - the question that the page shows, as text for a terminal, for Python, for C. state.js comes
// after it.

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
      '  nsvcd_result result = nsvcd_obj_load(path, NULL, &mesh, NULL);',
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
