#!/usr/bin/env python3
"""Makes tests/data/problems.txt and its meshes: three small sets of build/problems in one compact file.

Rounding (vertices to 10 um, poses to 1 um) keeps every label: the generator throws away what is within 100 um of contact.
The set leaves out detailed meshes, to stay small: it guards against regressions, `make accuracy` measures.
Run from the repository root: make problems && python3 tests/make_data.py
"""
import re
import subprocess
from pathlib import Path

SETS = (("standard", 300, 24, 901), ("hollow", 100, 10, 902), ("inside", 60, 6, 903))  # set, problems, pool, seed
SAMPLES = 17
LARGEST = 24000  # bytes of a mesh
WORK, OUT = Path("build/test_data"), Path("tests/data")


def short(number: str, digits: int) -> str:
    return re.sub(r"^(-?)0\.", r"\1.", f"{float(number):.{digits}f}".rstrip("0").rstrip("."))


def pose(fields: list[str]) -> str:
    return " ".join(short(f, 6) for f in fields)


def compact(obj: str) -> str:
    return "\n".join("v " + " ".join(short(x, 5) for x in l.split()[1:]) if l.startswith("v ") else l for l in obj.split("\n"))


def convert(name: str, wanted: int) -> list[str]:
    """The first `wanted` problems of build/test_data/NAME.txt whose meshes are small."""
    out, meshes, kept, keep = [], {}, 0, False
    for line in (WORK / f"{name}.txt").read_text().splitlines()[1:]:
        f = line.split()
        if f[0] == "mesh":
            meshes[f[1]] = compact((WORK / f[2]).read_text())
        elif f[0] == "problem":
            keep = kept < wanted and max(len(meshes[f[2]]), len(meshes[f[4]])) <= LARGEST
            kept += keep
            for m in (f[2], f[4]) if keep else ():
                target = OUT / "meshes" / f"{name}_{m}.obj"
                if not target.exists():
                    target.write_text(meshes[m])
                    out.append(f"mesh {name}_{m} meshes/{target.name}")
            head = ["problem", f"{name}_{f[1]}", f"{name}_{f[2]}", f[3], f"{name}_{f[4]}", f[5], pose(f[6:13]), *f[13:]]
            out += [" ".join(head)] if keep else []
        elif keep and f[0] != "#":
            out.append(pose(f))
    if kept < wanted:
        raise SystemExit(f"{name}: only {kept} problems have small meshes")
    return out


def main() -> None:
    WORK.mkdir(parents=True, exist_ok=True)
    (OUT / "meshes").mkdir(parents=True, exist_ok=True)
    for old in (OUT / "meshes").glob("*.obj"):
        old.unlink()
    out = ["nsvcd-problems 1", "# made by tests/make_data.py: " + ", ".join(f"{c} {s} (seed {d})" for s, c, _, d in SETS)]
    for name, count, pool, seed in SETS:
        subprocess.run(["build/problems", "--set", name, "--meshes", "procedural", "--count", str(3 * count), "--seed", str(seed),
                        "--pool", str(pool), "--motion-samples", str(SAMPLES), "--out", str(WORK / f"{name}.txt")], check=True)
        out += convert(name, count)
    (OUT / "problems.txt").write_text("\n".join(out) + "\n")


if __name__ == "__main__":
    main()
