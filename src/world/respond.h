// In: a body's speed and the contacts that it has. Out: its speed without what points into them.
//
// Sequential impulses (Catto, Iterative dynamics with temporal coherence, 2006), of one body
// against others that rest or are driven: round after round each contact takes the impulse that its
// own speed asks for, in sum never a pull, and friction up to its share of that. For a body that
// does not turn and has no friction the limit is the speed nearest to the given one that points
// into no contact.
//   A contact that is farther than where the body comes to rest may be approached, as fast as leads
// there in this frame; one that is nearer is left, by a fifth of what is missing in a frame.
#pragma once
#include "ask.h"

// rounds, at most; and the change of an impulse, as a fraction of the greatest, that ends them
#define NSVCD__IMPULSE_ROUNDS 100
#define NSVCD__IMPULSE_SAME 1e-4
// metres a second: what comes slower does not bounce
#define NSVCD__BOUNCES 0.5
#define NSVCD__LEAVES 0.2
#define NSVCD__SOFT 0.2

// A contact as the response sees it.
typedef struct nsvcd__hold {
  // from the body's pivot to its point there; the normal, away from the other body
  nsvcd__d3 arm, normal;
  // the other body's speed there
  nsvcd__d3 speed;
  // metres: how much nearer it is than half a margin beyond the clearance; below 0: farther
  double lacks;
  // metres a second, along the normal: at least; and how fast the body came against it
  double least, into;
  // what a unit impulse along the normal changes: the speed there, and the spin
  double give;
  nsvcd__d3 turn;
  // so far: along the normal, and across it
  double pushed;
  nsvcd__d3 rubbed;
} nsvcd__hold;

// The body that is moved: its speed, and what an impulse changes.
typedef struct nsvcd__thing {
  nsvcd__d3 linear, angular;
  double inverse_mass;
  // about its axes; and where these are
  nsvcd__d3 inverse_inertia;
  nsvcd__dmat3 axes;
  double friction;
} nsvcd__thing;

static nsvcd__d3 nsvcd__spun_by(const nsvcd__thing *thing, nsvcd__d3 moment) {
  nsvcd__d3 own = nsvcd__dmat3_apply_transpose(&thing->axes, moment);
  own.x *= thing->inverse_inertia.x;
  own.y *= thing->inverse_inertia.y;
  own.z *= thing->inverse_inertia.z;
  return nsvcd__dmat3_apply(&thing->axes, own);
}

static nsvcd__d3 nsvcd__speed_at(const nsvcd__thing *thing, nsvcd__d3 arm) {
  return nsvcd__d3_add(thing->linear, nsvcd__d3_cross(thing->angular, arm));
}

// The change of speed at an arm, along a direction, by a unit impulse there; *turn: of its spin.
static double nsvcd__give_of(const nsvcd__thing *thing, nsvcd__d3 arm, nsvcd__d3 along,
                             nsvcd__d3 *turn) {
  const nsvcd__d3 moment = nsvcd__d3_cross(arm, along);
  *turn = nsvcd__spun_by(thing, moment);
  return thing->inverse_mass + nsvcd__d3_dot(moment, *turn);
}

static void nsvcd__push(nsvcd__thing *thing, const nsvcd__hold *hold, double impulse) {
  thing->linear = nsvcd__d3_fma(impulse * thing->inverse_mass, hold->normal, thing->linear);
  thing->angular = nsvcd__d3_fma(impulse, hold->turn, thing->angular);
}

