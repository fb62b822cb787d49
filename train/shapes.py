"""Procedural solids as implicit functions, evaluated in batches on the GPU.

A solid is a sequence of up to PRIMITIVES parts. A part is one rounded box in Cartesian or in cylindrical coordinates
(so: boxes, plates, capsules, cylinders, tubes, rings, tori, cones, pyramids), under an affine map, optionally hollowed
to a shell and cut by two half-spaces. Parts are joined, hard or smoothly, or subtracted, in order. The sign of the
result is exact; its magnitude never exceeds the distance to the surface, which is all that labels need.
"""
from __future__ import annotations

import math
import random
from dataclasses import dataclass, field

import torch
from torch import Tensor

PRIMITIVES = 12
PARAMETERS = 32
FAR = 1e3

# Columns of a part's parameters.
M, C, LIP, MODE, RING, HALF, ROUND, TAPER, SHELL, CUTS, OP, SMOOTH, COUNT = 0, 9, 12, 13, 14, 15, 18, 19, 20, 21, 29, 30, 31
UNION, SUBTRACT = 0.0, 1.0


@dataclass
class Part:
    half: tuple[float, float, float]
    at: tuple[float, float, float] = (0, 0, 0)
    rotation: list[list[float]] | None = None
    stretch: tuple[float, float, float] = (1, 1, 1)
    revolve: bool = False  # half = (width, -, height) around a ring of radius `ring`
    ring: float = 0.0
    round: float = 0.0
    taper: float = 0.0  # the cross-section shrinks by this share from the bottom to the top
    shell: float = 0.0
    cuts: list[tuple[float, float, float, float]] = field(default_factory=list)  # n, o: keep n.p <= o
    op: float = UNION
    smooth: float = 0.0

    def row(self) -> list[float]:
        r = self.rotation or [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
        m = [r[j][i] / self.stretch[i] for i in range(3) for j in range(3)]  # world -> part: R^T, then stretch
        slope = abs(self.taper) * max(self.half[0], 0 if self.revolve else self.half[1]) / max(2 * self.half[2], 1e-6)
        lipschitz = min(self.stretch) / math.sqrt(1 + slope * slope)
        cuts = [v for c in (self.cuts + [(0, 0, 0, FAR)] * 2)[:2] for v in c]
        return [*m, *self.at, lipschitz, float(self.revolve), self.ring, *self.half, self.round, self.taper, self.shell,
                *cuts, self.op, self.smooth, 0.0]


def sdf(part: Tensor, p: Tensor) -> Tensor:
    """part (B, PRIMITIVES, PARAMETERS), p (B, n, 3) -> (B, n), negative inside."""
    total = torch.full_like(p[..., 0], FAR)
    for i in range(PRIMITIVES):
        a = part[:, i, :, None]  # (B, PARAMETERS, 1)
        x, y, z = (p[..., k] - a[:, C + k] for k in range(3))
        qx = a[:, M] * x + a[:, M + 1] * y + a[:, M + 2] * z
        qy = a[:, M + 3] * x + a[:, M + 4] * y + a[:, M + 5] * z
        qz = a[:, M + 6] * x + a[:, M + 7] * y + a[:, M + 8] * z
        revolve = a[:, MODE] > 0.5
        rho = torch.sqrt(qx * qx + qy * qy + 1e-18) - a[:, RING]
        ux, uy = torch.where(revolve, rho, qx).abs(), torch.where(revolve, torch.zeros_like(qy), qy.abs())
        narrow = 1 - 0.5 * a[:, TAPER] * (1 + (qz / a[:, HALF + 2].clamp_min(1e-6)).clamp(-1, 1))
        hx = a[:, HALF] * narrow
        hy = torch.where(revolve, torch.full_like(qy, FAR), a[:, HALF + 1] * narrow)
        dx, dy, dz = ux - hx, uy - hy, qz.abs() - a[:, HALF + 2]
        outside = torch.sqrt(dx.clamp_min(0) ** 2 + dy.clamp_min(0) ** 2 + dz.clamp_min(0) ** 2 + 1e-18)
        inside = torch.maximum(torch.maximum(dx, dy), dz).clamp_max(0)
        d = outside + inside - a[:, ROUND]
        d = torch.where(a[:, SHELL] > 0, d.abs() - a[:, SHELL], d)
        for c in (CUTS, CUTS + 4):
            d = torch.maximum(d, a[:, c] * qx + a[:, c + 1] * qy + a[:, c + 2] * qz - a[:, c + 3])
        d = d * a[:, LIP]
        k = a[:, SMOOTH].clamp_min(1e-6)
        h = (1 - (total - d).abs() / k).clamp_min(0)
        joined = torch.minimum(total, d) - 0.25 * k * h * h
        total = torch.where(a[:, OP] > 0.5, torch.maximum(total, -d), joined)
    return total


# ------------------------------------------------------------------------------------------------ random solids


def rotation_about(axis: list[float], angle: float) -> list[list[float]]:
    n = math.sqrt(sum(v * v for v in axis)) or 1.0
    x, y, z = (v / n for v in axis)
    c, s, t = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    return [[t * x * x + c, t * x * y - s * z, t * x * z + s * y], [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
            [t * x * z - s * y, t * y * z + s * x, t * z * z + c]]


class Maker:
    """Random solids, one family per method. Largest extent about 2; normalised afterwards."""

    def __init__(self, seed: int):
        self.r = random.Random(seed)

    def u(self, a: float, b: float) -> float:
        return self.r.uniform(a, b)

    def log(self, a: float, b: float) -> float:
        return math.exp(self.r.uniform(math.log(a), math.log(b)))

    def turn(self) -> list[list[float]]:
        k = self.r.random()
        if k < 0.4:
            return rotation_about([0, 0, 1], 0)
        if k < 0.65:
            return rotation_about(self.r.choice([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), self.r.choice([0.5, 1.0]) * math.pi / 2)
        return rotation_about([self.r.gauss(0, 1) for _ in range(3)], self.u(0, math.pi))

    def cut(self, size: float) -> list[tuple[float, float, float, float]]:
        out = []
        for _ in range(self.r.choice([0, 0, 1, 1, 2])):
            n = [self.r.gauss(0, 1) for _ in range(3)]
            length = math.sqrt(sum(v * v for v in n))
            out.append((*(v / length for v in n), self.u(-0.1, 0.9) * size))
        return out

    def part(self, size: float, at: tuple[float, float, float]) -> Part:
        kind = self.r.choice(["box", "box", "chunk", "chunk", "cylinder", "cone", "capsule", "torus", "ellipsoid", "plate", "rod",
                              "bowl", "ring"])
        s = lambda a=0.25, b=1.0: size * self.log(a, b)
        turn = self.turn()
        if kind == "box":
            return Part((s(), s(), s()), at, turn, round=self.r.choice([0, 0, 0.05 * size]), taper=self.r.choice([0, 0, 0.5]))
        if kind == "chunk":
            return Part((s(0.4), s(0.4), s(0.4)), at, turn, cuts=self.cut(size), taper=self.u(0, 0.6))
        if kind == "cylinder":
            return Part((s(0.2), 0, s(0.1)), at, turn, revolve=True, round=self.r.choice([0, 0, 0.05 * size]))
        if kind == "cone":
            return Part((s(0.3), 0, s(0.3)), at, turn, revolve=True, taper=self.u(0.5, 1))
        if kind == "capsule":
            return Part((0, 0, s()), at, turn, round=s(0.1, 0.4))
        if kind == "torus":
            return Part((0, 0, 0), at, turn, revolve=True, ring=s(0.5), round=s(0.08, 0.35))
        if kind == "ellipsoid":
            return Part((0, 0, 0), at, turn, (self.u(0.4, 1), self.u(0.4, 1), 1), round=s(0.5), cuts=self.cut(size))
        if kind == "plate":
            return Part((s(0.5), s(0.5), s(0.02, 0.1)), at, turn)
        if kind == "rod":
            return Part((s(0.04, 0.12), s(0.04, 0.12), s(0.6)), at, turn)
        if kind == "bowl":
            return Part((0, 0, 0), at, turn, round=s(0.5), shell=s(0.02, 0.08), cuts=[(0, 0, 1, self.u(-0.2, 0.4) * size)])
        ring = s(0.4)
        return Part((ring * self.log(0.05, 0.4), 0, s(0.05, 0.6)), at, turn, revolve=True, ring=ring)

    def composite(self) -> list[Part]:
        n = self.r.choice([1, 1, 2, 2, 3, 4, 5, 6, 8])
        smooth = self.r.choice([0, 0, 0, self.u(0.05, 0.3)])
        spread = self.u(0.3, 0.9)
        parts = []
        for i in range(n):
            at = tuple(self.u(-spread, spread) if i else 0.0 for _ in range(3))
            parts.append(self.part(self.log(0.3, 1.0) if i else self.u(0.5, 1), at))
            parts[-1].smooth = smooth
        for _ in range(self.r.choice([0, 0, 0, 1, 2])):  # holes, slots, notches
            hole = self.part(self.log(0.15, 0.5), tuple(self.u(-0.6, 0.6) for _ in range(3)))
            hole.op = SUBTRACT
            parts.append(hole)
        return parts

    def blocks(self) -> list[Part]:
        """Jagged chunks joined on a grid, as in random_urdfs-like toys."""
        step, parts, at = self.u(0.5, 0.7), [], [0.0, 0.0, 0.0]
        for _ in range(self.r.randint(3, 10)):
            h = [step * self.u(0.4, 0.62) for _ in range(3)]
            tilt = rotation_about([self.r.gauss(0, 1) for _ in range(3)], self.r.choice([0, 0.05, 0.3]) * self.u(0, 1))
            kind = self.r.random()
            if kind < 0.7:
                parts.append(Part(tuple(h), tuple(at), tilt, cuts=self.cut(step * 0.7), taper=self.r.choice([0, 0, self.u(0, 1)])))
            elif kind < 0.85:
                parts.append(Part((h[0], 0, h[2]), tuple(at), self.turn(), revolve=True, taper=self.r.choice([0, self.u(0, 1)])))
            else:
                parts.append(Part((h[0], h[1], 0.2 * h[2]), tuple(at), self.turn()))
            axis = self.r.randrange(3)
            origin = self.r.choice(parts).at
            at = [origin[k] + (self.r.choice([-step, step]) if k == axis else 0) for k in range(3)]
        return parts

    def panel(self) -> list[Part]:
        """Thin frames, doors, windows, brackets."""
        w, h, t = self.u(0.3, 1), self.u(0.3, 1), self.log(0.015, 0.12)
        b = self.u(0.04, 0.2) * min(w, h)
        kind = self.r.randrange(4)
        if kind == 0:
            parts = [Part((w, h, t)), Part((w - b, h - b, 2 * t), op=SUBTRACT)]
        elif kind == 1:
            parts = [Part((w, h, t)), Part((t, h * self.u(0.3, 1), w * self.u(0.3, 1)), (self.r.choice([-1, 0, 1]) * (w - t), 0, w * 0.5))]
        elif kind == 2:
            parts = [Part((w, h, t))]
            for _ in range(self.r.randint(1, 4)):
                parts.append(Part((self.u(0.05, 0.3) * w, 0, 2 * t), (self.u(-w, w), self.u(-h, h), 0), revolve=True, op=SUBTRACT))
        else:
            parts = [Part((w, h, t)), Part((w, t, h * self.u(0.2, 0.8)), (0, h - t, h * 0.4))]
        for _ in range(self.r.randint(0, 3)):  # handles, levers
            parts.append(self.part(self.log(0.1, 0.4), (self.u(-w, w), self.u(-h, h), self.u(-0.1, 0.1))))
        return parts

    def cup(self) -> list[Part]:
        rad, h, t = self.u(0.3, 0.9), self.u(0.3, 1), self.log(0.02, 0.1)
        floor = self.log(0.02, 0.15)
        if self.r.random() < 0.7:
            taper = self.r.choice([0, 0, self.u(-0.5, 0.3)])
            parts = [Part((rad, 0, h), revolve=True, taper=taper),
                     Part((rad - t, 0, h), (0, 0, floor), revolve=True, taper=taper, op=SUBTRACT)]
        else:
            parts = [Part((0, 0, 0), stretch=(1, 1, self.u(0.3, 1)), round=rad, shell=t, cuts=[(0, 0, 1, self.u(-0.3, 0.5) * rad)])]
        if self.r.random() < 0.5:
            turn = rotation_about([1, 0, 0], math.pi / 2)
            parts.insert(0, Part((0, 0, 0), (rad, 0, 0), turn, revolve=True, ring=h * self.u(0.3, 0.6), round=self.u(0.03, 0.09)))
        return parts

    def rack(self) -> list[Part]:
        n, w, d = self.r.randint(3, 5), self.u(0.6, 1), self.u(0.3, 0.8)
        t, h = self.log(0.02, 0.06), self.u(0.3, 0.9)
        parts = [Part((w, t, t), (0, -d, -h), round=0), Part((w, t, t), (0, d, -h))]
        if self.r.random() < 0.5:
            parts = [Part((w, d, t), (0, 0, -h))]
        cylinder = self.r.random() < 0.5
        for i in range(n):
            x = -w + 2 * w * i / (n - 1)
            for y in (-d, d):
                parts.append(Part((0, 0, h), (x, y, 0), round=t) if cylinder else Part((t, t, h), (x, y, 0)))
        return parts[:PRIMITIVES]

    def drawer(self) -> list[Part]:
        w, d, h, t = self.u(0.5, 1), self.u(0.4, 1), self.u(0.2, 0.8), self.log(0.02, 0.1)
        parts = [Part((w, d, h)), Part((w - t, d - t, h), (0, 0, t), op=SUBTRACT)]
        for _ in range(self.r.choice([0, 0, 1, 2])):
            parts.append(Part((t * 0.5, d, h * self.u(0.5, 1)), (self.u(-w, w) * 0.7, 0, 0)) if self.r.random() < 0.5
                         else Part((w, t * 0.5, h * self.u(0.5, 1)), (0, self.u(-d, d) * 0.7, 0)))
        if self.r.random() < 0.5:
            parts.append(Part((w * 0.3, self.u(0.05, 0.15), t), (0, d + 0.05, self.u(-h, h) * 0.5)))
        return parts

    def shelf(self) -> list[Part]:
        w, d, h, t = self.u(0.4, 1), self.u(0.2, 0.6), self.u(0.6, 1), self.log(0.02, 0.08)
        parts = [Part((t, d, h), (-w, 0, 0)), Part((t, d, h), (w, 0, 0))]
        n = self.r.randint(2, 5)
        parts += [Part((w, d, t), (0, 0, -h + t + (2 * h - 2 * t) * i / (n - 1))) for i in range(n)]
        if self.r.random() < 0.5:
            parts.append(Part((w, t * 0.5, h), (0, d, 0)))
        if self.r.random() < 0.3:
            parts.append(Part((t, d, h), (self.u(-w, w) * 0.5, 0, 0)))
        return parts

    def chair(self) -> list[Part]:
        w, d, h, t = self.u(0.3, 0.6), self.u(0.3, 0.6), self.u(0.3, 0.8), self.log(0.03, 0.09)
        seat = Part((w, d, t)) if self.r.random() < 0.7 else Part((w, 0, t), revolve=True)
        parts = [seat]
        lean = self.u(-0.2, 0.2)
        for x in (-1, 1):
            for y in (-1, 1):
                turn = rotation_about([0, 1, 0], lean * x)
                parts.append(Part((t, t, h * 0.5), (x * (w - t), y * (d - t), -h * 0.5), turn) if self.r.random() < 0.8
                             else Part((0, 0, h * 0.5), (x * (w - t), y * (d - t), -h * 0.5), turn, round=t))
        if self.r.random() < 0.6:
            parts.append(Part((w, t, h * 0.5), (0, d - t, h * 0.5)))
        if self.r.random() < 0.4:
            parts.append(Part((w, t * 0.6, t * 0.6), (0, d - t, -h * self.u(0.2, 0.8))))
        return parts

    def tube(self) -> list[Part]:
        parts = []
        for _ in range(self.r.randint(1, 4)):
            ring = self.u(0.3, 0.8)
            at = tuple(self.u(-0.4, 0.4) for _ in range(3))
            if self.r.random() < 0.5:
                parts.append(Part((ring * self.log(0.03, 0.3), 0, self.u(0.1, 1)), at, self.turn(), revolve=True, ring=ring))
            else:
                parts.append(Part((0, 0, 0), at, self.turn(), revolve=True, ring=ring, round=ring * self.log(0.08, 0.4)))
        return parts

    GENERAL = ("composite", "composite", "composite", "composite", "blocks", "blocks", "blocks", "panel", "panel", "cup", "rack",
               "drawer", "chair", "tube")
    HOLLOW = ("cup", "cup", "rack", "drawer", "drawer", "shelf", "shelf", "chair", "tube", "panel")

    def solids(self, count: int, families: tuple[str, ...]) -> Tensor:
        """(count, PRIMITIVES, PARAMETERS); a missing part is a union with something far away."""
        nothing = Part((0, 0, 0), (FAR, FAR, FAR)).row()
        rows = []
        for i in range(count):
            parts = getattr(self, families[i % len(families)])()[:PRIMITIVES]
            rows.append([p.row() for p in parts] + [nothing] * (PRIMITIVES - len(parts)))
            rows[-1][0][COUNT] = len(parts)
        return torch.tensor(rows, dtype=torch.float32)


# -------------------------------------------------------------------------------------------- surface sampling


def gradient(f, p: Tensor, h: float) -> Tensor:
    """Central differences of f at p (..., 3), by the four corners of a tetrahedron."""
    k = torch.tensor([[1, -1, -1], [-1, -1, 1], [-1, 1, -1], [1, 1, 1]], dtype=p.dtype, device=p.device)
    return sum(k[i] * f(p + h * k[i])[..., None] for i in range(4)) / (4 * h)


def trace(part: Tensor, origin: Tensor, direction: Tensor, reach: float, step_floor: float, steps: int, hits: int) -> Tensor:
    """Sphere tracing through all crossings: origin, direction (S, R, 3) -> parameters (S, R, hits), NaN where there are fewer."""
    t = torch.full(origin.shape[:2], -reach, device=origin.device)
    out = torch.full((*origin.shape[:2], hits), float("nan"), device=origin.device)
    found = torch.zeros(origin.shape[:2], dtype=torch.long, device=origin.device)
    d = sdf(part, origin + direction * t[..., None])
    for _ in range(steps):
        t2 = t + d.abs().clamp_min(step_floor) * 0.98
        d2 = sdf(part, origin + direction * t2[..., None])
        crossed = ((d < 0) != (d2 < 0)) & (t2 < reach) & (found < hits)
        i, j = crossed.nonzero(as_tuple=True)
        w = d[i, j] / (d[i, j] - d2[i, j])
        out[i, j, found[i, j]] = t[i, j] * (1 - w) + t2[i, j] * w
        found += crossed
        t, d = t2, d2
    return out


def sample_surface(part: Tensor, count: int, generator: torch.Generator, eval_sdf=sdf, eval_trace=trace) -> tuple[Tensor, Tensor, Tensor]:
    """Points uniform in area: random lines against the surface (Cauchy-Crofton).

    part (S, PRIMITIVES, PARAMETERS) -> points (S, count, 3), normals (S, count, 3), ok (S,) enough distinct points."""
    s, device = part.shape[0], part.device
    reach = 2.2  # every family fits into this ball
    points = torch.zeros(s, count, 3, device=device)
    filled = torch.zeros(s, dtype=torch.long, device=device)
    for _ in range(12):
        todo = (filled < count).nonzero()[:, 0]
        if not len(todo):
            break
        rays = 2 * count
        normal = lambda: torch.randn(len(todo), rays, 3, generator=generator, device=device)
        direction = torch.nn.functional.normalize(normal(), dim=-1)
        offset = torch.nn.functional.normalize(torch.linalg.cross(direction, normal()), dim=-1)
        origin = offset * reach * torch.rand(len(todo), rays, 1, generator=generator, device=device).sqrt()
        t = eval_trace(part[todo], origin, direction, reach, 2e-3, 160, 8)
        i, j, k = t.isfinite().nonzero(as_tuple=True)
        point = origin[i, j] + direction[i, j] * t[i, j, k][:, None]
        order = torch.argsort(i + torch.rand(i.shape, generator=generator, device=device, dtype=torch.float64))  # shuffled within a shape
        i, point = i[order], point[order]
        start = torch.searchsorted(i, torch.arange(len(todo), device=device))
        slot = filled[todo[i]] + torch.arange(len(i), device=device) - start[i]
        keep = slot < count
        points[todo[i[keep]], slot[keep]] = point[keep]
        filled += torch.bincount(todo[i[keep]], minlength=s)
    f = lambda p: eval_sdf(part, p)
    normals = torch.nn.functional.normalize(gradient(f, points, 5e-4), dim=-1)
    for _ in range(2):  # onto the surface
        points = points - (f(points)[..., None] * normals).clamp(-2e-3, 2e-3)
    normals = torch.nn.functional.normalize(gradient(f, points, 5e-4), dim=-1)
    return points, normals, filled >= count
