#!/usr/bin/env python3
"""What a question costs from Python: one by one, in a batch, and in batches on threads. Motions of a mug about a dish
rack; of each figure the best of 50 runs.

    examples/python/overhead.py [MOTIONS]     after `make python`
"""
import os
import sys
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import neuralsvcd as nsvcd

ASSETS = Path(__file__).resolve().parent.parent / "assets"
COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
POSES = 9


def best(run: Callable[[], object]) -> float:
    """Seconds."""
    times = []
    for _ in range(50):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times)


def motions(distance: float) -> np.ndarray:
    """(COUNT, POSES, 7): straight lines and turns, past points as far from the rack as said."""
    random = np.random.default_rng(1)
    start, end = random.normal(0, 0.2, (2, COUNT, 1, 3))
    t = np.linspace(0, 1, POSES)[None, :, None]
    angle = random.uniform(0, 2, (COUNT, 1, 1)) * t
    poses = np.zeros((COUNT, POSES, 7), np.float32)
    poses[:, :, :3] = start + t * (end - start) + [0, 0, distance]
    poses[:, :, 5:6] = np.sin(angle / 2)
    poses[:, :, 6:7] = np.cos(angle / 2)
    return poses


def main() -> None:
    mug, rack = (nsvcd.Body(ASSETS / name) for name in ("mug.obj", "dish_rack.obj"))
    threads = os.cpu_count() or 1
    print(f"us a question; {COUNT} motions of {POSES} poses    sweep  sweep_batch  overhead  on {threads} threads")
    for name, distance in (("about the rack", 0.1), ("far above it", 10)):
        paths = motions(distance)
        parts = np.array_split(paths, 8 * threads)
        single = best(lambda: deque((nsvcd.sweep(mug, rack, path) for path in paths), maxlen=0))
        batch = best(lambda: nsvcd.sweep_batch(mug, rack, paths))
        with ThreadPoolExecutor(threads) as pool:
            shared = best(lambda: list(pool.map(lambda part: nsvcd.sweep_batch(mug, rack, part), parts)))
        figures = [1e6 * seconds / COUNT for seconds in (single, batch, single - batch, shared)]
        print(f"{name:44}" + "{:9.2f}{:13.2f}{:10.2f}{:14.2f}".format(*figures))


if __name__ == "__main__":
    main()
