"""Small tests of the trainer, on the CPU: python3 -m unittest (Debian's python3-torch is enough)."""
from __future__ import annotations

import unittest

import torch

import patches
import problems
import shapes
from data import Geometry
from model import FACTS, Network, degree2, invariants, wigner2
from problems import Problems, Solids, quaternion_exp, quaternion_log, quaternion_multiply, rotate


def random_quaternions(*shape: int) -> torch.Tensor:
    return torch.nn.functional.normalize(torch.randn(*shape, 4, dtype=torch.float64), dim=-1)


def matrix(q: torch.Tensor) -> torch.Tensor:
    return torch.stack([rotate(q, e.expand(*q.shape[:-1], 3)) for e in torch.eye(3, dtype=q.dtype)], -1)


def turn(z: torch.Tensor, m: torch.Tensor, c: int) -> torch.Tensor:
    a, b = z[..., : 3 * c].unflatten(-1, (c, 3)), z[..., 3 * c : 8 * c].unflatten(-1, (c, 5))
    return torch.cat([(a @ m.mT).flatten(-2), (b @ wigner2(m).mT).flatten(-2), z[..., 8 * c :]], -1)


def random_geometry(count: int) -> Geometry:
    r = lambda *s: torch.randn(*s, dtype=torch.float64)
    return Geometry(r(count, 3), r(count, 3), r(count).abs() + 0.1, r(count).abs() + 0.1, random_quaternions(count), r(count, 3), r(count, 3))


class NetworkTest(unittest.TestCase):
    def setUp(self) -> None:
        torch.manual_seed(0)
        self.net = Network().double()

    def test_degree2_is_an_isometry_of_products(self) -> None:
        a = torch.randn(50, 3, dtype=torch.float64)
        self.assertLess((degree2(a, a).norm(dim=-1) - (a * a).sum(-1)).abs().max().item(), 1e-12)

    def test_wigner_rotates_degree2_and_is_a_group(self) -> None:
        a, b = torch.randn(50, 3, dtype=torch.float64), torch.randn(50, 3, dtype=torch.float64)
        m, n = matrix(random_quaternions(50)), -matrix(random_quaternions(50))  # improper ones too
        turned = degree2((m @ a[..., None])[..., 0], (m @ b[..., None])[..., 0])
        self.assertLess((turned - (wigner2(m) @ degree2(a, b)[..., None])[..., 0]).abs().max().item(), 1e-12)
        self.assertLess((wigner2(m @ n) - wigner2(m) @ wigner2(n)).abs().max().item(), 1e-12)

    def test_encoders_are_equivariant(self) -> None:
        for kind in ("context", "fervn"):
            with self.subTest(kind):
                self.check_equivariance(Network(encoder=kind).double())

    def check_equivariance(self, net: Network) -> None:
        u, n = 0.5 * torch.randn(20, 32, 3, dtype=torch.float64), torch.nn.functional.normalize(torch.randn(20, 32, 3, dtype=torch.float64), dim=-1)
        m = matrix(random_quaternions(1))
        for k in (m, -m):  # mirrored as well
            z, zr = net.encoder(u, n), net.encoder(u @ k.mT, n @ k.mT)
            self.assertLess((zr - turn(z, k[0], net.s.channels)).abs().max().item(), 1e-10)
        self.assertGreater(z.abs().mean().item(), 1e-3)

    def test_inputs_are_invariant(self) -> None:
        s, g = self.net.s, random_geometry(200)
        z1, z2 = torch.randn(200, s.latent, dtype=torch.float64), torch.randn(200, s.latent, dtype=torch.float64)
        x = invariants(s, z1, z2, g)
        q = random_quaternions(200)
        m = matrix(q)
        go = lambda v: rotate(q, v)
        moved = Geometry(3 * go(g.p1) + 1, 3 * go(g.p2) + 1, 3 * g.r1, 3 * g.r2, quaternion_multiply(q, g.q), 3 * go(g.v), go(g.w))
        self.assertLess((invariants(s, z1, turn(z2, m, s.channels), moved) - x).abs().max().item(), 1e-8)
        back = Geometry(g.p1, g.p2, g.r1, g.r2, g.q, -g.v, -g.w)
        self.assertLess((invariants(s, z1, z2, back) - x).abs().max().item(), 1e-8)
        # Swap: body 2 moves, body 1 stands still, in the frame of body 1.
        swapped = Geometry(g.p2, g.p1, g.r2, g.r1, g.q * 0 + random_quaternions(1), -g.v, -g.w)
        z2_local = turn(z2, matrix(swapped.q).mT, s.channels)
        z1_world = turn(z1, matrix(g.q), s.channels)
        self.assertLess((invariants(s, z2_local, z1_world, swapped) - x).abs().max().item(), 1e-8)
        k = torch.tensor([1.0, 1, -1], dtype=torch.float64)  # mirror in the plane z = 0
        mirror = torch.diag(k)
        both = Geometry(g.p1 * k, g.p2 * k, g.r1, g.r2, torch.tensor([0.0, 0, 0, 1], dtype=torch.float64).expand(200, 4), g.v * k, -g.w * k)
        zm1, zm2 = turn(turn(z1, matrix(g.q), s.channels), mirror, s.channels), turn(z2, mirror, s.channels)
        self.assertLess((invariants(s, zm1, zm2, both) - x).abs().max().item(), 1e-8)
        self.assertEqual(x.shape[-1], 2 * s.latent + FACTS)

    def test_degenerate_pairs_are_finite(self) -> None:
        s, g = self.net.s, random_geometry(4)
        zero = torch.zeros(4, 3, dtype=torch.float64)
        z = torch.zeros(4, s.latent, dtype=torch.float64)
        for p1, v, w in ((g.p2, g.v, g.w), (g.p1, zero, zero), (g.p2, zero, zero), (g.p1, g.p2 - g.p1, zero)):
            self.assertTrue(torch.isfinite(invariants(s, z, z, Geometry(p1, g.p2, g.r1, g.r2, g.q, v, w))).all())


