"""The training set that scenes.c wrote, on the device: patches of all bodies, and groups of problems among some of them."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

BODIES, PROBLEMS, PAIRS, POINTS, FACTS = 40, 1024, 24, 32, 32  # as in scenes.c and task/facts.h


@dataclass
class Batch:
    """The problems of a group, or some of them."""
    slots: Tensor  # (P, K, 2) patches of the group, the larger first; -1: no pair
    turns: Tensor  # (P, K, 2, 3, 3) from the bodies' frames to the pair's
    facts: Tensor  # (P, K, FACTS)
    reach: Tensor  # (P, K) metres, sum of the radii
    nearest: Tensor  # (P,) the pair that owns the nearest points, or -1
    margin: Tensor  # (P,) metres, negative where they hit
    kind: Tensor  # (P,)

    def to(self, dtype: torch.dtype) -> "Batch":
        return Batch(self.slots.long(), self.turns.to(dtype), self.facts.to(dtype), self.reach, self.nearest, self.margin, self.kind)


class Dataset:
    def __init__(self, folder: Path, device: str):
        def read(name: str, dtype: type, *shape: int) -> Tensor:
            array = np.fromfile(folder / name, dtype).reshape(-1, *shape)
            return torch.from_numpy(array).to(device)
        self.first = np.fromfile(folder / "bodies.i32", np.int32).tolist()
        self.points = read("points.i16", np.int16, POINTS, 3)
        self.normals = read("normals.i8", np.int8, POINTS, 3)
        self.groups = np.fromfile(folder / "groups.i32", np.int32).reshape(-1, BODIES).tolist()
        self.all = Batch(read("slots.i32", np.int32, PAIRS, 2), read("turns.f16", np.float16, PAIRS, 2, 3, 3),
                         read("facts.f16", np.float16, PAIRS, FACTS), read("reach.f32", np.float32, PAIRS),
                         read("nearest.i8", np.int8), read("margin.f32", np.float32), read("kind.i8", np.int8))

    def patches(self, g: int) -> tuple[Tensor, Tensor]:
        """Of the group's bodies, one after the other: samples about the centre over the radius, and normals, (N, POINTS, 3)."""
        ranges = [slice(self.first[b], self.first[b + 1]) for b in self.groups[g]]
        points = torch.cat([self.points[r] for r in ranges]).float() / 32767
        return points, torch.nn.functional.normalize(torch.cat([self.normals[r] for r in ranges]).float(), dim=-1)

    def batch(self, g: int) -> Batch:
        s = slice(g * PROBLEMS, (g + 1) * PROBLEMS)
        return Batch(*(getattr(self.all, k)[s] for k in ("slots", "turns", "facts", "reach", "nearest", "margin", "kind"))).to(torch.float32)
