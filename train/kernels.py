"""The implicit functions of shapes.py as Triton kernels: the same numbers, some hundred times faster. GPU only."""
from __future__ import annotations

import torch
import triton
import triton.language as tl
from torch import Tensor

from shapes import CUTS, FAR, HALF, LIP, MODE, OP, PARAMETERS, RING, ROUND, SHELL, SMOOTH, TAPER, C, COUNT, M

for _name, _value in list(dict(C=C, M=M, LIP=LIP, MODE=MODE, RING=RING, HALF=HALF, ROUND=ROUND, TAPER=TAPER, SHELL=SHELL, CUTS=CUTS, OP=OP,
                               SMOOTH=SMOOTH, COUNT=COUNT, PARAMETERS=PARAMETERS, FAR=FAR).items()):
    globals()["K_" + _name] = tl.constexpr(_value)


@triton.jit
def sdf_at(part, px, py, pz):
    """part: pointer to (PRIMITIVES, PARAMETERS) of one solid; px, py, pz: a block of points."""
    total = px * 0 + K_FAR
    count = tl.load(part + K_COUNT).to(tl.int32)
    for i in range(count):
        a = part + i * K_PARAMETERS
        x = px - tl.load(a + K_C)
        y = py - tl.load(a + K_C + 1)
        z = pz - tl.load(a + K_C + 2)
        qx = tl.load(a + K_M) * x + tl.load(a + K_M + 1) * y + tl.load(a + K_M + 2) * z
        qy = tl.load(a + K_M + 3) * x + tl.load(a + K_M + 4) * y + tl.load(a + K_M + 5) * z
        qz = tl.load(a + K_M + 6) * x + tl.load(a + K_M + 7) * y + tl.load(a + K_M + 8) * z
        revolve = tl.load(a + K_MODE) > 0.5
        rho = tl.sqrt(qx * qx + qy * qy + 1e-18) - tl.load(a + K_RING)
        ux = tl.abs(tl.where(revolve, rho, qx))
        uy = tl.where(revolve, 0.0, tl.abs(qy))
        high = tl.load(a + K_HALF + 2)
        t = qz / tl.maximum(high, 1e-6)
        narrow = 1 - 0.5 * tl.load(a + K_TAPER) * (1 + tl.minimum(tl.maximum(t, -1.0), 1.0))
        dx = ux - tl.load(a + K_HALF) * narrow
        dy = tl.where(revolve, uy - K_FAR, uy - tl.load(a + K_HALF + 1) * narrow)
        dz = tl.abs(qz) - high
        ox = tl.maximum(dx, 0.0)
        oy = tl.maximum(dy, 0.0)
        oz = tl.maximum(dz, 0.0)
        inside = tl.minimum(tl.maximum(tl.maximum(dx, dy), dz), 0.0)
        d = tl.sqrt(ox * ox + oy * oy + oz * oz + 1e-18) + inside - tl.load(a + K_ROUND)
        shell = tl.load(a + K_SHELL)
        d = tl.where(shell > 0, tl.abs(d) - shell, d)
        c = a + K_CUTS
        d = tl.maximum(d, tl.load(c) * qx + tl.load(c + 1) * qy + tl.load(c + 2) * qz - tl.load(c + 3))
        d = tl.maximum(d, tl.load(c + 4) * qx + tl.load(c + 5) * qy + tl.load(c + 6) * qz - tl.load(c + 7))
        d = d * tl.load(a + K_LIP)
        k = tl.maximum(tl.load(a + K_SMOOTH), 1e-6)
        h = tl.maximum(1 - tl.abs(total - d) / k, 0.0)
        joined = tl.minimum(total, d) - 0.25 * k * h * h
        total = tl.where(tl.load(a + K_OP) > 0.5, tl.maximum(total, -d), joined)
    return total


@triton.jit
def sdf_kernel(parts, shape, p, out, n, BLOCK: tl.constexpr):
    b = tl.program_id(1).to(tl.int64)
    j = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    live = j < n
    at = p + (b * n + j) * 3
    part = parts + tl.load(shape + b) * 12 * K_PARAMETERS
    d = sdf_at(part, tl.load(at, live, 0.0), tl.load(at + 1, live, 0.0), tl.load(at + 2, live, 0.0))
    tl.store(out + b * n + j, d, live)


