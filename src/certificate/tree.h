// In: a mesh. Out: its connected components, and a tree of boxes over its triangles. The floor, top
// to bottom:
//
//   tree        boxes, and components
//   models      where a body is at a time, and how far points leave their chords
//   planes      a plane that separates two nodes for an interval of time; its normal in a few bits
//   rays        what is inside of what at one time
//   certify     the traversal that a certificate is
//
// examples/verify builds and computes all of this again, by code of its own. The rules by which
// nodes are cut and opened, and the form of the bits, are the same in both.
#pragma once
#include "../ground/digests.h"
#include "../ground/valid.h"
#include "../interface/certificates.h"
#include "../ground/memory.h"
#include "../ground/spheres.h"

// of a mesh, at most; and nodes on the stack of a traversal of that many
#define NSVCD__TREE_TRIANGLES 0x20000000
#define NSVCD__TREE_STACK 32

// A run of triangles of a tree, with a box about them.
typedef struct nsvcd__node {
  // its row of boxes
  uint32_t box;
  // of order
  uint32_t first, count;
} nsvcd__node;

struct nsvcd_tree {
  nsvcd_mesh mesh;
  // (2 triangles - 1): of a node, of its left tree, of its right tree
  nsvcd__box *boxes;
  // (triangles): the leaves, from left to right
  uint32_t *order;
  // (triangles, 3, 3), in that order
  float *corners;
  // (vertices): the lowest vertex of its component; NSVCD_NO_TRIANGLE: no triangle has it
  uint32_t *component;
  // (vertices): the lowest vertex at its position
  uint32_t *weld;
  // (vertices): 1: that vertex's component is not closed
  uint8_t *open;
  uint32_t digest;
};

static const float *nsvcd__tree_corner(const nsvcd_tree *tree, uint32_t triangle, uint32_t k) {
  const uint32_t vertex = tree->mesh.indices[3 * (size_t)triangle + k];
  return tree->mesh.positions + 3 * (size_t)vertex;
}

// Three times a triangle's middle, in double: a key to sort by, which must be the same each time.
static nsvcd__d3 nsvcd__tree_middle(const nsvcd_tree *tree, uint32_t triangle) {
  nsvcd__d3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < 3; k++) {
    const nsvcd__d3 corner = nsvcd__d3_load(nsvcd__tree_corner(tree, triangle, k));
    sum = nsvcd__d3_stored(nsvcd__d3_add(sum, corner));
  }
  return sum;
}

// Below 0: a triangle is before another one, whose key is given; above 0: it is after it.
static int nsvcd__tree_order(const nsvcd_tree *tree, uint32_t triangle, uint32_t other,
                             double key, size_t axis) {
  const double own = nsvcd__d3_axis(nsvcd__tree_middle(tree, triangle), axis);
  if (own < key || own > key) return own < key ? -1 : 1;
  return triangle < other ? -1 : triangle > other;
}

// Sets the box of a node, and puts the lower half of its triangles first: by their middles, along
// the axis along which these differ most, and of equals by number. Quickselect (Hoare 1961).
static void nsvcd__cut_node(nsvcd_tree *tree, const nsvcd__node *node) {
  uint32_t *order = tree->order + node->first;
  nsvcd__box box;
  box.low = box.high = nsvcd__f3_load(nsvcd__tree_corner(tree, order[0], 0));
  nsvcd__d3 least = nsvcd__tree_middle(tree, order[0]);
  nsvcd__d3 most = least;
  for (uint32_t i = 0; i < node->count; i++) {
    const nsvcd__d3 middle = nsvcd__tree_middle(tree, order[i]);
    least = nsvcd__d3_min(least, middle);
    most = nsvcd__d3_max(most, middle);
    for (uint32_t k = 0; k < 3; k++) {
      const nsvcd__f3 x = nsvcd__f3_load(nsvcd__tree_corner(tree, order[i], k));
      box.low = nsvcd__f3_min(box.low, x);
      box.high = nsvcd__f3_max(box.high, x);
    }
  }
  tree->boxes[node->box] = box;
  const nsvcd__d3 sides = nsvcd__d3_stored(nsvcd__d3_sub(most, least));
  size_t axis = sides.y > sides.x;
  if (sides.z > nsvcd__d3_axis(sides, axis)) axis = 2;
  const ptrdiff_t half = (ptrdiff_t)(node->count / 2);
  ptrdiff_t from = 0;
  ptrdiff_t to = (ptrdiff_t)node->count - 1;
  while (from < to) {
    const uint32_t pivot = order[from + (to - from) / 2];
    const double key = nsvcd__d3_axis(nsvcd__tree_middle(tree, pivot), axis);
    ptrdiff_t i = from;
    ptrdiff_t j = to;
    while (i <= j) {
      while (nsvcd__tree_order(tree, order[i], pivot, key, axis) < 0) i++;
      while (nsvcd__tree_order(tree, order[j], pivot, key, axis) > 0) j--;
      if (i > j) break;
      const uint32_t swapped = order[i];
      order[i++] = order[j];
      order[j--] = swapped;
    }
    if (half > j) from = i;
    if (half < i) to = j;
  }
}

