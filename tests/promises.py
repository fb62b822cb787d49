"""Are the tests that PROMISES.md names there? Prints what is not; exit status 1 if something is not.

  tests      a name after `test_X.c` is a test that the file runs; one after another file is a text in it
  files      main.c runs every test_X.c, but for those that TESTS_APART of tests.mk names
  functions  every public function of src/interface/ is called by a test_X.c
"""

import re
import sys
from pathlib import Path

FOLDER = Path(__file__).parent
INTERFACE = FOLDER.parent / "src" / "interface"


def table_faults(path: Path) -> list[str]:
    faults = []
    for number, line in enumerate(path.read_text().split("\n"), 1):
        cells = line.split(" | ")
        if not line.startswith("| ") or len(cells) != 2 or cells[0] == "| promise":
            continue
        for part in re.split(r"; (?=`)", cells[1].rstrip(" |")):
            match = re.fullmatch(r"`([^`]+)`: (`[^`]+`(?:, `[^`]+`)*)", part)
            file = FOLDER / match.group(1) if match else None
            if not file or not file.is_file():
                faults.append(f"{number}: no file, or nothing named in it: {part}")
                continue
            text = file.read_text()
            for name in re.findall(r"`([^`]+)`", match.group(2)):
                is_test = file.name.startswith("test_")
                if (f"RUN({name});" if is_test else name) not in text:
                    faults.append(f"{number}: no {'test' if is_test else 'text'} '{name}' in {match.group(1)}")
    return faults


def main() -> int:
    path = FOLDER / "PROMISES.md"
    faults = [f"{path.name}:{fault}" for fault in table_faults(path)]
    runs = (FOLDER / "main.c").read_text()
    apart = re.search(r"^TESTS_APART = (.*)", (FOLDER / "tests.mk").read_text(), re.M).group(1).split()
    files = sorted(FOLDER.glob("test_*.c"))
    sections = [file.stem.removeprefix("test_") for file in files]
    faults += [f"main.c: does not run test_{name}.c" for name in sections if f"OF({name})," not in runs and name not in apart]
    tests = "".join(file.read_text() for file in [*files, *FOLDER.glob("*.h")])
    functions = re.findall(r"^NSVCDDEF [^;]*?\b(nsvcd_\w+)\(", "".join(f.read_text() for f in INTERFACE.glob("*.h")), re.M)
    faults += [f"no test calls {name}" for name in functions if not re.search(rf"\b{name}\(", tests)]
    print("\n".join([*faults, f"promises: {len(sections)} files of tests, {len(functions)} public functions; {len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
