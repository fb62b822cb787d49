// build.h - makes a tree_body of a mesh.
// In: a mesh (checked), how it may be cut. Out: the blob of body.h, from malloc.
//
// Triangles that are long beside their leaf are halved, as long as that makes leaves smaller: a few
// rounds of sorting and cutting. Then pieces are sorted so that each 16 are a leaf, each 16 leaves a
// node and so on, all of them full but the last ones: a set of pieces is split in two where the
// areas of the boxes, times what is in them, are least, at whole numbers of full children.
#ifndef LOOP_BUILD_H
#define LOOP_BUILD_H

#include "body.h"

#define CUT_ROUNDS 8

typedef struct cut_options {
  double share;     // a triangle is long from this share of its leaf's diagonal on,
  double fat;       // where the leaf is thicker than this share of it
  double smallest;  // share of the body's diagonal: nothing shorter is cut
  size_t budget;    // pieces more than triangles, at most
} cut_options;

#ifndef CUT
#define CUT {0.45, 0.05, 0.012, 0}
#endif
static const cut_options default_cut = CUT;

typedef struct piece {
  nsvcd__d3 at[3];  // about the middle
  uint32_t number;
  int closed;
} piece;

typedef struct builder {
  piece *pieces;
  size_t count, capacity;
  uint32_t *order;
  nsvcd__d3 *points;  // (3 count), in that order
  unsigned char *blob;
  size_t used, room;
  tree_body head;
} builder;

static void *build_memory(void *old, size_t size) {
  void *memory = realloc(old, size);
  if (!memory)
    exit(1);
  return memory;
}

// ---- sorting

typedef struct sort_key {
  float at;
  uint32_t piece;
} sort_key;
static int compare_keys(const void *a, const void *b) {
  const sort_key *x = (const sort_key *)a;
  const sort_key *y = (const sort_key *)b;
  if (x->at < y->at || x->at > y->at)
    return x->at < y->at ? -1 : 1;
  return x->piece < y->piece ? -1 : x->piece > y->piece;
}

typedef struct sort_box {
  nsvcd__d3 low, high;
} sort_box;
static const sort_box no_box = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

