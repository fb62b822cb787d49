// In: a checker and a motion of its joints. Out: is it free, as the joints make it, at all times?
#pragma once
#include "deviation.h"

// ---- a checker

// Is x a number, and no larger? By the bits, which are in the order of what is not negative.
static int nsvcd__is_number(double x, double most) {
  uint64_t bits, limit;
  memcpy(&bits, &x, sizeof bits);
  memcpy(&limit, &most, sizeof limit);
  return (bits & ~(uint64_t)0 >> 1) <= limit;
}

static nsvcd_result nsvcd__joint_check(const nsvcd_joint *joint, size_t i) {
  double axis = 0;
  if (joint->parent > i || (unsigned)joint->kind > NSVCD_JOINT_PRISMATIC)
    return NSVCD_ERROR_JOINT;
  for (size_t k = 0; k < 3; k++) {
    if (!nsvcd__is_finite(joint->axis[k])) return NSVCD_ERROR_AXIS;
    axis = nsvcd__max(axis, fabs((double)joint->axis[k]));
  }
  if (!(axis > 1e-15) || axis > 1e15) return NSVCD_ERROR_AXIS;
  const nsvcd_result result = nsvcd__poses_check(&joint->origin, 1);
  if (result) return result;
  const double most = (double)NSVCD_MAX_COORDINATE;
  if (!nsvcd__is_number(joint->speed, most) || !nsvcd__is_number(joint->acceleration, most))
    return NSVCD_ERROR_SPEED;
  if (joint->speed < 0 || joint->acceleration < 0) return NSVCD_ERROR_SPEED;
  if (joint->kind == NSVCD_JOINT_CONTINUOUS) return NSVCD_OK;
  if (!nsvcd__is_number(joint->low, most) || !nsvcd__is_number(joint->high, most))
    return NSVCD_ERROR_LIMITS;
  return joint->low <= joint->high ? NSVCD_OK : NSVCD_ERROR_LIMITS;
}

static nsvcd_result nsvcd__part_check(const nsvcd_scene *scene, const nsvcd_part *part) {
  const nsvcd_body *body = NULL;
  const nsvcd_result result = nsvcd_body_trust(part->body, SIZE_MAX, &body);
  if (result) return result;
  if (part->link > scene->joint_count) return NSVCD_ERROR_LINK;
  if (!nsvcd_body_describe(body).triangles) return NSVCD_ERROR_TRIANGLES;
  const float scale = part->scale;
  const int fits = scale >= NSVCD_MIN_SCALE && scale <= NSVCD_MAX_SCALE;
  if (!(fits || (scale <= 0 && scale >= 0))) return NSVCD_ERROR_SCALE;
  return nsvcd__poses_check(&part->pose, 1);
}

static nsvcd_result nsvcd__scene_check(const nsvcd_scene *scene) {
  nsvcd_result result = NSVCD_OK;
  if (!scene) return NSVCD_ERROR_ARGUMENT;
  if (scene->joint_count < 1 || scene->joint_count > NSVCD_MAX_JOINTS)
    return NSVCD_ERROR_COUNT;
  if (scene->part_count > NSVCD_MAX_PARTS) return NSVCD_ERROR_COUNT;
  if (!scene->joints) return NSVCD_ERROR_ARGUMENT;
  if ((scene->part_count > 0 && !scene->parts) || (scene->pair_count > 0 && !scene->pairs))
    return NSVCD_ERROR_ARGUMENT;
  for (size_t i = 0; i < scene->joint_count && !result; i++)
    result = nsvcd__joint_check(&scene->joints[i], i);
  for (size_t n = 0; n < scene->part_count && !result; n++)
    result = nsvcd__part_check(scene, &scene->parts[n]);
  for (size_t k = 0; k < scene->pair_count && !result; k++) {
    const nsvcd_body_pair *pair = &scene->pairs[k];
    if (pair->a >= scene->part_count) return NSVCD_ERROR_PAIR;
    if (pair->b >= scene->part_count) return NSVCD_ERROR_PAIR;
    if (scene->parts[pair->a].link == scene->parts[pair->b].link) return NSVCD_ERROR_PAIR;
  }
  return result;
}

