#!/bin/sh
# Is the replay worth anything? Each mutant is the loop with one mistake in it, and build/loop_replay has to fail on it. Prints a
# line for each; exits with 1 if one survives. An argument runs only mutants whose name contains it. SETS: a folder of problem files
# as NOTES.md makes them; WORK: where it builds.
set -u
CC=${CC:-cc}
cd "$(dirname "$0")/../../.." || exit 1
sets=${SETS:-build/sets}
work=${WORK:-build/loop_mutants}
mkdir -p "$work/tests/bench" "$work/examples"
cp neuralsvcd.h weights.h "$work/"
cp -r examples/scenery "$work/examples/"
cp tests/proof_scene.h "$work/tests/"
# name | file | text (occurs once) | what it becomes
cat >"$work/list" <<'LIST'
none|loop.h||
no rounding|motion.h|s->hair = NSVCD__ROUNDING * (|s->hair = 0 * (
no stray of few arcs|motion.h|s->eb = 1.00001f * (sqrtf(turn) + lanes_most|s->eb = 0 * (sqrtf(turn) + lanes_most
no drift of few arcs|motion.h|s->ea = 1.00001f * (sqrtf(stray) + lanes_most|s->ea = 0 * (sqrtf(stray) + lanes_most
no stray of many arcs|motion.h|s->eb = 1.00001f * (sqrtf(lanes_most(turn))|s->eb = 0 * (sqrtf(lanes_most(turn))
no stray along w|motion.h|s->eb_w = 1.00001f * (sqrtf(lanes_most(turn_w)) + lanes_most(bulge_w)) + 1e-6f * s->eb;|s->eb_w = 0;
no bulge of a part|motion.h|s->eb = part * k->bulge[n];|s->eb = 0;
no bulge of an arc|part.h|lanes_load(k->bulge + n) * lanes_set(a->reach) +|0 * lanes_set(a->reach) +
stray without reach|part.h|const float stray = s->axes_ea[j] + s->axes_eb[j] * c->reach;|const float stray = s->axes_ea[j];
later half begins late (knots)|motion.h|*(later ? \&s->first : \&s->last) = middle;|if (later) s->first = middle + 1 < s->last ? middle + 1 : middle; else s->last = middle;
later half begins late (arc)|motion.h|*(later ? \&s->from : \&s->to) = middle;|*(later ? \&s->from : \&s->to) = middle + (later ? 0.1 * (s->to - s->from) : 0);
poses of a half at its middle|motion.h|s->exact_end = true_pose(m, s->first, s->to);\n    store|s->exact_end = true_pose(m, s->first, 0.5 * (s->from + s->to));\n    store
later half forgotten|loop.h|  if (!(gaps[1 - nearer] > 0))\n|  if (0)\n
arcs forgotten|loop.h|    if (!here)\n|    if (!here \|\| share.first == 3)\n
no quanta of b|loop.h|float slack = s->rounding + leaf_error(t.b->leaf);|float slack = s->rounding;
no quanta of a|loop.h|t.slack = slack + p->m.scale * leaf_error(t.a->leaf);|t.slack = slack;
no quanta of couples|loop.h|c.slack = (double)p->m.scale * (double)leaf_error(leaf_a) + (double)leaf_error(leaf_b);|c.slack = 0;
no stray of couples|loop.h|allowed + stray_along_one(s, n, c->reach);|allowed;
no stray of planes|loop.h|t->limit = stray_of(s, \&n.x, t->reach) + t->slack;|t->limit = t->slack;
planes of the start|loop.h|const lanes3 end = corner_heights(t->a->end, n);\n    const lanes3 rest|const lanes3 end = corner_heights(t->a->start, n);\n    const lanes3 rest
left out by what was left out|loop.h|const uint32_t below = t->in_b \& lanes_above(lanes_set(lowest - t->limit), high);|const uint32_t below = t->in_b \& lanes_above(lanes_set(lanes_least(lanes_pick(t->in_a \& ~above, low, lanes_set(HUGE_VALF))) - t->limit), high);
box at the start|part.h|out->high[j] = lanes_max(start + start_by, end + end_by);|out->high[j] = start + start_by;
slab without across|part.h|out->slab_high = lanes_max(start + start_by, end + end_by) + scale|out->slab_high = lanes_max(start, end) + scale
leaves of another span|loop.h|if (out->leaf == leaf \&\& out->span == s->id)|if (out->leaf == leaf)
children of another span|loop.h|if (out->span != s->id \|\| out->node != node)|if (out->node != node)
a child forgotten|loop.h|for (int k = 0; k < n \&\& !leaves; k++)\n    push(p, s->id, place_of|for (int k = 1; k < n \&\& !leaves; k++)\n    push(p, s->id, place_of
a couple forgotten|loop.h|for (uint32_t k = 0; k < list.count \&\& !(s->id|for (uint32_t k = 1; k < list.count \&\& !(s->id
half of a couple forgotten|loop.h|    push_couple(p, 2 * item->span + 1, item->a, item->b);\n|
a span where its half is|motion.h|const unsigned slot = 2 * (unsigned)((id ^ id >> 5 ^ id >> 17) % (SPAN_SLOTS / 2)) + odd;|const unsigned slot = (unsigned)((id ^ id >> 6 ^ id >> 17) % SPAN_SLOTS) + 0 * odd;
what was cut short is left|loop.h|  if (!(item->span \& INSTANT))\n    push|  if (0)\n    push
no clearance of arcs|part.h|                        m->clearance;|                        0 * m->clearance;
no clearance of spans|motion.h|s->rounding = s->hair + m->clearance;|s->rounding = s->hair;
no clearance of couples|loop.h|s->exact_rounding + clearance;|s->exact_rounding;
an instant for good|loop.h|if (item.span \& INSTANT \&\& !(item.a \& COUPLE) \&\&|if (0 \&\&
LIST
status=0
fails=0
while IFS='|' read -r name file from to; do
  case "$name" in *"${1:-}"*) ;; *) continue ;; esac
  rm -rf "$work/tests/bench/loop"
  cp -r tests/bench/loop "$work/tests/bench/"
  NAME=$name FROM=$from TO=$to perl -0pi -e 'BEGIN { ($f, $t) = @ENV{qw(FROM TO)}; s/\\n/\n/g, s/\\([&|])/$1/g for $f, $t; }
    if ($f ne "") { $n = () = /\Q$f\E/g; die "$ENV{NAME}: found $n times\n" if $n != 1; s/\Q$f\E/$t/; }' \
    "$work/tests/bench/loop/$file" || { status=1; continue; }
  $CC -O2 -march=native -fno-math-errno -std=gnu99 -w -DNSVCD_NO_DISPATCH -o "$work/replay" "$work/tests/bench/loop/replay.c" -lm ||
    { echo "$name: does not compile"; status=1; continue; }
  fails=""
  for run in "--limit 12 $sets/standard/standard.txt $sets/hollow/hollow.txt" "--remote 1000 --press 18 --limit 20 $sets/p/still.txt" "$sets/p/offset.txt $sets/p/tiny.txt" \
    "--limit 12 $sets/p/spin.txt $sets/p/thin.txt $sets/p/nested.txt" "--press 20 --limit 20 $sets/p/same.txt" \
    "--press 20 --limit 12 $sets/rest/rest.txt $sets/p/still.txt" "--both --limit 12 $sets/p/spin.txt" \
    "--poses 3 --press 12 --limit 12 $sets/standard/standard.txt $sets/p/spin.txt" "--first 0.001 --limit 40 $sets/standard/standard.txt" \
    "--clearance 0.01 --limit 20 $sets/standard/standard.txt"; do
    "$work/replay" $run >"$work/out" 2>&1 || { fails="$fails [$(grep -h 'certificates:' "$work/out" | sed 's/.*times, \([0-9]* wrong\).*/\1/'), $(sed -n 's/.*watched, //p' "$work/out")]"; break; }
  done
  if [ "$name" = none ]; then
    [ -z "$fails" ] && echo "none: passes" || { echo "none: FAILS $fails"; status=1; }
  elif [ -n "$fails" ]; then
    echo "$name: caught $fails"
  else
    echo "$name: SURVIVES"
    status=1
  fi
done <"$work/list"
exit $status
