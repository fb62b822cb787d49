"""The network: patch encoder, latent rotation, decoder heads. neuralsvcd.h does the same, in C, and what a pair looks like
besides the latents (data.Batch) is computed there only.

Degree-1 and degree-2 blocks stand side by side on the last axis, 3 + 5 = 8 components, as in FER-VN.
"""
from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

from data import FACTS

ROOT3 = 3 ** 0.5


def degree2(a: Tensor, b: Tensor) -> Tensor:
    """Symmetric traceless part of a b^T in the basis of the real spherical harmonics; |degree2(a, a)| = |a|^2."""
    ax, ay, az, bx, by, bz = *a.unbind(-1), *b.unbind(-1)
    return torch.stack([0.5 * ROOT3 * (ax * by + ay * bx), 0.5 * ROOT3 * (ay * bz + az * by),
                        az * bz - 0.5 * (ax * bx + ay * by), 0.5 * ROOT3 * (ax * bz + az * bx),
                        0.5 * ROOT3 * (ax * bx - ay * by)], -1)


def wigner2(m: Tensor) -> Tensor:
    """D of degree 2 of an orthogonal matrix m (..., 3, 3) -> (..., 5, 5): the columns are the images of the basis."""
    s = 3 ** -0.5
    c = m.unbind(-1)  # columns
    q = lambda i, j: degree2(c[i], c[j])
    return torch.stack([2 * s * q(0, 1), 2 * s * q(1, 2), (2 * q(2, 2) - q(0, 0) - q(1, 1)) / 3, 2 * s * q(0, 2),
                        s * (q(0, 0) - q(1, 1))], -1)


@dataclass
class Shape:
    """Sizes, baked into weights.h."""
    context: int = 6
    point_hidden: int = 32
    pooled: int = 12
    pooled_scalars: int = 8
    hidden: int = 24
    patch_hidden: int = 48
    channels: int = 4
    scalars: int = 8
    heads: tuple[tuple[str, tuple[int, ...]], ...] = (("tiny", (32, 16)), ("small", (96, 32)), ("base", (160, 128, 32)))

    @property
    def latent(self) -> int:
        return 8 * self.channels + self.scalars


def mlp(sizes: list[int]) -> nn.Sequential:
    layers: list[nn.Module] = []
    for i, (a, b) in enumerate(zip(sizes, sizes[1:])):
        layers += [nn.Linear(a, b)] + ([nn.ReLU()] if i + 2 < len(sizes) else [])
    return nn.Sequential(*layers)


class Encoder(nn.Module):
    """Vector-Neuron encoder of one patch. Two passes over the points: fixed moments make context vectors; then every
    point's degree-1 and degree-2 vectors are gated by a network of invariants (among them their products with the
    context) and averaged. A gated VN layer mixes the averages into the latent, every vector shorter than 1."""

    def __init__(self, s: Shape):
        super().__init__()
        self.s = s
        weight = lambda o, i: nn.Parameter(torch.randn(o, i) / i ** 0.5)
        self.context1, self.context2 = weight(s.context, 4), weight(s.context, 4)
        self.point = mlp([2 + 5 * s.context, s.point_hidden, s.point_hidden, 5 * s.pooled + s.pooled_scalars])
        wide = s.pooled + s.context
        self.mix1, self.mix2 = weight(s.hidden, wide), weight(s.hidden, wide)
        self.patch = mlp([2 * wide + s.pooled_scalars, s.patch_hidden, 2 * s.hidden + s.scalars])
        self.out1, self.out2 = weight(s.channels, s.hidden), weight(s.channels, s.hidden)

    def forward(self, u: Tensor, n: Tensor) -> Tensor:
        """u (..., P, 3) points about the centre over the radius, n (..., P, 3) unit normals -> (..., latent)."""
        s = self.s
        un = (u * n).sum(-1, keepdim=True)
        uu = (u * u).sum(-1, keepdim=True)
        q = torch.stack([degree2(u, u), degree2(u, n), degree2(n, n)], -2)  # (..., P, 3, 5)
        m1 = torch.stack([n.mean(-2), (uu * n).mean(-2), (un * u).mean(-2), (uu * u).mean(-2)], -2)
        m2 = torch.cat([q.mean(-3), (un[..., None] * q[..., 1, :][..., None, :]).mean(-3)], -2)
        c1, c2 = self.context1 @ m1, self.context2 @ m2  # (..., G, 3), (..., G, 5)
        invariant = torch.cat([uu, un, u @ c1.mT, n @ c1.mT, (q @ c2.mT.unsqueeze(-3)).flatten(-2)], -1)
        g = self.point(invariant)  # (..., P, 5 C + S)
        gu, gn, g2, gs = g.split([s.pooled, s.pooled, 3 * s.pooled, s.pooled_scalars], -1)
        points = u.shape[-2]
        v1 = (gu.mT @ u + gn.mT @ n) / points  # (..., C, 3)
        g2 = g2.unflatten(-1, (3, s.pooled))
        v2 = sum(g2[..., k, :].mT @ q[..., k, :] for k in range(3)) / points  # (..., C, 5)
        a1, a2 = torch.cat([v1, c1], -2), torch.cat([v2, c2], -2)
        h = self.patch(torch.cat([(a1 * a1).sum(-1), (a2 * a2).sum(-1), gs.mean(-2)], -1))
        gate1, gate2, scalars = h.split([s.hidden, s.hidden, s.scalars], -1)
        z1 = self.out1 @ (gate1[..., None] * (self.mix1 @ a1))
        z2 = self.out2 @ (gate2[..., None] * (self.mix2 @ a2))
        shorten = lambda z: z / (1 + (z * z).sum(-1, keepdim=True)).sqrt()
        return torch.cat([shorten(z1).flatten(-2), shorten(z2).flatten(-2), torch.tanh(scalars)], -1)


