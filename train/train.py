"""Trains the network on a folder of scenes.c and writes DIR/checkpoint.pt. See README.md for the recipe and the ablation."""
from __future__ import annotations

import argparse
import json
import math
import time
from pathlib import Path

import torch
import torch.nn.functional as F
from torch import Tensor

from data import FACTS, Batch, Dataset
from model import Network, Shape, quantise

HEAD_WEIGHT = {"tiny": 0.35, "small": 0.6, "base": 1.0}
FAR = 7.0  # distances are clipped there, in tenths of r1 + r2: beyond one radius
KINDS = ("open", "into", "any", "floor", "face", "cavity")


def nearest_pair(distance: Tensor, reach: Tensor, valid: Tensor) -> Tensor:
    """Which pair comes nearest, in metres, (P, 1); distance (P, K) in tenths of reach."""
    return (distance * reach).masked_fill(~valid, 1e9).argmin(1, keepdim=True)


def losses(net: Network, u: Tensor, n: Tensor, noise: Tensor, b: tuple[Tensor, ...], seen: Tensor, weights: tuple[float, float, float]) -> tuple[Tensor, Tensor]:
    """Cross-entropy of the greatest logit; of the pairs, weights[0]; of the distances, weights[1]; of the least distance, weights[2].
    -> loss, base head's first part."""
    slots, turns, facts, reach, nearest, margin = b
    z = net.encoder(u, n) + noise
    valid = (slots[..., 0] >= 0) & seen
    hit = (margin < 0).float()
    owned = F.one_hot(nearest.clamp_min(0).long(), slots.shape[1]).bool() & (nearest >= 0)[:, None] & valid
    free_pairs = valid & (margin > 0)[:, None]
    told = free_pairs | owned  # of these it is known whether they meet
    apart = (10 * margin[:, None] / reach).clamp(-FAR, FAR)
    share = told.float() / told.float().sum(1, keepdim=True).clamp_min(1)
    total, shown = 0.0, torch.zeros((), device=z.device)
    for name, out in net.decode(z, slots.clamp_min(0), turns, facts).items():
        logit, distance = out.unbind(-1)
        top = logit.masked_fill(~valid, -30).amax(1)
        main = F.binary_cross_entropy_with_logits(top, hit)
        pair = (F.binary_cross_entropy_with_logits(logit, hit[:, None].expand_as(logit), reduction="none") * share).sum(1).mean()
        off = F.smooth_l1_loss(distance, apart, reduction="none", beta=0.1)
        near = torch.where(owned, off, off * (distance < apart))  # what is not the nearest is no nearer
        near = (near * (owned.float() + 0.1 * share)).sum(1).mean()
        least = nearest_pair(distance, reach, valid)
        whole = F.smooth_l1_loss(distance.gather(1, least), apart.gather(1, least), beta=0.1)
        total = total + HEAD_WEIGHT[name] * (main + weights[0] * pair + weights[1] * near + weights[2] * whole)
        if name == "base":
            shown = main.detach()
    return total, shown


@torch.no_grad()
def validate(net: Network, d: Dataset, head: str, groups: int, int8: bool = True) -> str:
    rows = []
    for g in range(min(groups, len(d.groups))):
        b = d.batch(g)
        z = net.encoder(*d.patches(g))
        out = net.decode(quantise(z), b.slots.clamp_min(0), b.turns, b.facts)[head]
        valid = b.slots[..., 0] >= 0
        logit = out[..., 0].masked_fill(~valid, -30).amax(1)
        pair = nearest_pair(out[..., 1], b.reach, valid)
        reach = b.reach.gather(1, pair)[:, 0]
        rows.append(torch.stack([logit, out[..., 1].gather(1, pair)[:, 0] * reach / 10, b.margin, reach, b.kind.float()]))
    logit, distance, margin, reach, kind = torch.cat(rows, 1)
    hit = margin < 0
    share = lambda x: f"{100 * x.float().mean().item():.2f}"
    right = (logit > 0) == hit
    by_kind = " ".join(f"{name} {share(right[kind == k])}" for k, name in enumerate(KINDS))
    close = margin.abs() < 0.5 * reach
    off = ((distance - margin).abs() / (0.5 * reach))[close]
    deep = hit & (margin < -1e-3)
    wide = ~hit & (margin > 2e-3)
    return (f"{head:5} right {share(right)} % ({by_kind}), missed {share(~right[hit])}, of 1 mm {share(~right[deep])}; stopped {share(~right[~hit])}, "
            f"at 2 mm {share(~right[wide])}; distance off by {100 * off.median().item():.2f} % of a radius in the median, "
            f"{100 * off.quantile(0.9).item():.1f} in nine of ten")