// A box about a part that is in this frame.
static nsvcd__bounds nsvcd__box_of(const nsvcd__member *m, const nsvcd__frame *frame) {
  const nsvcd__dmat3 axes = nsvcd__dmat3_of(frame->turn);
  const nsvcd__d3 *rows[3] = {&axes.x, &axes.y, &axes.z};
  nsvcd__d3 half = {0, 0, 0};
  for (size_t k = 0; k < 3; k++) {
    const nsvcd__d3 row = {fabs(rows[k]->x), fabs(rows[k]->y), fabs(rows[k]->z)};
    nsvcd__d3_set_axis(&half, k, nsvcd__d3_dot(row, m->half));
  }
  const nsvcd__d3 middle =
      nsvcd__d3_add(nsvcd__dmat3_apply(&axes, m->middle), frame->position);
  const nsvcd__bounds out = {nsvcd__d3_sub(middle, half), nsvcd__d3_add(middle, half)};
  return out;
}

static nsvcd__bounds nsvcd__box_over(const nsvcd__bounds *a, const nsvcd__bounds *b) {
  const nsvcd__bounds out = {nsvcd__d3_min(a->low, b->low), nsvcd__d3_max(a->high, b->high)};
  return out;
}

// Are two boxes apart by more than `room` along an axis?
static int nsvcd__boxes_apart(const nsvcd__bounds *a, const nsvcd__bounds *b, double room) {
  return a->low.x - b->high.x > room || b->low.x - a->high.x > room ||
         a->low.y - b->high.y > room || b->low.y - a->high.y > room ||
         a->low.z - b->high.z > room || b->low.z - a->high.z > room;
}

// Lays a checker out at base, which is aligned, or, where that is NULL, only counts. Returns the
// bytes; 0 if they are more than can be counted.
static size_t nsvcd__checker_layout(const nsvcd_scene *scene, char *base,
                                    nsvcd_checker **checker) {
  nsvcd_checker counted;
  uint64_t used = 0;
  size_t movers = 0;
  for (size_t n = 0; n < scene->part_count; n++) movers += scene->parts[n].link > 0;
  void *at = nsvcd__take(base, &used, 1, sizeof(nsvcd_checker));
  nsvcd_checker *c = at ? (nsvcd_checker *)at : &counted;
  const size_t parts = scene->part_count;
  const size_t pairs = scene->pair_count;
  const size_t samples = NSVCD__MOST_STEPS + 1;
  c->members = (nsvcd__member *)nsvcd__take(base, &used, parts, sizeof(nsvcd__member));
  c->order = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->left = (uint32_t *)nsvcd__take(base, &used, pairs, sizeof(uint32_t));
  c->frames = (nsvcd__frame *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd__frame));
  c->boxes =
      (nsvcd__bounds *)nsvcd__take(base, &used, movers * samples, sizeof(nsvcd__bounds));
  for (size_t n = 0; n < 2; n++)
    c->seen[n] = (nsvcd_pose *)nsvcd__take(base, &used, samples, sizeof(nsvcd_pose));
  c->query_size = nsvcd_sweep_workspace_size(NULL);
  c->query = nsvcd__take(base, &used, 1, c->query_size);
  *checker = (nsvcd_checker *)at;
  return used <= SIZE_MAX ? (size_t)used : 0;
}

NSVCDDEF size_t nsvcd_checker_size(const nsvcd_scene *scene) {
  nsvcd_checker *unused;
  return nsvcd__scene_check(scene) ? 0 : nsvcd__checker_layout(scene, NULL, &unused);
}

