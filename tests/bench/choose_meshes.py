#!/usr/bin/env python3
"""Makes the sample of a set of real meshes: an archive of few OBJ files that spread over the sizes there are.

    tests/bench/choose_meshes.py FOLDER STEP LARGEST OUT.tar.gz

By number of triangles, then by name: every STEP-th file, and the LARGEST last ones. FOLDER's LICENSE* go with them. The
same files give the same bytes.
"""
import gzip
import io
import sys
import tarfile
from pathlib import Path


def triangles(path: Path) -> int:
    return sum(len(line.split()) - 3 for line in path.read_text().splitlines() if line.startswith("f "))


def main(folder: Path, step: int, largest: int, out: Path) -> None:
    meshes = sorted(folder.rglob("*.obj"), key=lambda path: (triangles(path), path.name))
    chosen = set(meshes[::step]) | set(meshes[len(meshes) - largest :])
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for path in sorted(chosen | set(folder.glob("LICENSE*"))):
            entry = tarfile.TarInfo(f"{folder.name}/{path.name}")
            entry.size = path.stat().st_size
            archive.addfile(entry, io.BytesIO(path.read_bytes()))
    out.write_bytes(gzip.compress(data.getvalue(), mtime=0))
    print(f"{out}: {len(chosen)} of {len(meshes)} meshes, {out.stat().st_size} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
