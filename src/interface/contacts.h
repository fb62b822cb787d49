// In: two movers at rest. Out: where they are near each other.
#pragma once
#include "queries.h"

// the most sides on which nsvcd_contacts finds contacts, up to NSVCD_MAX_CONTACTS on each
#define NSVCD_MAX_SIDES 6

// Where are two bodies at rest near each other, on all sides? For a game or a simulation: what a
// body stands on, what it leans on and what is above it. A side is a direction. Two sides differ by
// more than 37 degrees (a cosine below 0.8), and each has the points that span the largest area.
//   question    not NULL: two bodies with one pose each, or none; `ask` is HIT. Its `clearance`, in
//               metres, is more than 0 and says how near counts
//   workspace   (workspace_size) bytes, nsvcd_sweep_workspace_size(question) or more, not NULL,
//               aligned to NSVCD_ALIGNMENT
//   contacts    (most) the nearest side first. Normals are from b to a, a gap is that at the point,
//               times are 0; the rest is as in a manifold. NULL if `most` is 0
//   most        room for so many contacts; NSVCD_MAX_SIDES * NSVCD_MAX_CONTACTS are enough. Less
//               has those of the nearest sides
//   count       number of contacts, not NULL; 0: nothing is so near
//   is_partial  1: contacts may be missing, since question.work ended, or since more triangle pairs
//               are near than there is room for: 12 for each segment of question.segments but two.
//               Of these the nearest were kept. May be NULL
//   allocates   nothing
//   threads     each needs a workspace of its own; bodies may be shared
//   errors      ARGUMENT, those of nsvcd_sweep, and POSES if a body has more than one pose; ASK,
//               SLOP if there is one, CLEARANCE if it is 0; TRIANGLES if a body has none
//   source      this library
//
// Contacts are computed, not proven. What has to be a fact is for nsvcd_sweep to say. They are of
// the surfaces alone: a body that is inside the other, and far from its surface, has none. Where
// triangles meet, the gap is 0, and the normal is that of one of their faces.
//
// On each side one contact is as near as the bodies come there. The others are where a corner is
// over a face, or where two edges cross. Edges within a flat floor make no sides of their own: a
// contact is only where both surfaces lead away from each other.
NSVCDDEF nsvcd_result nsvcd_contacts(const nsvcd_question *question, void *workspace,
                                     size_t workspace_size, nsvcd_contact *contacts,
                                     size_t most, size_t *count, int *is_partial);
