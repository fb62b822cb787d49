// In: boxes, each with a number from 1 on. Out: a tree in which those that meet a box are found.
//
// A leaf's node has the number of its box. A box is put beside the one where the boxes above grow
// least (Catto, Dynamic bounding volume hierarchies, 2019), and on the way up from there a node
// takes over a child of its sibling's where that makes boxes smaller, so that the tree stays good
// in whatever order boxes come. A box in the tree is larger than what it is about, so that what
// moves a little stays where it is.
#pragma once
#include "boxes.h"

typedef struct nsvcd__branch {
  nsvcd__box box;
  // 0: the root has none. The next free node of those that are not used
  uint32_t parent;
  // 0: a leaf
  uint32_t child[2];
} nsvcd__branch;

typedef struct nsvcd__box_tree {
  // (2 most): from 1 to most leaves, and from most + 1 on the others
  nsvcd__branch *nodes;
  uint32_t most, root, unused;
} nsvcd__box_tree;

static void nsvcd__tree_begin(nsvcd__box_tree *tree, nsvcd__branch *nodes, uint32_t most) {
  tree->nodes = nodes;
  tree->most = most;
  tree->root = 0;
  tree->unused = most > 1 ? most + 1 : 0;
  for (uint32_t n = most + 1; n < 2 * most; n++)
    nodes[n].parent = n + 1 < 2 * most ? n + 1 : 0;
}

// The first node after n, and all below it, in the tree's order; 0: there is none.
static uint32_t nsvcd__tree_skip(const nsvcd__box_tree *tree, uint32_t n) {
  while (tree->nodes[n].parent) {
    const nsvcd__branch *parent = &tree->nodes[tree->nodes[n].parent];
    if (parent->child[0] == n) return parent->child[1];
    n = tree->nodes[n].parent;
  }
  return 0;
}

// The next leaf, after leaf `at` or, if that is 0, the first, whose box meets another one; 0: there
// is none. The tree may not change in between.
static uint32_t nsvcd__tree_next(const nsvcd__box_tree *tree, uint32_t at,
                                 const nsvcd__box *box) {
  uint32_t n = at ? nsvcd__tree_skip(tree, at) : tree->root;
  while (n) {
    const nsvcd__branch *node = &tree->nodes[n];
    const int meets = nsvcd__boxes_meet(&node->box, box);
    if (meets && !node->child[0]) return n;
    n = meets ? node->child[0] : nsvcd__tree_skip(tree, n);
  }
  return 0;
}

// Half the area of a box.
static float nsvcd__box_area(nsvcd__box box) {
  const nsvcd__f3 size = nsvcd__f3_sub(box.high, box.low);
  return size.x * (size.y + size.z) + size.y * size.z;
}

static void nsvcd__tree_hang(nsvcd__box_tree *tree, uint32_t parent, int side, uint32_t n) {
  tree->nodes[n].parent = parent;
  if (parent) tree->nodes[parent].child[side] = n;
  if (!parent) tree->root = n;
}

static nsvcd__box nsvcd__box_of_children(const nsvcd__box_tree *tree,
                                         const nsvcd__branch *node) {
  return nsvcd__box_over(tree->nodes[node->child[0]].box, tree->nodes[node->child[1]].box);
}

// Exchanges a child of node n's with a child of the other one's, if the box of that gets smaller.
static void nsvcd__tree_rotate(nsvcd__box_tree *tree, uint32_t n) {
  nsvcd__branch *node = &tree->nodes[n];
  float most = 0;
  int best = 0;
  for (int k = 0; k < 4;
       k++) {  // child k / 2 goes below the other, in place of its child k % 2
    const nsvcd__branch *other = &tree->nodes[node->child[1 - k / 2]];
    if (!other->child[0]) continue;
    const nsvcd__box stays = tree->nodes[other->child[1 - k % 2]].box;
    const nsvcd__box comes = tree->nodes[node->child[k / 2]].box;
    const nsvcd__box box = nsvcd__box_over(stays, comes);
    const float gained = nsvcd__box_area(other->box) - nsvcd__box_area(box);
    if (gained > most) best = k;
    most = fmaxf(most, gained);
  }
  if (!(most > 0)) return;
  const uint32_t low = node->child[best / 2];
  const uint32_t other = node->child[1 - best / 2];
  const uint32_t high = tree->nodes[other].child[best % 2];
  nsvcd__tree_hang(tree, other, best % 2, low);
  nsvcd__tree_hang(tree, n, best / 2, high);
  tree->nodes[other].box = nsvcd__box_of_children(tree, &tree->nodes[other]);
}

// Makes the boxes from node n up to the root what they are to be.
static void nsvcd__tree_refit(nsvcd__box_tree *tree, uint32_t n) {
  for (; n; n = tree->nodes[n].parent) {
    nsvcd__tree_rotate(tree, n);
    tree->nodes[n].box = nsvcd__box_of_children(tree, &tree->nodes[n]);
  }
}

static void nsvcd__tree_insert(nsvcd__box_tree *tree, uint32_t leaf, nsvcd__box box) {
  nsvcd__branch *nodes = tree->nodes;
  uint32_t beside = tree->root;
  nodes[leaf].box = box;
  nodes[leaf].child[0] = nodes[leaf].child[1] = 0;
  if (!tree->root) {
    nsvcd__tree_hang(tree, 0, 0, leaf);
    return;
  }
  // Down, as long as a new node above a child costs less than one here.
  while (nodes[beside].child[0]) {
    float costs[2];
    const float here = nsvcd__box_area(nsvcd__box_over(nodes[beside].box, box));
    const float grows = here - nsvcd__box_area(nodes[beside].box);
    for (int k = 0; k < 2; k++) {
      const nsvcd__branch *child = &nodes[nodes[beside].child[k]];
      costs[k] = grows + nsvcd__box_area(nsvcd__box_over(child->box, box));
      if (child->child[0]) costs[k] -= nsvcd__box_area(child->box);
    }
    if (here < costs[0] && here < costs[1]) break;
    beside = nodes[beside].child[costs[1] < costs[0]];
  }
  const uint32_t above = tree->unused;
  const uint32_t parent = nodes[beside].parent;
  tree->unused = nodes[above].parent;
  nsvcd__tree_hang(tree, parent, parent && nodes[parent].child[1] == beside, above);
  nsvcd__tree_hang(tree, above, 0, beside);
  nsvcd__tree_hang(tree, above, 1, leaf);
  nsvcd__tree_refit(tree, above);
}

static void nsvcd__tree_remove(nsvcd__box_tree *tree, uint32_t leaf) {
  nsvcd__branch *nodes = tree->nodes;
  const uint32_t above = nodes[leaf].parent;
  if (!above) {
    tree->root = 0;
    return;
  }
  const uint32_t parent = nodes[above].parent;
  const uint32_t sibling = nodes[above].child[nodes[above].child[0] == leaf];
  nsvcd__tree_hang(tree, parent, parent && nodes[parent].child[1] == above, sibling);
  nodes[above].parent = tree->unused;
  tree->unused = above;
  nsvcd__tree_refit(tree, parent);
}
