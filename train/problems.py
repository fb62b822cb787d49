"""Motions, placements and labels on the GPU: appendix B, with both classes conditioned on the boundary.

Everything is in the frame of the fixed body B; A moves. Two solids overlap where max(sdf_A, sdf_B) < 0, so the label is
the sign of the minimum of that over space and time: found from surface points, then refined by a shrinking random
search. Twice the minimum is the margin (the distance if free, minus the depth if not).
"""
from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor

import shapes
from shapes import gradient

SAMPLES = 33  # poses of a motion; between two: position linear, rotation slerp (examples/FORMATS.md)
SEGMENTS = 16  # of the broad phase: every second pose
PAIRS = 16  # candidates kept per problem


# --------------------------------------------------------------------------------------------------- rotations


def quaternion_exp(w: Tensor) -> Tensor:
    """Rotation vector (..., 3) -> quaternion x y z w."""
    half = 0.5 * w.norm(dim=-1, keepdim=True)
    return torch.cat([w * 0.5 * torch.sinc(half / math.pi), torch.cos(half)], -1)


def quaternion_multiply(a: Tensor, b: Tensor) -> Tensor:
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    return torch.cat([aw * bv + bw * av + torch.linalg.cross(av, bv), aw * bw - (av * bv).sum(-1, keepdim=True)], -1)


def quaternion_log(q: Tensor) -> Tensor:
    q = torch.where(q[..., 3:] < 0, -q, q)
    s = q[..., :3].norm(dim=-1, keepdim=True)
    return q[..., :3] * torch.where(s > 1e-6, 2 * torch.atan2(s, q[..., 3:]) / s.clamp_min(1e-9), 2 * torch.ones_like(s))


def rotate(q: Tensor, v: Tensor) -> Tensor:
    u = 2 * torch.linalg.cross(q[..., :3].expand_as(v), v)
    return v + q[..., 3:] * u + torch.linalg.cross(q[..., :3].expand_as(v), u)


def conjugate(q: Tensor) -> Tensor:
    return torch.cat([-q[..., :3], q[..., 3:]], -1)


def interpolate(poses: Tensor, t: Tensor) -> tuple[Tensor, Tensor]:
    """poses (B, T, 7), t (B, n) -> positions (B, n, 3), quaternions (B, n, 4). Normalised lerp: within 1e-5 of slerp at
    the few degrees between two samples."""
    x = t.clamp(0, 1) * (poses.shape[1] - 1)
    k = x.floor().clamp(max=max(poses.shape[1] - 2, 0)).long()
    w = (x - k)[..., None]
    k2 = (k + 1).clamp_max(poses.shape[1] - 1)
    a, b = (poses.gather(1, i[..., None].expand(-1, -1, 7)) for i in (k, k2))
    b4 = torch.where((a[..., 3:] * b[..., 3:]).sum(-1, keepdim=True) < 0, -b[..., 3:], b[..., 3:])
    return a[..., :3] * (1 - w) + b[..., :3] * w, torch.nn.functional.normalize(a[..., 3:] * (1 - w) + b4 * w, dim=-1)


# ----------------------------------------------------------------------------------------------------- motions