static void nsvcd__children(const nsvcd__node *node, nsvcd__node *left, nsvcd__node *right) {
  const nsvcd__node whole = *node;
  left->box = whole.box + 1;
  left->first = whole.first;
  left->count = whole.count / 2;
  right->box = whole.box + 2 * left->count;
  right->first = whole.first + left->count;
  right->count = whole.count - left->count;
}

// ---- components

// Below 0, 0 or above it: the position of vertex i is before, at or after that of vertex j.
static int nsvcd__position_order(const nsvcd_tree *tree, uint32_t i, uint32_t j) {
  const float *x = tree->mesh.positions + 3 * (size_t)i;
  const float *y = tree->mesh.positions + 3 * (size_t)j;
  for (size_t k = 0; k < 3; k++) {
    if (x[k] < y[k]) return -1;
    if (x[k] > y[k]) return 1;
  }
  return 0;
}

// The ends of an edge, by the lowest vertices at their positions. Edge 3 t + k begins at corner k
// of triangle t.
static void nsvcd__edge_ends(const nsvcd_tree *tree, uint32_t edge, uint32_t *ends) {
  const uint32_t next = edge % 3 == 2 ? edge - 2 : edge + 1;
  ends[0] = tree->weld[tree->mesh.indices[edge]];
  ends[1] = tree->weld[tree->mesh.indices[next]];
}

// The same order of two edges, whichever way they go.
static int nsvcd__edge_order(const nsvcd_tree *tree, uint32_t i, uint32_t j) {
  uint32_t a[2], b[2];
  nsvcd__edge_ends(tree, i, a);
  nsvcd__edge_ends(tree, j, b);
  const int up_a = a[0] < a[1];
  const int up_b = b[0] < b[1];
  const uint64_t x = (uint64_t)a[!up_a] << 32 | a[up_a];
  const uint64_t y = (uint64_t)b[!up_b] << 32 | b[up_b];
  return x < y ? -1 : x > y;
}

typedef int nsvcd__tree_compare(const nsvcd_tree *tree, uint32_t i, uint32_t j);