@triton.jit
def unit_sdf(parts, shape, size, raw_centre, raw_scale, b, x, y, z):
    s = tl.load(shape + b)
    k = tl.load(size + b) * tl.load(raw_scale + s)
    c = raw_centre + s * 3
    return k * sdf_at(parts + s * 12 * K_PARAMETERS, x / k + tl.load(c), y / k + tl.load(c + 1), z / k + tl.load(c + 2))


@triton.jit
def probe_kernel(parts, raw_centre, raw_scale, moving, moving_size, fixed, fixed_size, poses, samples, x, t, t_row, t_column, out, n,
                 KIND: tl.constexpr, BLOCK: tl.constexpr):
    b = tl.program_id(1).to(tl.int64)
    j = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    live = j < n
    at = x + (b * n + j) * 3
    x0 = tl.load(at, live, 0.0)
    y0 = tl.load(at + 1, live, 0.0)
    z0 = tl.load(at + 2, live, 0.0)
    time = tl.load(t + b * t_row + j * t_column, live, 0.0)
    f = tl.minimum(tl.maximum(time, 0.0), 1.0) * (samples - 1)
    k = tl.minimum(f.to(tl.int32), samples - 2)
    w = f - k
    base = poses + (b * samples + k) * 7
    px = tl.load(base) * (1 - w) + tl.load(base + 7) * w
    py = tl.load(base + 1) * (1 - w) + tl.load(base + 8) * w
    pz = tl.load(base + 2) * (1 - w) + tl.load(base + 9) * w
    ax, ay, az, aw = tl.load(base + 3), tl.load(base + 4), tl.load(base + 5), tl.load(base + 6)
    bx, by, bz, bw = tl.load(base + 10), tl.load(base + 11), tl.load(base + 12), tl.load(base + 13)
    sign = tl.where(ax * bx + ay * by + az * bz + aw * bw < 0, -w, w)
    qx = ax * (1 - w) + bx * sign
    qy = ay * (1 - w) + by * sign
    qz = az * (1 - w) + bz * sign
    qw = aw * (1 - w) + bw * sign
    r = 1 / tl.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    qx, qy, qz, qw = qx * r, qy * r, qz * r, qw * r
    if KIND > 0:  # into the moving body's frame: the inverse rotation of x - p
        x1, y1, z1 = x0 - px, y0 - py, z0 - pz
        qx, qy, qz = -qx, -qy, -qz
    else:
        x1, y1, z1 = x0, y0, z0
    ux = 2 * (qy * z1 - qz * y1)
    uy = 2 * (qz * x1 - qx * z1)
    uz = 2 * (qx * y1 - qy * x1)
    rx = x1 + qw * ux + qy * uz - qz * uy
    ry = y1 + qw * uy + qz * ux - qx * uz
    rz = z1 + qw * uz + qx * uy - qy * ux
    if KIND == 0:
        d = unit_sdf(parts, fixed, fixed_size, raw_centre, raw_scale, b, rx + px, ry + py, rz + pz)
    else:
        d = unit_sdf(parts, moving, moving_size, raw_centre, raw_scale, b, rx, ry, rz)
        if KIND == 2:
            d = tl.maximum(d, unit_sdf(parts, fixed, fixed_size, raw_centre, raw_scale, b, x0, y0, z0))
    tl.store(out + b * n + j, d, live)


@triton.jit
def trace_kernel(parts, origin, direction, out, n, reach, step_floor, STEPS: tl.constexpr, HITS: tl.constexpr, BLOCK: tl.constexpr):
    b = tl.program_id(1).to(tl.int64)
    j = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    live = j < n
    at = (b * n + j) * 3
    ox, oy, oz = tl.load(origin + at, live, 9.0), tl.load(origin + at + 1, live, 9.0), tl.load(origin + at + 2, live, 9.0)
    vx, vy, vz = tl.load(direction + at, live, 1.0), tl.load(direction + at + 1, live, 0.0), tl.load(direction + at + 2, live, 0.0)
    part = parts + b * 12 * K_PARAMETERS
    t = ox * 0 - reach
    d = sdf_at(part, ox + vx * t, oy + vy * t, oz + vz * t)
    hits = j * 0
    for _ in range(STEPS):
        t2 = t + tl.maximum(tl.abs(d), step_floor) * 0.98
        d2 = sdf_at(part, ox + vx * t2, oy + vy * t2, oz + vz * t2)
        crossed = ((d < 0) != (d2 < 0)) & (t2 < reach) & live & (hits < HITS)
        w = d / tl.where(crossed, d - d2, 1.0)
        tl.store(out + (b * n + j) * HITS + hits, t * (1 - w) + t2 * w, crossed)
        hits = tl.where(crossed, hits + 1, hits)
        t = t2
        d = d2


