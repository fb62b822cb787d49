"""The training set, made on the device from a seed: solids, their patches at every N, problems with labels, pairs.

A group is 32 bodies (shape and N) and PER_GROUP problems among them, so that one training step encodes 32 bodies once.
"""
from __future__ import annotations

import importlib
import time
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import torch
from torch import Tensor

import problems
import shapes
from patches import COUNTS, Patches, furthest_points, make_patches
from problems import (INTO_FIXED, INTO_MOVING, PAIRS, Problems, Solids, broad_phase, closest, conjugate, interpolate, place, probe,
                      quaternion_log, quaternion_multiply, random_motions, rotate)

GENERAL_N = [512] * 7 + [256] * 7 + [128] * 5 + [64] * 3 + [32] * 2
HOLLOW_N = [512] * 3 + [256] * 3 + [128] * 1 + [64] * 1
GROUP_N = GENERAL_N + HOLLOW_N
PER_GROUP = 1024
PER_PATCH = 32  # points an encoder sees
POOL = 16384


@dataclass
class Geometry:
    """What the decoder is told of K pairs per problem, in the frame of the fixed body at the middle of the interval."""
    p1: Tensor  # (B, K, 3) centre of the moving patch
    p2: Tensor  # (B, K, 3)
    r1: Tensor  # (B, K)
    r2: Tensor  # (B, K)
    q: Tensor  # (B, K, 4) rotation of the moving body
    v: Tensor  # (B, K, 3) half displacement of the point midway between p1 and p2, as part of the moving body
    w: Tensor  # (B, K, 3) half rotation vector

    def map(self, f) -> "Geometry":
        return Geometry(*(f(x) for x in (self.p1, self.p2, self.r1, self.r2, self.q, self.v, self.w)))


def pair_geometry(poses: Tensor, c1: Tensor, c2: Tensor, r1: Tensor, r2: Tensor, enter: Tensor, leave: Tensor) -> Geometry:
    """poses (B, T, 7), c1 (B, K, 3) in the moving body's frame."""
    pe, qe = interpolate(poses, enter)
    pl, ql = interpolate(poses, leave)
    pm, qm = interpolate(poses, 0.5 * (enter + leave))
    p1 = pm + rotate(qm, c1)
    w = 0.5 * quaternion_log(quaternion_multiply(ql, conjugate(qe)))
    v1 = 0.5 * ((pl + rotate(ql, c1)) - (pe + rotate(qe, c1)))
    v = v1 + torch.linalg.cross(w, 0.5 * (c2 - p1))
    return Geometry(p1, c2, r1, r2, qm, v, w)


@dataclass
class Dataset:
    tables: dict[int, Patches]  # by N, over all shapes, unit size
    bodies: Tensor  # (G, 32) shape of each body; its N is GROUP_N
    slack: Tensor  # (G, 32) radii over the samples' radii: the library's cover triangles, so they are a little larger
    slot1: Tensor  # (P, K) patch of the moving body, counted through the group's patches
    slot2: Tensor
    geometry: Geometry
    valid: Tensor  # (P, K)
    target: Tensor  # (P, K) distance of the pair, metres, negative inside
    label: Tensor  # (P,) 0 or 1
    margin: Tensor  # (P,) metres
    weight: Tensor  # (P,) 0 where the label cannot be trusted


def build_solids(maker: shapes.Maker, count: int, families: tuple[str, ...], generator: torch.Generator, device: str, kernels=None,
                 chunk: int = 256) -> tuple[Solids, Tensor, Tensor]:
    raw = maker.solids(count, families).to(device)
    points, normals, ok = [], [], []
    for part in raw.split(chunk):
        p, n, k = shapes.sample_surface(part, POOL, generator, (kernels or shapes).sdf, (kernels or shapes).trace)
        points.append(p), normals.append(n), ok.append(k)
    points, normals, ok = torch.cat(points), torch.cat(normals), torch.cat(ok)
    raw, points, normals = raw[ok], points[ok], normals[ok]
    lo, hi = points.amin(1), points.amax(1)
    centre, scale = 0.5 * (lo + hi), 1 / (hi - lo).amax(-1)
    points = (points - centre[:, None]) * scale[:, None, None]
    coarse = torch.cat([make_patches(p, n, 32, 64, generator).points for p, n in zip(points.split(chunk), normals.split(chunk))])
    return Solids(raw, centre, scale, coarse, (hi - lo) * scale[:, None], kernels), points, normals


