"""On a GPU: the Triton kernels against the plain functions, and where the time goes."""
import time

import torch

import data
import kernels
import problems
import shapes
from problems import OVERLAP, INTO_FIXED, INTO_MOVING


def main() -> None:
    g = torch.Generator(device="cuda").manual_seed(1)
    maker = shapes.Maker(1)
    for name, use in (("torch", None), ("triton", kernels)):
        started = time.time()
        solids, points, normals = data.build_solids(shapes.Maker(1), 64, maker.GENERAL, g, "cuda", use)
        torch.cuda.synchronize()
        print(name, "solids", len(solids.scale), f"{time.time() - started:.2f} s", flush=True)
    b = 256
    moving, fixed = (torch.randint(len(solids.scale), (b,), generator=g, device="cuda") for _ in range(2))
    kind = torch.arange(b, device="cuda") % 3
    for _ in range(2):
        started = time.time()
        q, settled = data.draw_problems(solids, moving, fixed, kind, g)
        torch.cuda.synchronize()
        print(f"draw {time.time() - started:.2f} s, settled {settled.float().mean().item():.3f}", flush=True)
    touching, settled = problems.place(solids, q, 0.3 * torch.ones(b, 3, device="cuda"), torch.zeros(b, device="cuda"), g)
    label = problems.closest(solids, touching, g, times=33, per_group=64, keep=6)[2]
    denser = problems.closest(solids, touching, g, times=33, per_group=64, keep=8, rounds=20)[2]
    shares = torch.tensor([0.05, 0.5, 0.95], device="cuda")
    print("labels at contact, denser search minus label, mm, 5 / 50 / 95 %:", (1e3 * torch.quantile((denser - label)[settled], shares)).tolist())
    x = torch.randn(b, 500, 3, generator=g, device="cuda") * 0.1
    t = torch.rand(b, 500, generator=g, device="cuda")
    for kind in (INTO_FIXED, INTO_MOVING, OVERLAP):
        fast = problems.probe(solids, q, x, t, kind)
        solids.kernels = None
        slow = problems.probe(solids, q, x, t, kind)
        solids.kernels = kernels
        print("probe", kind, "largest difference", (fast - slow).abs().max().item(), "of", slow.abs().mean().item(), flush=True)


if __name__ == "__main__":
    main()
