"""Makes a mutant of tests/mutants.sh: the rooms and the headers made of them, or the checker of certificates, with one
mistake in them.

    python3 tests/make_mutant.py FOLDER LINE   writes it below FOLDER: LINE is name|text|what it becomes
    python3 tests/make_mutant.py --all LIST    can each line of a file still be made? Exit status 1 if not
"""

import re
import sys
from pathlib import Path

HEADERS = ("neuralsvcd.h", "extras/neuralsvcd_certify.h", "extras/neuralsvcd_robot.h", "extras/neuralsvcd_world.h")
CHECKER = Path("examples/verify")


def mutant_of(line: str, rooms: dict[str, str], headers: dict[str, str], checker: dict[str, str]) -> dict[str, str]:
    """The files that change, by name. The text occurs once in the rooms, or in the checker, however its lines are broken."""
    name, old, new = re.split(r"(?<!\\)\|", line, maxsplit=2)
    old, new = [part.replace("\\n", "\n").replace("\\&", "&").replace("\\|", "|") for part in (old, new)]
    new = new.rstrip("|") if name != "none" and new.endswith("|") else new
    if not old:
        return {}
    sources = checker if name.startswith(("verify:", "checker:", "claims:", "fits:", "plans:")) else rooms
    pattern = re.compile(r"\s+".join(map(re.escape, old.split())))
    found = sum(len(pattern.findall(text)) for text in sources.values())
    if found != 1:
        raise SystemExit(f"{name}: found {found} times")
    changed = sources if sources is checker else {**rooms, **headers}
    return {file: pattern.sub(lambda _: new, text) for file, text in changed.items()}


def main() -> None:
    rooms = {str(file): file.read_text() for file in sorted(Path("src").glob("*/*.h"))}
    headers = {header: Path(header).read_text() for header in HEADERS}
    checker = {str(file): file.read_text() for file in sorted(CHECKER.glob("*.h"))}
    if sys.argv[1] == "--all":
        for line in Path(sys.argv[2]).read_text().splitlines():
            mutant_of(line, rooms, headers, checker)
        return
    folder = Path(sys.argv[1])
    for file, text in {**rooms, **headers, **checker, **mutant_of(sys.argv[2], rooms, headers, checker)}.items():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text)


if __name__ == "__main__":
    main()
