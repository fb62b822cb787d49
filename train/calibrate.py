"""Thresholds of every head, on labelled problems that the library itself has answered.

Usage: calibrate.py CHECKPOINT SVCD PROBLEMS... - runs `svcd check` (built with thresholds of zero) for each head and N at the
default K, and writes into the checkpoint: the threshold at which misses and false alarms are equally frequent,
and those that keep at least 99, 99.9 and 99.99 % of the collisions, or, where planes parted so many that none does, all
that are left. Each recall is asked for, since patches swell by it. Certified and inside answers are not the network's to move.
"""
from __future__ import annotations

import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import torch

from export import HEADS, RECALLS, SIZES

CERTAIN = 50.0  # |logit| above this is not the network's


def answers(svcd: str, head: str, points: int, recall: float, path: Path) -> tuple[list[float], list[int]]:
    labels = {}
    for line in path.read_text().splitlines():
        w = line.split()
        if w[:1] == ["problem"]:
            labels[w[1]] = int(w[13])
    command = [svcd, "check", "--method", "network", "--repeat", "1", "--points", str(points), "--model", head,
               "--recall", str(recall), str(path)]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    rows = [line.split("\t") for line in out.splitlines() if line and not line.startswith(("#", "id", "ID"))]
    return [float(r[1]) for r in rows], [labels[r[0]] for r in rows]


def sides(answered: tuple[list[float], list[int]]) -> tuple[list[float], list[float]]:
    """Logits of collisions and of free motions, in order."""
    logits, labels = answered
    return sorted(v for v, k in zip(logits, labels) if k == 1), sorted(v for v, k in zip(logits, labels) if k == 0)


def thresholds(by_recall: list[tuple[list[float], list[int]]]) -> list[float]:
    """by_recall: logits and labels for each of RECALLS."""
    hit, free = sides(by_recall[0])
    grid = sorted({v for v in hit + free if abs(v) < CERTAIN})
    def gap(t: float) -> float:
        return abs(sum(v <= t for v in hit) / len(hit) - sum(v > t for v in free) / len(free))
    coarse = grid[:: max(1, len(grid) // 400)]
    out = [min(coarse, key=gap)]
    for r, answered in zip(RECALLS[1:], by_recall[1:]):
        hit, _ = sides(answered)
        seen = [v for v in hit if v > -CERTAIN]
        lost = len(hit) - len(seen)
        least = seen[max(0, min(len(hit) - 1, math.floor((1 - r) * len(hit))) - lost)]
        out.append(min(out[-1], least - 1e-4))  # a greater recall must not find less
    return out


def main() -> None:
    path, svcd = Path(sys.argv[1]), sys.argv[2]
    saved = torch.load(path, map_location="cpu")
    table = []
    pool = ThreadPoolExecutor(os.cpu_count())
    for head in HEADS:
        table.append([])
        for points in SIZES:
            asked = [(recall, Path(name)) for recall in RECALLS for name in sys.argv[3:]]
            told = pool.map(lambda ask: answers(svcd, head, points, *ask), asked)
            by_recall = [([], []) for _ in RECALLS]
            for (recall, _), (logits, labels) in zip(asked, told):
                by_recall[RECALLS.index(recall)][0].extend(logits)
                by_recall[RECALLS.index(recall)][1].extend(labels)
            row = thresholds(by_recall)
            pairs = [sides(answered) for answered in by_recall]
            share = lambda values, t: 100 * sum(v > t for v in values) / len(values)
            print(f"{head:5} N {points:3} thresholds", " ".join(f"{t:+.3f}" for t in row),
                  "found %", " ".join(f"{share(hit, t):.2f}" for (hit, _), t in zip(pairs, row)),
                  "false alarms %", " ".join(f"{share(free, t):.2f}" for (_, free), t in zip(pairs, row)), flush=True)
            table[-1].append(row)
    saved["thresholds"] = table
    torch.save(saved, path)


if __name__ == "__main__":
    main()
