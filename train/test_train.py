"""Small tests of the trainer, on the CPU: python3 -m unittest (Debian's python3-torch is enough; scenes.c wants a C compiler)."""
from __future__ import annotations

import subprocess
import tempfile
import unittest
from pathlib import Path

import torch

from calibrate import thresholds
from data import BODIES, FACTS, PAIRS, PROBLEMS, Dataset
from export import by_component, int8_rows
from model import Encoder, FerVn, Network, NoNormals, Shape, degree2, inputs, quantise, wigner2
from train import losses, nearest_pair

HERE = Path(__file__).resolve().parent


def random_matrices(*shape: int) -> torch.Tensor:
    """Orthogonal ones, mirrors too."""
    return torch.linalg.qr(torch.randn(*shape, 3, 3, dtype=torch.float64))[0]


def turned(z: torch.Tensor, m: torch.Tensor, c: int) -> torch.Tensor:
    a, b = z[..., : 3 * c].unflatten(-1, (c, 3)), z[..., 3 * c : 8 * c].unflatten(-1, (c, 5))
    return torch.cat([(a @ m.mT).flatten(-2), (b @ wigner2(m).mT).flatten(-2), z[..., 8 * c :]], -1)


class NetworkTest(unittest.TestCase):
    def setUp(self) -> None:
        torch.manual_seed(0)

    def test_degree2_is_an_isometry_of_products(self) -> None:
        a = torch.randn(50, 3, dtype=torch.float64)
        self.assertLess((degree2(a, a).norm(dim=-1) - (a * a).sum(-1)).abs().max().item(), 1e-12)

    def test_wigner_rotates_degree2_and_is_a_group(self) -> None:
        a, b = torch.randn(50, 3, dtype=torch.float64), torch.randn(50, 3, dtype=torch.float64)
        m, n = random_matrices(50), random_matrices(50)
        images = degree2((m @ a[..., None])[..., 0], (m @ b[..., None])[..., 0])
        self.assertLess((images - (wigner2(m) @ degree2(a, b)[..., None])[..., 0]).abs().max().item(), 1e-12)
        self.assertLess((wigner2(m @ n) - wigner2(m) @ wigner2(n)).abs().max().item(), 1e-12)

    def test_latents_turn_with_the_patch(self) -> None:
        u, n = torch.randn(6, 32, 3, dtype=torch.float64).clamp(-1, 1), torch.randn(6, 32, 3, dtype=torch.float64)
        n = torch.nn.functional.normalize(n, dim=-1)
        m = random_matrices(6)
        for encoder in (Encoder, FerVn, NoNormals):
            net = encoder(Shape()).double()
            z, moved = net(u, n), net(u @ m.mT, n @ m.mT)
            self.assertLess((turned(z, m, Shape().channels) - moved).abs().max().item(), 1e-9, encoder.__name__)

    def test_inputs_turn_and_scale_latents(self) -> None:
        s = Shape()
        z = torch.rand(5, s.latent, dtype=torch.float64)
        slots, turns, facts = torch.tensor([[0, 3], [4, 1]]), random_matrices(2, 2), torch.rand(2, FACTS, dtype=torch.float64)
        x = inputs(s, z, slots, turns, facts)
        v = 8 * s.channels
        for k in range(2):
            larger, smaller = turned(z[slots[k, 0]], turns[k, 0], s.channels), turned(z[slots[k, 1]], turns[k, 1], s.channels)
            share = facts[k, 1]
            parts = [larger[:v] * share, smaller[:v] * (1 - share), larger[v:], smaller[v:], facts[k]]
            self.assertLess((x[k] - torch.cat(parts)).abs().max().item(), 1e-12)


class ExportTest(unittest.TestCase):
    def test_components_are_a_permutation(self) -> None:
        self.assertEqual(by_component(Shape()).sort().values.tolist(), list(range(Shape().latent)))

    def test_int8_rows_round_to_half_a_step(self) -> None:
        w = torch.randn(16, 32)
        q, scale, total = int8_rows(w)
        rounded = q.transpose(1, 2).reshape(16, 32).float() * scale
        self.assertLessEqual(((rounded - w).abs() / scale).max().item(), 0.5001)
        self.assertTrue(torch.equal(total * scale, rounded.sum(0)) or (total * scale - rounded.sum(0)).abs().max().item() < 1e-3)

    def test_thresholds_keep_what_they_promise(self) -> None:
        logits = torch.randn(4000, generator=torch.Generator().manual_seed(3))
        labels = (logits + torch.randn(4000, generator=torch.Generator().manual_seed(4)) > 0).long()
        rows = thresholds([(logits.tolist(), labels.tolist())] * 4)
        hit = logits[labels == 1]
        for recall, t in zip((0.99, 0.999, 0.9999), rows[1:]):
            self.assertGreaterEqual((hit > t).float().mean().item(), recall)
        self.assertEqual(sorted(rows, reverse=True), rows)


