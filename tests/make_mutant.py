"""Makes a mutant of tests/mutants.sh: the headers, or the checker of certificates, with one mistake in them.

    python3 tests/make_mutant.py FOLDER LINE   writes it below FOLDER: LINE is name|text|what it becomes
    python3 tests/make_mutant.py --all LIST    can each line of a file still be made? Exit status 1 if not
"""

import re
import sys
from pathlib import Path

HEADERS = ("neuralsvcd.h", "extras/neuralsvcd_certify.h", "extras/neuralsvcd_robot.h")
CHECKER = Path("examples/verify")


def mutant_of(line: str, headers: dict[str, str], checker: dict[str, str]) -> dict[str, str]:
    """The files that change, by name. The text occurs once, however its lines are broken; a room of the ground stands in
    several headers, and counts once."""
    name, old, new = re.split(r"(?<!\\)\|", line, maxsplit=2)
    old, new = [part.replace("\\n", "\n").replace("\\&", "&").replace("\\|", "|") for part in (old, new)]
    new = new.rstrip("|") if name != "none" and new.endswith("|") else new
    if not old:
        return {}
    is_checker = name.startswith(("verify:", "checker:", "fits:"))
    pattern = re.compile(r"\s+".join(map(re.escape, old.split())))
    found = [(file, text) for file, all_of_it in (checker if is_checker else headers).items() for text in pattern.findall(all_of_it)]
    files = {file for file, _ in found}
    if not found or len({text for _, text in found}) != 1 or len(files) != len(found) or (is_checker and len(files) != 1):
        raise SystemExit(f"{name}: found {len(found)} times")
    return {file: (checker if is_checker else headers)[file].replace(text, new) for file, text in found}


def main() -> None:
    headers = {header: Path(header).read_text() for header in HEADERS}
    checker = {str(file): file.read_text() for file in sorted(CHECKER.glob("*.h"))}
    if sys.argv[1] == "--all":
        for line in Path(sys.argv[2]).read_text().splitlines():
            mutant_of(line, headers, checker)
        return
    folder = Path(sys.argv[1])
    for file, text in {**headers, **checker, **mutant_of(sys.argv[2], headers, checker)}.items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text)


if __name__ == "__main__":
    main()
