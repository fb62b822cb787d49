#!/bin/sh
# Runs fuzz targets side by side, and says of each how many inputs it ran, and, by libFuzzer, how many edges of all were
# reached: run.sh libfuzzer|fuzz SECONDS JOBS SEED TARGET... from the repository's root, after `make` has built them in
# build/libfuzzer or build/fuzz. JOBS processes of each target, with seeds from SEED on. What libFuzzer finds of interest
# is kept in build/fuzz_corpus; what fails, and what was printed, lies in build/fuzz_found. Ends with 1 if anything fails.
set -u
kind=$1 seconds=$2 jobs=$3 seed=$4
shift 4
found=build/fuzz_found
mkdir -p $found
one() {  # target, seed
  log=$found/$1_$2.txt
  if test "$kind" = libfuzzer; then
    mkdir -p "build/fuzz_corpus/$1"
    build/libfuzzer/"$1" -max_total_time="$seconds" -seed="$2" -max_len=8192 -timeout=60 -print_final_stats=1 \
      -artifact_prefix="$found/$1_$2." "build/fuzz_corpus/$1" "tests/fuzz/corpus/$1" >"$log" 2>&1
  else
    build/fuzz/"$1" --random 1000000000000 "$2" --seconds "$seconds" --out "$found/$1_$2.crash" "tests/fuzz/corpus/$1" \
      >"$log" 2>&1
  fi
  echo $? >"$log.status"
}
for target in "$@"; do
  number=0
  while test $number -lt "$jobs"; do
    one "$target" $((seed + number)) &
    number=$((number + 1))
  done
done
wait

failed=0
for target in "$@"; do
  number=0
  while test $number -lt "$jobs"; do
    log=$found/${target}_$((seed + number)).txt
    number=$((number + 1))
    if test "$(cat "$log.status")" != 0; then
      echo "$target: FAILED, see $log: $(grep -m 1 -E 'ERROR|runtime error|FUZZ_CHECK' "$log")"
      failed=1
    elif test "$kind" = libfuzzer; then
      runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
      edges=$(grep -o 'cov: [0-9]*' "$log" | tail -1 | cut -d' ' -f2)
      all=$(sed -n 's/.*modules *(\([0-9]*\) inline 8-bit counters).*/\1/p' "$log")
      echo "$target: $runs inputs, $edges of $all edges reached: all well"
    else
      tail -1 "$log"
    fi
  done
done
exit $failed
