#!/bin/bash
# Several trainings side by side, one per line of a file of arguments to train.py, spread over the GPUs.
# Usage: batch.sh OUT LINES ARGUMENTS... - writes OUT/N/checkpoint.pt and OUT/N/log.txt for line N.
cd "$(dirname "$0")" || exit 1
out=$1 lines=$2
shift 2
gpus=$(nvidia-smi -L | wc -l)
n=0
while read -r line; do
  mkdir -p "$out/$n"
  eval "CUDA_VISIBLE_DEVICES=$((n % gpus)) python3 train.py --out $out/$n $* $line" >"$out/$n/stdout" 2>&1 &
  n=$((n + 1))
done < <(grep -v '^#' "$lines")
wait
tail -n 6 "$out"/*/log.txt
