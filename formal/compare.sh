#!/bin/sh
# Gives build/verify and build/referee the same certificates: of each set of problems, FORMAL_COUNT of them, and FORMAL_MUTANTS mutants of
# each set's, twice: with no clearance, and with one of FORMAL_CLEARANCE metres. They must say the same of each, but of what the referee does not cover,
# and claims must be the same. So too of the first set's meshes as STL and as OBJ of larger faces (formats.py). Ends with 1 if they do not.
# Needs build/problems, build/svcd, build/verify and build/referee; run from the repository's root.
set -u
out=build/formal/sets
mkdir -p $out
sets=${FORMAL_SETS:-standard hollow inside cavity thin spin still tiny huge offset mixed far rest nested slivers soup one same}

# compare NAME FILE FOLDER CLEARANCE: columns 1 to 4 and 6 of verify's and the referee's lines. verify asks for a margin, 1e-10 of all
# lengths, where the referee computes with intervals: it may refuse a plane, an edge, two points or a ray that the referee accepts, which is
# told and must be rare; never the other way round.
compare() {
  build/verify "$2" "$3" --clearance "$4" --claims >$out/verify.txt
  test $? -le 1 || { echo "formal: $1: verify fails"; exit 1; }
  build/referee "$2" "$3" --clearance "$4" --claims >$out/referee.txt
  test $? -le 1 || { echo "formal: $1: the referee fails"; exit 1; }
  paste $out/verify.txt $out/referee.txt | awk -F'\t' -v name="$1" '
    function byte(reason) { sub(/.* /, "", reason); return reason + 0 }
    { all++; seconds += $11 / 1e6 }
    $8 == "accepted" { accepted++ }
    $8 == "accepted" && $9 == "inside" { insides++ }
    $8 == "accepted" && ($9 == "hit" || $9 == "near") { meetings++ }
    $9 ~ /^a ray / { rays++ }
    $8 == "refused" { refused++ }
    $8 == "uncovered" { uncovered++ }
    { same = $1 == $7 && ($8 == "uncovered" ? 1 : $2 == $8 && $3 == $9 && $4 == $10 && $6 == $12) }
    $2 == "accepted" && $6 !~ /^[0-9a-f]+$/ { same = 0 }
    !same && $3 ~ /^a plane|^an edge|^two points|^a ray passes/ && $2 == "refused" && ($8 != "refused" || byte($3) < byte($9)) { margin++; same = 1 }
    !same && $3 ~ /^a ray passes/ && $9 ~ /^a ray does not/ && byte($3) == byte($9) { margin++; same = 1 }
    !same { print "formal: " name ": " $0; bad++ }
    END {
      printf "%-24s %6d certificates: both accept %d (meetings %d, inside %d), both refuse %d (rays %d); not covered %d; margin %d; %.1f s\n",
        name, all, accepted, meetings, insides, refused, rays, uncovered, margin, seconds
      exit bad > 0 || margin > 1 + all / 100 || (name !~ /mutants/ && accepted == 0)
    }' || exit 1
}

# The sums that FIPS 180-4 publishes
sum() { test "$(build/referee --sha256 $out/sum.txt)" = $1 || { echo "formal: SHA-256 is not $1"; exit 1; }; }
printf abc >$out/sum.txt
sum ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad
printf abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq >$out/sum.txt
sum 248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1
head -c 1000000 /dev/zero | tr '\0' a >$out/sum.txt
sum cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0

# certify FILE FOLDER CLEARANCE
certify() {
  rm -rf "$2"
  mkdir -p "$2"
  build/svcd check --repeat 1 --clearance "$3" --certificates "$2" "$1" >/dev/null 2>&1
}

for set in $sets; do
  file=$out/$set.txt
  build/problems --set $set --meshes procedural --count ${FORMAL_COUNT:-6} --pool 8 --seed 51 --out $file >/dev/null 2>&1
  for clearance in 0 ${FORMAL_CLEARANCE:-0.02}; do
    name="$set, $clearance"
    certificates=$out/$set.$clearance
    certify $file $certificates $clearance
    compare "$name" $file $certificates $clearance
    rm -rf $certificates.mutants
    python3 formal/mutants.py $file $certificates ${FORMAL_MUTANTS:-30} $certificates.mutants.txt $certificates.mutants
    ! grep -qs '^problem' $certificates.mutants.txt || compare "$name, mutants" $certificates.mutants.txt $certificates.mutants $clearance
  done
done
set=${sets%% *}
for file in $(python3 formal/formats.py $out/$set.txt $out/$set); do
  certify $file ${file%.txt}.certificates 0
  compare "$(basename $file .txt)" $file ${file%.txt}.certificates 0
done
echo "formal: verify and the referee agree"