class NoNormals(Encoder):
    """Points only, for the ablation."""

    def forward(self, u: Tensor, n: Tensor) -> Tensor:
        return super().forward(u, torch.zeros_like(n))


class FerVn(nn.Module):
    """The published encoder scaled down to a patch (FER-VN-OccNet: lifted features, VN linear layers, magnitude gates,
    residual blocks that see the mean), for the ablation: the header implements Encoder only."""

    def __init__(self, s: Shape, width: int = 32, blocks: int = 2):
        super().__init__()
        self.s = s
        weight = lambda o, i: nn.Parameter(torch.randn(o, i) / i ** 0.5)
        self.lift = weight(width, 2)
        self.gates = nn.ModuleList(mlp([width, width // 2, width]) for _ in range(blocks + 2))
        self.blocks = nn.ParameterList(weight(width, 2 * width) for _ in range(blocks))
        self.out = weight(s.channels, width)
        self.scalars = mlp([width, width, s.scalars])

    def gate(self, k: int, x: Tensor) -> Tensor:
        norm = (x * x).sum(-1).add(1e-8).sqrt()
        return x * (self.gates[k](norm) / norm)[..., None]

    def forward(self, u: Tensor, n: Tensor) -> Tensor:
        length = (u * u).sum(-1, keepdim=True).add(1e-8).sqrt()
        x = torch.stack([torch.cat([u, degree2(u, u) / length], -1), torch.cat([n, degree2(n, n)], -1)], -2)  # (..., P, 2, 8)
        x = self.gate(0, self.lift @ x)
        for k, w in enumerate(self.blocks):
            x = x + self.gate(k + 1, w @ torch.cat([x, x.mean(-3, keepdim=True).expand_as(x)], -2))
        x = self.gate(len(self.blocks) + 1, x.mean(-3))
        z = self.out @ x
        shorten = lambda a: a / (1 + (a * a).sum(-1, keepdim=True)).sqrt()
        scalars = torch.tanh(self.scalars((x * x).sum(-1).add(1e-8).sqrt()))
        return torch.cat([shorten(z[..., :3]).flatten(-2), shorten(z[..., 3:]).flatten(-2), scalars], -1)


def inputs(s: Shape, z: Tensor, slots: Tensor, turns: Tensor, facts: Tensor) -> Tensor:
    """Inputs of the decoder for pairs of patches z (N, latent): slots (..., 2), turns (..., 2, 3, 3), facts (..., FACTS).
    The latents' vectors are turned into the pair's frame and scaled by the share of r1 + r2 that their patch's radius has."""
    c = s.channels
    share = facts[..., 1:2]  # of the larger one: NSVCD__FACT_RADIUS
    vectors, scalars = [], []
    for n, k in ((0, share), (1, 1 - share)):
        own, m = z[slots[..., n]], turns[..., n, :, :]
        a, b = own[..., : 3 * c].unflatten(-1, (c, 3)), own[..., 3 * c : 8 * c].unflatten(-1, (c, 5))
        vectors.append(torch.cat([(a @ m.mT).flatten(-2), (b @ wigner2(m).mT).flatten(-2)], -1) * k)
        scalars.append(own[..., 8 * c :])
    return torch.cat([*vectors, *scalars, facts], -1)


class Network(nn.Module):
    def __init__(self, s: Shape = Shape(), encoder: str = "context"):
        super().__init__()
        self.s = s
        self.encoder = {"context": Encoder, "fervn": FerVn, "no-normals": NoNormals}[encoder](s)
        # of two outputs: a logit, and how far the pair comes apart, in tenths of r1 + r2
        self.heads = nn.ModuleDict({name: mlp([2 * s.latent + FACTS, *sizes, 2]) for name, sizes in s.heads})

    def decode(self, z: Tensor, slots: Tensor, turns: Tensor, facts: Tensor) -> dict[str, Tensor]:
        """-> for each head (..., 2)"""
        x = inputs(self.s, z, slots, turns, facts)
        return {name: head(x) for name, head in self.heads.items()}


def quantise(z: Tensor) -> Tensor:
    """int8 latents, as a body stores them."""
    return torch.round(z * 127) / 127
