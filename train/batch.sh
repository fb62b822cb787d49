#!/bin/bash
# One call on the device: every line of BATCH_FILE is a name and the arguments of train.py; all run side by side on the
# visible GPUs, in turn. Usage: batch.sh OUT SECONDS BATCH_FILE
set -u
out=$1 seconds=$2 gpus=$(nvidia-smi -L | wc -l) k=0
while read -r name arguments; do
  [ -n "$name" ] || continue
  mkdir -p "$out/$name"
  echo "$arguments" | CUDA_VISIBLE_DEVICES=$((k % gpus)) timeout $((seconds + 85)) xargs \
    python3 -W ignore train.py --out "$out/$name" --real ../.data --steps 1000000 --seconds "$seconds" > "$out/$name.txt" 2>&1 &
  k=$((k + 1))
done < "$3"
wait
for f in "$out"/*.txt; do echo "== $f"; tail -45 "$f" | cut -c1-150; rm "$f"; done