NSVCDDEF nsvcd_result nsvcd_checker_open(const nsvcd_scene *scene, void *memory, size_t size,
                                         nsvcd_checker **checker) {
  nsvcd_checker *c;
  const nsvcd_result result = nsvcd__scene_check(scene);
  if (result) return result;
  if (!checker) return NSVCD_ERROR_ARGUMENT;
  if (!memory || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  const size_t needed = nsvcd__checker_layout(scene, NULL, &c);
  if (!needed || size < needed) return NSVCD_ERROR_WORKSPACE;
  (void)nsvcd__checker_layout(scene, (char *)memory, &c);
  c->scene = scene;
  for (size_t i = 0; i < scene->joint_count; i++) {
    const nsvcd_joint *joint = &scene->joints[i];
    const nsvcd__frame origin = nsvcd__frame_of(&joint->origin);
    nsvcd__link *link = &c->links[i];
    link->position = origin.position;
    link->turn = origin.turn;
    link->axis = nsvcd__d3_unit(nsvcd__d3_load(joint->axis), nsvcd__d3_of(0, 0, 1));
    link->path = (uint32_t)1 << i | (joint->parent ? c->links[joint->parent - 1].path : 0);
  }
  size_t row = 0;
  for (size_t n = 0; n < scene->part_count; n++) {
    const nsvcd_part *part = &scene->parts[n];
    const double scale = part->scale > 0 ? (double)part->scale : 1;
    const nsvcd_body_facts facts = nsvcd_body_describe(part->body);
    nsvcd__member *m = &c->members[n];
    m->frame = nsvcd__frame_of(&part->pose);
    const nsvcd__d3 centre = nsvcd__d3_scale(nsvcd__d3_load(facts.centre), scale);
    const nsvcd__frame sphere = {{0, 0, 0, 1}, centre};
    m->centre = nsvcd__frame_in(&m->frame, &sphere).position;
    // spheres are computed in float
    m->radius = 1.000001 * scale * (double)(facts.radius - facts.convex_radius);
    m->extent = 1.000001 * scale * (double)facts.extent;
    const nsvcd__d3 low = nsvcd__d3_load(facts.low);
    const nsvcd__d3 high = nsvcd__d3_load(facts.high);
    const nsvcd__d3 all = {1, 1, 1};
    m->middle = nsvcd__d3_scale(nsvcd__d3_add(low, high), 0.5 * scale);
    // what is round goes beyond
    m->half = nsvcd__d3_fma(scale * (double)facts.convex_radius, all,
                            nsvcd__d3_scale(nsvcd__d3_sub(high, low), 0.5 * scale));
    m->box = nsvcd__box_of(m, &m->frame);
    m->deviation = 0;
    m->rounding = 0;
    m->row = part->link ? NSVCD__MOST_STEPS + 1 : 0;
    m->row *= row;
    row += part->link > 0;
  }
  for (size_t k = 0; k < scene->pair_count; k++) c->order[k] = (uint32_t)k;
  *checker = c;
  return NSVCD_OK;
}

// ---- samples

// Places the parts that move, at a configuration, as sample k.
static void nsvcd__sample_put(nsvcd_checker *c, const nsvcd__configuration *at, size_t k) {
  const nsvcd_scene *scene = c->scene;
  double reach = 0;
  for (size_t link = 1; link <= scene->joint_count; link++)
    reach = nsvcd__max(reach, nsvcd__d3_length(at->frames[link].position));
  for (size_t n = 0; n < scene->part_count; n++) {
    nsvcd__member *m = &c->members[n];
    if (!scene->parts[n].link) continue;
    const nsvcd__frame frame = nsvcd__frame_of_part(c, at, n);
    const nsvcd__bounds box = nsvcd__box_of(m, &frame);
    c->frames[m->row + k] = frame;
    c->boxes[m->row + k] = box;
    m->box = k ? nsvcd__box_over(&m->box, &box) : box;
    // some 5e-16 of its moment arm for each joint
    const double arm = reach + nsvcd__d3_length(frame.position) + m->extent;
    m->rounding = nsvcd__max(k ? m->rounding : 0, NSVCD__FRAME_ROUNDING * arm);
  }
}

// Fills in, for each part that moves, its samples at c->times, one more than steps, and by how much
// it deviates between them.
static void nsvcd__sample(nsvcd_checker *c, const nsvcd_joint_motion *motion, size_t steps) {
  const nsvcd_scene *scene = c->scene;
  const size_t bytes = scene->joint_count * sizeof(double);
  nsvcd__step step;
  nsvcd__configuration *from = &c->at;
  nsvcd__configuration *to = &c->next;
  for (size_t n = 0; n < scene->part_count; n++) c->members[n].deviation = 0;
  nsvcd_motion_at(motion, scene->joint_count, c->times[0], from->joints);
  nsvcd__pose_links(c, from);
  nsvcd__sample_put(c, from, 0);
  for (size_t k = 0; k < steps; k++) {
    nsvcd__step_of(motion, scene->joint_count, c->times[k], c->times[k + 1], &step);
    memcpy(to->joints, step.to, bytes);
    nsvcd__pose_links(c, to);
    nsvcd__sample_put(c, to, k + 1);
    c->deviations[k] = 0;
    for (size_t n = 0; n < scene->part_count; n++) {
      nsvcd__member *m = &c->members[n];
      if (!scene->parts[n].link) continue;
      const double deviation = nsvcd__part_deviation(c, n, &step, from, to) * (1 + 1e-9);
      c->deviations[k] = nsvcd__max(c->deviations[k], deviation);
      m->deviation = nsvcd__max(m->deviation, deviation);
    }
    nsvcd__configuration *other = from;
    from = to;
    to = other;
  }
}

// Cuts steps so that no part deviates by more than is allowed, as far as can be foreseen: deviates
// go by the square of a step. Returns how many there are then, more than NSVCD__MOST_STEPS if there
// were too many: then nothing is done.
static size_t nsvcd__refine_steps(nsvcd_checker *c, size_t steps, double allowed) {
  size_t total = 0;
  for (size_t k = 0; k < steps; k++) {
    const double pieces = ceil(sqrt(c->deviations[k] / allowed));
    if (!(pieces <= NSVCD__MOST_STEPS)) return NSVCD__MOST_STEPS + 1;
    total += pieces > 1 ? (size_t)pieces : 1;
  }
  if (total > NSVCD__MOST_STEPS) return total;
  size_t at = total;
  c->times[total] = c->times[steps];
  for (size_t k = steps; k-- > 0;) {
    const double pieces = nsvcd__max(ceil(sqrt(c->deviations[k] / allowed)), 1);
    const double from = c->times[k];
    const double duration = c->times[at] - from;
    for (size_t i = (size_t)pieces; i-- > 0;)
      c->times[--at] = from + duration * (double)i / pieces;
  }
  return total;
}

// ---- pairs

static nsvcd__bounds nsvcd__bounds_at(const nsvcd_checker *c, size_t part, size_t k) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->boxes[m->row + k] : m->box;
}
// A box about a part in a step: it goes no farther from it than it deviates.
static nsvcd__bounds nsvcd__bounds_in(const nsvcd_checker *c, size_t part, size_t step) {
  const nsvcd__bounds from = nsvcd__bounds_at(c, part, step);
  const nsvcd__bounds to = nsvcd__bounds_at(c, part, step + 1);
  return nsvcd__box_over(&from, &to);
}