def join(a: Solids, b: Solids) -> Solids:
    return Solids(*(torch.cat([getattr(a, k), getattr(b, k)]) for k in ("parts", "centre", "scale", "groups", "extent")), a.kernels)


def draw_problems(solids: Solids, moving: Tensor, fixed: Tensor, kind: Tensor, generator: torch.Generator,
                  literal: bool = False) -> tuple[Problems, Tensor]:
    """kind (B,): 0 standard, 1 hollow, 2 anything -> boundary-conditioned problems, settled (B,)."""
    b, device = len(kind), kind.device
    u = lambda lo, hi: lo + (hi - lo) * torch.rand(b, generator=generator, device=device)
    log = lambda lo, hi: lo * (hi / lo) ** torch.rand(b, generator=generator, device=device)
    choose = lambda s, h, a: torch.where(kind == 0, s, torch.where(kind == 1, h, a))
    size_a = choose(u(0.1, 0.4), u(0.02, 0.12), log(0.02, 0.4))
    size_b = choose(u(0.1, 0.4), u(0.15, 0.4), log(0.05, 0.4))
    length = choose(u(0.1, 0.6), u(0.02, 0.3), log(0.0005, 0.4))
    angle = choose(u(0, 2.1), u(0, 2.1), u(0, 3.1) * (torch.rand(b, generator=generator, device=device) < 0.8))
    pick = torch.rand(b, generator=generator, device=device)
    sigma = torch.where(kind == 0, torch.where(pick < 0.4, 0.032, torch.where(pick < 0.75, 0.010, 0.004)),
                        torch.where(pick < 0.6, 0.010, 0.004))
    if literal:
        sigma = torch.full_like(sigma, 0.032)
    epsilon = sigma * torch.randn(b, generator=generator, device=device)
    poses = random_motions(b, length, angle, generator)
    half_a = 0.5 * solids.extent[moving].amax(-1, keepdim=True) * size_a[:, None]
    reach = 0.5 * solids.extent[fixed] * size_b[:, None] + torch.where(kind == 1, 0.0, 0.4)[:, None] * half_a
    return place(solids, Problems(moving, size_a, fixed, size_b, poses), reach, epsilon, generator, literal)


def pair_targets(solids: Solids, q: Problems, tables: dict[int, Patches], n1: int, n2: int, i: Tensor, j: Tensor,
                 enter: Tensor, leave: Tensor, times: int = 5) -> Tensor:
    """Least implicit distance between the points of patch i and body B, and of patch j and body A, over the interval."""
    b, k = i.shape
    best = torch.full((b, k), 1e9, device=i.device)
    a = tables[n1].points[q.moving[:, None], i] * q.moving_size[:, None, None, None]  # (B, K, P, 3)
    c = tables[n2].points[q.fixed[:, None], j] * q.fixed_size[:, None, None, None]
    spread = lambda x: x[..., None].expand(-1, -1, PER_PATCH).flatten(1)
    for s in torch.linspace(0, 1, times).tolist():
        t = spread(enter + s * (leave - enter))
        d = probe(solids, q, a.flatten(1, 2), t, INTO_FIXED)
        e = probe(solids, q, c.flatten(1, 2), t, INTO_MOVING)
        best = torch.minimum(best, torch.minimum(d, e).view(b, k, -1).amin(-1))
    return best


