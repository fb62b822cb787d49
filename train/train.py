"""Trains the network from nothing and writes DIR/checkpoint.pt. See README.md for the recipe and the ablation."""
from __future__ import annotations

import argparse
import json
import math
import time
from pathlib import Path

import torch
import torch.nn.functional as F
from torch import Tensor

import data as training_data
from data import Dataset, Geometry, PER_GROUP, group_patches
from model import Network, Shape, quantise
from validate import load_problems, logits, report

HEAD_WEIGHT = {"tiny": 0.35, "small": 0.6, "base": 1.0}


def losses(net: Network, u: Tensor, n: Tensor, noise: Tensor, slot1: Tensor, slot2: Tensor, g: Geometry, valid: Tensor, target: Tensor,
           label: Tensor, weight: Tensor, pairs: int, pair_weight: float, gradient_weight: float,
           head_weight: dict[str, float]) -> tuple[Tensor, Tensor]:
    """Cross-entropy of the pooled logit, plus per-pair cross-entropy and distance. -> loss, base head's cross-entropy."""
    z = net.encoder(u, n) + noise
    if gradient_weight > 0:
        g = Geometry(g.p1.detach().requires_grad_(True), g.p2, g.r1, g.r2, g.q, g.v, g.w)
    reach = g.r1 + g.r2
    soft = torch.sigmoid(-target / (0.02 * reach))
    far = (-10 * target / reach).clamp(-2, 2)
    mask = valid.float()
    total, shown = 0.0, torch.zeros((), device=z.device)
    for name, (logit, distance) in net.decode(z[slot1], z[slot2], g).items():
        pooled = torch.where(valid, logit, torch.full_like(logit, -30))[:, :pairs].amax(1)
        main = (F.binary_cross_entropy_with_logits(pooled, label, reduction="none") * weight).sum() / weight.sum()
        pair = (F.binary_cross_entropy_with_logits(logit, soft, reduction="none") * mask).sum() / mask.sum()
        near = (F.smooth_l1_loss(distance, far, reduction="none") * mask).sum() / mask.sum()
        total = total + head_weight[name] * (main + pair_weight * (pair + near))
        if name == "base":
            shown = main.detach()
            if gradient_weight > 0:  # appendix A: the logit's slope should be one, here 10 per (r1 + r2)
                slope = torch.autograd.grad(logit.sum(), g.p1, create_graph=True)[0].norm(dim=-1) * reach / 10
                total = total + gradient_weight * (((slope - 1) ** 2) * mask).sum() / mask.sum()
    return total, shown


def batch(d: Dataset, g: int) -> tuple:
    s = slice(g * PER_GROUP, (g + 1) * PER_GROUP)
    return (d.slot1[s], d.slot2[s], d.geometry.map(lambda x: x[s]), d.valid[s], d.target[s], d.label[s], d.weight[s])


@torch.no_grad()
def pooled_logits(net: Network, d: Dataset, head: str, pairs: int, groups: int | None = None) -> tuple[Tensor, Tensor, Tensor]:
    out = []
    for g in range(groups or len(d.bodies)):
        slot1, slot2, geometry, valid, *_ = batch(d, g)
        z = quantise(net.encoder(*group_patches(d, g)))
        value = net.decode(z[slot1], z[slot2], geometry)[head][0]
        out.append(torch.where(valid, value, torch.full_like(value, -30))[:, :pairs].amax(1))
    value = torch.cat(out)
    keep = d.weight[: len(value)] > 0
    return tuple(x[: len(value)][keep].cpu() for x in (value, d.label, d.margin))


