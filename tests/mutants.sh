#!/bin/sh
# Are the tests of the proof worth anything? Each mutant is the library with one mistake in it; tests/test_proof.c has to
# fail on it, or, where its name begins with `level:`, `asks:`, `long:`, `exact:`, `floor:`, `solids:`, `round:`,
# `robot:`, `looks:`, `shapes:`, `contacts:`, `world:`, `slide:`, `step:`, `route_looks:`, `many_joints:`, `postures:`, `reach:`, `ranges:`, `allowances:`, `mimics:`, `merge:` or `cones:`, tests/test_level.c and so on; of `verify:` and `checker:` the mistake is in the checker of
# certificates, examples/verify, and tests/test_certificate.c or tests/test_checker.c has to fail, of `fits:`
# tests/test_fits.c, of `plans:` tests/forge.py, which needs build/svcd. Prints a line for each, and exits with 1 if one survives. An argument runs only the mutants whose
# name contains it. Some 20 seconds each; PART=0 OF=16 WORK=folder: every 16th of them, in a folder of its own.
# DRY=1 only sees to it that each can still be made.
set -u
CC=${CC:-cc}
cd "$(dirname "$0")/.." || exit 1
work=${WORK:-build/mutants}
mkdir -p $work/tests/bench $work/examples/scenery $work/examples/verify
cp weights.h $work/
cp tests/test_proof.c tests/test_level.c tests/test_asks.c tests/test_long.c tests/test_exact.c tests/test_floor.c tests/test_solids.c tests/test_round.c tests/test_robot.c tests/test_looks.c tests/test_shapes.c tests/test_contacts.c tests/test_world.c tests/test_slide.c tests/test_step.c tests/test_route_looks.c tests/test_many_joints.c tests/test_postures.c tests/test_reach.c tests/test_ranges.c tests/test_allowances.c tests/test_mimics.c tests/test_merge.c tests/test_cones.c tests/test_certificate.c tests/test_checker.c tests/test_claims.c tests/test_fits.c tests/*.h $work/tests/
cp tests/bench/*.h $work/tests/bench/
cp examples/scenery/*.h $work/examples/scenery/
cp examples/verify/verify.c $work/examples/verify/

# name | text (occurs once, however its lines are broken) | what it becomes. Not here: axis_turn left out of bend_along_axis. The theorem needs it, but no
# motion was found that uses it: what strays most does so at samples, and there axis_bulge is exact.
cat >$work/list <<'LIST'
none|||
hull without deviation|margin * length + nsvcd__deviation_of(over, normal, arm)|margin * length
hull without slack|const float margin = margins + over->rounding + nsvcd__clearance(&p->goal);|const float margin = 0 * margins + over->rounding + nsvcd__clearance(&p->goal);
hull without the slack's scale|p->arcs.motion->scale * f->margins[i] + g->margins[j];|0.1f * f->margins[i] + g->margins[j];
hull without clearance|margins + over->rounding + nsvcd__clearance(&p->goal);|margins + over->rounding;
hull at the start only|const nsvcd__v at_either = nsvcd__v_min(at_start, at_end);|const nsvcd__v at_either = at_start;
deviation without drift|return origin_bend + turn + across|return 0 * origin_bend + turn + across
deviation without bulge|+ across * nsvcd__bend_of(over, arm);|;
deviation along the axis|return origin_bend + turn + across|return origin_bend + across
half the distance from the axis|over->bend * arm.from_axis +|0.5f * over->bend * arm.from_axis +
an axis that does not waver|arm.from_axis + over->bend_along_axis * arm.from_origin|arm.from_axis
the axis of the other body|arc->own_axis = nsvcd__dmat3_apply_transpose(\&moving, axis);|arc->own_axis = arc->axis;
pair at half the distance from the axis|arc->bend * pair->from_axis * off_axis|arc->bend * 0.5 * pair->from_axis * off_axis
pair whose axis does not waver|pair->from_axis += (arc->waver + 1e-6) * pair->from_origin;|
pair beside an axis that does not waver|across + arc->waver + 1e-6|across + 1e-6
chords off the axis|nsvcd__v_bend(scale, most->arc_along_axis + l, most->along_axis + l);|nsvcd__v_mul(scale, nsvcd__v_load(most->arc_along_axis + l));
lanes without bulge|return nsvcd__v_fma(turn, nsvcd__v_set(from_origin), nsvcd__v_min(by_axis, by_heading));|return nsvcd__v_fma(turn, nsvcd__v_set(0 * from_origin), nsvcd__v_min(by_axis, by_heading));
lanes without drift|return nsvcd__v_fma(turn, nsvcd__v_set(from_origin), nsvcd__v_min(by_axis, by_heading));|return nsvcd__v_mul(turn, nsvcd__v_set(from_origin));
disc without across|nsvcd__v_mul(slab->across, across);|nsvcd__v_mul(nsvcd__v_set(0), across);
group of eight|for (size_t i = first; i < first + NSVCD__GROUP \&\& i < f->body->patches; i++) {\n    if (slab.high|for (size_t i = first; i < first + 8 \&\& i < f->body->patches; i++) {\n    if (slab.high
group's disc at the start only|nsvcd__v3_add(a.at_start, nsvcd__vmat3_apply_transpose(turn, n));|a.at_start;
held plane without deviation|lowest - margin - nsvcd__deviation_of(over, n, nsvcd__patch_arm(f, i, over));|lowest - margin;
groups' spheres without slack|nsvcd__above((double)f->margins[i] + rounding);|nsvcd__above(rounding);
groups' spheres over the first half|for (size_t k = 0; k < count + !count; k++) {|for (size_t k = 0; k < (count + 1) / 2 + !count; k++) {
held plane without slack|g->margins[j] * length + highest;|highest;
heights over another plane|above->plane != memo->plane \|\| above->key != key|above->key != key
pair of coarse copies as if they were the meshes|pair.rounding + nsvcd__off_meshes(p) + moved;|pair.rounding + moved;
level: slabs on the way without slack|a->fixed_off = nsvcd__v_off(a, a->fixed.normal);|a->fixed_off = nsvcd__v_set(0);
slabs on the way at the start only|if (!a->may_bend) return nsvcd__v_separate(a, a->fixed.normal, start, start|if (1) return nsvcd__v_separate(a, a->fixed.normal, start, start
what turns does not bend|return over->bend > 0 \|\| over->origin_bend > 0;|return over->origin_bend > 0;
rotations that stay|return arc->turn > 0 \|\| arc->fixed_moves;|return arc->fixed_moves;
level: what is ahead is met when it is nearest|nsvcd__v_sub(nearest, nsvcd__v_mul(sum, per_length))|nearest
level: the first chunk of spheres alone|first < slots; first += NSVCD__GROUP) {\n    size_t level = top;|first < NSVCD__GROUP; first += NSVCD__GROUP) {\n    size_t level = top;
small meshes enclose nothing|outer->open \|\| outer->triangles < 2|outer->open \|\| outer->triangles < 13
round: tangents from the other side|const double fall = -nsvcd__d3_dot(p->separating, moved);|const double fall = nsvcd__d3_dot(p->separating, moved);
round: tangents a little too far|const double until = fall > 0 ? nsvcd__min(end, at + room / fall) : end;|const double until = fall > 0 ? nsvcd__min(end, at + above / fall) : end;
doubts forgotten|    nsvcd__keep_unresolved(p, pair, u0, u1);\n    return NSVCD__DONE;|    return NSVCD__DONE;
round: edges without length by another pose|if (w->blocks.over \&\& !(nsvcd__f3_dot(edge, edge) > 0))|if (!(nsvcd__f3_dot(edge, edge) > 0))
a block of the question before|p->push.too_deep = w->blocks.has_block = 0;|p->push.too_deep = 0;
round: segments as points|nsvcd__d3_distance2(t[0], t[1]) > 0 ? 2 : 1;|nsvcd__d3_distance2(t[0], t[1]) > 0 ? 1 : 1;
pivot without its bend|nsvcd__v_set(nsvcd__pivot_arm(m, &m->moving));|nsvcd__v_set(0 * nsvcd__pivot_arm(m, &m->moving));
pivot of an arc without its bend|arc->origin_bend += 0.1250001 * arm|arc->origin_bend += 0 * arm
pivots not among the lengths|given->lengths += nsvcd__pivot_arms(&task->motion);|given->lengths += 0 * nsvcd__pivot_arms(&task->motion);
pair without bulge|return turn + arc->twist * pair->from_origin + arc->origin_bend;|return arc->origin_bend;
pair without drift|return turn + arc->twist * pair->from_origin + arc->origin_bend;|return turn + arc->twist * pair->from_origin;
doubt goes on|p->goal.limit = p->work + left;|p->goal.limit = p->goal.limit;
doubt raises the limit|p->work + left < p->goal.limit|p->work > 0
pair without clearance|return lowest - highest > p->goal.clearance + pair->margin + deviation;|return lowest - highest > pair->margin + deviation;
pair at the start only|lowest = nsvcd__min(lowest, nsvcd__d3_dot(normal, at_end));|(void)at_end;
block without quanta|nsvcd__errors_of(p, i, j) + (over->rounding + over->origin_bend) + nsvcd__clearance(&p->goal);|(over->rounding + over->origin_bend) + nsvcd__clearance(&p->goal);
block without clearance|(over->rounding + over->origin_bend) + nsvcd__clearance(&p->goal);|(over->rounding + over->origin_bend);
block without bulge|stays + nsvcd__bend_of(over, arm)|stays
block at the start only|for (size_t k = 0; k < b->corner_count; k++) {\n    const nsvcd__v3 a =|for (size_t k = 0; k < 3; k++) {\n    const nsvcd__v3 a =
lanes parted at the start only|for (size_t k = 0; k < w->blocks.corner_count; k++) {\n      const nsvcd__v3 corner = nsvcd__v3_load(w->blocks.corners[k], s);|for (size_t k = 0; k < 3; k++) {\n      const nsvcd__v3 corner = nsvcd__v3_load(w->blocks.corners[k], s);
lanes parted without the clearance|nsvcd__v_set(margin * nsvcd__f3_norm(last) + highest);|nsvcd__v_set(highest);
rows parted by half the margin|met = nsvcd__left_by_normal(w, l, fixed, k, margin, met);|met = nsvcd__left_by_normal(w, l, fixed, k, k > 0 ? margin : 0.5f * margin, met);
parting plane without deviation|errors + over->rounding + nsvcd__clearance(&p->goal) + nsvcd__deviation_of(over, last, arm);|errors + over->rounding + nsvcd__clearance(&p->goal);
parting plane without quanta|errors + over->rounding + nsvcd__clearance(&p->goal) + nsvcd__deviation_of(over, last, arm);|0 * errors + over->rounding + nsvcd__clearance(&p->goal) + nsvcd__deviation_of(over, last, arm);
pose of another arc|known->arc == arc->first \&\& known->ticks == arc->ticks \&\& known->u == u|known->ticks == arc->ticks \&\& known->u == u
first half only|if (part == NSVCD__TOO_LONG) ends[left++] = 0.5 * (u + end);|if (part == NSVCD__TOO_LONG) ends[left - 1] = 0.5 * (u + end);
a window forgotten|b += NSVCD__WINDOW * NSVCD__LANES) {\n    nsvcd__window_load(\&w->blocks, \&p->fixed, j, b);\n    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {\n      nsvcd__moving_block_load(\&w->blocks, \&p->moving, i, a);\n      const|b += 2 * NSVCD__WINDOW * NSVCD__LANES) {\n    nsvcd__window_load(\&w->blocks, \&p->fixed, j, b);\n    for (size_t a = p->moving.first_triangle[i]; a < moving_end; a += NSVCD__LANES) {\n      nsvcd__moving_block_load(\&w->blocks, \&p->moving, i, a);\n      const
bounds of half a window's block|b->bounds[b->window++] = nsvcd__block_bounds(block);|nsvcd__box half = nsvcd__block_bounds(block);\n    half.low = nsvcd__f3_scale(nsvcd__f3_add(half.low, half.high), 0.5f);\n    b->bounds[b->window++] = half;
half of the box|nsvcd__f3_add(nsvcd__f3_load(e->outer->box + 3), margin);|nsvcd__f3_scale(nsvcd__f3_add(nsvcd__f3_load(e->outer->box + 3), nsvcd__f3_load(e->outer->box)), 0.5f);
rays without rounding|const float rounding = NSVCD__ROUNDING * extent * f->body->extent;|const float rounding = 0 * NSVCD__ROUNDING * extent * f->body->extent;
rays past half the groups|while (!sum.unclear \&\& nsvcd__traversal_next(\&groups, \&g)) {|while (!sum.unclear \&\& nsvcd__traversal_next(\&groups, \&g)) {\n    if (g % 2) continue;
block's boxes at the start only|low = nsvcd__v3_min(low, corner);\n      high = nsvcd__v3_max(high, corner);|if (k >= 3) continue;\n      low = nsvcd__v3_min(low, corner);\n      high = nsvcd__v3_max(high, corner);
last triangle skipped|size_t patience) {\n  nsvcd__proof *p = \&w->p;\n  const size_t moving_end = p->moving.first_triangle[i + 1];|size_t patience) {\n  nsvcd__proof *p = \&w->p;\n  const size_t moving_end = p->moving.first_triangle[i + 1] - 1;
containment one way|if (outer->open \|\| outer->triangles < 2) return 0;|if (outer->open + (e->inner != \&w->p.moving)) return 0;
long: an interval passed over|if (is_resolved) m->from = until;|if (is_resolved) m->from = until;\n  if (is_resolved \&\& arcs == 1 \&\& until < m->ticks) m->from = nsvcd__next_keyframe(m, until);
long: a try in vain is believed|is_resolved \|\| !is_try, p->work - before|1, p->work - before
long: gaps by the first pose|part.count = nsvcd__pose_before(track, until - 1) + 2 - first;|part.count = 1;
long: doubts of one interval forgotten|return is_open ? open : result;|return result;
long: distance of the last interval|if (is_resolved) low = nsvcd__min(low, bracket->low);|low = bracket->low;
long: ends not looked at|at_end < 2 \&\& !(fraction > 0)|0
long: contacts of a try are the first|result.has_contact \&\& !(is_try \&\& fraction > 0);|result.has_contact;
long: poses for work|given->grows = q->work == 0;|given->grows = 1;
long: an interval settled from the start|p->known.proven_until = (double)motion->from;|p->known.proven_until = 0;
first arc only|at < last \&\& (double)at < p->known.end;) {|at < last \&\& at == q->begin[patches->segment];) {
a segment dropped|uint32_t met = nsvcd__group_against_members(q, h, wanted, w->met_in);|uint32_t met = nsvcd__group_against_members(q, h, wanted, w->met_in);\n      for (size_t l = 0; l < NSVCD__GROUP; l++) {\n        if (w->met_in[l] \& (w->met_in[l] - 1)) w->met_in[l] \&= w->met_in[l] - 1;\n      }
a full buffer forgotten|if (!*left) break;|break;
passing not seen|if (!nsvcd__pair_passes(\&p->arcs, pair, u0, u1))|if (u0 <= u1)
passing without a change of sides|  const int falls = before > least_before \&\& after < -least_after;|  const int falls = before != 0;
both turn, twist forgotten|nsvcd__v_mul(turn, nsvcd__v_add(turn, fixed_turn));|nsvcd__v_mul(turn, turn);
both turn, half of the way|nsvcd__v_fma(fixed_turn, extent, nsvcd__v_add(travel, travel))|nsvcd__v_fma(fixed_turn, extent, travel)
both turn, no swing|nsvcd__v_fma(fixed_turn, extent, nsvcd__v_add(travel, travel))|nsvcd__v_add(travel, travel)
arcs of both, twist forgotten|arc->scale * twist;|arc->scale * 0 * twist;
arcs of both, no swing|(2 * across + angle * swing);|(2 * across);
arcs of both, half of the way|(2 * across + angle * swing);|(across + angle * swing);
a leg from its pose|out.from = (double)(first - begin) * per_tick;|out.from = 0;
knots of one body only|return after_a < after_b ? after_a : after_b;|return after_a;
group without scale|  sphere.radius *= q->scale;\n|
members without scale|nsvcd__v_fma(scale, radius, deviation));|nsvcd__v_add(radius, deviation));
discs without scale|nsvcd__v_mul(a->scale, nsvcd__v3_dot(w, w)); const nsvcd__v across = nsvcd__v_mul(a->scale, nsvcd__v3_norm(a->turned));|nsvcd__v3_dot(w, w);\n  const nsvcd__v across = nsvcd__v3_norm(a->turned);
disc without clearance|a.clearance = nsvcd__clearance(&p->goal);\n  a.radius = q->extent;|a.clearance = 0;\n  a.radius = q->extent;
moving disc without clearance|nsvcd__v_plus(a->over.rounding, a->clearance);|a->over.rounding;
groups without clearance|a.clearance = nsvcd__clearance(&p->goal); a.radius = nsvcd__group_extent|a.clearance = 0; a.radius = nsvcd__group_extent
held plane without clearance|below->height + nsvcd__clearance(&p->goal) * length|below->height
held plane not tried again|return above->height > below->height + nsvcd__clearance(&p->goal) * length;|return 1;
span of before it was clipped|w->memo.intervals \&= ~((uint64_t)1 << s);|
search without clearance|block->margin[l] += clearance;|block->margin[l] += 0 * clearance;
clipped without twice the bulge|    block->bend[l] *= 2;\n    block->origin_bend[l] *= 2;\n|    block->bend[l] *= 0.1f;\n
clipped too early|(double)q->begin[segment] < p->known.end;|(double)q->begin[segment] < 0.9 * p->known.end;
every other segment|s += few) {|s += 2 * few) {
contacts end too much|p->known.end = p->known.found.tick - p->goal.first;|p->known.end = 0.9 * p->known.found.tick - p->goal.first;
a start that is not asked|nsvcd__clear_until(w, \&result) <= 0 \&\& result.found.tick > 0|result.found.tick < 0
a doubt taken for free|nsvcd__min(nsvcd__min(r->end, r->unresolved), r->ran_out|nsvcd__min(r->end, r->ran_out
half the first distance|const double apart = 1.0001 * nsvcd__vertex_distance(|const double apart = 0.5 * nsvcd__vertex_distance(
distance without tolerance|p->goal.clearance = nsvcd__max(p->goal.low, p->goal.high - p->goal.measure);|p->goal.clearance = nsvcd__max(p->goal.low, p->goal.high * 1.01);
exact poses not lifted|arc->added = nsvcd__d3_add(fixed_pivot, nsvcd__d3_widen(m->push_out));|arc->added = nsvcd__d3_add(fixed_pivot, nsvcd__d3_scale(nsvcd__d3_widen(m->push_out), 0));
lift the wrong way|if (lacks > 0)\n        push_out = nsvcd__d3_add(|if (lacks > 0)\n        push_out = nsvcd__d3_sub(
a window of another patch|b->window > 0 \&\& b->fixed[0].first == first|b->window > 0
tile: every other group|nsvcd__traversal_next(traversal, \&g)) {\n    const nsvcd__sphere group|nsvcd__traversal_next(traversal, \&g) \&\& nsvcd__traversal_next(traversal, \&g)) {\n    const nsvcd__sphere group
tile: the first only|outcome == NSVCD__DONE \&\& nsvcd__search_next_tile(q));|0);
tile: skins of the first only|nsvcd__collects_on(p) \&\& p->work <= p->goal.limit;|nsvcd__collects_on(p) \&\& p->work < 0;
tile: way without reach|nsvcd__f3_sub(nsvcd__f3_min(start, end), around);\n    const nsvcd__f3 high|nsvcd__f3_min(start, end);\n    const nsvcd__f3 high
tile: approached in the first segment|wanted \&\& nearby \& ~met; wanted \&= wanted - 1) {|wanted \&\& nearby \& ~met; wanted = 0) {
level: near groups as dipoles|#define NSVCD__DIPOLE 3.0f|#define NSVCD__DIPOLE 0.8f
level: sums that do not scale|i < 3 * nsvcd__area_slots(b->padded); i++) {|i < 3 * (size_t)b->padded; i++) {
level: nearest patches about the middle only|nsvcd__v_fma(r, nsvcd__v_set(NSVCD__AMPLE), radius)|nsvcd__v_mul(r, nsvcd__v_set(NSVCD__AMPLE))
level: latents of one region|out->latents[NSVCD__LATENT * to + k]|out->latents[NSVCD__LATENT * i + k]
level: members of one dipole in two|const size_t member = NSVCD__GROUP * (first + nsvcd__low_bit(close));|const size_t member = NSVCD__GROUP * (first + (nsvcd__low_bit(close) \& ~(size_t)1));
margin of small normals|nsvcd__v_pick(square, nsvcd__v_set(1e-30f), nsvcd__v_set(1e30f), limit)|limit
round: the fixed one is not|given->radius = moving_radius + (double)w->p.fixed.counts->convex_radius;|given->radius = moving_radius;
round: without the scale|(double)w->p.moving.counts->convex_radius * task->motion.ratio;|(double)w->p.moving.counts->convex_radius;
round: distances of the skeletons|(float)(fmax(high - radius, 0)|(float)(fmax(high, 0)
round: as near as the skeletons|(float)(fmax(low - radius, 0)|(float)(fmax(low, 0)
round: points on the skeleton|fmin((double)p->fixed.counts->convex_radius, found->distance);|0;
round: gaps of the skeletons|(float)(fmax(found->distance - p->given.radius, 0) * unit);|(float)(found->distance * unit);
round: a point on either|    c->point[k] += gap * c->normal[k];|
round: a run short of its last|for (size_t k = 0; k < count; k++) {\n    if (k == end)|for (size_t k = 0; k + 1 < count; k++) {\n    if (k == end)
round: not scaled|*radius *= (float)by->most;|
round: a segment has a normal|return are_one ? nsvcd__d3_of(0, 0, 0) : nsvcd__d3_cross(u, v);|return nsvcd__d3_cross(u, v);
two patches by a plane of any triangle|if (height > highest) top = b;|if (height > highest) top = fixed_first;
two patches, but the last triangle|for (size_t a = moving_first; a < moving_end; a++) { const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, top);|for (size_t a = moving_first; a + 1 < moving_end; a++) { const nsvcd__triangle_pair pair = nsvcd__pair_of(p, i, j, a, top);
asks: a contact before the start|nsvcd__max(nsvcd__min(clear_until, found->tick), 0);|nsvcd__min(clear_until, found->tick);
asks: proven by parts to the end, but not free|nsvcd__choose_segments(goal.motion, q);\n}\n// When do they meet first?|nsvcd__choose_segments(goal.motion, q);\n  known->end = nsvcd__min(known->end, ticks);\n}\n// When do they meet first?
pair's last plane at the start alone|u0 < all \&\& nsvcd__plane_separates(p, pair, u0, all)|u0 < all \&\& nsvcd__plane_separates(p, pair, u0, u0)
exact: pairs without slack|return lowest - highest > p->goal.clearance + pair->margin + deviation;|return lowest - highest > p->goal.clearance + deviation;
exact: pairs without rounding|NSVCD__SAME_POSITION * ((double)p->given.lengths + nsvcd__d3_norm(p->arcs.arc.from));|0;
exact: a ratio of scales in float|m->ratio = (double)nsvcd__scale_of(moving) / (double)m->unit;|m->ratio = (double)(nsvcd__scale_of(moving) / m->unit);
turning contacts that are too near|distance <= p->goal.clearance + pair->rounding|distance <= p->goal.clearance + pair->close
exact: straight contacts that are too near|if (above <= pair->rounding) {|if (above <= pair->close) {
exact: planes of nearest points alone|for (size_t k = 0; k < 17; k++) {\n    const nsvcd__d3 *of|for (size_t k = 17; k < 17; k++) {\n    const nsvcd__d3 *of
exact: no planes of faces|n = k < 2 ? nsvcd__face_direction(of)|n = k < 2 ? guess
exact: no planes across edges|: nsvcd__across_edges(moving, fixed, k - 8);|: guess;
exact: no planes made normal to an edge|nsvcd__off_edge(guess, of[k / 2 - 1], of[k / 2 % 3])|guess
exact: planes on one side only|if (nsvcd__d3_dot(n, guess) < 0) n = nsvcd__d3_scale(n, -1);\n    const double beyond|const double beyond
pieces by their stored corners|} else if (f->counts->cut > 0) {|} else if (0) {
a piece of the triangle before|if (f->cut[first + half] <= number) first += half;|if (f->cut[first + half] < number) first += half;
floor: nearest times on the other side|if (slope < 0)\n      u0 = middle;|if (slope > 0)\n      u0 = middle;
asks: parts of the time that were lost|if (part.ran_out) return;|
asks: what no part settled|    }\n  }\n  nsvcd__restart(w, goal.motion);\n  nsvcd__choose_segments(goal.motion, q);|    }\n  }\n  known->ran_out = 0;\n  nsvcd__restart(w, goal.motion);\n  nsvcd__choose_segments(goal.motion, q);
long: gaps by other poses|part.poses += first;|
long: gaps without the lift|return origin_gap - p->given.lengths - 1.0001f * nsvcd__f3_norm(m->push_out);|return origin_gap - p->given.lengths - 0 * nsvcd__f3_norm(m->push_out);
long: a try that found nothing ends what is proven|!is_open \&\& !is_try \&\& !is_resolved|!is_open \&\& !is_resolved
long: an interval that forgets nothing|nsvcd__restart(w, m);\n    result = p->known;|result = p->known;
long: work of the first interval for all|if (given->grows) goal.most = p->work + given->work;|
solids: corners that are not joined|const double widest = nsvcd__join_corners(m, arena->allocator);|const double widest = 0;
solids: corners joined from afar|#define NSVCD__JOINED 1e-4|#define NSVCD__JOINED 1e-3
solids: gaps that are not remembered|out->gap = nsvcd__max(out->gap, sqrt(square));|
solids: rays through a gap|ray.margin += (double)nsvcd__off_mesh(f) + (double)f->counts->gap;|ray.margin += (double)nsvcd__off_mesh(f);
solids: faces that stay twice|m->alive[n] = m->first[third] == 0;|
solids: fins that stay|nsvcd__peel(m);\n  for|for
solids: walls that stay|pass < 8 \&\& nsvcd__drop_walls(m, parts) > 0|pass < 0
solids: turned faces are a sheet's|part->odd == 0 \&\& is_most ? NSVCD__EITHER_DIRECTION|0 ? NSVCD__EITHER_DIRECTION
solids: a house on a terrain turned round|part->area >= 0.5 * whole->area;|1;
solids: slits are holes|const int is_slit = hole->area <= NSVCD__SLIT * hole->length * hole->length;|const int is_slit = 0;
solids: rims are holes|if (!is_slit \&\& !is_flush) whole->is_sheet = 1;|
solids: doors are holes|if (!is_slit \&\& !is_three \&\& !(whole->volume > 0)) whole->is_sheet = 1;|
solids: holes of any size|whole->holes < NSVCD__HOLES * whole->area|1
solids: a missing face is all of its hole|(is_three ? NSVCD__HOLE_OF_THREE : 1)|1
solids: a whole that is closed in part|whole->closed >= 0.5 * whole->area;|whole->closed > 0;
solids: edges of what is closed|is_closed ? 0 : whole->odd;|whole->odd;
solids: nearly a solid is a sheet|*kind = NSVCD__NEARLY;|*kind = NSVCD__SHEET;
solids: rays count nothing of what is nearly a solid|odd += sum.nearly % 2 != 0 \|\| sum.winds != 0;|
solids: faces turned either way wind|if ((sum.winds != 0) != (sum.either_way % 2 != 0)) return 1;|if (sum.winds != 0 \&\& sum.either_way % 2 == 0) return 1;
asks: faces without area|length > 1e-9 * longest|length > 0
asks: pushed through one face only|n, t->directions[0]) > -0.3 \|\| nsvcd__d3_dot(n, t->directions[1]) > -0.3|n, t->directions[0]) > -0.3 \&\& nsvcd__d3_dot(n, t->directions[1]) > -0.3
asks: a lift that is not tried|    still->push_out = nsvcd__f3_round(push_out);|    return 0;
asks: ends not looked at|may_be_brief \&\& p->work + NSVCD__BRIEF_BUDGET < limit;|0;
asks: the start only|if (nsvcd__meets_at(w, q, goal, at_end, NSVCD__END_BUDGET, \&result))|if (!at_end \&\& nsvcd__meets_at(w, q, goal, at_end, NSVCD__END_BUDGET, \&result))
asks: a bracket lost|if (pass.outcome == NSVCD__EXHAUSTED) return 0;|if (pass.outcome == NSVCD__EXHAUSTED) bracket->low = 0;\n  if (pass.outcome == NSVCD__EXHAUSTED) return 0;
asks: a gap lost|{nsvcd__max(clear, (double)gap), known->found.distance, 0};|{0 * (clear + (double)gap), known->found.distance, 0};
asks: a bracket as wide as may be|while (!bracket->is_wide \&\& goal.measure > finest) {|while (0 \&\& !bracket->is_wide) {
asks: triangles not named|p->given.tells \&\& nsvcd__meets_at(|0 \&\& nsvcd__meets_at(
asks: metres without the way|return arc->speed + arc->turn|return arc->turn
asks: metres without the turn|return arc->speed + arc->turn|return arc->speed + 0 * arc->turn
asks: too deep for the manifold too|p->push.too_deep = w->blocks.has_block = 0;|w->blocks.has_block = 0;
asks: depth across edges forgotten|for (size_t k = 0; k < 12; k++) {\n    nsvcd__d3 n = k < 3|for (size_t k = 0; k < 3; k++) {\n    nsvcd__d3 n = k < 3
asks: deep in one direction|for (int side = 0; side < 2; side++) {\n      const double pushed_out|for (int side = 0; side < 1; side++) {\n      const double pushed_out
asks: metres of the arc before|  nsvcd__arcs_begin(\&p->arcs, motion);|  p->arcs.motion = motion;
asks: a safe place not lifted|n == moving_takes_it ? 0 : n ? -unit : unit|0
asks: a safe place on the other side|n == moving_takes_it ? 0 : n ? -unit : unit|n == moving_takes_it ? 0 : n ? unit : -unit
asks: a safe place too late|const double t = (double)answer->safe.time;|const double t = fmin(1, 1.05 * (double)answer->safe.time + 0.01);
asks: a safe place where it is about to touch|answer->safe.time = (float)(fmax(0, until - back) * (1 - 1e-7));|answer->safe.time = answer->time.low;
asks: not set down|return nsvcd__d3_sub(push_out, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));|return push_out;
asks: set down through contacts|return nsvcd__d3_sub(push_out, nsvcd__d3_scale(by, fmin(fmax(clear, 0), 1)));|return least;
a depth of planes alone|if (nsvcd__gap_after(t, n, 0.998 * most) <= square) return most;|return most;
asks: half of a depth|p->push.depths[k] = nsvcd__max(p->push.depths[k], depth);|p->push.depths[k] = fmax(p->push.depths[k], 0.5 * depth);
asks: one depth for all normals|const double along = least + (by_depth ? push->depths[k] : 0);|const double along = least + (by_depth ? push->depths[0] : 0);
no look on the way off|if (is_free \&\& p->push.normal_count > 0) nsvcd__deepen(w, q, goal);|
asks: no lift under a ceiling|least < 0.9 * p->given.slop|least < 0
asks: a floor that is near by|nsvcd__max(near_by, nsvcd__min(p->given.to, 0.5 * push->slop))|near_by
asks: contacts out of reach|nsvcd__d3_distance2(posed[k], foot) <= m->tolerance * m->tolerance|1
asks: contacts past an edge|if (aside > 0.01 * m->same * m->same) return;|
asks: contacts of any normal|if (along * along < 0.64 * square) continue;|
asks: contacts that hold less|if (!(spanned > 1.001 * *area)) continue;|if (*area > 0) continue;
asks: contacts of one normal|int tries = nsvcd__manifold_normals(\&w->p, found, \&twist, normals);|int tries = nsvcd__manifold_normals(\&w->p, found, \&twist, normals) > 0;
asks: all of a short way|fmax(0.25 * whole,|fmax(whole,
asks: nothing between the directions|area > NSVCD__SLIM * square) return 0;|area >= 0) return 0;
ranges: a box without a joint|for (size_t k = 0; k < s->joints; k++) sum += k == without|for (size_t k = 1; k < s->joints; k++) sum += k == without
ranges: a quarter of the width|s->half[k] = nsvcd__max(|s->half[k] = 0.25 * nsvcd__max(
ranges: always without the travel|nsvcd__ask_range(r, 1, along, travel + room|nsvcd__ask_range(r, 1, along, 0 * travel + room
ranges: never without the travel|const double clearance = (double)r->options.clearance + travel;|const double clearance = (double)r->options.clearance;
ranges: arms that nothing lengthens|slides ? 1 : across + moved;|slides ? 1 : across;
ranges: arms of half a box|1.000001 * (nsvcd__d3_axis(m->half, k) - m->round)|0.5 * (nsvcd__d3_axis(m->half, k) - m->round)
ranges: arms to the middle|most = nsvcd__max(most, nsvcd__d3_dot(out, out));|most = nsvcd__d3_dot(middle, middle);
ranges: planes without what bends|across * (before + 0.5 * h * r));|across * before);
ranges: planes without what joints beyond displace|across * (before + 0.5 * h * r));|across * 0.5 * h * r);
ranges: planes that joints displace once|*moved += chord;|*moved += 0 * chord;
ranges: planes whose chords count less|return nsvcd__min(way, across * chord);|return nsvcd__min(way, across * across * chord);
ranges: planes without the slope|h * (fabs(nsvcd__d3_dot(along, off)) + across|h * (0 * fabs(nsvcd__d3_dot(along, off)) + across
ranges: planes that slide for nothing|return h * fabs(nsvcd__d3_dot(along, axis));|return 0;
ranges: planes fixed twice|least[0][n] + least[1][s->way_count - n];|least[0][n] + least[1][n];
ranges: planes of triangles alone|const double kept = (double)r->options.clearance + s->beyond;|const double kept = (double)r->options.clearance;
ranges: planes without the clearance|const double kept = (double)r->options.clearance + s->beyond;|const double kept = s->beyond;
ranges: boxes given up are proven|r->count == 0 \&\& !(r->dropped > 0)|r->count == 0
robot: joints that do not bend|bend += step->bend[j] * arms[j];|(void)bend;
robot: half the bend|bend += step->bend[j] * arms[j];|bend += 0.5 * step->bend[j] * arms[j];
robot: joints that do not turn each other|(2 * outer + moved)|(moved)
robot: joints that turn each other once|(2 * outer + moved)|(outer + moved)
robot: joints without a square|(2 * outer + moved)|(2 * outer)
robot: no slerp|w * w * c->members[part].extent) / 8|0 * w * c->members[part].extent) / 8
robot: a slerp of half the angle|return 2 * nsvcd__dquat_arc(|return nsvcd__dquat_arc(
robot: levers of the centre|+ m->radius + moved;|+ moved;
robot: levers of the sample|+ m->radius + moved;|+ m->radius;
robot: a step of a ninth|return (bend + second + w * w * c->members[part].extent) / 8;|return (bend + second + w * w * c->members[part].extent) / 9;
postures: poses without rounding|if (moves[n]) local.rounding += 2|if (0) local.rounding += 2
postures: poses seen from the world|const nsvcd__dpose in = nsvcd__dpose_inverse_mul(\&local.frame, \&frames[n][k]);|const nsvcd__dpose in = frames[n][k];
postures: free of each other as floats|if (out->verdict != NSVCD_FREE \|\| out->distance.low > 0) return 1;|return 1;
postures: depths of floats|q.clearance = nsvcd__above(error + 2e-7 * (double)o->max_depth);|
robot: strays of one part|range->error = nsvcd__max(range->error, off);|range->error = nsvcd__max(range->error, nsvcd__deviation_in(c, pair->a, k)); (void)off;
robot: strays of the first step|range->error = nsvcd__max(range->error, off);|range->error = k == range->first ? off : range->error;
robot: boxes that stray|if (nsvcd__bounds_apart(\&at_a, \&at_b, room + off * (1 + 1e-9))) continue;|(void)off; if (nsvcd__bounds_apart(\&at_a, \&at_b, room)) continue;
robot: one part of a pair sampled anew|c->members[pair->a].is_skipped = c->members[pair->b].is_skipped = 0;|c->members[pair->a].is_skipped = 0;
robot: speeds that jump|step->bend[j] += 2 * h * jumps;|(void)jumps;
robot: half the jump of speed|step->bend[j] += 2 * h * jumps;|step->bend[j] += h * jumps;
robot: the first piece of a step alone|for (size_t piece = first; piece <= last; piece++) {|for (size_t piece = first; piece <= first; piece++) {
robot: bends by the share of a piece|second[i] = per_piece * per_piece * twice|second[i] = twice
robot: no strays|const double clearance = kept + errors;|const double clearance = kept;
robot: boxes without the clearance|const double room = (kept + rounding) * (1 + 1e-9);|const double room = rounding;
robot: boxes at samples alone|nsvcd__bounds_over(at, at + 1)|*at
robot: boxes without strays|\&b->bounds, room + most)) return 0;|\&b->bounds, room)) return 0; (void)most;
robot: the first step of a spell alone|range->steps = last - (steps ? range->first : 0);|range->steps = steps \&\& last > range->first ? 1 : 0;
robot: the last piece alone|const size_t steps = next - p == 1|if (next < m.pieces) continue;\n    const size_t steps = next - p == 1
robot: what is free of the first pair|if (nsvcd__ask_pair(s, parts, 1, work, \&range, \&found) == NSVCD_FREE) continue;|if (nsvcd__ask_pair(s, parts, 1, work, \&range, \&found) == NSVCD_FREE) break;
robot: the other half of a tree never|nsvcd__nearest_in(t, cell->first + !(side > 0), at, off,|if (0) nsvcd__nearest_in(t, cell->first + !(side > 0), at, off,
robot: leaves cut with a hole|if (!(off2 < *best)) return;|if (!(1.5 * off2 < *best)) return;
robot: ramps that are not proven|if (!nsvcd__ask_motion(r, \&blend->motion)) return;|
robot: routes without a clearance|r->check.clearance = r->options.clearance + NSVCD__SPARE;|r->check.clearance = NSVCD__SPARE;
robot: ramps beyond the speed|if (fabs(peak) > speed) {|if (fabs(peak) > 2 * speed) {
robot: ramps with any acceleration|return fabs(a) <= most;|return 1;
robot: ramps that are slow|const double side = distance >= least ? 1 : -1;|const double side = distance >= 0 ? 1 : -1;
robot: shortcuts that are not proven|if (nsvcd__ask_edge(r, from, to)) return 2;|return 2;
robot: starts by the work of the search|if (n / 2) r->check.work = 0;|
robot: a last proof that nobody ends|whole.stop = r->check.stop;|
robot: trees that stay in their holes|if (r->idle[side] >= NSVCD__IDLE|if (r->idle[side] > SIZE_MAX - 1
robot: limits of joints that a route may leave|return answer->verdict == NSVCD_FREE \&\& answer->joint == NSVCD_NONE;|return answer->verdict == NSVCD_FREE;
robot: whole turns are gone|at[j] -= full_turn * turns;|at[j] -= 0 * turns;
postures: slopes by the lever alone|sign * nsvcd__rate(c->scene, link - 1) * nsvcd__d3_dot(normal, speed);|sign * nsvcd__rate(c->scene, link - 1) * nsvcd__d3_norm(speed);
postures: slopes of a alone|nsvcd__slope_add(c, pair->b, \&local, point, normal, -1, out->slope);|
postures: depths of a alone|nsvcd__slope_add(c, pair->b, local, point, normal, -1 / rate, out->slope);|
postures: depths without a rate|nsvcd__slope_add(c, pair->a, local, on_a, normal, 1 / rate, out->slope);|nsvcd__slope_add(c, pair->a, local, on_a, normal, 1, out->slope);
postures: depths where a is lifted|const nsvcd__d3 on_a = nsvcd__d3_fma(-high, push_out, point);|const nsvcd__d3 on_a = point;
postures: near without the boxes' room|&b->bounds, 1.000001 * max_distance))|&b->bounds, 0.5 * max_distance))
postures: near without within|q.clearance = nsvcd__above((double)o->max_distance + error);|q.clearance = 0;
postures: no depth|out->depth = nsvcd__above(high * length);|
postures: a depth of half|out->depth = nsvcd__above(high * length);|out->depth = 0.5f * nsvcd__above(high * length);
postures: a depth of all the lift|*(is_apart ? &high : &low) = middle;|low = middle;
postures: brackets without rounding|out->distance.high = nsvcd__above((double)found.distance.high + error);|out->distance.high = found.distance.high;
postures: more than there is room for|if (written < capacity) out[written] = found;|out[written] = found;
postures: escapes without the clearance|{o->clearance, 0, 0, o->stop, o->user, 0};|{0, 0, 0, o->stop, o->user, 0};
cones: ways out that lead away|if (nsvcd__distance2(at, from, joints) > best * best * (1 + 1e-9)) continue;|
postures: no way back|memcpy(is_free ? at : blocked, middle, joints * sizeof *at);|memcpy(blocked, middle, joints * sizeof *at);
postures: the first way out|is_found = 1;\n    best = sqrt(nsvcd__distance2(at, from, joints));|if (is_found) break;\n    is_found = 1;
postures: what touches once touches always|if (nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT) return 0;|if (n == 0 && nsvcd__ask_sweep(c, &q, &found) != NSVCD_HIT) return 0;
postures: out of the limits|joints[j] = nsvcd__max(nsvcd__low_of(joint), nsvcd__min(nsvcd__high_of(joint), joints[j]));|
postures: the world is adjacent|return a > 0 && b > 0 && (scene->joints[a - 1].parent == b|return a > 0 && (b == 0 \|\| scene->joints[a - 1].parent == b
postures: never touching|pairs[in_all ? total - ++found.touching : found.asked++] = pair;|pairs[found.asked++] = pair;
reach: positions that are not looked at|return r->miss.position <= r->options.position_tolerance \&\&|return
reach: angles that are not looked at|\&\& r->miss.angle <= r->options.angle_tolerance \&\& r->miss.is_in;|;
reach: steps beyond the limits|if (is_held[n] \|\| (step[n] <= up \&\& step[n] >= down)) continue;|continue;
reach: a start out of its limits|nsvcd__clamp_to_limits(r->scene, r->start);|
reach: turns beyond the limits|if (to < nsvcd__low_of(joint) \|\| to > nsvcd__high_of(joint)) turns -= turns > 0 ? 1 : -1;|
reach: turns that stay|q[j] -= full_turn * turns;|
reach: taken though not free|if (!nsvcd__reach_is_free(r, q, \&found)) {|if (0) {
reach: free without the clearance|options = {r->options.clearance, 0, 0, r->problem.stop,|options = {0, 0, 0, r->problem.stop,
reach: the farthest first|r->start, joints) > distance2) at--;|r->start, joints) < distance2) at--;
reach: solutions side by side|if (nsvcd__distance2(row, q, joints) < apart2) continue;|
reach: a nearer one gives way|if (!is_beside \|\| nsvcd__distance2(row, r->start, joints) > distance2) continue;|continue;
reach: the first that touches is told|!answer->touching \|\| distance2 < best2;|!answer->touching;
reach: more than there is room for|\&\& found.solutions < capacity \&\&|\&\&
reach: boxes that are points|x - nsvcd__max(-half, nsvcd__min(half, x))|x
reach: boxes of twice the size|const double half = (double)p->half[k];|const double half = 2 * (double)p->half[k];
reach: an axis that is free in the target|nsvcd__turn_between(r->free_axis, nsvcd__dquat_rotate(unit, r->free_axis));|nsvcd__turn_between(r->free_axis, nsvcd__dquat_rotate(unit, r->free_axis)), turn = nsvcd__d3_scale(turn, 0.5);
reach: one joint for both sides|l; l = joints[l - 1].parent) sides[l - 1] -= 1;|l; l = joints[l - 1].parent) sides[l - 1] += 1;
reach: tools at the link|r->tool = nsvcd__unit_dpose(\&problem->tool);|r->tool = nsvcd__unit_dpose(\&nsvcd__at_origin);
reach: what is missed, as it was found|if (!found.reached \&\& !is_stopped) nsvcd__reach_from|if (0) nsvcd__reach_from
postures: handed over unturned|const nsvcd__dpose out = {nsvcd__dquat_mul(back, b->rotation),|const nsvcd__dpose out = {b->rotation,
postures: handed over from the world|const nsvcd__d3 offset = nsvcd__d3_sub(b->position, a->position);|const nsvcd__d3 offset = b->position;
verify: nothing is needed|if (!(gap > least \&\& last > least \&\& gap < VERIFY__BEYOND)) return 0;|if (!(gap > -1e9)) return 0;
verify: parted at the start alone|if (!(gap > least \&\& last > least \&\& gap < VERIFY__BEYOND)) return 0;|if (at == r->instants \&\& !(gap > least)) return 0;
verify: parted at the ends by one of them|if (!(gap > least \&\& last > least \&\& gap < VERIFY__BEYOND)) return 0;|if (!(gap > least)) return 0;
verify: no deviations|length * (r->clearance + margin) + deviation;|length * (r->clearance + margin);
verify: deviations of a alone|+ verify__deviation_along(r->b, \&v->b, \&at->b, at->deviation_b, n, exact);|;
verify: deviations of b alone|deviation = verify__deviation_along(r->a, \&v->a, \&at->a, at->deviation_a, n, exact) +|deviation =
verify: deviations at the origin|* any + sqrt(verify__dot(across, across)) * turn;|* any;
fits: half the distance from the axis|const double turn = deviation[2] * verify__aside|const double turn = 0.5 * deviation[2] * verify__aside
fits: the axis of the body in the world|axis[i] = verify__dot(at->turn + 3 * i, deviation + 3);|axis[i] = deviation[3 + i] + 0 * at->turn[0];
verify: no clearance|length * (r->clearance + margin) + deviation|length * margin + deviation
verify: margins that are taken away|(r->clearance + margin) + deviation;|(r->clearance - 1e4 * margin) + deviation;
verify: places without what they are computed from|mover->reach = verify__max(mover->reach, far_off);|(void)far_off;
verify: edges that all close|if (balance != 0) m->open|if (0) m->open
verify: edges one way|? 1 : weld[m->indices[e]] > weld[to] ? -1 : 0;|? 1 : weld[m->indices[e]] > weld[to] ? 1 : 0;
verify: half the deviation|deviation[2] = 0.1250001 * h * h;|deviation[2] = 0.06 * h * h;
verify: turns of half the angle|return 4 * atan2(|return 2 * atan2(
verify: the first child alone|v[0].a = child[1];|v[0].a = child[0];
verify: the second child alone|v[1].b = child[0];|v[1].b = child[1];
verify: the first half alone|v[1].t1 = v->t0 = 0.5 * (t0 + t1);|v[1].t1 = v->t1 = 0.5 * (t0 + t1);
verify: the second half alone|v[1].t1 = v->t0 = 0.5 * (t0 + t1);|v[1].t0 = v->t0 = 0.5 * (t0 + t1);
verify: a walk that ends early|while (height > 0) {\n    verify__visit *v|while (height > 0 \&\& r->at < r->bits - 8) {\n    verify__visit *v
verify: boxes of the left child|const nsvcd_verify_node right = {node->box + 2 * half,|const nsvcd_verify_node right = {node->box + 1,
verify: the highest corner of a box only|low[way[i] > 0 ? i + 3 : i]|low[i + 3]
verify: two corners of a triangle|for (uint32_t i = 0; i < 3 * node->count; i++) {\n    const float *x|for (uint32_t i = 0; i < 3 * node->count - 1; i++) {\n    const float *x
verify: triangles by half|const double along = way[0] * (double)x[0]|const double along = 0.5 * way[0] * (double)x[0]
verify: no scale|way[i] = mover->scale * (n[0]|way[i] = (n[0]
verify: no rays|if (!why \&\& !r->apart) why = verify__outside(r, a, b);\n    if (!why \&\& !r->apart) why = verify__outside(r, b, a);|
verify: rays from a alone|if (!why \&\& !r->apart) why = verify__outside(r, b, a);|
verify: rays from b alone|if (!why \&\& !r->apart) why = verify__outside(r, a, b);|
verify: apart whatever is parted|if (v->a.box == 0 \&\& v->b.box == 0) r->apart = 1;|r->apart = 1;
verify: rays that cross once|if (verify__wound(by->mesh) != 0)|if (verify__wound(by->mesh) > 1e9)
verify: rays that are not clear|if (crossed == 2) return 0;|if (crossed == 2) continue;
verify: what is inside whatever the ray|return verify__wound(m) != 0 ? NULL|return 1 ? NULL
verify: sums of what is open|sum += m->open[v] ? 0 : m->sums[v];|sum += m->sums[v];
verify: leaving is entering|return left > 0 ? 1 : -1;|return 1;
verify: crossed behind|if ((volume > 0) != (left > 0)) return 0;|
verify: points of other triangles|? NULL : "two points are not as near as that"|? NULL : r ? NULL : ""
verify: near by the margin's other side|sqrt(verify__dot(apart, apart)) + verify__extent|sqrt(verify__dot(apart, apart)) - 1e7 * verify__extent
verify: edges that end before|return clear \&\& second == -first ? NULL|return clear ? NULL
verify: edges that pass by|return clear \&\& second == -first ? NULL|return second == -first ? NULL
verify: another mesh|if (!why \&\& !is_a) why =|if (0) why =
verify: another mesh b|if (!why \&\& !is_b) why =|if (0) why =
verify: another motion|if (!why \&\& !is_motion) why =|if (0) why =
verify: what follows|if (!why \&\& (r->at + 7) / 8 != size)|if (0)
verify: no knots|t = verify__min(r->a->next(r->a->motion, t), r->b->next(r->b->motion, t));|t = t1;
verify: knots of a alone|t = verify__min(r->a->next(r->a->motion, t), r->b->next(r->b->motion, t));|t = r->a->next(r->a->motion, t);
verify: vertices at one place are two|weld[v] = same ? weld[m->part[i - 1]] : v;|weld[v] = v; (void)same;
verify: quaternions of other sides|dot < 0 ? -sqrt(square_b) : sqrt(square_b)|sqrt(square_b)
verify: joints without a bend|deviation[k] += 0.1250001 * bend * arm[k];|
verify: joints that do not turn each other|(2 * outer[k] + speed * arm[k])|(speed * arm[k])
verify: joints without their own turn|(2 * outer[k] + speed * arm[k])|(2 * outer[k])
verify: levers without offsets|outer[k] += speed * arm[k];\n    }\n    reach += verify__offset(joint->origin) +|outer[k] += speed * arm[k];\n    }\n    reach +=
verify: levers without slides|reach += verify__offset(joint->origin) + (joint->slides ? most : 0);\n  }\n}|reach += verify__offset(joint->origin);\n  }\n}
verify: pieces as one|return m->pieces > 0 ? verify__piece_end(m, verify__piece(m, t) + 1) : 1;|return 1;
verify: other points of a motion|d = verify__hash_double(d, *value);|
verify: coordinates that are none|if (!verify__within(positions[i], 1e6f)) return|if (0) return
verify: indices out of range|if (indices[i] >= vertices) return|if (0) return
verify: quaternions of any length|if (!(fabs(square - 1) < 2.1e-4)) return|if (0) return
verify: times that fall|if (timed \&\& k > 0 \&\& !(|if (0 \&\& !(
verify: what stays by a curve's first points|for (size_t i = from * m->degree; i <= to * m->degree; i++) { const double value|for (size_t i = from * m->degree; i < to * m->degree; i++) { const double value
verify: what stays at the other end|values[there * m->degree * m->joint_count]|values[from * m->degree * m->joint_count]
verify: what stays without its size|double reach = verify__offset(part->pose) + radius;|double reach = verify__offset(part->pose);
verify: what stays without its pose|double reach = verify__offset(part->pose) + radius;|double reach = radius;
verify: what stays without offsets|reach += verify__offset(joint->origin) + (joint->slides ? most : 0);\n  }\n  return moved|reach += (joint->slides ? most : 0);\n  }\n  return moved
verify: what stays without slides|reach += verify__offset(joint->origin) + (joint->slides ? most : 0);\n  }\n  return moved|reach += verify__offset(joint->origin);\n  }\n  return moved
verify: what stays but slides|moved += joint->slides ? way : way * reach;|moved += joint->slides ? 0 : way * reach;
verify: what stays by the last joint|moved += joint->slides ? way : way * reach;|moved = joint->slides ? way : way * reach;
verify: sizes by one corner|for (size_t i = 0; i < 3 * mesh->triangles; i++) {\n    const float *x = verify__corner(mesh, i / 3, i % 3);\n    most|for (size_t i = 0; i < 3 * mesh->triangles; i += 3) {\n    const float *x = verify__corner(mesh, i / 3, i % 3);\n    most
verify: boxes without the lesser arm|arms[k] = side ? verify__min(arms[k], arm) : arm;|arms[k] = side ? 0.5 * verify__min(arms[k], arm) : arm;
verify: boxes whose joints do not move each other's|path[k]) + moved;|path[k]);
verify: boxes by one corner|for (size_t n = 0; n < 3 * mesh->triangles; n++) {\n    const float *x|for (size_t n = 0; n < 3 * mesh->triangles; n += 3) {\n    const float *x
verify: boxes about the base's axes|const double *row = joint.turn + 3 * i;|const double *row = at.turn + 3 * i; (void)joint;
verify: boxes about axes through the base|off[i] = at.at[i] - joint.at[i] + row[0]|off[i] = at.at[i] + row[0]
verify: boxes without slides|if (!slides) arm =|if (slides) arm = 0; else arm =
verify: boxes without the first joint|for (size_t k = 0; k < count; k++) sum +=|for (size_t k = 1; k < count; k++) sum +=
verify: boxes without what is not swept|sum += path[k] == but ? 0 :|sum += path[k] != but ? 0 :
plans: boxes of any clearance|if (!((double)clearance >= nsvcd_verify_travel(parts, meshes, half, swept)))|if (0)
plans: boxes of half their width|half[j] = (1 + 1e-15) * verify__max(|half[j] = 0.5 * verify__max(
plans: boxes swept half|points[joints + swept - 1] = high[swept - 1];|
plans: half of the boxes|box[joint] = box[3 * joints + joint] = middle;\n      height++;|box[joint] = middle;
plans: boxes that are too deep|} else if (height == MOST_BOXES) {|} else if (height == 100 * MOST_BOXES) {
plans: what follows the boxes|return !why \&\& *at != size ? "something follows its end" : why;|return why;
plans: pieces that are none|if (until > from \|\| from > pieces)|if (0)
plans: what may touch at the start|if ((until > 0 \&\& !nsvcd_verify_stays(|if ((0 \&\& !nsvcd_verify_stays(
plans: what may touch at the end|(from < pieces \&\& !nsvcd_verify_stays(|(0 \&\& !nsvcd_verify_stays(
plans: one part that may touch|for (int k = 0; k < 2; k++)\n    if ((until > 0|for (int k = 0; k < 1; k++)\n    if ((until > 0
plans: the rest from the start|rest->points += until * rest->degree * rest->joint_count;|
plans: all of the rest's pieces|rest->pieces = from - until;|rest->pieces = from - until > 1 ? from - until - 1 : 0;
plans: any two may touch|if (is_of(allows[k].pair, who)) metres|if (who) metres
plans: proofs where none are due|if (rest.pieces == 0) return length ?|if (rest.pieces == 0) return 0 ?
plans: things that stand elsewhere|if (!(sqrt(off) <= 1e-9 + 1e-7 * verify__offset(part.pose) \&\& turned <= 3e-7))|if (!(turned <= 3e-7))
plans: things that are turned|\&\& turned <= 3e-7))|))
plans: things at no pose|if (!verify__is_pose(body->pose)) return|if (0) return
plans: things on the world|body->link = line->link;|body->link = line->link > 0;
plans: bodies of the robot are taken|if (moves \&\& line->thing < r.own) fail(|if (0) fail(
plans: things that are lost|s.is_lost \|= s.change_count > 0 \&\& !s.has_ended;|
plans: ends of what is refused|s.has_ended = wanted \&\& check_plan(\&s);|s.has_ended = wanted \&\& (check_plan(\&s) \|\| 1);
plans: changes of all plans above|s.changes = line + 1;|
plans: pairs on one link|if (bodies[a].link == bodies[b].link) continue;|if (bodies[a].link == bodies[b].link \&\& bodies[a].link == 0) continue;
plans: pairs of own bodies alone|for (uint32_t a = 0; a < r->bodies.count; a++) {\n    for (uint32_t b|for (uint32_t a = 0; a < r->own; a++) {\n    for (uint32_t b
plans: what a path attaches|return is_line(line, "plan") \|\| is_line(line, "together");|return is_line(line, "plan");
checker: arithmetic of any kind|const char *why = verify__arithmetic();|const char *why = NULL;
checker: meshes by arithmetic of any kind|if (unfit) return unfit;|
checker: rounded anyhow|if (sums[0] > one \|\| !(sums[1] > one)) return|if (0) return
checker: subnormal floats as 0|if (!((double)least > 0)) return|if (0) return
checker: infinity as a number|return (bits \& 0x7fffffffu) <= limit;|return (bits \& 0x7fffffffu) <= limit \|\| bits == 0x7f800000u;
checker: two motions|if (!why \&\& (a->clock != b->clock \|\| a->base != b->base))|if (!why \&\& a->base != b->base)
checker: two bases|if (!why \&\& (a->clock != b->clock \|\| a->base != b->base))|if (!why \&\& a->clock != b->clock)
checker: deviations that nobody wrote|memset(at, 0, sizeof *at);|
checker: a normal of 0|if (!(gap > least \&\& last > least \&\& gap < VERIFY__BEYOND)) return 0;|if (!(gap >= least \&\& last >= least \&\& gap < VERIFY__BEYOND)) return 0;
checker: corners that there are not|\|\| of->mesh->part[out->a] == NSVCD_VERIFY_NONE)|)
claims: of any clearance|verify__tell(\&sha, \&clearance, 1, 4);|
claims: of joints anywhere|verify__tell(sha, joint->origin, 7, 4);|
claims: of poses at any time|if (timed) verify__tell(sha, p->times, p->count, 4);|
claims: of a mesh without its triangles|verify__tell(\&sha, m->indices, 3 * m->triangles, 4);|
contacts: inner edges are sides|    if (same_moving \&\& nsvcd__goes_on(at_it.pair.fixed, points->on_b, normal, same)) return 1;|
contacts: edges of the moving body are sides|    if (same_fixed \&\& nsvcd__goes_on(at_it.posed, points->on_a, back, same)) return 1;|
contacts: ghosts among supports|if ((number \& 2) \&\& nsvcd__goes_on_beside(|if (0 \&\& nsvcd__goes_on_beside(
contacts: the nearest is left out|if (has_nearest) return (size_t)count;|if (count > 0) return (size_t)count;
contacts: a side of all directions|if (nsvcd__f3_dot(other->normal, item->normal) >= NSVCD__SAME_SIDE) other->is_resolved = 1;|other->is_resolved = 1;
contacts: corners over a face that is not the nearest|    if (!(side * heights[k] > 0)) return 0;|
contacts: a full list that is not said|  list->is_full = 1;|  list->is_full = 0;
contacts: work that ended is not said|return !result.ran_out \&\& !list->is_full;|return !list->is_full;
looks: balls as found|c->radii[nearest] += best;|(void)best;
looks: a cover without its convex radius|const double radius = c.radii[order[n]] + (double)o->convex_radius;|const double radius = c.radii[order[n]];
looks: errors of balls about points inside alone|: -depths[n];|: depths[n];
looks: balls that keep their size|ball.radius = nsvcd__above(radius + more);|ball.radius = nsvcd__above(radius / by);
looks: balls that do not grow by roundings|out->radii[n] = nsvcd__above(radius + 5e-7 * length);|out->radii[n] = (float)(radius - 5e-7 * length);
looks: clusters of nothing|nsvcd__cover_balls(f);\n}\n\n// Builds|}\n\n// Builds
looks: damaged balls are taken|nsvcd__balls_are_sound(b);|1;
looks: a box that is not round|const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(s->room + l), reach + s->b.round);|const nsvcd__v sum = nsvcd__v_plus(nsvcd__v_load(s->room + l), reach);
looks: no margin|nsvcd__v_plus(far_off, 1e-6f * extent + room * unit)|nsvcd__v_plus(far_off, 1e-6f * extent)
looks: a margin in the other's lengths|1e-6f * extent + room * unit|1e-6f * extent + room
looks: radii without their scale|return s->scale * (s->a.levels[0].r[i] + s->a.more);|return s->a.levels[0].r[i] + s->a.more;
looks: turned the other way|nsvcd__v_scale(nsvcd__v3_dot(to[i], from[k]), s->scale)|nsvcd__v_scale(nsvcd__v3_dot(from[i], to[k]), s->scale)
looks: a slab's height alone|const nsvcd__v square = nsvcd__v_fma(along, along, nsvcd__v_mul(across, across));|const nsvcd__v square = nsvcd__v_mul(nsvcd__v_set(4), nsvcd__v_fma(along, along, nsvcd__v_mul(across, across)));
looks: balls of the cluster before|    s.placed = 0;\n    if (s.b.is_box)|    if (s.b.is_box)
looks: the last child of a level is not seen|for (size_t i = 0; i < count \&\& !nsvcd__look_ends(s); i++)\n    nsvcd__look_down|for (size_t i = 0; i + 1 < count \&\& !nsvcd__look_ends(s); i++)\n    nsvcd__look_down
looks: any box is one|for (size_t k = 0; k < 6; k++) is_box \&= faces[k] == 2;|
shapes: heights in one number|return (double)(upper + lower / half) * (double)half + (double)(lower % half);|return (double)upper * (double)half;
shapes: what is in the plane is seen|if (nsvcd__facet_height(h, other, point) > 0) {|if (nsvcd__facet_height(h, other, point) >= 0) {
shapes: a grid of 2^20|#define NSVCD__GRID_BITS 30|#define NSVCD__GRID_BITS 20
shapes: points of the last facet alone|if (!(nsvcd__facet_height(h, h->facets + at, q) > 0)) {|if (0) {
shapes: points that the first facet saw|if (at == NSVCD__NO_INDEX) return;|if (at == NSVCD__NO_INDEX \|\| list == at) return;
shapes: points between corners stay|if (h->fan[i] < 3) continue;|if (h->fan[i] < 1) continue;
shapes: stretched as the longest axis|f.positions[i] *= (float)by->axes[i % 3];|f.positions[i] *= (float)by->most;
shapes: points that are not stretched|const double whole = floor((double)*at * (by->axes[n / count] / by->most) + 0.5);|const double whole = (double)*at;
shapes: slabs without the margin|const double more = margin + 1e-6 * reach;|const double more = -margin;
shapes: half a patch's sphere|const double reach = (1 + 1e-6) * (sqrt(farthest) + margin);|const double reach = 0.5 * (sqrt(farthest) + margin);
shapes: a mirror that turns nothing|if (by->mirror) nsvcd__turn_triangles(\&f);|
shapes: the other diagonal|indices[3 * count] = corners[0];\n        indices[3 * count + 1] = corners[k - 1];|indices[3 * count] = corners[found - 1];\n        indices[3 * count + 1] = corners[k - 2];
shapes: holes are samples at 0|return nsvcd__magnitude(height) > 0x7f800000u;|return nsvcd__magnitude(height) > 0xff800000u;
route_looks: the world turned|return link ? nsvcd__look_axes(c->links[link - 1].axis) : world;|(void)world; return nsvcd__look_axes(link ? c->links[link - 1].axis : nsvcd__d3_of(0, 0, 1));
route_looks: sines of the next quarter|sines[l] = quarter \& 2 ? -sine : sine;|sines[l] = quarter \& 1 ? -sine : sine;
route_looks: boxes of half the parts|part->low[i] = low - part->radius;|part->low[i] = low + part->radius;
route_looks: handed out unproven|is_free = !r->result \&\& nsvcd__prove_by(r, \&t->motion, \&whole);|is_free = r->is_looking \|\| (!r->result \&\& nsvcd__prove_by(r, \&t->motion, \&whole));
route_looks: pairs without their clearance|return (double)s->options->clearance + (own ? (double)own[pair - scene->pairs] : 0);|(void)own; return (double)s->options->clearance;
route_looks: the first pair's clearance|own[pair - scene->pairs]|own[0]
route_looks: looks that nobody ends|if (o->stop \&\& o->stop(o->user)) r->is_stopped = 1;\n  // between|// between
route_looks: no search after looks|if (r->root_count > 0 \&\& r->answer.status != NSVCD_ROUTE_FOUND \&\& !r->is_stopped) {|if (0) {
robot: nodes that are cut off found|\|\| t->marks[node] \& NSVCD__NODE_CUT) continue;|) continue;
robot: what hangs on a node that is cut off stays|if (t->marks[t->parents[n]] \& NSVCD__NODE_CUT) t->marks[n] \|= NSVCD__NODE_CUT;|break;
route_looks: looks believed where one was wrong|if (is_doubted) r->is_looking = 0;|
route_looks: single joints late where looks were wrong|r->idle[t == \&r->trees[1]] = NSVCD__IDLE;|
route_looks: single joints of nodes that are cut off|while (t->marks[node] \& NSVCD__NODE_CUT) node = t->parents[node];|
route_looks: limits that looks may leave|if (nsvcd__joint_outside(r->scene, motion, p) != NSVCD_NONE) return 0;|
robot: questions that nobody stops|asked.stop = c->stop;|asked.stop = NULL;
robot: asks again once it is stopped|if (!s->is_stopped \&\& o->stop \&\& o->stop(o->user)) s->is_stopped = 1;|if (o->stop \&\& o->stop(o->user)) s->is_stopped = 1;
robot: stopped is free|if (!s->is_stopped) left = nsvcd__ask_pairs(s, is_last, left);|left = s->is_stopped ? 0 : nsvcd__ask_pairs(s, is_last, left); if (!left) s->is_stopped = 0;
robot: free until the end of what is not|if (answer->verdict == NSVCD_HIT) continue; const nsvcd_check_answer found|if (answer->verdict == NSVCD_HIT) { answer->free_until = middle; continue; } const nsvcd_check_answer found
allowances: half of an arm|moved += nsvcd__slides(c, j) ? way : way * reach;|moved += nsvcd__slides(c, j) ? way : way * 0.3 * reach;
allowances: no offsets in an arm|reach += nsvcd__d3_norm(c->links[j].origin.position);|
allowances: no size in an arm|double reach = nsvcd__d3_norm(m->frame.position) + m->extent + m->round;|double reach = nsvcd__d3_norm(m->frame.position);
allowances: a curve by its ends|for (size_t i = 0; i <= m->degree; i++) { low[j]|for (size_t i = 0; i <= m->degree; i += m->degree ? m->degree : 1) { low[j]
allowances: of any pair|if (allowance->pair == pair \&\& nsvcd__allows_from_to|if (nsvcd__allows_from_to
allowances: one part alone|for (size_t n = 0; n < 2; n++) { const nsvcd__member *m = \&c->members[parts[n]];|for (size_t n = 0; n < 1; n++) { const nsvcd__member *m = \&c->members[parts[n]];
allowances: no end|c->cuts[2 * n + 1] = nsvcd__allowed_up_to(c, \&c->scene->allowances[n], m, t1, t0);|c->cuts[2 * n + 1] = t1;
merge: without delays|return m->delay + nsvcd__piece_start(\&m->motion, piece);|return nsvcd__piece_start(\&m->motion, piece);
merge: no rest before|while (own > 0 \&\& nsvcd__knot_at(m, 0) > merged->times[at] + all->same) at++;|
merge: pieces that are not cut|nsvcd__cut_curve(p, m->motion.degree, (merged->times[at] - start) / whole, to);|
merge: fractions of all pieces from the start|const double start = merged->times[at];\n    const double whole|const double start = merged->times[0];\n    const double whole
merge: points that stay in another degree|for (size_t i = degree; i > 0; i--) p[i] += (double)i / whole * (p[i - 1] - p[i]);|
merge: who rests where it began|column[row * all->joints] = column[(row - 1) * all->joints];|column[row * all->joints] = m->motion.points[k];
merge: one joint of two motions|all->moved[m->joints[k]]++) return|(all->moved[m->joints[k]]++ \&\& 0)) return
merge: times of the first alone|if (is_over \|\| time < times[written]) times[written] = time;|if (is_over) times[written] = time;
cones: bends alone|return (bend + turned * turned) / 8 * (1 + 1e-9);|return bend / 8;
cones: turns alone|return (bend + turned * turned) / 8 * (1 + 1e-9);|return turned * turned / 8;
cones: a sixteenth|return (bend + turned * turned) / 8 * (1 + 1e-9);|return (bend + turned * turned) / 16;
cones: ends alone|if (least >= deviation) {|if (least >= 0) {
cones: one end alone|const double least = nsvcd__min(last - last_error, next - error);|const double least = next - error;
cones: edges that nobody leaves|const int stays = deviation <= NSVCD__CONE_FINEST \&\& fabs(next - last) <= least_change;|(void)least_change; const int stays = deviation <= NSVCD__CONE_FINEST;
cones: steps that nobody ends|if (++polls % NSVCD__CONE_POLL == 0 \&\& o->stop \&\& o->stop(o->user)) {|if (++polls > SIZE_MAX - 1 \&\& o->stop) {
cones: stops that a check forgets|s->is_stopped \|= answer->why == NSVCD_WHY_WORK;|
cones: of the first cone only|answer->verdict = nsvcd__ask_cone(c, \&c->cones[n], m, t0, t1, o, \&at, \&why);|answer->verdict = nsvcd__ask_cone(c, \&c->cones[0], m, t0, t1, o, \&at, \&why);
cones: what turns slides|if (nsvcd__slides(c, link - 1)) continue; bend += step->bend[link - 1];|if (!nsvcd__slides(c, link - 1)) continue; bend += step->bend[link - 1];
cones: a start anywhere|if (last < last_error) return last < -last_error ? NSVCD_HIT : NSVCD_UNDECIDED;|
cones: the pair's own axis|c->cones[n].axis = nsvcd__dquat_rotate(c->members[cone->part].frame.rotation, axis);|c->cones[n].axis = axis;
cones: ranges ask about them|s->scene.cone_count = 0;|
cones: goals do not aim at them|r->jacobian[n][6] = r->units[n] * r->slope[j];|r->jacobian[n][6] = 0;
cones: goals anywhere|r->miss.angle <= r->options.angle_tolerance \&\& r->miss.is_in;|r->miss.angle <= r->options.angle_tolerance;
cones: nothing drawn into them|if (!nsvcd__into_cones(c, NULL, NSVCD__FREE_CONE, at)) continue;|
many_joints: held ones that are drawn|out[r->moving[k]] = nsvcd__draw_joint(r, r->moving[k], is_wide);|out[r->moving[k]] = nsvcd__draw_joint(r, r->moving[k], is_wide);\n  for (size_t j = 0; j < joints; j++) out[j] = nsvcd__draw_joint(r, j, is_wide);
many_joints: held ones that move alone|if (!r->scene->joints[j].mimic \&\& !(problem->held \&\& problem->held[j])) r->moving|r->moving
mimics: any motion is one|return follows ? NSVCD_OK : NSVCD_ERROR_MIMIC;|return NSVCD_OK;
mimics: a motion by its first point|nsvcd__follows(scene, m->pieces * m->degree + 1, m->points);|nsvcd__follows(scene, 1, m->points);
mimics: without the offset|return j->mimic ? j->multiplier * at[j->mimic - 1] + j->offset : at[joint];|return j->mimic ? j->multiplier * at[j->mimic - 1] : at[joint];
mimics: a leader within its own limits alone|c->joints[i] = nsvcd__narrowed(scene, i);|c->joints[i] = *joint;
mimics: blends at the leader's pace|nsvcd__driven(scene, j, from->x), rate * b->v0,|nsvcd__driven(scene, j, from->x), b->v0,
mimics: routes that drift|nsvcd__follow(r->scene, 2 * t->motion.pieces + 1, t->points);|
mimics: a box of the leader's width|s->arms[s->drivers[k]] += rates[k] * arms[k];|s->arms[s->drivers[k]] += arms[k];
mimics: a box without what is driven|s->arms[s->drivers[k]] += rates[k] * arms[k];|s->arms[s->drivers[k]] = arms[k];
mimics: a sweep of the leader alone|nsvcd__follow(\&s->scene, 1 + (along != NSVCD_NONE), points);|
mimics: a slope of the leader alone|slope[nsvcd__driver(c->scene, link - 1)] +=|slope[link - 1] +=
mimics: turns of a fraction|return is_endless \&\& rate > floor(rate) ? NSVCD_ERROR_MIMIC : NSVCD_OK;|return NSVCD_OK;
mimics: steps of the leader alone|r->jacobian[i][k] += rate * r->jacobian[n][k];|r->jacobian[i][k] += 0;
world: boxes of turns without their bend|const double bend = 0.126 * turn * turn * shape->reach;|const double bend = 0 * turn;
world: boxes of one size|out.half = nsvcd__d3_scale(out.half, scale);|
world: boxes above as they were|tree->nodes[n].box = nsvcd__box_of_children(tree, \&tree->nodes[n]);|
world: what moves stays in the tree|if (!is_new \&\& is_within) return;|if (!is_new) return;
world: a driven body where it is now alone|way, r->is_driven ? 2 : 1, 0);|way, 1, 0);
world: a driven body at rest|mover->count = q->at_once ? 1 : 2;|mover->count = 1;
world: groups pass one way|!(groups \& other->passes) \&\& !(other->groups \& passes)|!(groups \& other->passes)
world: pairs of what is fixed|if (n <= id \|\| (a->given.fixed \&\& b->given.fixed)) continue;|if (n <= id) continue;
world: ids are lost|world->free = (uint32_t)id;|
world: a box without the clearance|(double)q->question.clearance + (double)q->question.tolerance +|0 * (double)q->question.tolerance +
world: the last time|t->time.low = fminf(t->time.low, answer->time.low);|t->time.low = answer->time.low;
world: safe of the first body|if (t->safe_by \&\& answer->safe.time >= t->safe_time) return;|if (t->safe_by) return;
world: push-outs in sum|depths[k] - nsvcd__d3_dot(out, normals[k]);|depths[k];
world: sensors stop|(r->given.sensor \&\& !q->with_sensors)|0
world: meets itself|at == q->self \|\| (r->given|(r->given
world: any other method|given->method != NSVCD_METHOD_DEFAULT \&\& given->method != NSVCD_METHOD_PROOF|given->method == NSVCD_METHOD_NETWORK
world: changes within changes|if (world->changes \& 1) return 0;|
world: a list as it comes|for (; at > 0 \&\& ids[at - 1] > id; at--)|for (; at > most;)
slide: driven bodies from their start|s->ask.since = 1 - s->left;\n  s->ask.at_once = at_once;|s->ask.since = 0;\n  s->ask.at_once = at_once;
slide: half the clearance|s->ask.question.clearance = (float)s->clearance;|s->ask.question.clearance = 0.5f * (float)s->clearance;
slide: driven bodies without a speed|const nsvcd__d3 driven = nsvcd__driven_speed(s, s->contacts[k].body, on_other);|const nsvcd__d3 driven = {0 * on_other.x, 0, 0};
slide: nobody is caught|out.caught = nsvcd__caught_by(\&s);|(void)nsvcd__caught_by(\&s);
slide: no way out|return nsvcd__push_off(s) \|\| gone > 0;|return gone > 0;
slide: what touches at first is stuck|if (answer.verdict == NSVCD_FREE) continue;\n    q.question.a.count = 1;|if (answer.verdict != NSVCD_FREE) return 0;\n    q.question.a.count = 1;
slide: caught by what is not driven|if (q->of_driven \&\& !r->is_driven) continue;|
slide: few rounds before doors|nsvcd__met_driven(\&s) ? 4 * rounds : rounds|rounds
slide: rests on what is gone|if (!r \|\| r->moved > before->clock) return 0;|
slide: rests whatever comes|if (r->is_driven \|\| r->moved > before->clock) return 0;|
slide: rests in the way of doors|return is_short \&\& !nsvcd__is_driven_near(s);|return is_short;
slide: creeps for good|nsvcd__travel_left(s) <= most \|\| (touches \&\& !memcmp(to, \&s->pose, sizeof *to));|nsvcd__travel_left(s) <= most;
slide: up what is too steep|if (!s->ground \&\& into > 0) s->thing.linear = nsvcd__d3_fma(into, away, s->thing.linear);|
slide: walls that lean are ramps|if (s->ground) h->normal = away;|
slide: friction without an end|const double most = thing->friction * hold->pushed;|const double most = 1e9;
slide: nothing bounces|h->least = nsvcd__max(h->least, (double)s->given->restitution * h->into);|(void)0;
slide: the rest of the frame is lost|if (!at_once) s->left *= 1 - (double)t.safe_time;|if (!at_once) s->left = 0;
slide: stays at the clearance|left[k].least = NSVCD__LEAVES * nsvcd__max(holds[k].lacks, 0) / seconds;|left[k].least = 0;
slide: no way down|if (stood \&\& !s.ground \&\& given->step > 0 \&\& rises <= 0) nsvcd__step_down(\&s);|
slide: a climb is no way|s->pace *= 1 - gone;|
slide: nobody rides|s->ridden = nsvcd__driven_speed(s, s->ground->body, nsvcd__pivot_at(s));|
slide: no edge is one of a step|if (nsvcd__is_on_step(s)) return 1;|
slide: edges of what is too high|return s->ground \&\& nsvcd__height_of(s, s->ground) <= s->floor + (double)s->given->step;|return s->ground != NULL;
slide: edges of what is too steep|if (nsvcd__is_on_step(s)) return 1;|return 1;
slide: a step farther on than edges|gap + radius * (lies - sqrt(1 - bears * bears));|step;
slide: feet as thin as lines|radius * (lies - sqrt(1 - bears * bears));|0 * bears;
slide: steps above the sole|s->floor = s->ground ? nsvcd__height_of(s, s->ground) : sole;|s->floor = sole;
slide: no edge leads down|(!s->is_on_edge \|\| nsvcd__leads_down(s))|!s->is_on_edge
slide: all edges lead down|const int leads = s->ground \&\& nsvcd__height_of(s, s->ground) >= edge - step;|const int leads = s->ground != NULL \|\| edge > -1e9;
slide: edges bear for a frame|if (s->was_on_edge) nsvcd__seek_ground(s);|if (s->was_on_edge) nsvcd__slide_look(s);
slide: who stops hangs on edges|if (!s->is_on_edge \|\| nsvcd__d3_dot(walks, n) > 0) return;|return;
slide: risers that are left hold|for (int k = 0; k < 2; k++) {\n    (void)nsvcd__go_by(s, nsvcd__d3_scale(walks|for (int k = 0; k < 1; k++) {\n    (void)nsvcd__go_by(s, nsvcd__d3_scale(walks
slide: edges stop|h->normal = s->up;|(void)0;
slide: flies off kerbs|if (stood) nsvcd__stop_climbing(\&s);|
slide: jumps are eaten|if (s->jumps) return;|
slide: kerbs eat jumps|if (!(s->given->step > 0) \|\| s->jumps) return NULL;|if (!(s->given->step > 0)) return NULL;
slide: edges at rest on trains|nsvcd__climb(s, before);\n    nsvcd__ride(s);|nsvcd__climb(s, before);
step: going along is no way|is_free = nsvcd__ask_about(\&q, id, \&answer) \&\& answer.verdict == NSVCD_FREE;|is_free = 1;
step: known whatever moved|if (r->proven >= moved \|\| o->proven >= moved) continue;|if (r->proven \|\| o->proven) continue;
step: a lift passes through|if (nsvcd__ask_about(\&q, id, \&answer) \&\& answer.verdict != NSVCD_FREE) found = id;|(void)0;
step: who is in the way stays|if (may_join) o->joins = r->carrier;|
step: as fast as the world sees it|if (is_thing) nsvcd__add_carried(goes, turns, -1, \&m->velocity);|
step: those carried see no slip|if (!r->carrier) return nsvcd__d3_of(0, 0, 0);|return nsvcd__d3_of(0, 0, 0);
step: brakes hold what is carried|is_braked \&\& !is_carried \&\&|is_braked \&\&
world: boxes in a frame without the way|nsvcd__boxes_meet_in(\&a->poses[0], \&q->shape, a->poses, a->count, q->apart,|nsvcd__boxes_meet_in(\&a->poses[0], \&q->shape, a->poses, 1, q->apart,
step: rests as in another world|before->rests \&\& nsvcd__is_last_slide(world, s->ask.self, before) \&\&|before->rests \&\&
step: sleeps as in another world|if (!nsvcd__is_last_slide(crowd->world, m->id, last)) return 1;|
step: nobody tells where it is driven|movers[k].answer.pose = *at;|
step: movers of the array's order|return a.height < b.height;|return a.mover < b.mover;
step: a mover twice|if (!r \|\| r->mover != k \|\| r->given.fixed)|if (!r \|\| r->given.fixed)
step: what is fixed moves|r->mover != k \|\| r->given.fixed)|r->mover != k)
step: more than there can be|if (count > world->most) return NSVCD_ERROR_INDEX;|if (count > 3 * world->most) count = 3;
step: sleeps while it is driven at|if (m \&\& m->asleep) nsvcd__wake(m);|
step: sleeps on what is gone|return !r \|\| (r->moved > since|return r \&\& (r->moved > since
step: sleeps on what falls|nsvcd__mover_speed(crowd, other) > crowd->quiet) return 1;|0) return 1;
step: what is driven slides|if (m->asleep \|\| r->is_driven) return NSVCD_OK;|if (m->asleep) return NSVCD_OK;
step: driven for good|const nsvcd_result arrives = nsvcd_world_arrive(world);|const nsvcd_result arrives = NSVCD_OK;
step: nobody sleeps|m->asleep = 1;|
step: nothing is taken off|if (other) nsvcd__push(other, \&at->other, -more);|
step: what a slide gave is given twice|nsvcd__push(\&p.thing, own, own->pushed);|(void)0;
step: energy from nowhere|if (!(after > before)) return 1;|return 1;
step: a half for too much energy|nsvcd__share_all(p, came, 2 * share);|(void)0;
step: who rests pushes nothing|if (!(mass > 0)) return;|if (!(mass > 0) \|\| m->answer.rests) return;
step: what could not move gives nothing|const double lost = 1 - (double)m->answer.spent;|const double lost = 0;
slide: stops are for good|> s->margin) continue;|> 1e9) continue;
slide: bounces gain energy|if (s->given->restitution > 0 \&\& !is_driven \&\&|if (0 \&\&
step: piles hand all on|if (is_piled \&\& falls|if (0 \&\& falls
step: who creeps does not stand|const int stands = nsvcd__d3_norm(nsvcd__d3_sub(to, from)) < NSVCD__STANDS * asked;|const int stands = !(nsvcd__d3_norm(nsvcd__d3_sub(to, from)) > 0);
step: who stops once is a pile|r->stood = stands ? (r->stood > 0 ? 2 : 1) : 0;|r->stood = stands ? 2 : 0;
step: rows are piles|if (is_piled \&\& falls > NSVCD__LEVEL_NORMAL * nsvcd__d3_norm(crowd->falls)) return 0;|if (is_piled) return 0;
step: pushed at one corner|if (!nsvcd__has_pushed(\&m->answer, c->body)) continue;|if (!(c->impulse > 0)) continue;
step: bounces by where it has gone|at->own = holds[k];|at->own = nsvcd__hold_of_other(crowd, m->id, \&p->thing, \&c->contact);
step: characters push nothing|came.inverse_mass = p->thing.inverse_mass /= mass;|came.inverse_mass = p->thing.inverse_mass;
step: masses about the box|s.y + s.z, s.z + s.x, s.x + s.y|s.x + s.y, s.z + s.x, s.y + s.z
step: open meshes are solids|if (nsvcd__d3_norm(off) > most * size) return 0;|
LIST

if [ -n "${DRY:-}" ]; then python3 tests/make_mutant.py --all $work/list && exit 0 || exit 1; fi
survived=0
while IFS= read -r line; do
  name=${line%%|*}
  case "$name" in *"${1:-}"*) ;; *) continue ;; esac
  number=$((${number:-0} + 1))
  test -z "${OF:-}" || test $((number % OF)) = "$PART" || continue
  python3 tests/make_mutant.py "$work" "$line" || exit 1
  tile=  # those of tiles are looked for where small bodies make several
  file=test_proof.c
  fused=  # as the Makefile compiles these
  many=1
  case "$name" in
    tile:*) tile=-DNSVCD__TILE=2 ;;
    level:*) file=test_level.c ;;
    asks:*) file=test_asks.c fused=-ffp-contract=fast ;;
    long:*) file=test_long.c ;;
    exact:*) file=test_exact.c many=50 ;;
    floor:*) file=test_floor.c ;;
    solids:*) file=test_solids.c ;;
    round:*) file=test_round.c fused=-ffp-contract=fast ;;
    robot:*) file=test_robot.c ;;
    looks:*) file=test_looks.c ;;
    shapes:*) file=test_shapes.c ;;
    contacts:*) file=test_contacts.c ;;
    world:*) file=test_world.c ;;
    slide:*) file=test_slide.c ;;
    step:*) file=test_step.c ;;
    route_looks:*) file=test_route_looks.c ;;
    many_joints:*) file=test_many_joints.c ;;
    ranges:*) file=test_ranges.c ;;
    postures:*) file=test_postures.c ;;
    reach:*) file=test_reach.c ;;
    allowances:*) file=test_allowances.c ;;
    mimics:*) file=test_mimics.c ;;
    merge:*) file=test_merge.c ;;
    cones:*) file=test_cones.c ;;
    verify:*) file=test_certificate.c ;;
    checker:*) file=test_checker.c ;;
    claims:*) file=test_claims.c ;;
    fits:*) file=test_fits.c ;;
    plans:*) file=forge.py ;;
  esac
  source=$work/tests/$file
  test "$file" = forge.py && source=$work/examples/verify/verify.c
  $CC -O2 -march=native -std=c99 -w -I"$work" -DNSVCD_NO_DISPATCH $tile $fused -DTEST_ALONE -DCHECK_ENDS_EARLY -o $work/test $source -lm || exit 1
  run=$work/test
  test "$file" = forge.py && run="python3 tests/forge.py"
  (ulimit -t "${LIMIT:-400}"; TEST_MANY=$many VERIFY=$work/test exec $run) >$work/out.txt 2>&1
  code=$?
  if [ $code = 137 ] || [ $code = 152 ]; then echo "NO END    $name: raise LIMIT, CPU seconds"; survived=1; continue; fi
  if [ $code = 0 ]; then
    if [ "$name" = none ]; then echo "the header itself passes"; continue; fi
    echo "SURVIVES  $name"
    survived=1
  else
    if [ "$name" = none ]; then echo "the header itself fails: see $work/out.txt"; exit 1; fi
    echo "caught    $name: $(grep -m 1 'FAILED' $work/out.txt | cut -d' ' -f1)"
  fi
done <$work/list
exit $survived