def random_motions(count: int, length: Tensor, angle: Tensor, generator: torch.Generator) -> Tensor:
    """length (count,) metres, angle (count,) radians -> poses (count, SAMPLES, 7) with the middle of the path at the origin.
    A cubic Bezier curve of the given length; rotation about a slowly turning axis; uniform start orientation."""
    device = length.device
    n = lambda *s: torch.randn(*s, generator=generator, device=device)
    control = torch.cumsum(n(count, 1, 3) + 0.8 * n(count, 4, 3), 1)
    t = torch.linspace(0, 1, SAMPLES, device=device)
    bernstein = torch.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3], -1)
    path = torch.einsum("tk,bkc->btc", bernstein, control)
    path = path - path[:, SAMPLES // 2 : SAMPLES // 2 + 1]
    path = path * (length / (path[:, 1:] - path[:, :-1]).norm(dim=-1).sum(1).clamp_min(1e-6))[:, None, None]
    axis = torch.nn.functional.normalize(n(count, 1, 3), dim=-1) + 0.4 * n(count, 1, 3) * t[None, :, None]
    turn = torch.nn.functional.normalize(axis, dim=-1) * (angle[:, None] * t)[..., None]
    start = torch.nn.functional.normalize(n(count, 1, 4), dim=-1).expand(-1, SAMPLES, -1)
    return torch.cat([path, quaternion_multiply(quaternion_exp(turn), start)], -1)


# ------------------------------------------------------------------------------------------------------ labels


@dataclass
class Solids:
    """Unit shapes (largest extent 1, bounding box about the origin), with surface points in 32 spatial groups."""
    parts: Tensor  # (S, PRIMITIVES, PARAMETERS)
    centre: Tensor  # (S, 3) of the raw shape
    scale: Tensor  # (S,) raw -> unit
    groups: Tensor  # (S, 32, G, 3) unit
    extent: Tensor  # (S, 3) of the unit shape's bounding box
    kernels: object = None  # the module kernels, on a GPU

    def sdf(self, shape: Tensor, size: Tensor, p: Tensor) -> Tensor:
        """shape, size (B,), p (B, n, 3) metres, body frame -> (B, n) metres."""
        k = (size * self.scale[shape])[:, None]
        return k * (self.kernels or shapes).sdf(self.parts[shape], p / k[..., None] + self.centre[shape][:, None])


@dataclass
class Problems:
    moving: Tensor  # (B,) shape
    moving_size: Tensor  # (B,) metres
    fixed: Tensor
    fixed_size: Tensor
    poses: Tensor  # (B, SAMPLES, 7)

    def __getitem__(self, i):
        return Problems(self.moving[i], self.moving_size[i], self.fixed[i], self.fixed_size[i], self.poses[i])


INTO_FIXED, INTO_MOVING, OVERLAP = 0, 1, 2


def probe(solids: Solids, q: Problems, x: Tensor, t: Tensor, kind: int) -> Tensor:
    """x (B, n, 3), t (B, n) or (B, 1) -> (B, n). INTO_FIXED: x in A's frame, sdf of B. INTO_MOVING: x in B's frame, sdf of A.
    OVERLAP: x in B's frame, the greater of both."""
    if solids.kernels:
        return solids.kernels.probe(solids, q, x, t, kind)
    position, rotation = interpolate(q.poses, t)
    if kind == INTO_FIXED:
        return solids.sdf(q.fixed, q.fixed_size, position + rotate(rotation, x))
    d = solids.sdf(q.moving, q.moving_size, rotate(conjugate(rotation), x - position))
    return d if kind == INTO_MOVING else torch.maximum(d, solids.sdf(q.fixed, q.fixed_size, x))


def coarse(solids: Solids, q: Problems, times: int, per_group: int, keep: int) -> tuple[Tensor, Tensor, Tensor]:
    """Surface points of each body in the other: the best `keep` of the 32 groups, each way.
    -> x (B, 2 keep, 3) in B's frame, t, value."""
    b, device = len(q.moving), q.poses.device
    out = []
    for own, size, kind in ((q.moving, q.moving_size, INTO_FIXED), (q.fixed, q.fixed_size, INTO_MOVING)):
        g = (solids.groups[own][:, :, :per_group] * size[:, None, None, None]).flatten(1, 2)  # (B, 32 per_group, 3)
        best = torch.full((b, 32), 1e9, device=device)
        best_i = torch.zeros(b, 32, dtype=torch.long, device=device)
        best_t = torch.zeros(b, 32, device=device)
        for k in range(times):
            t = torch.full((b, 1), k / (times - 1), device=device)
            value, i = probe(solids, q, g, t, kind).view(b, 32, per_group).min(-1)
            better = value < best
            best, best_i, best_t = torch.where(better, value, best), torch.where(better, i, best_i), torch.where(better, t, best_t)
        value, group = best.topk(keep, largest=False)
        index = group * per_group + best_i.gather(1, group)
        x, t = g.gather(1, index[..., None].expand(-1, -1, 3)), best_t.gather(1, group)
        if kind == INTO_FIXED:
            position, rotation = interpolate(q.poses, t)
            x = position + rotate(rotation, x)
        out.append((x, t, value))
    return tuple(torch.cat(z, 1) for z in zip(*out))


def refine(solids: Solids, q: Problems, x: Tensor, t: Tensor, spacing: Tensor, generator: torch.Generator,
           rounds: int = 14, tries: int = 24) -> tuple[Tensor, Tensor, Tensor]:
    """Minimise max(sdf_A, sdf_B) about each candidate by a shrinking random search -> x (B, 3), t (B,), margin (B,)."""
    b, m = t.shape
    value = probe(solids, q, x, t, OVERLAP)
    sigma_t = 0.7 / (SAMPLES - 1)
    for k in range(rounds):
        shrink = 0.66 ** k
        dx = torch.randn(b, m, tries, 3, generator=generator, device=x.device) * (spacing[:, None, None, None] * shrink)
        dt = torch.randn(b, m, tries, generator=generator, device=x.device) * (sigma_t * shrink)
        trial_x = (x[:, :, None] + dx).view(b, -1, 3)
        trial_t = (t[:, :, None] + dt).view(b, -1).clamp(0, 1)
        trial = probe(solids, q, trial_x, trial_t, OVERLAP).view(b, m, tries)
        best, i = trial.min(-1)
        better = best < value
        value = torch.where(better, best, value)
        pick = i[..., None]
        x = torch.where(better[..., None], trial_x.view(b, m, tries, 3).gather(2, pick[..., None].expand(-1, -1, 1, 3))[:, :, 0], x)
        t = torch.where(better, trial_t.view(b, m, tries).gather(2, pick)[..., 0], t)
    value, i = value.min(1)
    return x.gather(1, i[:, None, None].expand(-1, 1, 3))[:, 0], t.gather(1, i[:, None])[:, 0], 2 * value


def closest(solids: Solids, q: Problems, generator: torch.Generator, times: int = 17, per_group: int = 24, keep: int = 4,
            rounds: int = 14) -> tuple[Tensor, Tensor, Tensor]:
    x, t, _ = coarse(solids, q, times, per_group, keep)
    spacing = 0.04 * torch.minimum(q.moving_size, q.fixed_size).clamp_min(0.05)
    return refine(solids, q, x, t, spacing, generator, rounds)


def shifted(q: Problems, v: Tensor) -> Problems:
    """Moves the fixed body by v (B, 3): in its own frame the motion goes the other way."""
    poses = q.poses.clone()
    poses[..., :3] -= v[:, None]
    return Problems(q.moving, q.moving_size, q.fixed, q.fixed_size, poses)


def outward(solids: Solids, q: Problems, x: Tensor) -> Tensor:
    """Unit normal of B at x: the direction from B towards A near contact."""
    f = lambda p: solids.sdf(q.fixed, q.fixed_size, p)
    return torch.nn.functional.normalize(gradient(f, x[:, None], 2e-4)[:, 0], dim=-1, eps=1e-6)


@torch.no_grad()
def place(solids: Solids, q: Problems, reach: Tensor, epsilon: Tensor, generator: torch.Generator,
          literal: bool = False) -> tuple[Problems, Tensor]:
    """Appendix B, conditioned: offset B at random (within `reach` (B, 3) of the path, then further out) until it is free;
    bring it back by the shortest vector until the bodies just touch; then go on by epsilon. -> problems, settled (B,)."""
    b, device = len(q.moving), q.poses.device
    if literal:  # one random place, one shift, whatever still touches after it
        q = shifted(q, reach * (2 * torch.rand(b, 3, generator=generator, device=device) - 1))
        x, t, margin = closest(solids, q, generator)
        normal = outward(solids, q, x)
        return shifted(q, normal * (margin + epsilon)[:, None]), normal.norm(dim=-1) > 0.5
    best, best_gap = q, torch.full((b,), -1e9, device=device)
    for k in range(12):
        at = torch.randint(SAMPLES, (b,), generator=generator, device=device)
        on_path = q.poses[torch.arange(b, device=device), at, :3]
        trial = shifted(q, on_path + (1 + 0.12 * k) * reach * (2 * torch.rand(b, 3, generator=generator, device=device) - 1))
        gap = coarse(solids, trial, 9, 8, 1)[2].amin(1)
        # The first free one stays; while none is free, the least deep.
        better = (best_gap < 1e-3) & (gap > best_gap)
        best = Problems(q.moving, q.moving_size, q.fixed, q.fixed_size, torch.where(better[:, None, None], trial.poses, best.poses))
        best_gap = torch.where(better, gap, best_gap)
    q = best
    for _ in range(2):  # push out what still overlaps
        x, t, margin = closest(solids, q, generator, 9, 8, 2, rounds=6)
        push = (-margin + 2e-3).clamp_min(0) * (margin < 0)
        q = shifted(q, -outward(solids, q, x) * push[:, None])
    last = torch.zeros(b, 3, device=device)
    for _ in range(6):  # back by the shortest vector until they touch
        x, t, margin = closest(solids, q, generator)
        last = outward(solids, q, x)
        q = shifted(q, last * margin[:, None])
    x, t, margin = closest(solids, q, generator)
    settled = (margin.abs() < 4e-4) & (outward(solids, q, x).norm(dim=-1) > 0.5)
    return shifted(q, outward(solids, q, x) * epsilon[:, None]), settled


# ------------------------------------------------------------------------------------------------- broad phase


@dataclass
class Pairs:
    moving: Tensor  # (B, PAIRS) patch of A
    fixed: Tensor  # (B, PAIRS)
    enter: Tensor  # (B, PAIRS) time
    leave: Tensor
    valid: Tensor  # (B, PAIRS) bool
    overlapping: Tensor  # (B,) number of pairs of spheres that ever meet


def least_gap(centre_a: Tensor, radius_a: Tensor, centre_b: Tensor, radius_b: Tensor) -> tuple[Tensor, Tensor]:
    """centre_a (B, Na, T, 3) along the motion, centre_b (B, Nb, 3) -> depth (B, Na, Nb) = 1 - least distance / (r + r),
    and the segment of the least distance."""
    least = torch.full(centre_a.shape[:2] + centre_b.shape[1:2], 1e18, device=centre_a.device)
    where = torch.zeros_like(least)
    for k in range(centre_a.shape[2] - 1):
        a, step = centre_a[:, :, k], centre_a[:, :, k + 1] - centre_a[:, :, k]
        dx, dy, dz = (a[:, :, None, c] - centre_b[:, None, :, c] for c in range(3))
        along = dx * step[:, :, None, 0] + dy * step[:, :, None, 1] + dz * step[:, :, None, 2]
        square = (step * step).sum(-1)[:, :, None]
        tau = (-along / square.clamp_min(1e-18)).clamp(0, 1)
        d = dx * dx + dy * dy + dz * dz + tau * (2 * along + tau * square)
        closer = d < least
        least = torch.where(closer, d, least)
        where = torch.where(closer, torch.full_like(where, k), where)
    reach = radius_a[:, :, None] + radius_b[:, None, :]
    return 1 - least.clamp_min(0).sqrt() / reach, where


def broad_phase(poses: Tensor, centre_a: Tensor, radius_a: Tensor, centre_b: Tensor, radius_b: Tensor, kernel=least_gap) -> Pairs:
    """poses (B, T, 7); centres (B, N, 3) metres, body frames; radii (B, N). The PAIRS deepest pairs and their intervals."""
    b, device = poses.shape[0], poses.device
    key = poses[:, :: (poses.shape[1] - 1) // SEGMENTS]  # (B, SEGMENTS + 1, 7)
    path = key[:, None, :, :3] + rotate(key[:, None, :, 3:].expand(-1, centre_a.shape[1], -1, -1),
                                        centre_a[:, :, None].expand(-1, -1, key.shape[1], -1))
    depth, where = kernel(path, radius_a, centre_b, radius_b)
    overlapping = (depth > 0).flatten(1).sum(1)
    flat = depth.flatten(1)
    k = min(PAIRS, flat.shape[1])
    top, index = flat.topk(k, dim=1)
    if k < PAIRS:
        top = torch.cat([top, top.new_full((b, PAIRS - k), -1)], 1)
        index = torch.cat([index, index.new_zeros(b, PAIRS - k)], 1)
    i, j = index // centre_b.shape[1], index % centre_b.shape[1]
    deepest = where.flatten(1).gather(1, index).long()
    pa = path.gather(1, i[..., None, None].expand(-1, -1, *path.shape[2:]))  # (B, K, T, 3)
    d = pa - centre_b.gather(1, j[..., None].expand(-1, -1, 3))[:, :, None]
    reach = radius_a.gather(1, i) + radius_b.gather(1, j)
    start, step = d[:, :, :-1], d[:, :, 1:] - d[:, :, :-1]
    qa, qb = (step * step).sum(-1), (start * step).sum(-1)
    qc = (start * start).sum(-1) - (reach * reach)[..., None]
    root = (qb * qb - qa * qc).clamp_min(0).sqrt()
    still = qa < 1e-18
    lo = torch.where(still, torch.zeros_like(qa), ((-qb - root) / qa.clamp_min(1e-18)).clamp(0, 1))
    hi = torch.where(still, torch.ones_like(qa), ((-qb + root) / qa.clamp_min(1e-18)).clamp(0, 1))
    meets = torch.where(still, qc <= 0, (qb * qb - qa * qc > 0) & ((-qb - root) < qa) & ((-qb + root) > 0))
    # The run of meeting segments about the deepest one, cut into blocks of at most 45 degrees of rotation.
    segment = torch.arange(SEGMENTS, device=device)
    turn = quaternion_log(quaternion_multiply(key[:, 1:, 3:], conjugate(key[:, :-1, 3:]))).norm(dim=-1).amax(1)
    block = (math.pi / 4 / turn.clamp_min(1e-6)).floor().clamp(1, SEGMENTS).long()[:, None]
    miss = ~meets
    before = (miss & (segment < deepest[..., None])).long() * (segment + 1)
    first = before.amax(-1)
    after = torch.where(miss & (segment > deepest[..., None]), segment, torch.full_like(segment, SEGMENTS))
    last = after.amin(-1) - 1
    first = first + (deepest - first).div(block, rounding_mode="floor") * block
    last = torch.minimum(last, first + block - 1)
    enter = (first + lo.gather(2, first[..., None])[..., 0]) / SEGMENTS
    leave = (last + hi.gather(2, last[..., None])[..., 0]) / SEGMENTS
    return Pairs(i, j, enter, torch.maximum(leave, enter), top > 0, overlapping)