// The steps outside of which the boxes of a pair stay apart; none for a single configuration.
typedef struct nsvcd__step_range {
  size_t first, steps;
} nsvcd__step_range;

// Where does a pair come as near as `room`, by its boxes? Returns 0 if nowhere.
static int nsvcd__steps_near(const nsvcd_checker *c, const nsvcd_body_pair *pair, size_t steps,
                             double room, nsvcd__step_range *range) {
  size_t last = 0;
  if (nsvcd__boxes_apart(&c->members[pair->a].box, &c->members[pair->b].box, room)) return 0;
  range->first = steps;
  for (size_t k = 0; k < steps; k++) {
    const nsvcd__bounds a = nsvcd__bounds_in(c, pair->a, k);
    const nsvcd__bounds b = nsvcd__bounds_in(c, pair->b, k);
    if (nsvcd__boxes_apart(&a, &b, room)) continue;
    if (range->first == steps) range->first = k;
    last = k + 1;
  }
  range->steps = last - (steps ? range->first : 0);
  return steps == 0 || last > 0;
}

// A pair as one of its parts sees it: so places are small where the two are near each other,
// however far from the world's origin they are, and a float has digits left. That is the part that
// rests, if one does; else b, where it is half way.
typedef struct nsvcd__sight {
  // the frame that both are seen from, in the world
  nsvcd__frame from;
  // metres: what poses in float are off there, at most, of both together
  double rounding;
} nsvcd__sight;

// Fills in c->seen. frames: of a and of b, (count) each, but one of a part that rests.
static void nsvcd__view_pair(nsvcd_checker *c, const nsvcd_body_pair *pair,
                             const nsvcd__frame *const *frames, size_t count,
                             nsvcd__sight *view) {
  const size_t parts[2] = {pair->a, pair->b};
  view->from = c->scene->parts[pair->a].link ? frames[1][0] : frames[0][0];
  if (c->scene->parts[pair->a].link && c->scene->parts[pair->b].link)
    view->from = frames[1][count / 2];
  view->rounding = 0;
  for (size_t n = 0; n < 2; n++) {
    const int moves = c->scene->parts[parts[n]].link > 0;
    double most = 0;
    for (size_t k = 0; k < (moves ? count : 1); k++) {
      const nsvcd__frame in = nsvcd__frame_from(&view->from, &frames[n][k]);
      c->seen[n][k] = nsvcd__pose_in(&in);
      most = nsvcd__max(most, nsvcd__d3_length(in.position));
    }
    // places and quaternions as floats are off by no more
    if (moves) view->rounding += 2 * (1.1e-7 * most + 1.3e-7 * c->members[parts[n]].extent);
  }
}

