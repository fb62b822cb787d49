// SPDX-License-Identifier: MIT
// glue.c - the proof as a WebAssembly module for neuralsvcd.js, which calls the library's own
// functions and reads its structs in linear memory. Only the readers of files need one more. The
// module imports nothing.
#define NSVCD_NO_STDIO
#define NSVCD_NO_NETWORK
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"

#include "../../examples/scenery/mesh_files.h"
#include "../../examples/web/no_host.h"

// neuralsvcd.js counts words of four bytes, in this order.
_Static_assert(sizeof(nsvcd_question) == 4 * 34, "nsvcd_question");
_Static_assert(offsetof(nsvcd_question, b) == 4 * 8, "nsvcd_mover");
_Static_assert(offsetof(nsvcd_question, surfaces) == 4 * 31, "nsvcd_question");
_Static_assert(sizeof(nsvcd_answer) == 4 * 102, "nsvcd_answer");
_Static_assert(offsetof(nsvcd_answer, contacts) == 4 * 28, "nsvcd_answer");
_Static_assert(offsetof(nsvcd_answer, work) == 4 * 101, "nsvcd_answer");
_Static_assert(sizeof(nsvcd_contact) == 4 * 13, "nsvcd_contact");
_Static_assert(sizeof(nsvcd_body_facts) == 4 * 25, "nsvcd_body_facts");
_Static_assert(sizeof(nsvcd_encode_options) == 4 * 10, "nsvcd_encode_options");
_Static_assert(sizeof(nsvcd_faces) == 4 * 6 && sizeof(nsvcd_mesh) == 4 * 4, "nsvcd_faces");
_Static_assert(offsetof(nsvcd_mesh_options, scale) == 32, "nsvcd_mesh_options");
_Static_assert(sizeof(mesh_fault) == 4 * 3, "mesh_fault");

// Returns 1, or 0 with a reason in *fault.
__attribute__((export_name("mesh_parse"))) int glue_mesh_parse(const char *name, const void *data,
                                                               size_t size,
                                                               const nsvcd_mesh_options *options,
                                                               nsvcd_mesh *mesh,
                                                               mesh_fault *fault) {
  return mesh_parse_to(name, data, size, options, NULL, mesh, fault);
}
