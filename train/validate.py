"""Accuracy on problem files (examples/FORMATS.md), by N and by distance from contact. Same steps as the library."""
from __future__ import annotations

import importlib
import math
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor

from data import PER_PATCH, pair_geometry
from model import Network, quantise
from patches import make_patches
from problems import broad_phase, least_gap

BANDS = (0.0, 0.001, 0.0025, 0.005, 0.010, 0.020, math.inf)


@dataclass
class ProblemFile:
    names: list[str]
    meshes: list[tuple[Tensor, Tensor]]  # vertices (V, 3), triangles (T, 3)
    moving: Tensor  # (B,)
    fixed: Tensor
    size1: Tensor
    size2: Tensor
    poses: Tensor  # (B, T, 7) in the fixed body's frame
    label: Tensor
    margin: Tensor


def load_obj(path: Path) -> tuple[Tensor, Tensor]:
    v, f = [], []
    for line in path.read_text(errors="replace").splitlines():
        w = line.split()
        if w[:1] == ["v"]:
            v.append([float(x) for x in w[1:4]])
        elif w[:1] == ["f"]:
            k = [int(x.split("/")[0]) for x in w[1:]]
            k = [i - 1 if i > 0 else len(v) + i for i in k]
            f += [[k[0], k[i], k[i + 1]] for i in range(1, len(k) - 1)]
    return torch.tensor(v), torch.tensor(f, dtype=torch.long)


def load_problems(path: Path) -> ProblemFile:
    names, meshes, rows = {}, [], []
    lines = iter(path.read_text().splitlines())
    for line in lines:
        w = line.split("#")[0].split()
        if w[:1] == ["mesh"]:
            names[w[1]] = len(meshes)
            meshes.append(load_obj(path.parent / w[2]))
        elif w[:1] == ["problem"]:
            count = int(w[-1])
            rows.append((names[w[2]], float(w[3]), names[w[4]], float(w[5]), [float(x) for x in w[6:13]], int(w[13]), float(w[14]),
                         [[float(x) for x in next(lines).split()] for _ in range(count)]))
    from problems import conjugate, quaternion_multiply, rotate
    pose = torch.tensor([r[4] for r in rows], dtype=torch.float64)[:, None]
    poses = torch.tensor([r[7] for r in rows], dtype=torch.float64)
    back = conjugate(pose[..., 3:])
    local = torch.cat([rotate(back.expand(-1, poses.shape[1], -1), poses[..., :3] - pose[..., :3]),
                       quaternion_multiply(back.expand(-1, poses.shape[1], -1), poses[..., 3:])], -1).float()
    column = lambda k, dtype: torch.tensor([r[k] for r in rows], dtype=dtype)
    return ProblemFile(list(names), meshes, column(0, torch.long), column(2, torch.long), column(1, torch.float32),
                       column(3, torch.float32), local, column(5, torch.float32), column(6, torch.float32))


def sample_mesh(vertices: Tensor, triangles: Tensor, count: int, generator: torch.Generator) -> tuple[Tensor, Tensor]:
    """Stratified by area, as the library does."""
    a, b, c = vertices[triangles].unbind(1)
    cross = torch.linalg.cross(b - a, c - a)
    area = cross.double().norm(dim=-1).cumsum(0)
    at = (torch.arange(count, dtype=torch.float64, device=a.device) + 0.5) / count * area[-1]
    k = torch.searchsorted(area, at).clamp_max(len(area) - 1)
    r = torch.rand(count, 2, generator=generator, device=a.device)
    s = r[:, :1].sqrt()
    return a[k] * (1 - s) + b[k] * (s * (1 - r[:, 1:])) + c[k] * (s * r[:, 1:]), torch.nn.functional.normalize(cross[k], dim=-1)


@torch.no_grad()
def logits(net: Network, f: ProblemFile, n: int, device: str, settings: list[tuple[str, int]], slack: float = 1.187) -> list[Tensor]:
    """Pooled logits of every problem, for each (head, K) of `settings`; the radii are `slack` times the samples'."""
    g = torch.Generator(device=device).manual_seed(1)
    sampled = [sample_mesh(v.to(device), t.to(device), 32 * n, g) for v, t in f.meshes]
    points, normals = (torch.stack([s[k] for s in sampled]) for k in (0, 1))
    latents, centres, radii = [], [], []
    for p, m in zip(points.split(128), normals.split(128)):
        made = make_patches(p, m, n, PER_PATCH, g)
        radius = made.radius * slack
        u = (made.points - made.centre[:, :, None]) / radius.clamp_min(1e-9)[..., None, None]
        latents.append(quantise(net.encoder(u.flatten(0, 1), made.normals.flatten(0, 1))).view(len(p), n, -1))
        centres.append(made.centre), radii.append(radius)
    z, centre, radius = torch.cat(latents), torch.cat(centres), torch.cat(radii)
    kernel = importlib.import_module("kernels").least_gap if device == "cuda" else least_gap
    out: list[list[Tensor]] = [[] for _ in settings]
    for s in torch.arange(len(f.label)).split(max(8, min(2048, 2 ** 25 // (n * n)))):
        m, x, s1, s2, poses = (a[s].to(device) for a in (f.moving, f.fixed, f.size1, f.size2, f.poses))
        ca, ra, cb, rb = centre[m] * s1[:, None, None], radius[m] * s1[:, None], centre[x] * s2[:, None, None], radius[x] * s2[:, None]
        k = broad_phase(poses, ca, ra, cb, rb, kernel)
        pick = lambda a, idx: a.gather(1, idx[..., None].expand(-1, -1, a.shape[2])) if a.dim() == 3 else a.gather(1, idx)
        geometry = pair_geometry(poses, pick(ca, k.moving), pick(cb, k.fixed), pick(ra, k.moving), pick(rb, k.fixed), k.enter, k.leave)
        value = net.decode(pick(z[m], k.moving), pick(z[x], k.fixed), geometry)
        for row, (head, pairs) in zip(out, settings):
            v = value[head][0][:, :pairs]
            row.append(torch.where(k.valid[:, :pairs], v, torch.full_like(v, -30)).amax(1).cpu())
    return [torch.cat(row) for row in out]


def report(name: str, logit: Tensor, label: Tensor, margin: Tensor) -> str:
    """Accuracy, misses and false alarms in per cent at 0 and at the best threshold; then accuracy by |margin|."""
    def rates(t: float) -> tuple[float, float, float]:
        hit = logit > t
        wrong = hit != (label > 0.5)
        return (100 * (1 - wrong.float().mean()).item(), 100 * wrong[label > 0.5].float().mean().item(),
                100 * wrong[label < 0.5].float().mean().item())
    best = max((rates(t / 10)[0], t / 10) for t in range(-60, 61))
    bands = []
    for lo, hi in zip(BANDS, BANDS[1:]):
        k = (margin.abs() >= lo) & (margin.abs() < hi)
        bands.append(f"{100 * ((logit[k] > 0) == (label[k] > 0.5)).float().mean().item():.1f}")
    a, m, fa = rates(0.0)
    return f"{name:24s} {a:6.2f} miss {m:5.2f} alarm {fa:5.2f} | best {best[0]:6.2f} at {best[1]:+.1f} | {' '.join(bands)}"