// A direction and a point as they are seen, in the world.
static nsvcd__d3 nsvcd__seen_direction(const nsvcd__sight *view, nsvcd__d3 way) {
  return nsvcd__dquat_rotate(view->from.turn, way);
}
static nsvcd__d3 nsvcd__seen_point(const nsvcd__sight *view, nsvcd__d3 point) {
  return nsvcd__d3_add(nsvcd__seen_direction(view, point), view->from.position);
}

// Takes a contact as it is seen to the world.
static void nsvcd__set_contact(const nsvcd__sight *view, nsvcd_contact *contact) {
  const nsvcd__d3 point = nsvcd__seen_point(view, nsvcd__d3_load(contact->point));
  const nsvcd__d3 normal = nsvcd__seen_direction(view, nsvcd__d3_load(contact->normal));
  nsvcd__f3_store(nsvcd__f3_round(point), contact->point);
  nsvcd__f3_store(nsvcd__f3_round(normal), contact->normal);
}

// By how much a part is off the way that its samples say, at most.
static double nsvcd__off(const nsvcd_checker *c, size_t part) {
  return c->members[part].deviation + 2 * c->members[part].rounding;
}

// Of two parts as they are seen, in so many poses each; what rests has one.
static nsvcd_question nsvcd__question_of(const nsvcd_checker *c, const nsvcd_body_pair *pair,
                                         size_t count, size_t work) {
  const size_t parts[2] = {pair->a, pair->b};
  nsvcd_question question;
  memset(&question, 0, sizeof question);
  for (size_t n = 0; n < 2; n++) {
    const nsvcd_part *part = &c->scene->parts[parts[n]];
    nsvcd_mover *mover = n ? &question.b : &question.a;
    mover->body = part->body;
    mover->scale = part->scale;
    mover->poses = c->seen[n];
    mover->count = part->link ? count : 1;
  }
  question.method = NSVCD_METHOD_PROOF;
  question.work = work ? work : NSVCD_DEFAULT_WORK;
  return question;
}

// Asks whether two parts, as they are seen, come as near as the clearance.
static nsvcd_result nsvcd__ask_seen(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    size_t count, float clearance,
                                    const nsvcd_check_options *options, nsvcd_answer *found,
                                    nsvcd_check_answer *answer) {
  nsvcd_question question = nsvcd__question_of(c, pair, count, options->work);
  question.clearance = clearance;
  if (options->stop && options->stop(options->user)) {
    memset(found, 0, sizeof *found);
    found->why = NSVCD_WHY_WORK;
    return NSVCD_OK;
  }
  answer->sweeps++;
  return nsvcd_sweep(&question, c->query, c->query_size, found);
}

// The frames of a part from a sample on.
static const nsvcd__frame *nsvcd__frames_at(const nsvcd_checker *c, size_t part,
                                            size_t sample) {
  const nsvcd__member *m = &c->members[part];
  return c->scene->parts[part].link ? c->frames + m->row + sample : &m->frame;
}

// Asks about a pair, in the poses of so many steps, whether it comes as near as the clearance and,
// if a proof is wanted, all that these may be off. range: what was asked about; the times of *found
// are of it.
static nsvcd_result nsvcd__ask_pair(nsvcd_checker *c, const nsvcd_body_pair *pair,
                                    size_t steps, int is_proof,
                                    const nsvcd_check_options *options,
                                    nsvcd__step_range *range, nsvcd_answer *found,
                                    nsvcd_check_answer *answer) {
  nsvcd__sight view;
  const double off = nsvcd__off(c, pair->a) + nsvcd__off(c, pair->b);
  const double room = (double)options->clearance + off;
  if (!nsvcd__steps_near(c, pair, steps, room * (1 + 1e-9), range)) {
    found->verdict = NSVCD_FREE;
    return NSVCD_OK;
  }
  const nsvcd__frame *const frames[2] = {nsvcd__frames_at(c, pair->a, range->first),
                                         nsvcd__frames_at(c, pair->b, range->first)};
  nsvcd__view_pair(c, pair, frames, range->steps + 1, &view);
  const double deviations = is_proof ? off + view.rounding : 0;
  const double clearance = (double)options->clearance + deviations;
  return nsvcd__ask_seen(c, pair, range->steps + 1,
                         clearance > 0 ? nsvcd__above(clearance) : 0, options, found, answer);
}

