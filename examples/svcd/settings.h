// settings.h - the options of all commands of svcd, and what the commands share beyond scenery.
#ifndef NSVCD_SVCD_SETTINGS_H
#define NSVCD_SVCD_SETTINGS_H

#include "../scenery/problem_file.h"
#include "../scenery/status_of.h"
// these call functions of problem_file.h
#include "../scenery/load.h"
#include "../scenery/options.h"
#include "../scenery/manual.h"
#include "../scenery/json_write.h"
#include "../scenery/robot_shapes.h"
#include "../scenery/robot_file.h"
#include "../scenery/robot_room.h"
#include "../scenery/problem_summary.h"
#include "../scenery/sweep_motion.h"
#include "../scenery/pose_table.h"
// and these of the oracle
#include "../scenery/poses.h"
#include "../scenery/sweep_picture.h"
#include "../scenery/robot_picture.h"
#include "../scenery/certificates.h"

struct settings {
  nsvcd_encode_options encode;
  nsvcd_question sweep;  // without bodies
  float first[2];        // a fraction of the motion, or metres; 0: not asked for
  float measure;         // metres
  float first_to;        // seconds: the first hit of a curve, to this; 0: the default
  float seconds;         // 0: for a plan as long as it takes, for a question DECIDE_SECONDS
  size_t visits;         // the most for a certificate; 0: the library's default
  size_t repeat;         // 0: the command's default
  const char *from, *to, *rotate, *poses, *scale, *picture, *film, *details, *only, *joints;
  const char *certificate, *certificates, *srdf;
  size_t seed, samples;
  size_t threads;  // 0: 1
  int int8, help, json, is_first_given, recentre, all;
  int exit_code;  // 1: the exit status is to be
  int answer;     // ... this: 0 free, 1 hit, 3 undecided
  const char **paths;
  size_t path_count;
};

static int usage_error(const char *what, const char *reason) {
  complain("%s: %s", what, reason);
  return USAGE;
}

// Asks for the first contact, to a fraction of the motion or to metres; if both are 0, for any.
static int wants_first(const settings *options) {
  return options->first[0] > 0 || options->first[1] > 0;
}
static void ask_first(nsvcd_question *question, const settings *options) {
  question->ask = wants_first(options) ? NSVCD_ASK_FIRST : NSVCD_ASK_HIT;
  question->to_time = options->first[0];
  question->to = options->first[1];
}

// Whoever asks one question waits for its answer: if it is undecided for want of work, it is asked
// again with eight times as much while there is time, unless --work limits the work.
#define DECIDE_SECONDS 10
typedef struct waiting {
  double began, end;
  int is_bounded;  // --work limits the work
  int is_told;     // a line on the terminal says that it takes long
} waiting;

static waiting wait_for(const settings *options) {
  const double most = options->seconds > 0 ? (double)options->seconds : DECIDE_SECONDS;
  const double now = seconds();
  const waiting out = {now, now + most, options->sweep.work > 0, 0};
  return out;
}

// The work for asking again a question that was undecided after `work` units and `taken` seconds:
// no more than there is time for, by estimate. 0: it is not asked again.
static size_t more_work(waiting *w, size_t work, double taken) {
  const double now = seconds();
  const double least = (double)work;
  const double most = fmin(8 * least, least * (w->end - now) / fmax(taken, 1e-6));
  if (w->is_bounded || !(most > 1.5 * least) || most > 1e9) return 0;
  if (now - w->began > 0.5 && is_terminal()) {
    fprintf(stderr, "\r" PROGRAM ": undecided after %.1f s, %.0f units more ", now - w->began,
            most);
    w->is_told = 1;
  }
  return (size_t)most;
}

// Clears that line.
static void wait_no_more(waiting *w) {
  if (w->is_told) fprintf(stderr, "\r%60s\r", "");
  w->is_told = 0;
}

// Is a contact known, but not whether it is the first, though that was asked? Surfaces that come
// nearer than the precision of stored triangles can hide it.
static int hides_first(const nsvcd_answer *answer) {
  return answer->verdict == NSVCD_HIT && answer->why != NSVCD_WHY_NOTHING;
}

#endif
