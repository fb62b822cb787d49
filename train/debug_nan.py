import torch, data, train
from model import Network, invariants
torch.set_float32_matmul_precision("high")
d = data.build(1, 768, 64, "cuda")
fin = lambda t: (~torch.isfinite(t)).sum().item()
for k, v in (*vars(d.geometry).items(), ("target", d.target), ("margin", d.margin), ("weight", d.weight)):
    print(k, fin(v), v.abs().max().item(), flush=True)
reach = d.geometry.r1 + d.geometry.r2
print("reach min", reach.min().item(), "of valid", reach[d.valid].min().item())
for n, t in d.tables.items():
    print(n, "centre", fin(t.centre), "radius", fin(t.radius), t.radius.min().item(), (t.radius == 0).float().mean().item(), "points", fin(t.points), "normals", fin(t.normals), (t.normals.norm(dim=-1) < 0.5).float().mean().item(), "empty", (t.area == 0).float().mean().item())
for g in range(64):
    u, n = data.group_patches(d, g)
    if u.norm(dim=-1).max() > 1.01 or fin(u): print("group", g, "u", u.norm(dim=-1).max().item(), fin(u))
torch.manual_seed(1)
net = Network().cuda()
opt = torch.optim.AdamW(net.parameters(), lr=2e-3, weight_decay=1e-4)
own = list(net.parameters())
for step in range(500):
    g = step % 64
    u, n = data.group_patches(d, g)
    b = train.batch(d, g)
    loss, shown = train.losses(net, u, n, torch.zeros(len(u), 72, device="cuda"), *b, 16, 0.4, 0.0)
    opt.zero_grad(); loss.backward()
    norm = torch.nn.utils.clip_grad_norm_(own, 1.0)
    if step % 50 == 0: print(step, loss.item(), shown.item(), norm.item(), flush=True)
    if not torch.isfinite(loss) or not torch.isfinite(norm):
        print("step", step, "group", g, loss.item(), norm.item(), "params", sum(fin(p) for p in own), "grads", [k for k, p in net.named_parameters() if p.grad is not None and fin(p.grad)])
        z = net.encoder(u, n)
        print("z", fin(z), fin(u), fin(n))
        x = invariants(net.s, z[b[0]], z[b[1]], b[2])
        bad = (~torch.isfinite(x)).any(-1)
        print("x", bad.sum().item(), "logit", fin(net.decode(z[b[0]], z[b[1]], b[2])["base"][0]))
        if bad.any():
            i = bad.nonzero()[0]
            print("columns", (~torch.isfinite(x[i[0], i[1]])).nonzero()[:, 0].tolist(), {k: v[i[0], i[1]].tolist() for k, v in vars(b[2]).items()}, b[3][i[0], i[1]].item())
        break
    opt.step()