// Is a pair hit at joints of its motion? Then the answer says so.
static nsvcd_result nsvcd__ask_at(nsvcd_checker *c, size_t pair, const double *joints,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_answer found;
  nsvcd__sight view;
  nsvcd__frame at[2];
  const nsvcd__frame *const frames[2] = {&at[0], &at[1]};
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  memcpy(c->at.joints, joints, c->scene->joint_count * sizeof *joints);
  nsvcd__pose_links(c, &c->at);
  answer->placed++;
  at[0] = nsvcd__frame_of_part(c, &c->at, both->a);
  at[1] = nsvcd__frame_of_part(c, &c->at, both->b);
  nsvcd__view_pair(c, both, frames, 1, &view);
  const nsvcd_result result =
      nsvcd__ask_seen(c, both, 1, options->clearance, options, &found, answer);
  if (result || found.verdict != NSVCD_HIT) return result;
  answer->verdict = NSVCD_HIT;
  answer->contact = found.nearest;
  nsvcd__set_contact(&view, &answer->contact);
  return NSVCD_OK;
}

// Puts a pair first in the order.
static void nsvcd__put_first(nsvcd_checker *c, size_t pair) {
  size_t at = 0;
  while (c->order[at] != pair) at++;
  for (; at > 0; at--) c->order[at] = c->order[at - 1];
  c->order[0] = (uint32_t)pair;
}

// Is a pair that is not proven hit in one configuration? Asked about where it is as near as its
// proof reached, then about where the samples' own way hits. found: what the proof said.
static nsvcd_result nsvcd__seek_hit(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                    size_t pair, size_t steps, nsvcd__step_range *range,
                                    nsvcd_answer *found, const nsvcd_check_options *options,
                                    nsvcd_check_answer *answer) {
  const nsvcd_body_pair *both = &c->scene->pairs[pair];
  double joints[NSVCD_MAX_JOINTS];
  nsvcd_result result = NSVCD_OK;
  answer->pair = pair;
  answer->why = found->why;
  for (int look = 0; look < 2 && !result && found->verdict != NSVCD_FREE; look++) {
    if (steps > 0) {
      // times of a sweep go by samples
      const double at =
          (double)range->steps * nsvcd__max(0, nsvcd__min(1, (double)found->nearest.time));
      const size_t step = (size_t)at < range->steps ? (size_t)at : range->steps - 1;
      const size_t k = range->first + step;
      const double fraction = at - (double)step;
      const double time = c->times[k] + fraction * (c->times[k + 1] - c->times[k]);
      answer->piece = nsvcd__piece_at(motion, time);
      answer->fraction = nsvcd__fraction_at(motion, answer->piece, time);
    }
    nsvcd__joints_at(motion, c->scene->joint_count, answer->piece, answer->fraction, joints,
                     NULL);
    result = nsvcd__ask_at(c, pair, joints, options, answer);
    if (answer->verdict == NSVCD_HIT) return result;
    if (look == 0 && !result)
      result = nsvcd__ask_pair(c, both, steps, 0, options, range, found, answer);
  }
  return result;
}

