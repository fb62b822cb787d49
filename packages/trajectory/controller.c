// SPDX-License-Identifier: MIT
// controller.c - stands in for a controller at 1 kHz: every millisecond it is told where a person is, and asks
// whether the next 200 ms of its trajectory are free. If they are not, it brakes, on the trajectory: that
// stays within what was proven last. Once the person has gone it goes on.
//
//   controller ROBOT.txt SCENE PERSON SECONDS JOINTS.tsv
//
// ROBOT.txt: a planning file, PERSON an obstacle of its scene; JOINTS.tsv: of `svcd plan --only ID --samples
// N --joints`, of a plan that takes SECONDS. Prints what happened, and how long the answers took.
#define _POSIX_C_SOURCE 200112L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "trajectory_guard.h"

// seconds from full speed to rest: of each joint of arm.urdf, 3.14 rad/s at urdf.py's 3 times that
#define BRAKING 0.34
// seconds of the trajectory that are asked about: more than BRAKING / 2, what it goes on by meanwhile, and a cycle
#define AHEAD 0.2
#define BUDGET 0.0005  // of a millisecond
#define MOST_POINTS 1024
#define MOST_CYCLES 60000
#define CLEARANCE 0.001f

#ifdef COUNT_ALLOCATIONS  // gcc's --wrap=malloc: tells that nothing is allocated in the loop
size_t allocations;
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
  allocations++;
  return __real_malloc(size);
}
#else
static size_t allocations;
#endif

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a;
  const double y = *(const double *)b;
  return (x > y) - (x < y);
}

// Reads the points; velocities are differences of their neighbours'. Returns how many.
static size_t read_points(const char *path, size_t joints, double seconds, double *positions,
                          double *velocities, double *times) {
  FILE *file = fopen(path, "r");
  size_t count = 0;
  int good = 1;
  if (!file) return 0;
  while (good && count < MOST_POINTS && fscanf(file, "%*s %*s") == 0) {
    for (size_t k = 0; k < joints && good; k++)
      good = fscanf(file, "%lf", &positions[count * joints + k]) == 1;
    count += (size_t)good;
  }
  fclose(file);
  for (size_t i = 0; i < count; i++) times[i] = seconds * (double)i / (double)(count - 1);
  for (size_t i = 0; i < count * joints; i++) {
    const int is_end = i < joints || i >= (count - 1) * joints;
    velocities[i] = is_end ? 0 : (positions[i + joints] - positions[i - joints]) / (2 * times[1]);
  }
  return count;
}

static void print_stop(double when, const guard_answer *answer) {
  printf("%.3f s: stops", when);
  if (answer->reason) printf(": undecided, %s", answer->reason);
  if (answer->joint) printf(": %s leaves its limits", answer->joint);
  if (answer->a) printf(": %s, %s", answer->a, answer->b);
  printf("\n");
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int argc, char **argv) {
  static double positions[MOST_POINTS * 128], velocities[MOST_POINTS * 128], times[MOST_POINTS];
  static double taken[MOST_CYCLES];
  if (argc != 6)
    return fprintf(stderr, "controller ROBOT.txt SCENE PERSON SECONDS JOINTS.tsv\n"), 2;
  trajectory_guard *guard = guard_open(argv[1], argv[2], CLEARANCE, MOST_POINTS, NULL, 0);
  if (!guard) return 1;
  guard_trajectory t = {positions, velocities, NULL, times, 0};
  t.count = read_points(argv[5], guard_joints(guard), atof(argv[4]), positions, velocities, times);
  if (t.count < 2) return fprintf(stderr, "controller: %s has no points\n", argv[5]), 1;

  const double end = times[t.count - 1];
  double at = 0;      // of the trajectory
  double rate = 0;    // its seconds in a second: at rest
  double proven = 0;  // free before this
  size_t cycles = 0, rested = 0, late = 0, beyond = 0;
  int was_held = 0;
  const size_t allocated = allocations;
  const double began = now();
  while (at < end && cycles < MOST_CYCLES) {
    // the person comes as near as the camera says, stays a while, and goes
    const double when = (double)cycles * 1e-3;
    const double steps = when < 1 ? 1 - when : when < 2 ? 0 : when - 2;
    const float pose[7] = {(float)(0.6 + 1.5 * steps), -0.25f, 0.45f, 0, 0, 0, 1};
    const double start = now();
    if (!guard_move(guard, argv[3], pose))
      return fprintf(stderr, "controller: no %s\n", argv[3]), 1;
    const guard_answer answer = guard_check(guard, &t, at, at + AHEAD, BUDGET);
    taken[cycles++] = now() - start;
    if (answer.verdict == GUARD_REFUSED)
      return fprintf(stderr, "controller: %s\n", answer.reason), 1;
    const int holds = answer.verdict != GUARD_FREE;
    if (holds && !was_held) print_stop(when, &answer);
    if (!holds && was_held) printf("%.3f s: goes on\n", when);
    was_held = holds;
    if (!holds) proven = at + AHEAD;
    rate = holds ? fmax(rate - 1e-3 / BRAKING, 0) : fmin(rate + 1e-3 / BRAKING, 1);
    at += 1e-3 * rate;
    rested += !(rate > 0);
    beyond += rate > 0 && at > proven;
    // the next millisecond
    const double next = began + 1e-3 * (double)cycles;
    late += now() > next;
    while (now() < next) {
    }
  }
  printf("%s after %.3f s, at rest for %.3f s, %lu cycles beyond what was proven\n",
         at >= end ? "there" : "not there", 1e-3 * (double)cycles, 1e-3 * (double)rested,
         (unsigned long)beyond);
  qsort(taken, cycles, sizeof *taken, compare);
  printf(
      "%lu answers: median %.0f us, 999 of 1000 within %.0f us, worst %.0f us; %lu cycles late; "
      "%lu allocations\n",
      (unsigned long)cycles, 1e6 * taken[cycles / 2], 1e6 * taken[cycles * 999 / 1000],
      1e6 * taken[cycles - 1], (unsigned long)late, (unsigned long)(allocations - allocated));
  guard_close(guard);
  return at >= end ? 0 : 1;
}