static void box_add(sort_box *box, const piece *p) {
  double *low = &box->low.x;
  double *high = &box->high.x;
  for (int k = 0; k < 3; k++) {
    const double *at = &p->at[k].x;
    for (int axis = 0; axis < 3; axis++) {
      low[axis] = at[axis] < low[axis] ? at[axis] : low[axis];
      high[axis] = at[axis] > high[axis] ? at[axis] : high[axis];
    }
  }
}
static double box_area(const sort_box *box) {
  const nsvcd__d3 d = nsvcd__d3_sub(box->high, box->low);
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

// The best of the splits of n sorted keys into whole full children on the left and the rest.
static double best_split(const builder *b, const sort_key *keys, size_t n, size_t full,
                         double *areas, size_t *split) {
  double best = HUGE_VAL;
  sort_box box = no_box;
  for (size_t i = n; i-- > 0;) {
    box_add(&box, &b->pieces[keys[i].piece]);
    areas[i] = box_area(&box);
  }
  box = no_box;
  for (size_t i = 0; i + 1 < n; i++) {
    box_add(&box, &b->pieces[keys[i].piece]);
    if ((i + 1) % full)
      continue;
    const double cost = box_area(&box) * (double)(i + 1) + areas[i + 1] * (double)(n - i - 1);
    if (cost >= best)
      continue;
    best = cost;
    *split = i + 1;
  }
  return best;
}

static void sort_pieces(builder *b, uint32_t *order, size_t n, size_t full) {
  if (n <= LANES)
    return;
  while (full >= n)
    full /= LANES;
  sort_key *keys = (sort_key *)build_memory(NULL, n * sizeof *keys);
  sort_key *chosen = (sort_key *)build_memory(NULL, n * sizeof *keys);
  double *areas = (double *)build_memory(NULL, n * sizeof *areas);
  double best = HUGE_VAL;
  size_t split = full;
  for (size_t way = 0; way < 6; way++) {
    size_t here = 0;
    for (size_t i = 0; i < n; i++) {
      const nsvcd__d3 *at = b->pieces[order[i]].at;
      const double sum = nsvcd__d3_axis(at[0], way % 3) + nsvcd__d3_axis(at[1], way % 3) +
                         nsvcd__d3_axis(at[2], way % 3);
      keys[i].at = (float)(way < 3 ? sum : -sum);
      keys[i].piece = order[i];
    }
    qsort(keys, n, sizeof *keys, compare_keys);
    const double cost = best_split(b, keys, n, full, areas, &here);
    if (cost < best || way == 0) {
      best = cost;
      split = here ? here : full;
      memcpy(chosen, keys, n * sizeof *keys);
    }
  }
  for (size_t i = 0; i < n; i++)
    order[i] = chosen[i].piece;
  free(keys);
  free(chosen);
  free(areas);
  sort_pieces(b, order, split, full);
  sort_pieces(b, order + split, n - split, full);
}

static void sort_all(builder *b) {
  size_t full = LANES;
  while (full < b->count)
    full *= LANES;
  b->order = (uint32_t *)build_memory(b->order, b->count * sizeof *b->order);
  b->points = (nsvcd__d3 *)build_memory(b->points, 3 * b->count * sizeof *b->points);
  for (size_t i = 0; i < b->count; i++)
    b->order[i] = (uint32_t)i;
  sort_pieces(b, b->order, b->count, full);
  for (size_t i = 0; i < b->count; i++)
    memcpy(b->points + 3 * i, b->pieces[b->order[i]].at, 3 * sizeof *b->points);
}

// ---- slabs

// The direction in which pieces first .. first + count - 1, as sorted, are thin.
static nsvcd__d3 thin_direction(const builder *b, size_t first, size_t count) {
  const nsvcd__points points = {b->points + 3 * first, 3 * count};
  nsvcd__d3 mean = nsvcd__d3_of(0, 0, 0);
  for (size_t i = 0; i < count; i++)
    mean = nsvcd__d3_add(mean, nsvcd__face_normal(points.at + 3 * i));
  nsvcd__d3 best = nsvcd__least_axis(points);
  mean = nsvcd__d3_unit(mean, best);
  if (nsvcd__thickness(points, mean) < nsvcd__thickness(points, best))
    best = mean;
  return nsvcd__thinner(points, best);
}

// ---- cutting

typedef struct long_piece {
  uint32_t piece;
  int edge;
  double length;
} long_piece;
static int compare_long(const void *a, const void *b) {
  const double x = ((const long_piece *)a)->length;
  const double y = ((const long_piece *)b)->length;
  return x > y ? -1 : x < y;
}

static double longest_edge(const piece *p, int *edge) {
  double longest = -1;
  for (int k = 0; k < 3; k++) {
    const double length = nsvcd__d3_length(nsvcd__d3_sub(p->at[(k + 1) % 3], p->at[k]));
    if (length > longest) {
      longest = length;
      *edge = k;
    }
  }
  return longest;
}

// Pieces that are long beside their leaf. Returns how many.
static size_t find_long(const builder *b, const cut_options *cut, double least, long_piece *found) {
  size_t many = 0;
  for (size_t first = 0; first < b->count; first += LANES) {
    const size_t n = b->count - first < LANES ? b->count - first : LANES;
    sort_box box = no_box;
    for (size_t i = 0; i < n; i++)
      box_add(&box, &b->pieces[b->order[first + i]]);
    const double diagonal = nsvcd__d3_length(nsvcd__d3_sub(box.high, box.low));
    const nsvcd__points points = {b->points + 3 * first, 3 * n};
    if (nsvcd__thickness(points, thin_direction(b, first, n)) < cut->fat * diagonal)
      continue;
    for (size_t i = 0; i < n; i++) {
      long_piece *p = &found[many];
      p->piece = b->order[first + i];
      p->length = longest_edge(&b->pieces[p->piece], &p->edge);
      many += p->length > cut->share * diagonal && p->length > least;
    }
  }
  return many;
}

static void halve_piece(builder *b, const long_piece *p) {
  if (b->count == b->capacity) {
    b->capacity = 2 * b->capacity + 64;
    b->pieces = (piece *)build_memory(b->pieces, b->capacity * sizeof *b->pieces);
  }
  piece *one = &b->pieces[p->piece];
  piece *other = &b->pieces[b->count++];
  const int next = (p->edge + 1) % 3;
  const nsvcd__d3 middle = nsvcd__d3_mix(one->at[p->edge], one->at[next], 0.5);
  *other = *one;
  one->at[next] = middle;
  other->at[p->edge] = middle;
}

static void cut_long(builder *b, const cut_options *cut) {
  sort_box all = no_box;
  for (size_t i = 0; i < b->count; i++)
    box_add(&all, &b->pieces[i]);
  const double least = cut->smallest * nsvcd__d3_length(nsvcd__d3_sub(all.high, all.low));
  const size_t most = b->count + cut->budget;
  for (int round = 0; round < CUT_ROUNDS && b->count < most; round++) {
    long_piece *found = (long_piece *)build_memory(NULL, (b->count + 1) * sizeof *found);
    const size_t many = find_long(b, cut, least, found);
    qsort(found, many, sizeof *found, compare_long);
    for (size_t i = 0; i < many && b->count < most; i++)
      halve_piece(b, &found[i]);
    free(found);
    if (!many)
      return;
    sort_all(b);
  }
}

// ---- writing

// Room for a thing, zeroed; where it begins, in words.
static uint32_t take_room(builder *b, size_t size) {
  const size_t at = (b->used + 3) / 4 * 4;
  if (at + size + 256 > b->room) {
    b->room = 2 * (at + size + 256);
    b->blob = (unsigned char *)build_memory(b->blob, b->room);
  }
  memset(b->blob + b->used, 0, at + size + 256 - b->used);
  b->used = at + size;
  return (uint32_t)(at / 4);
}

typedef struct leaf_draft {
  uint16_t places[3 * LANES][3];
  uint16_t corners[LANES];
  unsigned vertices;
} leaf_draft;

static unsigned draft_vertex(leaf_draft *d, const uint16_t *place) {
  unsigned v = 0;
  while (v < d->vertices && memcmp(d->places[v], place, sizeof d->places[v]) != 0)
    v++;
  if (v == d->vertices)
    memcpy(d->places[d->vertices++], place, sizeof d->places[v]);
  return v;
}

// The lattice of a leaf: a power of two, wide enough for 16 bits and for the float of any corner.
static double lattice_step(const sort_box *box, double *origin) {
  double most = 0;
  double widest = 0;
  for (size_t k = 0; k < 3; k++) {
    const double low = nsvcd__d3_axis(box->low, k);
    const double high = nsvcd__d3_axis(box->high, k);
    most = fmax(most, fmax(fabs(low), fabs(high)));
    widest = fmax(widest, high - low);
  }
  int exponent;
  frexp(fmax(widest / 65533, most / 8388608), &exponent);
  const double step = fmax(ldexp(1, exponent), 1e-37);
  for (size_t k = 0; k < 3; k++)
    origin[k] = floor(nsvcd__d3_axis(box->low, k) / step) * step;
  return step;
}

static uint32_t write_leaf(builder *b, size_t first, size_t n) {
  sort_box box = no_box;
  leaf_draft draft = {0};
  double origin[3];
  for (size_t i = 0; i < n; i++)
    box_add(&box, &b->pieces[b->order[first + i]]);
  const double step = lattice_step(&box, origin);
  uint16_t all[3][LANES][3];
  for (size_t i = 0; i < LANES; i++) {
    const piece *p = &b->pieces[b->order[first + (i < n ? i : 0)]];
    for (unsigned k = 0; k < 3; k++) {
      for (size_t axis = 0; axis < 3; axis++)
        all[k][i][axis] = (uint16_t)((nsvcd__d3_axis(p->at[k], axis) - origin[axis]) / step + 0.5);
      draft.corners[i] |= (uint16_t)((draft_vertex(&draft, all[k][i]) & 31) << 5 * k);
    }
  }
  const unsigned vertices = draft.vertices > MOST_SHARED ? LOOSE : draft.vertices;
  const size_t number_size = b->head.wide_numbers ? 4 : 2;
  const uint32_t at = take_room(b, sizeof(tree_leaf) + n * number_size + 6 * vertices);
  tree_leaf *leaf = (tree_leaf *)(void *)(b->blob + 4 * (size_t)at);
  for (int k = 0; k < 3; k++)
    leaf->origin[k] = (float)origin[k];
  leaf->step = (float)step;
  leaf->count = (uint8_t)n;
  leaf->vertices = (uint8_t)vertices;
  memcpy(leaf->corners, draft.corners, sizeof draft.corners);
  unsigned char *numbers = (unsigned char *)(leaf + 1);
  for (size_t i = 0; i < n; i++) {
    const piece *p = &b->pieces[b->order[first + i]];
    leaf->closed |= (uint16_t)((p->closed != 0) << i);
    memcpy(numbers + i * number_size, &p->number, number_size);
  }
  uint16_t *lattice = (uint16_t *)(void *)(numbers + n * number_size);
  for (unsigned axis = 0; axis < 3; axis++)
    for (unsigned v = 0; v < vertices; v++)
      lattice[axis * vertices + v] =
          vertices == LOOSE ? all[v / LANES][v % LANES][axis] : draft.places[v][axis];
  b->head.quantum = fmaxf(b->head.quantum, leaf_error(leaf));
  b->head.leaves++;
  return at | LEAF_LINK;
}

// A subtree: what it holds, and where it is.
typedef struct branch {
  size_t first, count;  // pieces, as sorted
  uint32_t link;
} branch;

static int16_t step_below(double x) {
  return (int16_t)floor(x);
}
static int16_t step_above(double x) {
  return (int16_t)ceil(x);
}

static void write_child(const builder *b, const branch *from, tree_node *node, unsigned l) {
  const nsvcd__points points = {b->points + 3 * from->first, 3 * from->count};
  const double q = (double)node->quantum;
  const nsvcd__d3 middle = nsvcd__d3_load(node->middle);
  for (size_t k = 0; k < 3; k++) {
    nsvcd__d3 axis = nsvcd__d3_of(k == 0, k == 1, k == 2);
    const nsvcd__range range = nsvcd__range_along(points, axis);
    const double from_middle = nsvcd__d3_axis(middle, k);
    node->low[k][l] = step_below((range.low - from_middle) / q);
    node->high[k][l] = step_above((range.high - from_middle) / q);
  }
  const nsvcd__d3 thin = thin_direction(b, from->first, from->count);
  nsvcd__d3 stored = thin;
  for (size_t k = 0; k < 3; k++) {
    node->normal[k][l] = (int16_t)(nsvcd__d3_axis(thin, k) * 32767);  // towards 0
    nsvcd__d3_set_axis(&stored, k, node->normal[k][l] / 32767.0);
  }
  const nsvcd__range slab = nsvcd__range_along(points, stored);
  const double along = nsvcd__d3_dot(stored, middle);
  node->slab[0][l] = step_below((slab.low - along) / (2 * q));
  node->slab[1][l] = step_above((slab.high - along) / (2 * q));
  double reach = 0;
  for (size_t i = 0; i < points.count; i++)
    reach = fmax(reach, nsvcd__d3_length(points.at[i]));
  node->reach[l] = (uint16_t)ceil(reach / (double)b->head.reach_unit);
  node->links[l] = from->link;
}

static uint32_t write_node(builder *b, const branch *from, size_t n) {
  const uint32_t at = take_room(b, sizeof(tree_node));
  tree_node *node = (tree_node *)(void *)(b->blob + 4 * (size_t)at);
  const size_t count = from[n - 1].first + from[n - 1].count - from[0].first;
  sort_box box = no_box;
  for (size_t i = 0; i < count; i++)
    box_add(&box, &b->pieces[b->order[from[0].first + i]]);
  double widest = 1e-36;
  for (size_t k = 0; k < 3; k++) {
    const double low = nsvcd__d3_axis(box.low, k);
    const double high = nsvcd__d3_axis(box.high, k);
    node->middle[k] = nsvcd__to_float(0.5 * (low + high));
    widest = fmax(widest, fmax(high - (double)node->middle[k], (double)node->middle[k] - low));
  }
  node->quantum = nsvcd__to_float(widest / NODE_STEPS * (1 + 1e-6));
  node->count = (uint32_t)n;
  for (size_t i = 0; i < n; i++)
    write_child(b, &from[i], node, (unsigned)i);
  b->head.nodes++;
  return at;
}

static void write_tree(builder *b) {
  size_t n = (b->count + LANES - 1) / LANES;
  branch *row = (branch *)build_memory(NULL, n * sizeof *row);
  for (size_t i = 0; i < n; i++) {
    row[i].first = LANES * i;
    row[i].count = b->count - LANES * i < LANES ? b->count - LANES * i : LANES;
    row[i].link = write_leaf(b, row[i].first, row[i].count);
  }
  for (int done = 0; !done;) {
    done = n == 1;  // the top has one child
    for (size_t i = 0; i * LANES < n; i++) {
      branch *from = &row[i * LANES];
      const size_t many = n - i * LANES < LANES ? n - i * LANES : LANES;
      const branch above = {from->first,
                            from[many - 1].first + from[many - 1].count - from->first,
                            write_node(b, from, many)};
      row[i] = above;
    }
    n = (n + LANES - 1) / LANES;
    b->head.depth++;
  }
  b->head.top = row[0].link;
  free(row);
}

// ---- all of it

static void read_pieces(builder *b, const nsvcd_mesh *mesh, const nsvcd__topology *topology) {
  nsvcd__d3 low = nsvcd__d3_of(HUGE_VAL, HUGE_VAL, HUGE_VAL);
  nsvcd__d3 high = nsvcd__d3_scale(low, -1);
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    low = nsvcd__d3_min(low, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
    high = nsvcd__d3_max(high, nsvcd__d3_row(mesh->positions, mesh->indices[i]));
  }
  const nsvcd__f3 centre = nsvcd__f3_round(nsvcd__d3_mix(low, high, 0.5));
  const nsvcd__d3 middle = nsvcd__d3_widen(centre);
  nsvcd__f3_store(centre, b->head.centre);
  b->head.off = (float)nsvcd__d3_length(middle) * 1.000001f;
  b->head.open = 1;
  double reach = 0;
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    piece *p = &b->pieces[b->count++];
    p->number = (uint32_t)t;
    p->closed = !topology->open[topology->parents[topology->welded[mesh->indices[3 * t]]]];
    b->head.open &= !p->closed;
    for (size_t k = 0; k < 3; k++) {
      p->at[k] = nsvcd__d3_sub(nsvcd__d3_row(mesh->positions, mesh->indices[3 * t + k]), middle);
      reach = fmax(reach, nsvcd__d3_length(p->at[k]));
    }
  }
  b->head.reach_unit = nsvcd__to_float(fmax(reach, 1e-30) / 65500);
  b->head.reach = nsvcd__to_float(reach * 1.000001);
  for (size_t k = 0; k < 3; k++) {
    b->head.low[k] = -nsvcd__float_above(-nsvcd__d3_axis(nsvcd__d3_sub(low, middle), k));
    b->head.high[k] = nsvcd__float_above(nsvcd__d3_axis(nsvcd__d3_sub(high, middle), k));
  }
}

