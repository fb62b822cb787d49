#!/usr/bin/env python3
"""What a question costs from Python, in microseconds: one by one, and all in one call, on one thread and on all; of that call,
what is spent in the library's nsvcd_sweep_batch. Motions of a mug about a dish rack; of each figure the best of 20 runs.

    examples/python/overhead.py [MOTIONS]     after `make python`
"""
import os
import sys
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path

import numpy as np

import neuralsvcd as nsvcd

ASSETS = Path(__file__).resolve().parent.parent / "assets"
COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 10000
POSES = 9


def best(run: Callable[[], object]) -> float:
    """Seconds."""
    times = []
    for _ in range(20):
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


class Timed:
    """A function of the library's, and how long its fastest call took."""

    def __init__(self, function: Callable[..., int]) -> None:
        self.function = function
        self.least = float("inf")

    def __call__(self, *arguments: object) -> int:
        start = time.perf_counter()
        code = self.function(*arguments)
        self.least = min(self.least, time.perf_counter() - start)
        return code


def main() -> None:
    library = nsvcd._library._library
    mug, rack = (nsvcd.Body(ASSETS / name) for name in ("mug.obj", "dish_rack.obj"))
    threads = os.cpu_count() or 1
    print(f"{COUNT} motions of {POSES} poses    one by one  in one call   of it in C  on {threads} threads")
    for name, distance in (("about the rack", 0.1), ("far above it", 10)):
        paths = motions(distance)
        single = best(lambda: deque((nsvcd.sweep(mug, rack, path) for path in paths), maxlen=0))
        plain = library.nsvcd_sweep_batch
        library.nsvcd_sweep_batch = timed = Timed(plain)
        batch = best(lambda: nsvcd.sweep(mug, rack, paths))
        library.nsvcd_sweep_batch = plain
        shared = best(lambda: nsvcd.sweep(mug, rack, paths, threads=threads))
        print(f"{name:28}" + "{:12.2f}{:13.2f}{:14.2f}{:14.2f}".format(
            *(1e6 * seconds / COUNT for seconds in (single, batch, timed.least, shared))))


if __name__ == "__main__":
    main()
