"""Opens the page from the disk in a headless Chromium, drops two files on it, and says what it answers: first on the motion
that it chooses, then with A from above to B, and with A ending above B. ways_page.py INDEX.html A.stl B.obj"""

import os
import sys
import time
from pathlib import Path

index, *files = map(Path, sys.argv[1:])
sys.path.insert(0, str(Path(__file__).parent.parent / "examples" / "web"))
sys.argv[1:] = [str(index), "build/svcd", "unused.png"]
import test_page  # noqa: E402 - it reads its arguments


def processor(root: int) -> float:
    """Seconds that a process and its descendants have taken, those among them that have ended and were waited for."""
    parents, taken = {}, {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has just ended
        pid = int(stat.parent.name)
        parents[pid], taken[pid] = int(fields[1]), sum(map(int, fields[11:15]))
    family = {root}
    while more := {pid for pid, parent in parents.items() if parent in family} - family:
        family |= more
    return sum(taken[pid] for pid in family if pid in taken) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    start = time.monotonic()
    page = test_page.Page()
    page.browser = test_page.start_browser()
    try:
        page.open(index.resolve().as_uri())
        page.drop_on(page.find("canvas"), [[file.name, file.read_bytes()] for file in files])
        page.until(lambda: page.text("verdict-title") in ("Hit", "Free"))
        print(f"first verdict after {time.monotonic() - start:.1f} s, {processor(page.browser.service.process.pid):.1f} of a "
              f"processor: {page.text('verdict-title')}")
        for n, file in enumerate(files):
            page.assertEqual(page.name(n), f"{'AB'[n]}: {file.name}")
        for end in ("0 0 0", "0 0 1.5"):
            page.set_poses("0 0 2 0 0 0 1", f"{end} 0 0 0 1")
            print(page.text("verdict-title").lower())
    finally:
        page.browser.quit()


main()
