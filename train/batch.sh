#!/bin/bash
# One call on the device: every line of BATCH_FILE is a name and the arguments of train.py; all run side by side on the
# visible GPUs, in turn. Usage: batch.sh OUT SECONDS BATCH_FILE [MORE ARGUMENTS FOR ALL]
set -u
out=$1 seconds=$2 file=$3 gpus=$(nvidia-smi -L | wc -l) k=0
shift 3
while read -r name arguments; do
  [ -n "$name" ] || continue
  mkdir -p "$out/$name"
  echo "$arguments" | CUDA_VISIBLE_DEVICES=$((k % gpus)) timeout $((seconds + 85)) xargs \
    python3 -W ignore train.py --out "$out/$name" --real ../.data --steps 1000000 --seconds "$seconds" "${@}" > "$out/$name.txt" 2>&1 &
  k=$((k + 1))
done < "$file"
wait
for f in "$out"/*.txt; do echo "== $f"; grep -E "ms/step|K=8|Error|rror:" "$f" | tail -16 | cut -c10-135; done
(cd "$out" && tar czf all.tgz -- */ *.txt && rm -r -- */ *.txt)  # the device returns few files