class ScenesTest(unittest.TestCase):
    """A training set of one group, written by scenes.c."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        folder = Path(cls.folder.name)
        program = folder / "scenes"
        subprocess.run(["cc", "-O2", "-std=gnu99", "-o", program, HERE / "scenes.c", "-lm", "-lpthread"], check=True)
        for name in ("one", "again"):
            (folder / name).mkdir()
            subprocess.run([program, folder / name, "--seed", "5", "--meshes", "34", "--groups", "1", "--threads", "2" if name == "one" else "1"],
                           check=True, capture_output=True)
        cls.data = Dataset(folder / "one", "cpu")

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    def test_the_seed_decides(self) -> None:
        folder = Path(self.folder.name)
        for file in sorted((folder / "one").iterdir()):
            self.assertEqual(file.read_bytes(), (folder / "again" / file.name).read_bytes(), file.name)

    def test_numbers_are_in_their_ranges(self) -> None:
        b = self.data.batch(0)
        u, n = self.data.patches(0)
        valid = b.slots[..., 0] >= 0
        self.assertEqual(tuple(b.slots.shape), (PROBLEMS, PAIRS, 2))
        self.assertEqual(len(self.data.groups[0]), BODIES)
        self.assertTrue(bool(valid.any(1).all()))
        self.assertLess(b.slots.max().item(), len(u))
        self.assertTrue(bool(torch.isfinite(b.facts).all()) and bool(torch.isfinite(b.turns).all()))
        self.assertLess(u.norm(dim=-1).max().item(), 1.001)  # samples are in the ball
        self.assertLess((n.norm(dim=-1) - 1).abs().max().item(), 1e-5)
        m = b.turns[valid]
        self.assertLess((m @ m.mT - torch.eye(3)).abs().max().item(), 5e-3)  # of half precision
        self.assertEqual((b.margin < 0).sum().item(), PROBLEMS // 2)
        owners = b.slots[torch.arange(PROBLEMS), b.nearest.clamp_min(0).long(), 0]
        self.assertTrue(bool((owners[b.nearest >= 0] >= 0).all()))
        self.assertGreater((b.nearest >= 0).float().mean().item(), 0.6)

    def test_planes_leave_little_between_free_pairs(self) -> None:
        """Of the nearest pair of a free problem, the widest gap of the tips is seldom more than the margin by much: tips are of the patches."""
        b = self.data.batch(0)
        rows = torch.nonzero((b.nearest >= 0) & (b.margin > 0))[:, 0]
        pair = b.nearest[rows].long()
        told = b.facts[rows, pair, 24:27].amin(-1)  # NSVCD__FACT_WIDEST
        gap = told / (1 - told.abs()) / 40 * b.reach[rows, pair]
        self.assertLess((gap - b.margin[rows] > 0.003).float().mean().item(), 0.05)
        self.assertGreater((gap - b.margin[rows] > -0.02).float().mean().item(), 0.9)

    def test_a_few_steps_learn(self) -> None:
        torch.manual_seed(1)
        net = Network()
        optimizer = torch.optim.Adam(net.parameters(), lr=3e-3)
        b = self.data.batch(0)
        pick = slice(0, 128)
        few = tuple(x[pick] for x in (b.slots, b.turns, b.facts, b.reach, b.nearest, b.margin))
        # only the patches that these see
        names, index = torch.unique(few[0].clamp_min(0), return_inverse=True)
        u, n = (x[names] for x in self.data.patches(0))
        few = (torch.where(few[0] < 0, few[0], index), *few[1:])
        seen = torch.ones(1, PAIRS, dtype=torch.bool)
        values = []
        for _ in range(25):
            loss, _ = losses(net, u, n, torch.zeros(len(u), net.s.latent), few, seen, (0.3, 0.3, 1.0))
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            values.append(loss.item())
        self.assertLess(values[-1], 0.8 * values[0])
        z = quantise(net.encoder(u, n))
        distance = net.decode(z, few[0].clamp_min(0), few[1], few[2])["base"][..., 1]
        valid = few[0][..., 0] >= 0
        pair = nearest_pair(distance, few[3], valid)
        self.assertTrue(bool(valid.gather(1, pair).all()))  # never of an empty place
        metres = distance * few[3]
        self.assertTrue(bool((metres.gather(1, pair) <= torch.where(valid, metres, 1e9)).all()))


if __name__ == "__main__":
    unittest.main()
