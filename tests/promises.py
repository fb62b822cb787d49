"""Are the tests that PROMISES.md names there, and does each promise have one? Prints what is not; exit status 1 if something is not.

  tests      a name after `test_X.c` or `promises/X.c` is a test that the file runs; one after another file is a text in it
  files      main.c runs every test_X.c, but for those that the Makefile's TESTS_APART names, and every promises/X.c
  promises   a row that test_X.c holds names first one of promises/, but in the sections of WITHIN
  functions  every public function of src/interface/ is called in promises/, and each test there is named by a row; so each
             function has a row
"""

import re
import sys
from pathlib import Path

FOLDER = Path(__file__).parent
INTERFACE = FOLDER.parent / "src" / "interface"
# Sections of what a program that calls the public functions does not see.
WITHIN = ["Within the library", "PLY and GLB", "The header as a file", "Not tested"]


def row_faults(held_by: str, is_within: bool, named: set[str]) -> list[str]:
    faults = []
    parts = re.split(r"; (?=`)", held_by.rstrip(" |"))
    if "`test_" in held_by and not is_within and not held_by.startswith("`promises/"):
        faults.append("no test of the public functions comes first")
    for part in parts:
        match = re.fullmatch(r"`([^`]+)`: (`[^`]+`(?:, `[^`]+`)*)", part)
        file = FOLDER / match.group(1) if match else None
        if not file or not file.is_file():
            faults.append(f"no file, or nothing named in it: {part}")
            continue
        text = file.read_text()
        for name in re.findall(r"`([^`]+)`", match.group(2)):
            is_test = file.suffix == ".c" and (file.name.startswith("test_") or file.parent.name == "promises")
            if (f"RUN({name});" if is_test else name) not in text:
                faults.append(f"no {'test' if is_test else 'text'} '{name}' in {match.group(1)}")
            named.add(f"{match.group(1)}: {name}")
    return faults


def table_faults(path: Path, named: set[str]) -> list[str]:
    faults, section = [], ""
    for number, line in enumerate(path.read_text().split("\n"), 1):
        section = line.removeprefix("## ") if line.startswith("## ") else section
        cells = line.split(" | ")
        if line.startswith("| ") and len(cells) == 2 and cells[0] != "| promise":
            faults += [f"{number}: {fault}" for fault in row_faults(cells[1], section in WITHIN, named)]
    return faults


def main() -> int:
    path = FOLDER / "PROMISES.md"
    named: set[str] = set()
    faults = [f"{path.name}:{fault}" for fault in table_faults(path, named)]
    runs = (FOLDER / "main.c").read_text()
    makefiles = "".join(f.read_text() for f in sorted([FOLDER.parent / "Makefile", *FOLDER.parent.rglob("*.mk")]))
    apart = re.search(r"^TESTS_APART = (.*)", makefiles, re.M).group(1).split()
    sections = [file.stem.removeprefix("test_") for file in sorted(FOLDER.glob("test_*.c"))]
    faults += [f"main.c: does not run test_{name}.c" for name in sections if f" OF({name})," not in runs and name not in apart]
    promises = sorted((FOLDER / "promises").glob("*.c"))
    faults += [f"main.c: does not run promises/{file.name}" for file in promises if f"PROMISES_OF({file.stem})," not in runs]
    texts = {file: file.read_text() for file in promises}
    count = 0
    for file, text in texts.items():
        for test in re.findall(r"^static void (\w+)\(void\) \{", text, re.M):
            count += 1
            if f"RUN({test});" not in text:
                faults.append(f"promises/{file.name}: does not run {test}")
            if f"promises/{file.name}: {test}" not in named:
                faults.append(f"{path.name}: no row names {test} of promises/{file.name}")
    calls = "".join([*texts.values(), *(file.read_text() for file in (FOLDER / "promises").glob("*.h"))])
    functions = re.findall(r"^NSVCDDEF [^;]*?\b(nsvcd_\w+)\(", "".join(f.read_text() for f in INTERFACE.glob("*.h")), re.M)
    faults += [f"no test of promises/ calls {name}" for name in functions if not re.search(rf"\b{name}\b", calls)]
    said = f"{count} tests of promises, {len(sections)} other files, {len(functions)} public functions; {len(faults)} faults"
    print("\n".join([*faults, f"promises: {said}"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