// Moves an entry of a heap down to where it belongs.
static void nsvcd__sink(const nsvcd_tree *tree, nsvcd__tree_compare *order, uint32_t *heap,
                        size_t count, size_t at) {
  const uint32_t sinks = heap[at];
  for (size_t child = 2 * at + 1; child < count; child = 2 * at + 1) {
    if (child + 1 < count && order(tree, heap[child], heap[child + 1]) < 0) child++;
    if (order(tree, sinks, heap[child]) >= 0) break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = sinks;
}

// Heap sort (Williams 1964): no memory, and no mesh makes it slow.
static void nsvcd__sort_numbers(const nsvcd_tree *tree, nsvcd__tree_compare *order,
                                uint32_t *numbers, size_t count) {
  for (size_t at = count / 2; at-- > 0;) nsvcd__sink(tree, order, numbers, count, at);
  for (size_t end = count; end-- > 1;) {
    const uint32_t last = numbers[end];
    numbers[end] = numbers[0];
    numbers[0] = last;
    nsvcd__sink(tree, order, numbers, end, 0);
  }
}

// Fills in tree->weld. numbers: (vertices), scratch.
static void nsvcd__weld_positions(nsvcd_tree *tree, uint32_t *numbers) {
  const size_t count = tree->mesh.vertex_count;
  size_t end;
  for (size_t v = 0; v < count; v++) numbers[v] = (uint32_t)v;
  nsvcd__sort_numbers(tree, nsvcd__position_order, numbers, count);
  for (size_t i = 0; i < count; i = end) {
    uint32_t lowest = numbers[i];
    end = i;
    while (end < count && nsvcd__position_order(tree, numbers[i], numbers[end]) == 0) {
      lowest = numbers[end] < lowest ? numbers[end] : lowest;
      end++;
    }
    for (size_t n = i; n < end; n++) tree->weld[numbers[n]] = lowest;
  }
}

// Union-find, with the lowest vertex as the root.
static uint32_t nsvcd__find_root(uint32_t *roots, uint32_t v) {
  while (roots[v] != v) {
    roots[v] = roots[roots[v]];
    v = roots[v];
  }
  return v;
}

static void nsvcd__unite(uint32_t *roots, uint32_t v, uint32_t w) {
  const uint32_t x = nsvcd__find_root(roots, v);
  const uint32_t y = nsvcd__find_root(roots, w);
  roots[x > y ? x : y] = x > y ? y : x;
}

// Fills in tree->component and tree->open: unites the corners of each triangle, and vertices at the
// same position. A component is open if its triangles do not go along an edge equally often in both
// directions. edges: (3 triangles), scratch.
static void nsvcd__find_components(nsvcd_tree *tree, uint32_t *edges) {
  const uint32_t *indices = tree->mesh.indices;
  const size_t corners = 3 * tree->mesh.triangle_count;
  size_t end;
  uint32_t *roots = tree->component;
  nsvcd__weld_positions(tree, roots);
  for (size_t v = 0; v < tree->mesh.vertex_count; v++) {
    roots[v] = NSVCD_NO_TRIANGLE;
    tree->open[v] = 0;
  }
  for (size_t i = 0; i < corners; i++) {
    const uint32_t lowest = tree->weld[indices[i]];
    roots[indices[i]] = indices[i];
    roots[lowest] = lowest;
    edges[i] = (uint32_t)i;
  }
  for (size_t i = 0; i < corners; i++) {
    nsvcd__unite(roots, indices[i], indices[i / 3 * 3]);
    nsvcd__unite(roots, indices[i], tree->weld[indices[i]]);
  }
  for (size_t i = 0; i < corners; i++) roots[indices[i]] = nsvcd__find_root(roots, indices[i]);
  nsvcd__sort_numbers(tree, nsvcd__edge_order, edges, corners);
  for (size_t i = 0; i < corners; i = end) {
    ptrdiff_t balance = 0;
    for (end = i; end < corners && nsvcd__edge_order(tree, edges[i], edges[end]) == 0; end++) {
      uint32_t ends[2];
      nsvcd__edge_ends(tree, edges[end], ends);
      balance += (ends[0] < ends[1]) - (ends[1] < ends[0]);
    }
    if (balance != 0) tree->open[roots[indices[edges[i]]]] = 1;
  }
}

// Lays a tree out at base, or, where that is NULL, only counts. Returns the bytes that it takes.
static uint64_t nsvcd__tree_layout(const nsvcd_mesh *mesh, char *base, nsvcd_tree *tree) {
  uint64_t used = 0;
  const size_t triangles = mesh->triangle_count;
  (void)nsvcd__take(base, &used, 1, sizeof *tree);
  tree->boxes = NSVCD__TAKE_ROWS(nsvcd__box, 2 * triangles - 1, base, &used);
  tree->order = NSVCD__TAKE_ROWS(uint32_t, triangles, base, &used);
  tree->corners = (float *)nsvcd__take(base, &used, triangles, 9 * sizeof(float));
  tree->component = NSVCD__TAKE_ROWS(uint32_t, mesh->vertex_count, base, &used);
  tree->weld = NSVCD__TAKE_ROWS(uint32_t, mesh->vertex_count, base, &used);
  tree->open = NSVCD__TAKE_ROWS(uint8_t, mesh->vertex_count, base, &used);
  return used;
}

NSVCDDEF size_t nsvcd_tree_size(const nsvcd_mesh *mesh) {
  nsvcd_tree counted;
  if (nsvcd__mesh_check(mesh)) return 0;
  const uint64_t size = nsvcd__tree_layout(mesh, NULL, &counted);
  return size > SIZE_MAX ? 0 : (size_t)size;
}

NSVCDDEF nsvcd_result nsvcd_tree_build(const nsvcd_mesh *mesh, void *memory, size_t size,
                                       const nsvcd_tree **tree) {
  nsvcd__node stack[NSVCD__TREE_STACK];
  nsvcd_tree counted;
  size_t height = 1;
  const nsvcd_result result = nsvcd__mesh_check(mesh);
  if (result) return result;
  if (!tree) return NSVCD_ERROR_ARGUMENT;
  const uint64_t needed = nsvcd__tree_layout(mesh, NULL, &counted);
  if (mesh->triangle_count > NSVCD__TREE_TRIANGLES || needed > SIZE_MAX)
    return NSVCD_ERROR_TOO_LARGE;
  if (!memory || size < needed || !nsvcd__is_aligned(memory)) return NSVCD_ERROR_WORKSPACE;
  nsvcd_tree *t = (nsvcd_tree *)memory;
  (void)nsvcd__tree_layout(mesh, (char *)memory, t);
  t->mesh = *mesh;
  t->digest =
      nsvcd__digest((uint32_t)mesh->vertex_count, mesh->positions, 3 * mesh->vertex_count);
  t->digest = nsvcd__digest(t->digest, mesh->indices, 3 * mesh->triangle_count);
  nsvcd__find_components(t, (uint32_t *)t->boxes);
  for (size_t i = 0; i < mesh->triangle_count; i++) t->order[i] = (uint32_t)i;
  stack[0].box = stack[0].first = 0;
  stack[0].count = (uint32_t)mesh->triangle_count;
  while (height > 0) {
    const nsvcd__node node = stack[--height];
    nsvcd__cut_node(t, &node);
    if (node.count == 1) continue;
    nsvcd__children(&node, &stack[height], &stack[height + 1]);
    height += 2;
  }
  for (size_t i = 0; i < 3 * mesh->triangle_count; i++) {
    const float *corner = nsvcd__tree_corner(t, t->order[i / 3], (uint32_t)(i % 3));
    memcpy(t->corners + 3 * i, corner, 3 * sizeof *corner);
  }
  *tree = t;
  return NSVCD_OK;
}