def main() -> None:
    p = argparse.ArgumentParser()
    p.add_argument("--data", type=Path, required=True, help="folder of scenes.c")
    p.add_argument("--held", type=Path, required=True, help="the same of another seed: reported, never trained on")
    p.add_argument("--out", type=Path, required=True)
    p.add_argument("--steps", type=int, default=50000)
    p.add_argument("--seconds", type=float, default=1e9, help="end the schedule by then, counted from the start of the program")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--rate", type=float, default=6e-3)
    p.add_argument("--pair-weight", type=float, default=0.3)
    p.add_argument("--distance-weight", type=float, default=0.3)
    p.add_argument("--least-weight", type=float, default=1.0)
    p.add_argument("--encoder", choices=["context", "fervn", "no-normals"], default="context")
    p.add_argument("--shape", type=json.loads, default={}, help="sizes of the network that differ, as JSON")
    p.add_argument("--blind", type=json.loads, default=[], help="facts that are always 0, for the ablation")
    p.add_argument("--every", type=int, default=10000, help="steps between validations")
    p.add_argument("--resume", type=Path)
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
    d, held = Dataset(a.data, device), Dataset(a.held, device)
    if a.blind:
        d.all.facts[..., a.blind] = 0
        held.all.facts[..., a.blind] = 0
    log(f"read {len(d.groups)} groups")
    shape = Shape(**a.shape)
    net, average = Network(shape, a.encoder).to(device), Network(shape, a.encoder).to(device)
    average.load_state_dict(net.state_dict())
    optimizer = torch.optim.AdamW(net.parameters(), lr=a.rate, weight_decay=1e-4, **({"fused": True} if compiled else {}))
    first = 0
    if a.resume:
        saved = torch.load(a.resume, map_location=device)
        net.load_state_dict(saved["net"]), average.load_state_dict(saved["average"])
        optimizer.load_state_dict(saved["optimizer"])
        first = saved["step"]
    # groups differ in their number of patches by a little: they are padded to one number
    most = max(sum(d.first[b + 1] - d.first[b] for b in group) for group in d.groups)
    step_loss = torch.compile(losses, dynamic=False) if compiled else losses
    own, mean = list(net.parameters()), list(average.parameters())
    order = torch.Generator().manual_seed(a.seed)
    queue: list[int] = []
    begun, step, shown = time.time(), first, torch.zeros(())

    def save() -> None:
        torch.save({"net": net.state_dict(), "average": average.state_dict(), "optimizer": optimizer.state_dict(), "step": step,
                    "shape": a.shape, "arguments": {k: str(v) for k, v in vars(a).items()}}, a.out / "checkpoint.pt")

    def report(groups: int) -> None:
        log(f"step {step} loss {float(shown):.4f} {(time.time() - begun) / max(1, step - first) * 1e3:.1f} ms/step")
        for head in ("tiny", "small", "base"):
            log("held-out", validate(average, held, head, groups))
        log("seen    ", validate(average, d, "base", groups))

    while step < a.steps:
        # the schedule follows the clock where time is short, else the steps
        fraction = step / a.steps
        if a.seconds < 1e9:
            fraction = max(fraction, (time.time() - begun) / max(1.0, a.seconds - (begun - started)))
        if fraction >= 1:
            break
        rate = a.rate * min(1.0, (step + 1) / 300) * 0.5 * (1 + math.cos(math.pi * fraction)) + 1e-6
        for group in optimizer.param_groups:
            group["lr"] = rate
        if not queue:
            queue = torch.randperm(len(d.groups), generator=order).tolist()
        g = queue.pop()
        u, n = (F.pad(x, (0, 0, 0, 0, 0, most - len(x)), value=0.1) for x in d.patches(g))
        noise = (torch.rand(most, shape.latent, device=device) - 0.5) / 127  # rounding to int8
        b = d.batch(g)
        pairs = torch.full((), 8 if step % 2 else b.slots.shape[1], device=device)
        seen = (torch.arange(b.slots.shape[1], device=device) < pairs)[None]
        loss, shown = step_loss(net, u, n, noise, (b.slots, b.turns, b.facts, b.reach, b.nearest, b.margin), seen, (a.pair_weight, a.distance_weight, a.least_weight))
        optimizer.zero_grad(set_to_none=True)
        loss.backward()
        if step % 100 == 0 and not math.isfinite(loss.item()):
            raise SystemExit(f"step {step}: the loss is not finite")
        torch.nn.utils.clip_grad_norm_(own, 1.0)
        optimizer.step()
        with torch.no_grad():
            for m, w in zip(mean, own):
                m.lerp_(w, 1 - min(0.999, (1 + step) / (10 + step)))
        step += 1
        if step % 500 == 0 and step <= 1000:
            log(f"step {step} loss {float(shown):.4f} {(time.time() - begun) / (step - first) * 1e3:.1f} ms/step")
        if step % a.every == 0:
            report(8)
            save()
    save()
    report(32)
    log("done")


if __name__ == "__main__":
    main()