class ProblemTest(unittest.TestCase):
    def test_rotation_vectors(self) -> None:
        w = torch.randn(100, 3, dtype=torch.float64)
        self.assertLess((quaternion_log(quaternion_exp(w)) - w)[w.norm(dim=-1) < 3].abs().max().item(), 1e-9)

    def ball(self, radius: float) -> shapes.Part:
        return shapes.Part((0, 0, 0), round=radius)

    def test_ball_past_ball(self) -> None:
        """Closed form: a ball of 0.1 m moves along x past one at distance h; the margin is h - 0.1 - 0.05."""
        nothing = shapes.Part((0, 0, 0), (1e3, 1e3, 1e3)).row()
        part = torch.tensor([[self.ball(0.5).row()] + [nothing] * 11])
        g = torch.Generator().manual_seed(1)
        points, normals, ok = shapes.sample_surface(part, 2048, g)
        self.assertTrue(bool(ok.all()))
        self.assertLess((points.norm(dim=-1) - 0.5).abs().max().item(), 1e-4)
        self.assertLess(points.mean(1).norm().item(), 0.04)
        groups = patches.make_patches(points, normals, 32, 64, g).points
        solids = Solids(part, torch.zeros(1, 3), torch.ones(1), groups, torch.ones(1, 3))
        h = torch.tensor([0.10, 0.145, 0.16, 0.2])
        poses = torch.zeros(4, 33, 7)
        poses[..., 6] = 1
        poses[..., 0] = torch.linspace(-0.3, 0.31, 33)
        poses[..., 1] = h[:, None]
        zero = torch.zeros(4, dtype=torch.long)
        q = Problems(zero, torch.full((4,), 0.2), zero, torch.full((4,), 0.1), poses)
        _, _, margin = problems.closest(solids, q, g)
        error = (margin - (h - 0.15)).abs()
        self.assertLess(error[1:3].max().item(), 3e-4)  # near contact, where labels are decided
        self.assertLess(error.max().item(), 5e-3)  # far from it a search that ends early only errs in size, not in sign

    def test_patches_without_members_are_harmless(self) -> None:
        """64 places, each eight times, for 128 patches: half of them stay empty."""
        g = torch.Generator().manual_seed(2)
        points = torch.randn(1, 64, 3, generator=g).repeat(1, 8, 1)
        normals = torch.nn.functional.normalize(points, dim=-1)
        p = patches.make_patches(points, normals, 128, 32, g)
        self.assertGreater((p.area == 0).sum().item(), 0)
        self.assertLessEqual((p.points - p.centre[:, :, None]).norm(dim=-1).amax(-1).sub(p.radius).max().item(), 1e-6)

    def test_broad_phase_finds_the_entry(self) -> None:
        poses = torch.zeros(1, 33, 7)
        poses[..., 6] = 1
        poses[..., 0] = torch.linspace(-1, 1, 33)
        centre = torch.zeros(1, 1, 3)
        k = problems.broad_phase(poses, centre, torch.full((1, 1), 0.2), centre, torch.full((1, 1), 0.3))
        self.assertAlmostEqual(k.enter[0, 0].item(), 0.25, places=5)
        self.assertAlmostEqual(k.leave[0, 0].item(), 0.75, places=5)
        self.assertEqual(k.valid.sum().item(), 1)


if __name__ == "__main__":
    unittest.main()
