// certify.h - what tests hear of: every plane that is tried, and what it parts (replay.c).
// A side is a node or a leaf, and which of its children or triangles; 0: those of the lane.
//   LOOP_AXIS        lanes `from` on have been parted by a gap (above 0) by now; n: the plane tried
//   LOOP_CERTIFY     lanes of `parted` are parted over a span, each by the first plane that did it;
//                    forgets all planes
//   LOOP_CERTIFY_BEST   the same of one couple, where lanes were planes
//   LOOP_CERTIFY_PLANE  a plane by itself
//   LOOP_CERTIFY_ARCS   lanes were arcs of a span, of which those in `met` are not parted
#ifndef LOOP_CERTIFY_H
#define LOOP_CERTIFY_H

#ifndef LOOP_AXIS
#define LOOP_AXIS(from, gap, n) ((void)0)
#define LOOP_CERTIFY(p, s, parted, a, in_a, b, in_b) ((void)0)
#define LOOP_CERTIFY_BEST(p, s, a, l_a, b, l_b, parted) ((void)0)
#define LOOP_CERTIFY_PLANE(p, s, a, in_a, b, in_b, n) ((void)0)
#define LOOP_CERTIFY_ARCS(p, s, met, place_a, place_b) ((void)0)
#endif

#endif