// A interval of a motion from time t0 to t1 in so many steps at first, or, with none, one
// configuration. What takes too many steps is halved, so often at most.
static nsvcd_result nsvcd__check_interval(nsvcd_checker *c, const nsvcd_joint_motion *motion,
                                          double t0, double t1, size_t steps, int halvings,
                                          const nsvcd_check_options *options,
                                          nsvcd_check_answer *answer) {
  size_t left = c->scene->pair_count;
  double allowed = NSVCD__COARSE;
  nsvcd_answer found;
  nsvcd__step_range range;
  nsvcd_check_options brief = *options;
  if (!brief.work || brief.work > NSVCD__PAIR_TRY) brief.work = NSVCD__PAIR_TRY;
  memcpy(c->left, c->order, left * sizeof *c->left);
  answer->piece = nsvcd__piece_at(motion, t0);
  answer->fraction = nsvcd__fraction_at(motion, answer->piece, t0);
  for (size_t k = 0; k <= steps; k++)
    c->times[k] = k < steps ? t0 + (t1 - t0) * (double)k / (double)steps : t1;
  nsvcd__sample(c, motion, steps);
  answer->placed += steps + 1;
  while (left > 0) {
    const size_t finer = nsvcd__refine_steps(c, steps, allowed);
    if (finer > NSVCD__MOST_STEPS) {
      const double middle = 0.5 * (t0 + t1);
      answer->why = NSVCD_WHY_WORK;
      if (halvings == 0 || !(middle > t0 && middle < t1)) return NSVCD_OK;
      const nsvcd_result result =
          nsvcd__check_interval(c, motion, t0, middle, steps, halvings - 1, options, answer);
      if (result || answer->verdict != NSVCD_FREE) return result;
      answer->verdict = NSVCD_UNDECIDED;
      return nsvcd__check_interval(c, motion, middle, t1, steps, halvings - 1, options,
                                   answer);
    }
    if (finer > steps) {
      steps = finer;
      nsvcd__sample(c, motion, steps);
      answer->placed += steps + 1;
    }
    size_t kept = 0;
    for (size_t n = 0; n < left; n++) {
      const size_t pair = c->left[n];
      const nsvcd_body_pair *both = &c->scene->pairs[pair];
      nsvcd_result result =
          nsvcd__ask_pair(c, both, steps, 1, options, &range, &found, answer);
      if (!result && found.verdict == NSVCD_FREE) continue;
      // with a small budget, but for the last time
      const int is_last = steps == 0 || allowed <= (double)options->finest;
      if (!result)
        result = nsvcd__seek_hit(c, motion, pair, steps, &range, &found,
                                 is_last ? options : &brief, answer);
      if (result) return result;
      if (answer->verdict == NSVCD_HIT) {
        nsvcd__put_first(c, pair);
        return NSVCD_OK;
      }
      c->left[kept++] = (uint32_t)pair;
    }
    left = kept;
    if (left == 0) break;
    if (steps == 0 || allowed <= (double)options->finest) return NSVCD_OK;
    allowed = nsvcd__max(allowed / NSVCD__DEVIATION_FRACTION, (double)options->finest);
  }
  answer->pair = NSVCD_NONE;
  answer->verdict = NSVCD_FREE;
  return NSVCD_OK;
}

// Does the motion turn sharply where a piece begins? There a sample belongs.
static int nsvcd__is_corner(const nsvcd_joint_motion *motion, size_t joints, size_t piece) {
  const double before = nsvcd__piece_time(motion, piece - 1);
  const double after = nsvcd__piece_time(motion, piece);
  double jumps = 0;
  for (size_t j = 0; j < joints; j++) jumps += nsvcd__jump_at(motion, joints, piece, j);
  return !(jumps * nsvcd__min(before, after) <= NSVCD__CORNER);
}

// What a joint may be out of its limits by rounding.
static double nsvcd__limit_off(const nsvcd_joint *joint) {
  return 1e-9 * (1 + fabs(joint->low) + fabs(joint->high));
}

// Does a joint leave its limits in a piece? Halved until it is within at all its points, or out at
// an end.
static int nsvcd__leaves(const double *points, size_t degree, double low, double high,
                         int depth) {
  double first[NSVCD_MAX_DEGREE + 1], second[NSVCD_MAX_DEGREE + 1];
  int step = 1;
  for (size_t i = 0; i <= degree; i++) step &= points[i] >= low && points[i] <= high;
  if (step) return 0;
  if (depth == 0 || !(points[0] >= low && points[0] <= high)) return 1;
  if (!(points[degree] >= low && points[degree] <= high)) return 1;
  memcpy(first, points, (degree + 1) * sizeof *points);
  memcpy(second, points, (degree + 1) * sizeof *points);
  nsvcd__cut_curve(first, degree, 0, 0.5);
  nsvcd__cut_curve(second, degree, 0.5, 1);
  return nsvcd__leaves(first, degree, low, high, depth - 1) ||
         nsvcd__leaves(second, degree, low, high, depth - 1);
}