def main() -> None:
    p = argparse.ArgumentParser()
    p.add_argument("--out", type=Path, required=True)
    p.add_argument("--real", type=Path, help="folder of problem files with exact labels: reported, never trained on")
    p.add_argument("--steps", type=int, default=30000)
    p.add_argument("--seconds", type=float, default=1e9, help="end the schedule by then, counted from the start of the program")
    p.add_argument("--groups", type=int, default=1000)
    p.add_argument("--shapes", type=int, default=6000)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--rate", type=float, default=4e-3)
    p.add_argument("--pair-weight", type=float, default=0.2)
    p.add_argument("--gradient-weight", type=float, default=0.0)
    p.add_argument("--scaling", choices=["sum", "paper"], default="sum")
    p.add_argument("--roll", choices=["velocity", "lean"], default="velocity")
    p.add_argument("--encoder", choices=["context", "fervn", "no-normals"], default="context")
    p.add_argument("--literal-problems", action="store_true", help="appendix B as printed: one shift, then epsilon")
    p.add_argument("--no-canonical", action="store_true")
    p.add_argument("--shape", type=json.loads, default={}, help="sizes of the network that differ, as JSON")
    p.add_argument("--head-weight", type=json.loads, default={}, help="shares of the heads in the loss that differ, as JSON")
    p.add_argument("--every", type=int, default=25000, help="steps between validations")
    p.add_argument("--cache", type=Path, help="file to share the training set among processes of the same seed and sizes")
    p.add_argument("--resume", type=Path)
    p.add_argument("--files", nargs="*", default=["standard", "urdfs", "metaworld", "hollow"])
    a = p.parse_args()
    started = time.time()
    a.out.mkdir(parents=True, exist_ok=True)
    journal = open(a.out / "log.txt", "a")

    def log(*words: object) -> None:
        line = f"[{time.time() - started:6.0f}] " + " ".join(str(w) for w in words)
        print(line, flush=True)
        print(line, file=journal, flush=True)

    device = "cuda" if torch.cuda.is_available() else "cpu"
    compiled = device == "cuda"
    torch.set_float32_matmul_precision("high")
    torch.manual_seed(a.seed)
    build = lambda: training_data.build(a.seed, a.shapes, a.groups, device, log, literal=a.literal_problems)
    d = training_data.cached(a.cache, build, log)
    held = training_data.build(a.seed + 1000003, min(500, a.shapes), min(33, a.groups), device, log)
    files = {n: load_problems(a.real / f"{n}.txt") for n in a.files} if a.real else {}
    net = Network(Shape(**a.shape), a.scaling, a.roll, not a.no_canonical, a.encoder).to(device)
    average = Network(Shape(**a.shape), a.scaling, a.roll, not a.no_canonical, a.encoder).to(device)
    average.load_state_dict(net.state_dict())
    optimizer = torch.optim.AdamW(net.parameters(), lr=a.rate, weight_decay=1e-4, fused=compiled)
    first = 0
    if a.resume:
        saved = torch.load(a.resume, map_location=device)
        net.load_state_dict(saved["net"]), average.load_state_dict(saved["average"])
        optimizer.load_state_dict(saved["optimizer"])
        first = saved["step"]
    step_loss = torch.compile(losses, dynamic=False) if compiled and a.gradient_weight == 0 else losses
    own, mean = list(net.parameters()), list(average.parameters())
    order = torch.Generator().manual_seed(a.seed)
    queue: list[int] = []
    begun, fraction = time.time(), first / a.steps
    step, shown = first, 0.0

    def save(name: str = "checkpoint.pt") -> None:
        torch.save({"net": net.state_dict(), "average": average.state_dict(), "optimizer": optimizer.state_dict(), "step": step,
                    "shape": a.shape, "arguments": {k: str(v) for k, v in vars(a).items()}}, a.out / name)

    def validate(wide: bool) -> None:
        average.eval()
        log(f"step {step} loss {float(shown):.4f} {(time.time() - begun) / max(1, step - first) * 1e3:.1f} ms/step")
        log(report("held-out base K=8", *pooled_logits(average, held, "base", 8)))
        if wide:
            log(report("held-out tiny K=8", *pooled_logits(average, held, "tiny", 8)))
            log(report("seen base K=8", *pooled_logits(average, d, "base", 8, min(33, a.groups))))
        for name, f in files.items():
            for n in (128, 256, 512) if wide else (256,):
                settings = [("base", 8)] + ([("base", 16)] if wide else []) + ([("tiny", 8), ("small", 8)] if wide and n == 256 else [])
                for (head, k), value in zip(settings, logits(average, f, n, device, settings)):
                    log(report(f"{name} N={n} {head} K={k}", value, f.label, f.margin))

    while step < a.steps:
        # The schedule follows the clock where time is short, else the steps.
        if a.seconds < 1e9:
            fraction = max(step / a.steps, (time.time() - begun) / max(1.0, a.seconds - (begun - started)))
        else:
            fraction = step / a.steps
        if fraction >= 1:
            break
        rate = a.rate * min(1.0, (step + 1) / 300) * 0.5 * (1 + math.cos(math.pi * fraction)) + 1e-6
        for group in optimizer.param_groups:
            group["lr"] = rate
        if not queue:
            queue = torch.randperm(len(d.bodies), generator=order).tolist()
        g = queue.pop()
        u, n = group_patches(d, g)
        noise = (torch.rand(len(u), net.s.latent, device=device) - 0.5) / 127  # rounding to int8
        pairs = 8 if step % 2 else 16
        loss, shown = step_loss(net, u, n, noise, *batch(d, g), pairs, a.pair_weight, a.gradient_weight,
                                {**HEAD_WEIGHT, **a.head_weight})
        optimizer.zero_grad(set_to_none=True)
        loss.backward()
        if step % 100 == 0 and not math.isfinite(loss.item()):
            raise SystemExit(f"step {step}: the loss is not finite")
        torch.nn.utils.clip_grad_norm_(own, 1.0)
        optimizer.step()
        with torch.no_grad():
            decay = min(0.999, (1 + step) / (10 + step))
            torch._foreach_lerp_(mean, own, 1 - decay)
        step += 1
        if step % 500 == 0 and step <= 1000:
            log(f"step {step} loss {float(shown):.4f} {(time.time() - begun) / (step - first) * 1e3:.1f} ms/step")
        if step % a.every == 0:
            validate(False)
            save()
    save()
    validate(True)
    log("done")


if __name__ == "__main__":
    main()