// soft: a fraction of what the contact gives way by to a unit impulse, by which it gives way
// besides. Returns by how much the impulse along the normal has changed.
static double nsvcd__respond_at(nsvcd__thing *thing, nsvcd__hold *hold, double soft) {
  const nsvcd__d3 speed = nsvcd__d3_sub(nsvcd__speed_at(thing, hold->arm), hold->speed);
  const double along = nsvcd__d3_dot(speed, hold->normal);
  const double before = hold->pushed;
  const double lacks = hold->least - along - soft * hold->give * before;
  hold->pushed = nsvcd__max(before + lacks / (hold->give + soft * hold->give), 0);
  const double more = hold->pushed - before;
  nsvcd__push(thing, hold, more);
  if (!(thing->friction > 0) || !(before + hold->pushed > 0)) return fabs(more);
  const nsvcd__d3 now = nsvcd__d3_sub(nsvcd__speed_at(thing, hold->arm), hold->speed);
  const nsvcd__d3 aside = nsvcd__d3_fma(-nsvcd__d3_dot(now, hold->normal), hold->normal, now);
  const double slip = nsvcd__d3_norm(aside);
  if (!(slip > 1e-12)) return fabs(more);
  nsvcd__d3 turn;
  const nsvcd__d3 u = nsvcd__d3_scale(aside, 1 / slip);
  const double across = nsvcd__give_of(thing, hold->arm, u, &turn);
  const double most = thing->friction * hold->pushed;
  nsvcd__d3 rubbed = nsvcd__d3_fma(-slip / across, u, hold->rubbed);
  const double length = nsvcd__d3_norm(rubbed);
  if (length > most) rubbed = nsvcd__d3_scale(rubbed, most / length);
  const nsvcd__d3 rubs = nsvcd__d3_sub(rubbed, hold->rubbed);
  thing->linear = nsvcd__d3_fma(thing->inverse_mass, rubs, thing->linear);
  thing->angular =
      nsvcd__d3_add(thing->angular, nsvcd__spun_by(thing, nsvcd__d3_cross(hold->arm, rubs)));
  hold->rubbed = rubbed;
  return fabs(more);
}

static void nsvcd__respond(nsvcd__thing *thing, nsvcd__hold *holds, size_t count,
                           double soft) {
  double most = 0;
  double change = 1;
  for (size_t k = 0; k < count; k++)
    holds[k].give = nsvcd__give_of(thing, holds[k].arm, holds[k].normal, &holds[k].turn);
  for (int round = 0; round < NSVCD__IMPULSE_ROUNDS && change > NSVCD__IMPULSE_SAME * most;
       round++) {
    change = 0;
    for (size_t k = 0; k < count; k++) {
      change = nsvcd__max(change, nsvcd__respond_at(thing, &holds[k], soft));
      most = nsvcd__max(most, holds[k].pushed);
    }
  }
}

// Joules.
static double nsvcd__energy_of(const nsvcd__thing *thing) {
  const nsvcd__d3 own = nsvcd__dmat3_apply_transpose(&thing->axes, thing->angular);
  const nsvcd__d3 inverse = thing->inverse_inertia;
  double twice = nsvcd__d3_dot(thing->linear, thing->linear) / thing->inverse_mass;
  for (size_t k = 0; k < 3; k++) {
    const double spin = nsvcd__d3_axis(own, k);
    if (nsvcd__d3_axis(inverse, k) > 0) twice += spin * spin / nsvcd__d3_axis(inverse, k);
  }
  return 0.5 * twice;
}

// How fast a body is to go so that it is half a margin off everything: a share of what each contact
// lacks, in a frame. That is no speed that it has, and it does not turn. Contacts are soft: so
// between two walls that are too close for that it goes half way.
static nsvcd__d3 nsvcd__leaving(const nsvcd__hold *holds, size_t count, double seconds) {
  nsvcd__thing out;
  nsvcd__hold left[NSVCD_WORLD_CONTACTS];
  memset(&out, 0, sizeof out);
  out.inverse_mass = 1;
  for (size_t k = 0; k < count; k++) {
    left[k] = holds[k];
    left[k].speed = nsvcd__d3_of(0, 0, 0);
    left[k].least = NSVCD__LEAVES * nsvcd__max(holds[k].lacks, 0) / seconds;
  }
  nsvcd__respond(&out, left, count, NSVCD__SOFT);
  return out.linear;
}
