// method.h - what the benchmark asks of a method that checks a moving body against a fixed one.
//
// A method prepares a body once per mesh (not timed within the query; its time and bytes are
// reported) and answers for the motion at discrete times. Float32, single thread, no allocation in
// a query: as a user of the method would write it for speed. All methods stop at the first
// placement that collides, and visit placements in the same order.
#ifndef NSVCD_BENCH_METHOD_H
#define NSVCD_BENCH_METHOD_H

#include <math.h>
#include <stddef.h>

#include "../../neuralsvcd.h"  // nsvcd_mesh, nsvcd_pose

// The moving body in the frame of the fixed one: fixed = rotation * moving + position.
typedef struct transform {
  float rotation[9];  // row-major
  float position[3];  // metres
} transform;

typedef struct preparation {  // what a body depends on; each method says which fields it reads
  float detail;               // length or share, see the method
  size_t points;              // surface points or parts
} preparation;

typedef struct method {
  const char *name;
  // A body of a mesh in metres; NULL if memory runs out or the mesh cannot be used.
  void *(*prepare)(const nsvcd_mesh *mesh, const preparation *how);
  // Optional, NULL if preparing is quick: a copy of a body, scaled about its origin.
  void *(*scaled)(const void *body, float scale);
  void (*release)(void *body);  // NULL allowed
  size_t (*bytes)(const void *body);
  // 1 at the first of the `count` placements at which the bodies are nearer than `activation`
  // metres (negative: where they overlap by more than that), else 0.
  int (*hits)(const void *moving, const void *fixed, const transform *at, size_t count,
              float activation);
} method;

#endif  // NSVCD_BENCH_METHOD_H
