// seeds.h - a route by several seeds at once, a thread for each: the shortest motion counts, so that
// it does not depend on which thread is the first.
#ifndef NSVCD_SVCD_SEEDS_H
#define NSVCD_SVCD_SEEDS_H

#include "settings.h"

// Threads that need nothing but libm to link; without them the seeds are tried one after another. A
// glibc before 2.34 needs -pthread, which defines _REENTRANT.
#if defined(_WIN32) || (defined(__GLIBC__) && defined(__GLIBC_MINOR__) && !defined(_REENTRANT) && \
                        __GLIBC__ == 2 && __GLIBC_MINOR__ < 34)
#define SEED_THREADS 0
#else
#define SEED_THREADS 1
#include <pthread.h>
#endif
#define SEED_STACK ((size_t)4 << 20)

typedef struct seed_search {
  const nsvcd_route_problem *problem;
  nsvcd_route_options options;
  nsvcd_checker *checker;
  void *room, *memory;  // of a checker of its own, NULL: it has none; of the route
  size_t size;
  nsvcd_result result;
  nsvcd_route_answer answer;
#if SEED_THREADS
  pthread_t thread;
#endif
  int is_started;
} seed_search;

static void *seek_by_seed(void *given) {
  seed_search *s = (seed_search *)given;
  s->result = nsvcd_route(s->checker, s->problem, &s->options, s->memory, s->size, &s->answer);
  return NULL;
}

// Prepares the searches: the first has the checker that is given, the others have their own.
static nsvcd_result prepare_seeds(const nsvcd_scene *scene, nsvcd_checker *checker,
                                  const nsvcd_route_problem *problem,
                                  const nsvcd_route_options *options, seed_search *all,
                                  size_t count) {
  nsvcd_result result = NSVCD_OK;
  memset(all, 0, count * sizeof *all);
  for (size_t n = 0; n < count && !result; n++) {
    seed_search *s = &all[n];
    s->problem = problem;
    s->options = *options;
    s->options.seed += n;
    s->checker = checker;
    if (n > 0) {
      const size_t size = nsvcd_checker_size(scene);
      s->room = allocate(size);
      result = nsvcd_checker_open(scene, s->room, size, &s->checker);
    }
    s->size = nsvcd_route_size(s->checker, problem, options);
    s->memory = allocate(s->size);
  }
  return result;
}

// The route of `count` seeds from options->seed on that takes the least time; of none, what the first
// says. *memory: to be freed, the motion is in it.
static nsvcd_result route_by_seeds(const nsvcd_scene *scene, nsvcd_checker *checker,
                                   const nsvcd_route_problem *problem,
                                   const nsvcd_route_options *options, size_t count,
                                   nsvcd_route_answer *answer, void **memory) {
  seed_search *all = (seed_search *)allocate(count * sizeof *all);
  nsvcd_result result = prepare_seeds(scene, checker, problem, options, all, count);
  size_t best = 0;
#if SEED_THREADS
  pthread_attr_t attributes;
  const int has_attributes = pthread_attr_init(&attributes) == 0;
  if (has_attributes) pthread_attr_setstacksize(&attributes, SEED_STACK);
  for (size_t n = 1; n < count && !result; n++)
    all[n].is_started = pthread_create(&all[n].thread, has_attributes ? &attributes : NULL,
                                       seek_by_seed, &all[n]) == 0;
#endif
  for (size_t n = 0; n < count && !result; n++)
    if (!all[n].is_started) seek_by_seed(&all[n]);
#if SEED_THREADS
  for (size_t n = 1; n < count; n++)
    if (all[n].is_started) pthread_join(all[n].thread, NULL);
  if (has_attributes) pthread_attr_destroy(&attributes);
#endif
  for (size_t n = 0; n < count && !result; n++) {
    const nsvcd_route_answer *one = &all[n].answer;
    const nsvcd_route_answer *least = &all[best].answer;
    result = all[n].result;
    if (one->status != NSVCD_ROUTE_FOUND) continue;
    if (least->status != NSVCD_ROUTE_FOUND || one->duration < least->duration) best = n;
  }
  *answer = all[best].answer;
  *memory = all[best].memory;
  for (size_t n = 0; n < count; n++) {
    if (n != best) free(all[n].memory);
    free(all[n].room);
  }
  free(all);
  return result;
}

#endif
