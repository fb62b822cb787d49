"""Surface points -> N patches: furthest point sampling, three Lloyd steps, as neuralsvcd.h does it (section patches)."""
from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

COUNTS = (32, 64, 128, 256, 512)  # N
LLOYD_STEPS = 3


@dataclass
class Patches:
    centre: Tensor  # (S, N, 3)
    radius: Tensor  # (S, N)
    points: Tensor  # (S, N, P, 3) members, drawn with replacement where a patch has fewer than P
    normals: Tensor  # (S, N, P, 3)
    area: Tensor  # (S, N) share of the surface


def furthest_points(points: Tensor, count: int) -> Tensor:
    """points (S, n, 3) -> indices (S, count); starts at the point furthest from the centroid."""
    nearest = ((points - points.mean(1, keepdim=True)) ** 2).sum(-1)
    chosen = torch.empty(points.shape[0], count, dtype=torch.long, device=points.device)
    for k in range(count):
        chosen[:, k] = nearest.argmax(1)
        d = ((points - points.gather(1, chosen[:, k, None, None].expand(-1, 1, 3))) ** 2).sum(-1)
        nearest = d if k == 0 else torch.minimum(nearest, d)
    return chosen


def make_patches(points: Tensor, normals: Tensor, count: int, per_patch: int, generator: torch.Generator,
                 first: Tensor | None = None) -> Patches:
    """points, normals (S, n, 3) -> Patches of `count` per shape; first (S, count): the furthest points, where known."""
    s, n, _ = points.shape
    first = furthest_points(points, count) if first is None else first
    centre = points.gather(1, first[..., None].expand(-1, -1, 3))
    ones = torch.ones(s, n, device=points.device)
    for _ in range(LLOYD_STEPS):
        owner = torch.cdist(points, centre).argmin(-1)  # (S, n)
        members = torch.zeros(s, count, device=points.device).scatter_add_(1, owner, ones)
        total = torch.zeros_like(centre).scatter_add_(1, owner[..., None].expand(-1, -1, 3), points)
        centre = torch.where(members[..., None] > 0, total / members[..., None].clamp_min(1), centre)
    owner = torch.cdist(points, centre).argmin(-1)
    members = torch.zeros(s, count, device=points.device).scatter_add_(1, owner, ones)
    total = torch.zeros_like(centre).scatter_add_(1, owner[..., None].expand(-1, -1, 3), points)
    centre = torch.where(members[..., None] > 0, total / members[..., None].clamp_min(1), centre)
    distance = (points - centre.gather(1, owner[..., None].expand(-1, -1, 3))).norm(dim=-1)
    radius = torch.zeros(s, count, device=points.device).scatter_reduce_(1, owner, distance, "amax")
    order = torch.argsort(owner + torch.rand(s, n, generator=generator, device=points.device) * 0.999, dim=1)
    start = torch.cumsum(members, 1) - members  # (S, N)
    slot = torch.arange(per_patch, device=points.device)[None, None, :]
    few = members[..., None].clamp_min(1)
    pick = torch.where(slot < few, slot.expand(s, count, -1).float(),
                       (torch.rand(s, count, per_patch, generator=generator, device=points.device) * few).floor())
    pick = (start[..., None] + pick).long().clamp_max(n - 1).view(s, -1)
    index = order.gather(1, pick)[..., None].expand(-1, -1, 3)
    # A patch without members (centres can coincide) must meet nothing and encode to something finite.
    empty = (members == 0)[..., None]
    centre = torch.where(empty, torch.full_like(centre, 1e3), centre)
    inside = torch.where(empty[..., None], centre[:, :, None], points.gather(1, index).view(s, count, per_patch, 3))
    return Patches(centre, radius, inside, normals.gather(1, index).view(s, count, per_patch, 3), members / n)