@torch.no_grad()
def build(seed: int, shape_count: int, groups: int, device: str, log=print, chunk: int = 8192, literal: bool = False) -> Dataset:
    started = time.time()
    generator = torch.Generator(device=device).manual_seed(seed)
    kernels = importlib.import_module("kernels") if device == "cuda" else None
    maker = shapes.Maker(seed)
    hollow_count = shape_count // 4
    general, p1, n1 = build_solids(maker, shape_count - hollow_count, maker.GENERAL, generator, device, kernels)
    hollow, p2, n2 = build_solids(maker, hollow_count, maker.HOLLOW, generator, device, kernels)
    solids, points, normals = join(general, hollow), torch.cat([p1, p2]), torch.cat([n1, n2])
    ng, nh = len(general.scale), len(hollow.scale)
    tables: dict[int, Patches] = {}
    first = torch.cat([furthest_points(p, max(COUNTS)) for p in points.split(1024)])
    for n in COUNTS:
        made = [make_patches(p, m, n, PER_PATCH, generator, f[:, :n]) for p, m, f in zip(points.split(256), normals.split(256), first.split(256))]
        tables[n] = Patches(*(torch.cat([getattr(x, k) for x in made]) for k in ("centre", "radius", "points", "normals", "area")))
    sync = torch.cuda.synchronize if device == "cuda" else (lambda: None)
    sync()
    log(f"{ng} + {nh} solids with patches, {time.time() - started:.0f} s")
    r = lambda hi, *s: torch.randint(hi, s, generator=generator, device=device)
    bodies = torch.cat([r(ng, groups, len(GENERAL_N)), ng + r(nh, groups, len(HOLLOW_N))], 1)
    # Measured on real meshes: with 32 samples per patch the covering radius is 1.19 times the samples', less with more.
    share = torch.tensor(GROUP_N, device=device) * 32 / POOL
    slack = 1 + 0.19 * share.sqrt() + 0.08 * (torch.rand(groups, 32, generator=generator, device=device) - 0.5)
    total = groups * PER_GROUP
    group = torch.arange(total, device=device) // PER_GROUP
    dice = torch.rand(total, generator=generator, device=device)
    kind = torch.where(dice < 0.5, 0, torch.where(dice < 0.82, 1, 2))
    body1 = r(32, total)
    body2 = torch.where(kind == 1, 24 + r(8, total), r(32, total))
    moving, fixed = bodies[group, body1], bodies[group, body2]
    base = torch.tensor([0] + GROUP_N, device=device).cumsum(0)
    count = torch.tensor(GROUP_N, device=device)
    poses = torch.empty(total, 33, 7, device=device)
    f = lambda: torch.empty(total, device=device)
    size1, size2, margin, weight = f(), f(), f(), f()
    witness, moment = torch.empty(total, 3, device=device), f()
    for a in range(0, total, chunk):
        s = slice(a, min(a + chunk, total))
        q, settled = draw_problems(solids, moving[s], fixed[s], kind[s], generator, literal)
        x, t, m = closest(solids, q, generator, times=33, per_group=64, keep=6)
        poses[s], size1[s], size2[s], margin[s], witness[s], moment[s] = q.poses, q.moving_size, q.fixed_size, m, x, t
        weight[s] = (settled & (m.abs() > 1e-4)).float()
    log(f"{total} problems, {100 * weight.mean():.1f} % settled, {100 * (margin < 0).float().mean():.1f} % collide, {time.time() - started:.0f} s")
    k = PAIRS
    full = lambda *shape, dtype=torch.float32: torch.zeros(total, k, *shape, device=device, dtype=dtype)
    slot1, slot2, valid, target = full(dtype=torch.long), full(dtype=torch.long), full(dtype=torch.bool), full()
    geometry = Geometry(full(3), full(3), full(), full(), full(4), full(3), full(3))
    found = torch.zeros(total, device=device)
    for n1 in COUNTS:
        for n2 in COUNTS:
            rows = ((count[body1] == n1) & (count[body2] == n2)).nonzero()[:, 0]
            for s in rows.split(max(64, min(4096, 2 ** 26 // (n1 * n2)))):
                q = Problems(moving[s], size1[s], fixed[s], size2[s], poses[s])
                ca, ra = tables[n1].centre[q.moving] * q.moving_size[:, None, None], tables[n1].radius[q.moving] * q.moving_size[:, None]
                cb, rb = tables[n2].centre[q.fixed] * q.fixed_size[:, None, None], tables[n2].radius[q.fixed] * q.fixed_size[:, None]
                ra, rb = ra * slack[group[s], body1[s], None], rb * slack[group[s], body2[s], None]
                pairs = broad_phase(q.poses, ca, ra, cb, rb, (kernels or problems).least_gap)
                pick = lambda x, i: x.gather(1, i[..., None].expand(-1, -1, 3)) if x.dim() == 3 else x.gather(1, i)
                g = pair_geometry(q.poses, pick(ca, pairs.moving), pick(cb, pairs.fixed), pick(ra, pairs.moving), pick(rb, pairs.fixed),
                                  pairs.enter, pairs.leave)
                d = pair_targets(solids, q, tables, n1, n2, pairs.moving, pairs.fixed, pairs.enter, pairs.leave)
                # The refined witness belongs to the pair of patches that own its two surface points.
                position, rotation = interpolate(q.poses, moment[s][:, None])
                local = rotate(conjugate(rotation), witness[s][:, None] - position)
                own1 = torch.cdist(local, ca)[:, 0].argmin(-1)
                own2 = torch.cdist(witness[s][:, None], cb)[:, 0].argmin(-1)
                owner = (pairs.moving == own1[:, None]) & (pairs.fixed == own2[:, None]) & pairs.valid
                d = torch.where(owner, torch.minimum(d, margin[s][:, None].expand_as(d)), d)
                d = torch.where((margin[s] > 0)[:, None], torch.maximum(d, margin[s][:, None]), d)
                found[s] = owner.any(1).float()
                slot1[s], slot2[s] = base[body1[s]][:, None] + pairs.moving, base[body2[s]][:, None] + pairs.fixed
                valid[s], target[s] = pairs.valid, d
                for name in ("p1", "p2", "r1", "r2", "q", "v", "w"):
                    getattr(geometry, name)[s] = getattr(g, name)
    weight = weight * valid.any(1)
    if literal:  # balanced, as by rejection
        share = (weight * (margin < 0)).sum() / weight.sum()
        weight = weight * torch.where(margin < 0, 0.5 / share, 0.5 / (1 - share))
    shallow = (margin < 0) & (margin > -0.01) & (weight > 0)
    log(f"pairs done; touching pair among the {k}: {100 * found[shallow].mean():.1f} % of shallow contacts; {time.time() - started:.0f} s")
    return Dataset(tables, bodies, slack, slot1, slot2, geometry, valid, target, (margin < 0).float(), margin, weight)


def group_patches(data: Dataset, g: int) -> tuple[Tensor, Tensor]:
    """All patches of a group's 32 bodies: u (sum N, P, 3) about the centre over the radius, normals (sum N, P, 3)."""
    us, ns, body = [], [], 0
    for n, run in groupby(GROUP_N):
        k = len(list(run))
        shape, table = data.bodies[g, body : body + k], data.tables[n]
        radius = table.radius[shape] * data.slack[g, body : body + k, None]
        us.append(((table.points[shape] - table.centre[shape][:, :, None]) / radius.clamp_min(1e-6)[..., None, None]).clamp(-1, 1).flatten(0, 1))
        ns.append(table.normals[shape].flatten(0, 1))
        body += k
    return torch.cat(us), torch.cat(ns)


def cached(path: Path | None, make, log=print) -> Dataset:
    """make() once for all processes that name the same file: the first writes it, the others wait for it."""
    if path is None:
        return make()
    try:
        path.with_suffix(".lock").touch(exist_ok=False)
    except FileExistsError:
        while not path.exists():
            time.sleep(1)
        made = torch.load(path, map_location="cuda" if torch.cuda.is_available() else "cpu", weights_only=False)
        log(f"read {path}")
        return made
    made = make()
    torch.save(made, path.with_suffix(".part"))
    path.with_suffix(".part").rename(path)
    log(f"wrote {path}")
    return made