// A joint that leaves its limits in a piece by more than rounding, or NSVCD_NONE.
static size_t nsvcd__joint_outside(const nsvcd_scene *scene, const nsvcd_joint_motion *motion,
                                   size_t piece) {
  double own[NSVCD_MAX_DEGREE + 1];
  for (size_t j = 0; j < scene->joint_count; j++) {
    const nsvcd_joint *joint = &scene->joints[j];
    if (joint->kind == NSVCD_JOINT_CONTINUOUS) continue;
    nsvcd__joint_points(motion, piece, scene->joint_count, j, own);
    const double off = nsvcd__limit_off(joint);
    if (nsvcd__leaves(own, motion->degree, joint->low - off, joint->high + off, 30)) return j;
  }
  return NSVCD_NONE;
}

// Is a motion, as it is meant, in order?
static nsvcd_result nsvcd__motion_check(const nsvcd_joint_motion *m, size_t joints) {
  const double most = (double)NSVCD_MAX_COORDINATE;
  if (m->pieces && (m->degree < 1 || m->degree > NSVCD_MAX_DEGREE)) return NSVCD_ERROR_DEGREE;
  if (m->pieces > SIZE_MAX / sizeof(double) / (NSVCD_MAX_DEGREE + 1) / joints)
    return NSVCD_ERROR_DEGREE;
  for (size_t k = 0; k < (m->pieces * m->degree + 1) * joints; k++) {
    if (!nsvcd__is_number(m->points[k], most)) return NSVCD_ERROR_VALUE;
  }
  for (size_t p = 0; p <= m->pieces && m->times; p++) {
    if (!nsvcd__is_number(m->times[p], most)) return NSVCD_ERROR_TIMES;
    if (p > 0 && !(m->times[p] > m->times[p - 1])) return NSVCD_ERROR_TIMES;
  }
  return NSVCD_OK;
}

NSVCDDEF nsvcd_result nsvcd_check(nsvcd_checker *checker, const nsvcd_joint_motion *motion,
                                  const nsvcd_check_options *options,
                                  nsvcd_check_answer *answer) {
  nsvcd_check_answer found;
  nsvcd_check_options o;
  if (!checker || !motion || !answer || !motion->points) return NSVCD_ERROR_ARGUMENT;
  const nsvcd_scene *scene = checker->scene;
  const size_t joints = scene->joint_count;
  const nsvcd_joint_motion m = nsvcd__motion_meant(motion);
  nsvcd_result result = nsvcd__motion_check(&m, joints);
  if (result) return result;
  memset(&o, 0, sizeof o);
  if (options) o = *options;
  if (!nsvcd__is_finite(o.clearance) || o.clearance < 0) return NSVCD_ERROR_CLEARANCE;
  if (!nsvcd__is_finite(o.finest) || o.finest < 0) return NSVCD_ERROR_FINEST;
  o.finest = o.finest > 0 ? o.finest : NSVCD__FINEST;
  memset(&found, 0, sizeof found);
  found.joint = found.pair = found.piece = NSVCD_NONE;
  for (size_t p = 0; p < m.pieces + !m.pieces && found.joint == NSVCD_NONE; p++)
    found.joint = nsvcd__joint_outside(scene, &m, p);
  found.verdict = NSVCD_UNDECIDED;
  if (m.pieces == 0) result = nsvcd__check_interval(checker, &m, 0, 0, 0, 0, &o, &found);
  // from corner to corner
  for (size_t p = 0, next; p < m.pieces && !result; p = next) {
    next = p + 1;
    while (next < m.pieces && !nsvcd__is_corner(&m, joints, next)) next++;
    const size_t steps = next - p == 1 && m.degree == 1 ? 1 : NSVCD__FIRST_STEPS;
    found.verdict = NSVCD_UNDECIDED;
    result = nsvcd__check_interval(checker, &m, nsvcd__piece_start(&m, p),
                                   nsvcd__piece_start(&m, next), steps, NSVCD__STRETCHES, &o,
                                   &found);
    if (found.verdict != NSVCD_FREE) break;
  }
  if (result) return result;
  if (found.verdict == NSVCD_FREE) {
    found.piece = NSVCD_NONE;
    found.fraction = 0;
    found.why = NSVCD_WHY_NOTHING;
  }
  *answer = found;
  return NSVCD_OK;
}