// A vertex of each component, about the middle.
static void write_seeds(builder *b, const nsvcd_mesh *mesh, const nsvcd__topology *topology) {
  b->head.seeds = take_room(b, 12 * topology->component_count);
  float *out = (float *)(void *)(b->blob + 4 * (size_t)b->head.seeds);
  memset(topology->seen, 0, mesh->vertex_count);
  for (size_t t = 0; t < mesh->triangle_count; t++) {
    const uint32_t root = topology->parents[topology->welded[mesh->indices[3 * t]]];
    if (topology->seen[root])
      continue;
    topology->seen[root] = 1;
    for (size_t k = 0; k < 3; k++)
      *out++ = mesh->positions[3 * (size_t)root + k] - b->head.centre[k];
    b->head.seed_count++;
  }
}

// NULL where the mesh is no mesh.
static tree_body *build_body(const nsvcd_mesh *mesh, const cut_options *cut) {
  nsvcd__arena arena = nsvcd__arena_of(NULL);
  nsvcd__topology topology;
  builder b;
  memset(&b, 0, sizeof b);
  if (nsvcd__mesh_check(mesh))
    return NULL;
  if (!nsvcd__topology_build(mesh, &arena, &topology)) {
    nsvcd__arena_free(&arena);
    return NULL;
  }
  b.capacity = mesh->triangle_count;
  b.pieces = (piece *)build_memory(NULL, b.capacity * sizeof *b.pieces);
  b.head.triangles = (uint32_t)mesh->triangle_count;
  b.head.wide_numbers = mesh->triangle_count > 65536;
  read_pieces(&b, mesh, &topology);
  sort_all(&b);
  cut_long(&b, cut);
  b.head.pieces = (uint32_t)b.count;
  take_room(&b, sizeof(tree_body));
  write_tree(&b);
  write_seeds(&b, mesh, &topology);
  take_room(&b, 128);  // vectors read past what they need
  b.head.bytes = (uint32_t)b.used;
  memcpy(b.blob, &b.head, sizeof b.head);
  free(b.pieces);
  free(b.order);
  free(b.points);
  nsvcd__arena_free(&arena);
  return (tree_body *)(void *)b.blob;
}

#endif
