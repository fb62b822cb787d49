// web.c - neuralsvcd.h as a WebAssembly module for library.js: two bodies, one motion, one answer,
// its certificate; and a robot's (arm.h).
//
// The module imports nothing. What library.js reads are the library's own structs in linear memory:
// what it reads of them has four bytes on wasm32, so that a struct is an array of floats or words.
// `web_encode`, `web_sweep` and `web_certify` return an nsvcd_result, which `web_result_string`
// puts into words.
#define NSVCD_NO_STDIO
#define NSVCD_NO_INT8
#define NSVCD_NO_GRADIENT
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#include "../../neuralsvcd.h"
#include "../../extras/neuralsvcd_certify.h"
#include "../../extras/neuralsvcd_robot.h"

#include <stdlib.h>

#include "../scenery/mesh_check.h"
#include "../scenery/mesh_files.h"
#include "no_host.h"

// library.js counts on it.
_Static_assert(sizeof(nsvcd_answer) == 4 * 102 && sizeof(nsvcd_pose) == 4 * 7, "a field is a word");
_Static_assert(offsetof(nsvcd_certificate, size) == 4 * 6, "behind a double");

#define EXPORT(name) __attribute__((export_name(#name))) name

// A and B.
typedef struct side {
  nsvcd_mesh mesh;
  const nsvcd_body *body;
  void *baked;  // the memory of a body that was not encoded here, or NULL
  nsvcd_body_facts facts;
  int has_latents;         // what the network needs, and which takes most of the time
  void *memory;            // the tree's
  const nsvcd_tree *tree;  // the mesh's; NULL: not yet built
} side;

static side sides[2];
static nsvcd_pose motion[2];  // A's; B rests at the origin
static nsvcd_answer answer;   // of web_sweep
static nsvcd_answer nearest;  // of web_distance
static nsvcd_certificate certificate;
static uint8_t proof[1 << 20];  // the certificate's bytes
static void *workspace;
static size_t workspace_size;
static mesh_fault fault;  // the last file's
static char findings[MESH_FINDINGS * MESH_LINE];

// Room for a text of so many bytes, to be written by the page and given to a function that frees
// it; NULL without memory.
char *EXPORT(web_text)(size_t size) {
  const size_t unit = NSVCD_ALIGNMENT;
  return (char *)aligned_alloc(unit, (size + unit) / unit * unit);
}

static void set_body(side *s, const nsvcd_body *body, void *baked) {
  if (!s->baked) nsvcd_body_free(s->body, NULL);
  free(s->baked);
  s->body = body;
  s->baked = baked;
}

// Reads a file and encodes it as A (0) or B (1); gives its name and its bytes back. On failure the
// body stays what it was; web_fault_line is the line at fault, or 0, and web_fault_reason says why.
// baked: NULL, or the body as `svcd encode` makes it of that file, which is kept.
nsvcd_result EXPORT(web_encode)(size_t which, char *name, char *bytes, size_t size, void *baked,
                                size_t baked_size) {
  nsvcd_mesh mesh;
  const nsvcd_body *body = NULL;
  const nsvcd_encode_options options = {0};
  const int good = mesh_parse(name, bytes, size, NULL, &mesh, &fault);
  free(name);
  free(bytes);
  if (!good) return NSVCD_ERROR_SYNTAX;
  const nsvcd_result result = baked ? nsvcd_body_load(baked, baked_size, &body)
                                    : nsvcd_encode(&mesh, &options, NULL, NULL, 0, &body);
  if (result) {
    nsvcd_mesh_free(&mesh, NULL);
    free(baked);
    fault.reason = nsvcd_result_string(result);
    return result;
  }
  nsvcd_mesh_free(&sides[which].mesh, NULL);
  set_body(&sides[which], body, baked);
  sides[which].mesh = mesh;
  sides[which].facts = nsvcd_body_describe(body);
  sides[which].has_latents = 0;
  sides[which].tree = NULL;
  return NSVCD_OK;
}

// Once for each body that the network is asked about.
static nsvcd_result add_latents(side *s) {
  nsvcd_encode_options options = {0};
  const nsvcd_body *body = NULL;
  options.latents = 1;
  if (s->has_latents) return NSVCD_OK;
  const nsvcd_result result = nsvcd_encode(&s->mesh, &options, NULL, NULL, 0, &body);
  if (result) return result;
  set_body(s, body, NULL);
  s->has_latents = 1;
  return NSVCD_OK;
}

