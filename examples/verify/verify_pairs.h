// SPDX-License-Identifier: MIT
// verify_pairs.h - of verify.c: certificates that two bodies of a robot never meet, whatever the joints
// between them do within their limits. Values are cut into boxes; in each a sweep along one joint, the
// others at the middle of their values, is proven free, with a clearance that is more than what the
// others can move a point.
#ifndef NSVCD_VERIFY_PAIRS_H
#define NSVCD_VERIFY_PAIRS_H
#include "verify_plans.h"

#define MOST_BOXES 128  // of a stack

// A box of values: NULL, or why it is not proven that two bodies are apart in all of it. swept: a link.
static const char *check_box(request *asked, const robot *r, const robot_body *const *bodies,
                             const double *low, const double *high, uint32_t swept,
                             const uint8_t *bytes, size_t size, size_t *at) {
  static const double times[2] = {0, 1};
  double points[2 * NSVCD_VERIFY_JOINTS], half[NSVCD_VERIFY_JOINTS];
  const size_t joints = r->joint_count;
  const nsvcd_verify_motion m = {r->joints, joints, 1, 1, points, times};
  const nsvcd_verify_mesh *meshes[2] = {bodies[0]->mesh, bodies[1]->mesh};
  nsvcd_verify_part parts[2];
  const uint32_t bits = (uint32_t)take(bytes, size, at, 4);
  const size_t length = (size_t)take(bytes, size, at, 4);
  float clearance;
  memcpy(&clearance, &bits, sizeof clearance);
  if (*at > size || length > size - *at) return "it ends early";
  for (size_t j = 0; j < joints; j++) {
    const double middle = 0.5 * (low[j] + high[j]);
    points[j] = points[joints + j] = middle;
    half[j] = (1 + 1e-15) * verify__max(high[j] - middle, middle - low[j]);
  }
  points[swept - 1] = low[swept - 1];
  points[joints + swept - 1] = high[swept - 1];
  const char *why = nsvcd_verify_motion_check(&m);
  if (why) return why;
  for (int k = 0; k < 2; k++) {
    parts[k].motion = &m;
    parts[k].link = bodies[k]->link;
    parts[k].base = nsvcd_verify_common(&m, bodies[0]->link, bodies[1]->link);
    memcpy(parts[k].pose, bodies[k]->pose, sizeof parts[k].pose);
    if (!verify__is_pose(parts[k].pose)) return "a body is at no pose";
  }
  if (!((double)clearance >= nsvcd_verify_travel(parts, meshes, half, swept)))
    return "joints of a box move a point farther than its clearance";
  return check_free(asked, bodies, parts, clearance, bytes, length, at);
}

// All values of the joints between two bodies: NULL, or why it is not proven that they never meet.
static const char *check_never(request *asked, const robot *r, const robot_body *const *bodies,
                               const uint8_t *bytes, size_t size, size_t *at) {
  const size_t joints = r->joint_count;
  const char *why = NULL;
  uint8_t is_between[NSVCD_VERIFY_JOINTS] = {0};
  size_t height = 1;
  *at = 4;
  if (size < 4 || memcmp(bytes, "NSVN", 4) != 0) return "it is no certificate of two bodies";
  for (uint32_t a = bodies[0]->link, b = bodies[1]->link; a != b;) {
    uint32_t *outer = a > b ? &a : &b;
    is_between[*outer - 1] = 1;
    *outer = r->joints[*outer - 1].parent;
  }
  double *boxes = (double *)allocate(MOST_BOXES * 2 * joints * sizeof *boxes);
  memcpy(boxes, r->low, joints * sizeof *boxes);
  memcpy(boxes + joints, r->high, joints * sizeof *boxes);
  while (height > 0 && !why) {
    double *box = boxes + (height - 1) * 2 * joints;
    const size_t code = (size_t)take(bytes, size, at, 1);
    const size_t joint = code & 127;
    if (*at > size) {
      why = "it ends early";
    } else if (joint >= joints || !is_between[joint]) {
      why = "a joint is not between the two";
    } else if (code < 128) {
      why = check_box(asked, r, bodies, box, box + joints, (uint32_t)joint + 1, bytes, size, at);
      height--;
    } else if (height == MOST_BOXES) {
      why = "it is too deep";
    } else {  // the lower half comes first
      const double middle = 0.5 * (box[joint] + box[joints + joint]);
      memcpy(box + 2 * joints, box, 2 * joints * sizeof *box);
      box[joint] = box[3 * joints + joint] = middle;
      height++;
    }
  }
  free(boxes);
  return !why && *at != size ? "something follows its end" : why;
}

static int is_named(const robot *r, uint32_t a, uint32_t b) {
  const uint32_t who[2] = {a, b};
  for (size_t k = 0; k < r->own_pairs; k += 2)
    if (is_of((const uint32_t *)r->pairs.items + k, who)) return 1;
  return 0;
}

// Writes a name to `to` at *at, so that no two pairs A-B are written alike: with %2d for -, %2f for /,
// %2c for a comma and %25 for %.
static void put_name(char *to, size_t capacity, size_t *at, const char *name) {
  for (; *name && *at + 4 < capacity; name++) {
    const int is_plain = !strchr("-/,%", *name);
    if (!is_plain) snprintf(to + *at, 4, "%%%02x", (unsigned)(unsigned char)*name);
    if (is_plain) to[*at] = *name;
    *at += is_plain ? 1 : 3;
    to[*at] = 0;
  }
}

// Checks A-B.cert for each two bodies of the robot that are on different links and no pair of the
// file, which plans look at. Returns 1 if all are accepted.
static int check_pairs(robot *r, request *asked) {
  const robot_body *all = (const robot_body *)r->bodies.items;
  int good = 1;
  for (uint32_t n = 0; n < r->own * r->own; n++) {
    const robot_body *bodies[2] = {all + n / r->own, all + n % r->own};
    char id[1024], path[4096];
    size_t size = 0;
    size_t at = 0;
    if (bodies[0] >= bodies[1] || bodies[0]->link == bodies[1]->link) continue;
    size_t end = 0;
    put_name(id, sizeof id / 2, &end, bodies[0]->name);
    id[end++] = '-';
    put_name(id, sizeof id, &end, bodies[1]->name);
    snprintf(path, sizeof path, "%s/%s.cert", asked->folder, id);
    if (is_named(r, (uint32_t)(n / r->own), (uint32_t)(n % r->own)) || !is_wanted(asked, id))
      continue;
    uint8_t *bytes = (uint8_t *)read_file(path, &size);
    const clock_t start = clock();
    const char *why = "there is no certificate";
    if (bytes) why = check_never(asked, r, bodies, bytes, size, &at);
    const double taken = 1e6 * (double)(clock() - start) / (double)CLOCKS_PER_SEC;
    print_line(asked, id, why, "never", bytes ? size : 0, at, taken);
    free(bytes);
    good &= !why;
  }
  return good;
}
#endif  // NSVCD_VERIFY_PAIRS_H
