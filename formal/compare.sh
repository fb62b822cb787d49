#!/bin/sh
# Gives build/verify and build/referee the same certificates: of each set of problems, FORMAL_COUNT of them, and FORMAL_MUTANTS mutants of
# each set's, twice: with no clearance, and with one of FORMAL_CLEARANCE metres. They must say the same of each, but of what the referee does not cover. Ends with 1 if they do not.
# Needs build/problems, build/svcd, build/verify and build/referee; run from the repository's root.
set -u
out=build/formal/sets
mkdir -p $out
sets=${FORMAL_SETS:-standard hollow inside cavity thin spin still tiny huge offset mixed far rest nested slivers soup one same}

# compare NAME FILE FOLDER CLEARANCE: columns 1 to 4 of verify's and the referee's lines. verify asks for a margin, 1e-10 of all
# lengths, where the referee computes with intervals: it may refuse a plane, an edge, two points or a ray that the referee accepts, which is
# told and must be rare; never the other way round.
compare() {
  build/verify "$2" "$3" --clearance "$4" >$out/verify.txt
  test $? -le 1 || { echo "formal: $1: verify fails"; exit 1; }
  build/referee "$2" "$3" --clearance "$4" >$out/referee.txt
  test $? -le 1 || { echo "formal: $1: the referee fails"; exit 1; }
  paste $out/verify.txt $out/referee.txt | awk -F'\t' -v name="$1" '
    function byte(reason) { sub(/.* /, "", reason); return reason + 0 }
    { all++; seconds += $10 / 1e6 }
    $7 == "accepted" { accepted++ }
    $7 == "accepted" && $8 == "inside" { insides++ }
    $7 == "accepted" && ($8 == "hit" || $8 == "near") { meetings++ }
    $8 ~ /^a ray / { rays++ }
    $7 == "refused" { refused++ }
    $7 == "uncovered" { uncovered++ }
    { same = $1 == $6 && ($7 == "uncovered" ? 1 : $2 == $7 && $3 == $8 && $4 == $9) }
    !same && $3 ~ /^a plane|^an edge|^two points|^a ray passes/ && $2 == "refused" && ($7 != "refused" || byte($3) < byte($8)) { margin++; same = 1 }
    !same && $3 ~ /^a ray passes/ && $8 ~ /^a ray does not/ && byte($3) == byte($8) { margin++; same = 1 }
    !same { print "formal: " name ": " $0; bad++ }
    END {
      printf "%-24s %6d certificates: both accept %d (meetings %d, inside %d), both refuse %d (rays %d); not covered %d; margin %d; %.1f s\n",
        name, all, accepted, meetings, insides, refused, rays, uncovered, margin, seconds
      exit bad > 0 || all == 0 || margin > 1 + all / 100
    }' || exit 1
}

for set in $sets; do
  file=$out/$set.txt
  build/problems --set $set --meshes procedural --count ${FORMAL_COUNT:-6} --pool 8 --seed 51 --out $file >/dev/null 2>&1
  for clearance in 0 ${FORMAL_CLEARANCE:-0.02}; do
    name="$set, $clearance"
    certificates=$out/$set.$clearance
    mkdir -p $certificates
    build/svcd check --repeat 1 --clearance $clearance --certificates $certificates $file >/dev/null 2>&1
    compare "$name" $file $certificates $clearance
    rm -rf $certificates.mutants
    python3 formal/mutants.py $file $certificates ${FORMAL_MUTANTS:-30} $certificates.mutants.txt $certificates.mutants
    ! grep -qs '^problem' $certificates.mutants.txt || compare "$name, mutants" $certificates.mutants.txt $certificates.mutants $clearance
  done
done
echo "formal: verify and the referee agree"