// The lines of what `svcd info` warns of. The size is left out: it depends on the scale, and the
// page asks about it.
const char *EXPORT(web_findings)(size_t which) {
  static char lines[MESH_FINDINGS][MESH_LINE];
  const nsvcd_mesh *mesh = &sides[which].mesh;
  mesh_report report;
  int grave;
  findings[0] = 0;
  if (!mesh_check(mesh, 1, &report)) return findings;
  const int sized = mesh_find_size(&report, lines[0]);
  int count = mesh_findings(&report, lines, &grave);
  count += mesh_find_open(&sides[which].facts, lines[count]);
  count += mesh_find_large(mesh, &sides[which].facts, lines[count]);
  for (int i = sized; i < count; i++) {
    strcat(findings, lines[i]);
    strcat(findings, "\n");
  }
  return findings;
}

static nsvcd_question make_question(float scale_a, float scale_b, float clearance) {
  nsvcd_question question = {0};
  question.a.body = sides[0].body;
  question.a.poses = motion;
  question.a.count = 2;
  question.a.scale = scale_a;
  question.b.body = sides[1].body;
  question.b.scale = scale_b;
  question.clearance = clearance;
  return question;
}

// Asks `times` times whether A hits B, for the clock; once is enough for web_answer. first: to
// which share of the motion the first contact is timed; 0: any contact will do.
nsvcd_result EXPORT(web_sweep)(float scale_a, float scale_b, float first, float clearance,
                               nsvcd_method method, size_t times) {
  nsvcd_result result = NSVCD_OK;
  if (method != NSVCD_METHOD_PROOF) result = add_latents(&sides[0]);
  if (method != NSVCD_METHOD_PROOF && !result) result = add_latents(&sides[1]);
  nsvcd_question question = make_question(scale_a, scale_b, clearance);
  question.ask = first > 0 ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
  question.to_time = first;
  question.method = method;
  if (!workspace) {
    workspace_size = nsvcd_sweep_workspace_size(NULL);
    workspace = malloc(workspace_size);
  }
  for (size_t i = 0; i < times && !result; i++)
    result = nsvcd_sweep(&question, workspace, workspace_size, &answer);
  return result;
}

// How near do they come, if the last web_sweep found them free? web_nearest is what comes of it.
nsvcd_result EXPORT(web_distance)(float scale_a, float scale_b) {
  nsvcd_question question = make_question(scale_a, scale_b, 0);
  question.ask = NSVCD_ASK_DISTANCE;
  question.to = 1e-4f * (scale_a * sides[0].facts.radius + scale_b * sides[1].facts.radius);
  question.work = 100000;
  return nsvcd_sweep(&question, workspace, workspace_size, &nearest);
}

// Once for each mesh.
static nsvcd_result build_tree(side *s) {
  const size_t size = nsvcd_tree_size(&s->mesh);
  if (s->tree) return NSVCD_OK;
  free(s->memory);
  s->memory = malloc(size);
  return s->memory ? nsvcd_tree_build(&s->mesh, s->memory, size, &s->tree) : NSVCD_ERROR_MEMORY;
}

// Proves the answer of the last web_sweep anew, of the motion that there is now: web_certificate
// and web_proof are what comes of it.
nsvcd_result EXPORT(web_certify)(float scale_a, float scale_b, float clearance) {
  const nsvcd_question question = make_question(scale_a, scale_b, clearance);
  const nsvcd_certify_options options = {&answer, 200000};  // a third of a second
  nsvcd_result result = build_tree(&sides[0]);
  if (!result) result = build_tree(&sides[1]);
  if (result) return result;
  const size_t size = nsvcd_certify_workspace_size(&question, sides[0].tree, sides[1].tree);
  void *room = malloc(size);
  if (!room) return NSVCD_ERROR_MEMORY;
  result = nsvcd_certify(&question, sides[0].tree, sides[1].tree, &options, room, size, proof,
                         sizeof proof, &certificate);
  free(room);
  return !result && certificate.size > sizeof proof ? NSVCD_ERROR_TOO_LARGE : result;
}

nsvcd_pose *EXPORT(web_motion)(void) {
  return motion;
}
const nsvcd_answer *EXPORT(web_answer)(void) {
  return &answer;
}
const nsvcd_answer *EXPORT(web_nearest)(void) {
  return &nearest;
}
const nsvcd_certificate *EXPORT(web_certificate)(void) {
  return &certificate;
}
const uint8_t *EXPORT(web_proof)(void) {
  return proof;
}
const nsvcd_mesh *EXPORT(web_mesh)(size_t which) {
  return &sides[which].mesh;
}
const nsvcd_body_facts *EXPORT(web_facts)(size_t which) {
  return &sides[which].facts;
}
size_t EXPORT(web_fault_line)(void) {
  return fault.line;
}
const char *EXPORT(web_fault_format)(void) {
  return fault.format;
}
const char *EXPORT(web_fault_reason)(void) {
  return fault.reason;
}
const char *EXPORT(web_result_string)(nsvcd_result result) {
  return nsvcd_result_string(result);
}

#include "arm.h"