@triton.jit
def gap_kernel(path, radius_a, centre_b, radius_b, depth, where, na, nb, stamps, BLOCK: tl.constexpr):
    b = tl.program_id(2).to(tl.int64)
    i = tl.program_id(1).to(tl.int64)
    j = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    live = j < nb
    at = centre_b + (b * nb + j) * 3
    cx, cy, cz = tl.load(at, live, 0.0), tl.load(at + 1, live, 0.0), tl.load(at + 2, live, 0.0)
    reach = tl.load(radius_a + b * na + i) + tl.load(radius_b + b * nb + j, live, 1.0)
    least = cx * 0 + 1e18
    which = j * 0
    row = path + (b * na + i) * stamps * 3
    for k in range(stamps - 1):
        ax, ay, az = tl.load(row + 3 * k), tl.load(row + 3 * k + 1), tl.load(row + 3 * k + 2)
        sx, sy, sz = tl.load(row + 3 * k + 3) - ax, tl.load(row + 3 * k + 4) - ay, tl.load(row + 3 * k + 5) - az
        dx, dy, dz = ax - cx, ay - cy, az - cz
        along = dx * sx + dy * sy + dz * sz
        square = sx * sx + sy * sy + sz * sz
        tau = tl.minimum(tl.maximum(-along / tl.maximum(square, 1e-18), 0.0), 1.0)
        d = dx * dx + dy * dy + dz * dz + tau * (2 * along + tau * square)
        which = tl.where(d < least, k, which)
        least = tl.minimum(least, d)
    tl.store(depth + (b * na + i) * nb + j, 1 - tl.sqrt(tl.maximum(least, 0.0)) / reach, live)
    tl.store(where + (b * na + i) * nb + j, which, live)


BLOCK = 128


def least_gap(path: Tensor, radius_a: Tensor, centre_b: Tensor, radius_b: Tensor) -> tuple[Tensor, Tensor]:
    """As problems.least_gap."""
    b, na, stamps, _ = path.shape
    nb = centre_b.shape[1]
    depth = torch.empty(b, na, nb, device=path.device)
    where = torch.empty(b, na, nb, dtype=torch.int32, device=path.device)
    gap_kernel[(triton.cdiv(nb, BLOCK), na, b)](path.contiguous(), radius_a.contiguous(), centre_b.contiguous(), radius_b.contiguous(), depth, where,
                                                na, nb, stamps, BLOCK=BLOCK)
    return depth, where


def sdf(parts: Tensor, p: Tensor) -> Tensor:
    """As shapes.sdf."""
    p, parts = p.contiguous(), parts.contiguous()
    out = torch.empty(p.shape[:2], device=p.device)
    rows = torch.arange(len(parts), device=p.device)
    sdf_kernel[(triton.cdiv(p.shape[1], BLOCK), p.shape[0])](parts, rows, p, out, p.shape[1], BLOCK=BLOCK)
    return out


def probe(solids, q, x: Tensor, t: Tensor, kind: int) -> Tensor:
    """As problems.probe. t (B, n) or (B, 1)."""
    x, t, poses = x.contiguous(), t.contiguous(), q.poses.contiguous()
    out = torch.empty(x.shape[:2], device=x.device)
    wide = t.shape[1] > 1
    probe_kernel[(triton.cdiv(x.shape[1], BLOCK), x.shape[0])](
        solids.parts, solids.centre, solids.scale, q.moving.contiguous(), q.moving_size.contiguous(), q.fixed.contiguous(),
        q.fixed_size.contiguous(), poses, poses.shape[1], x, t, t.shape[1], 1 if wide else 0, out, x.shape[1], KIND=kind, BLOCK=BLOCK)
    return out


def trace(parts: Tensor, origin: Tensor, direction: Tensor, reach: float, step_floor: float, steps: int, hits: int) -> Tensor:
    """As shapes.trace."""
    out = torch.full((*origin.shape[:2], hits), float("nan"), device=origin.device)
    trace_kernel[(triton.cdiv(origin.shape[1], BLOCK), origin.shape[0])](
        parts.contiguous(), origin.contiguous(), direction.contiguous(), out, origin.shape[1], reach, step_floor, STEPS=steps, HITS=hits, BLOCK=BLOCK)
    return out
