"""Are the tests worth anything? Makes mistakes in neuralsvcd.h at random, one at a time, and counts how many the tests
notice; for each room of src/ that they include they get that header. From the repository's root:

  python3 tests/mutate.py --count 100 --seed 1 --jobs 16             all of them
  python3 tests/mutate.py --count 100 --seed 1 --part 0 --of 4       every fourth: mutant n is the same whatever the parts
  python3 tests/mutate.py --numbers 20,26 --seed 1                   these two
  python3 tests/mutate.py --list --count 20 --seed 1                 shows them, and runs nothing

A mutant is caught if a test fails, crashes, or takes more than LIMIT times as long as on the header itself and LEAST
seconds more. One that does not compile, or compiles to the same machine code, is none, and another is drawn. Each has a
folder of its own. The tests of its section come first, then all others, the quick ones first; the first that fails ends it.
Writes OUT/part_P_of_N.txt as it goes, prints survivors with their lines, and ends with 0 unless the header itself fails.
"""

from __future__ import annotations

import argparse
import difflib
import random
import re
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parent.parent
HEADER = "neuralsvcd.h"
LIMIT = 4
LEAST = 20  # seconds
# Files of tests to begin with, for rooms and floors; else that of the room's name.
FIRST = {
    "ground/strings": ["results"],
    "ground": ["math", "surface", "motion"],
    "ground/memory": ["query", "encoding"],
    "mesh": ["mesh"],
    "lanes": ["vectors", "broad_phase", "decoder"],
    "patches": ["patches", "encoding"],
    "patches/topology": ["regions", "facets"],
    "patches/edges": ["solids"],
    "patches/solids": ["solids"],
    "patches/regions": ["regions", "level", "encoding"],
    "surface": ["surface", "facets", "proof"],
    "encoder": ["encoder", "decoder"],
    "body": ["body", "facets", "encoding"],
    "body/facets": ["facets", "proof"],
    "motion": ["motion", "broad_phase", "proof"],
    "search": ["broad_phase", "proof"],
    "proof": ["proof", "asks"],
    "network/pairs": ["decoder"],
    "network/invariants": ["decoder"],
    "query": ["query", "cost", "proof"],
    "gradient": ["gradient"],
    "plan": ["optimizer", "spline", "plan_spheres", "tasks"],
}
# It asks three builds of the same: minutes to compile.
LEFT_OUT = {"processor"}
SWAPPED = [("fmin", "fmax"), ("min", "max"), ("low", "high"), ("sin", "cos"), ("start", "end"), ("least", "greatest"),
           ("moving", "fixed"), ("first", "last"), ("floor", "ceil"), ("x", "y"), ("and", "or")]


@dataclass(frozen=True)
class Site:
    """A text on a line that may become another."""

    line: int  # from 0
    begin: int
    end: int
    new: str
    kind: str


@dataclass
class Mutant:
    number: int
    site: Site
    section: str
    old: str
    new: str
    caught_by: str = ""
    seconds: float = 0
    discarded: int = 0
    asked: list[str] = field(default_factory=list)


# ------------------------------------------------------------------------------------------ where


def code_of(line: str) -> str:
    return line.split("//")[0].rstrip()


def lines_compiled(text_lines: int, cc: str, flags: list[str]) -> set[int]:
    """The header's lines, from 0, of which the preprocessor leaves something."""
    source = '#define NEURALSVCD_IMPLEMENTATION\n#include "neuralsvcd.h"\n'
    out = subprocess.run([cc, *flags, "-std=c99", "-E", "-I", str(ROOT), "-"], input=source, capture_output=True, text=True,
                         check=True).stdout
    lines, here, at = set(), False, 0
    for line in out.split("\n"):
        marker = re.match(r'# (\d+) "([^"]*)"', line)
        if marker:
            here = marker.group(2).endswith(HEADER)
            at = int(marker.group(1)) - 1
            continue
        if here and line.strip() and at < text_lines:
            lines.add(at)
        at += 1
    return lines


def sections_of(lines: list[str]) -> list[str]:
    """Of each line the name of its section."""
    names, name = [], ""
    for line in lines:
        match = re.match(r"// -{20,} (.+)$", line)
        name = match.group(1) if match else name
        names.append(name)
    return names


def lines_of_functions(lines: list[str]) -> set[int]:
    inside, body = set(), False
    for n, line in enumerate(lines):
        if body and line.startswith("}"):
            body = False
        if body:
            inside.add(n)
        starts = line and not line[0].isspace() and not line.startswith(("//", "#", "}", "typedef", "enum", "struct"))
        if code_of(line).endswith("{") and (starts or re.match(r" {4,}.*\) \{$", line)) and "=" not in line:
            body = True
    return inside


def sites_of(n: int, line: str) -> list[Site]:
    code = code_of(line)
    sites = []

    def add(match: re.Match, new: str, kind: str, group: int = 0) -> None:
        sites.append(Site(n, match.start(group), match.end(group), new, kind))

    for match in re.finditer(r"(?<=[\w)\]] )(<=|>=|==|!=|<|>|&&|\|\||\+|-|\*|/|&|\|)(?= [\w(!~&*-])", code):
        for new in {"<": [">=", "<="], "<=": [">", "<"], ">": ["<=", ">="], ">=": ["<", ">"], "==": ["!="], "!=": ["=="],
                    "&&": ["||"], "||": ["&&"], "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "&": ["|"],
                    "|": ["&"]}[match.group()]:
            add(match, new, "operator")
    for match in re.finditer(r"(?<![\w.])(\d+\.\d*(?:e-?\d+)?f?|\d+e-?\d+f?|\d+u?)(?![\w.])", code):
        text = match.group()
        if re.fullmatch(r"\d+u?", text):
            value = int(text.rstrip("u"))
            for new in {value + 1, max(value - 1, 0), 0} - {value}:
                add(match, str(new) + ("u" if text.endswith("u") else ""), "constant")
        else:
            for new in ("0", "(2 * " + text + ")", "(0.5f * " + text + ")"):
                add(match, new, "constant")
    for match in re.finditer(r"\b(?:if|while) \((.*)\)(?: \{)?$", code):
        if match.group(1).count("(") == match.group(1).count(")"):
            for new in ("!(" + match.group(1) + ")", "0", "1"):
                add(match, new, "condition", 1)
    for match in re.finditer(r"(?<![\w)\]!])!(?=[\w(])", code):
        add(match, "", "condition")
    statement = re.fullmatch(r" +([\w.>\[\]*()+ -]+ [-+*|&]?= [^;]*|[\w.>\[\]-]+(?:\+\+|--)|\w+\([^;]*\)|break|continue);", code)
    if statement and not re.match(r" +(?:const |static |return|size_t |float |double |int |u?int\d+_t |nsvcd__\w+ \w|char |\(void\))", code):
        sites.append(Site(n, len(code) - len(code.lstrip()), len(code), ";", "statement"))
    for one, other in SWAPPED:
        for old, new in ((one, other), (other, one)):
            for match in re.finditer(rf"(?<![A-Za-z]){old}(?![A-Za-z])", code):
                add(match, new, "name")
    return sites


def all_sites(text: str, compiled: set[int]) -> list[Site]:
    lines = text.split("\n")
    inside = lines_of_functions(lines)
    sites = []
    for n, line in enumerate(lines):
        if n not in inside or n not in compiled or line.lstrip().startswith("#") or line.endswith("\\"):
            continue
        if '"' in line or "NSVCD__AT(" in line or "(void)" in line:
            continue
        sites += sites_of(n, line)
    return sites


def mutated(text: str, site: Site) -> str:
    lines = text.split("\n")
    line = lines[site.line]
    lines[site.line] = line[: site.begin] + site.new + line[site.end :]
    return "\n".join(lines)


# ------------------------------------------------------------------------------------------- run


class Bench:
    """The header, its tests, and how long these take on it."""

    def __init__(self, options: argparse.Namespace):
        self.options = options
        self.flags = options.flags.split()
        self.out = Path(options.out).resolve()
        self.out.mkdir(parents=True, exist_ok=True)
        self.text = (ROOT / HEADER).read_text()
        lines = self.text.split("\n")
        self.sections = sections_of(lines)
        self.sites = all_sites(self.text, lines_compiled(len(lines), options.cc, self.flags))
        if options.section:
            self.sites = [site for site in self.sites if self.sections[site.line] in options.section.split(",")]
        self.weights = self.weights_of_kinds()
        self.tests = sorted(path.stem.removeprefix("test_") for path in (ROOT / "tests").glob("test_*.c"))
        self.tests = [test for test in self.tests if test not in LEFT_OUT and self.needs_header(test)]
        # linked to the library, as a program is
        self.tests += sorted(f"promises_{path.stem}" for path in (ROOT / "tests" / "promises").glob("*.c"))
        if options.tests:
            self.tests = [test for test in self.tests if test in options.tests.split(",")]
        self.usual: dict[str, float] = {}
        self.code = ""

    def needs_header(self, test: str) -> bool:
        made = subprocess.run([self.options.cc, "-MM", "-I.", "-DTEST_ALONE", f"tests/test_{test}.c"], cwd=ROOT, capture_output=True,
                              text=True, check=True)
        return HEADER in made.stdout or "src/" in made.stdout

    def weights_of_kinds(self) -> list[float]:
        """Every kind of mistake is as likely as another, whatever the number of its sites."""
        counts: dict[str, int] = {}
        for site in self.sites:
            counts[site.kind] = counts.get(site.kind, 0) + 1
        return [1 / counts[site.kind] for site in self.sites]

    def folder(self, name: str, text: str) -> Path:
        """A copy of what the tests need, with this header."""
        folder = self.out / name
        shutil.rmtree(folder, ignore_errors=True)
        for part in ("tests", "tests/bench", "tests/promises", "packages", "examples", "examples/scenery"):
            (folder / part).mkdir(parents=True)
            for path in (ROOT / part).iterdir():
                if path.is_file() and path.suffix in (".c", ".h"):
                    (folder / part / path.name).symlink_to(path)
        for part in ("tests/data", "examples/assets", "examples/scenery/meshes", "examples/verify"):
            (folder / part).symlink_to(ROOT / part)
        (folder / "build").mkdir()
        (folder / "weights.h").symlink_to(ROOT / "weights.h")
        (folder / HEADER).write_text(text)
        (folder / "extras").symlink_to(ROOT / "extras")
        extras = {name: f"extras/neuralsvcd_{header}.h" for name, header in (("certificate", "certify"), ("robot", "robot"), ("world", "world"))}
        for path in [ROOT / "src/header.h", *(ROOT / "src").glob("*/*.h")]:
            room = folder / path.relative_to(ROOT)
            room.parent.mkdir(parents=True, exist_ok=True)
            up = "../" * (len(room.relative_to(folder).parts) - 1)
            room.write_text(f'#include "{up}{extras.get(path.parent.name, HEADER)}"\n')
        return folder

    def assembly(self, folder: Path) -> str:
        """What the compiler makes of the header; empty if it refuses it."""
        source = folder / "library.c"
        source.write_text('#define NEURALSVCD_IMPLEMENTATION\n#include "neuralsvcd.h"\n')
        made = subprocess.run([self.options.cc, *self.flags, "-std=c99", "-w", "-S", "-o", "-", "library.c"], cwd=folder,
                              capture_output=True, text=True)
        return made.stdout if made.returncode == 0 else ""

    @staticmethod
    def sources(test: str) -> list[str]:
        if test.startswith("promises_"):
            return [f"tests/promises/{test.removeprefix('promises_')}.c", "packages/neuralsvcd.c"]
        return [f"tests/test_{test}.c"]

    def run_test(self, folder: Path, test: str, limit: float) -> tuple[str, float]:
        """What went wrong, or nothing, and the seconds that it took."""
        command = [self.options.cc, *self.flags, "-std=c99", "-w", "-pthread", "-I.", "-DTEST_ALONE", "-DCHECK_ENDS_EARLY", "-o",
                   f"test_{test}", *self.sources(test), "-lm"]
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if made.returncode:
            return "does not compile", 0
        begin = time.monotonic()
        # Of memory and of what it prints there is an end, too.
        command = ["sh", "-c", f"ulimit -v 4000000; ulimit -f 200000; exec ./test_{test} >test_{test}.txt 2>&1"]
        try:
            status = subprocess.run(command, cwd=folder, timeout=limit).returncode
        except subprocess.TimeoutExpired:
            return f"no end in {limit:.0f} s", limit
        finally:
            (folder / f"test_{test}").unlink(missing_ok=True)
        seconds = time.monotonic() - begin
        if status == 0:
            return "", seconds
        said = (folder / f"test_{test}.txt").read_text(errors="replace")
        failed = re.findall(r"^(\w+) +FAILED$", said, flags=re.MULTILINE)
        return failed[0] if failed else f"status {status}", seconds

    def measure(self) -> bool:
        """The header itself: do the tests pass, and how long do they take?"""
        folder = self.folder("itself", self.text)
        self.code = self.assembly(folder)

        def one(test: str) -> tuple[str, str, float]:
            return (test, *self.run_test(folder, test, 3000))

        with ThreadPoolExecutor(self.options.jobs) as pool:
            for test, fault, seconds in pool.map(one, self.tests):
                if not fault:
                    self.usual[test] = seconds
                else:
                    print(f"mutate: the header itself fails: test_{test}.c: {fault}")
        shutil.rmtree(folder)
        return bool(self.code) and len(self.usual) == len(self.tests)

    def order(self, section: str) -> list[str]:
        floor, _, room = section.partition("/")
        first = FIRST.get(section, FIRST.get(floor, [room]))
        first = [test for test in first if test in self.tests]
        return first + sorted((test for test in self.tests if test not in first), key=lambda test: self.usual.get(test, 0))

    def draw(self, number: int) -> Mutant:
        """Mutant `number`: the first of its own row of sites that compiles to something else."""
        rng = random.Random(f"{self.options.seed} {number}")
        discarded = 0
        while True:
            site = rng.choices(self.sites, self.weights)[0]
            text = mutated(self.text, site)
            lines = text.split("\n")
            mutant = Mutant(number, site, self.sections[site.line], self.text.split("\n")[site.line], lines[site.line])
            mutant.discarded = discarded
            if self.options.list:
                return mutant
            folder = self.folder(f"mutant_{number}", text)
            code = self.assembly(folder)
            if code and code != self.code:
                return mutant
            discarded += 1

    def judge(self, number: int) -> Mutant:
        mutant = self.draw(number)
        folder = self.out / f"mutant_{number}"
        begin = time.monotonic()
        for test in self.order(mutant.section):
            fault, _ = self.run_test(folder, test, LIMIT * self.usual[test] + LEAST)
            mutant.asked.append(test)
            if fault:
                mutant.caught_by = f"test_{test}.c: {fault}"
                break
        mutant.seconds = time.monotonic() - begin
        shutil.rmtree(folder)
        return mutant


def described(mutant: Mutant) -> str:
    diff = difflib.ndiff([mutant.old.strip()], [mutant.new.strip()])
    change = "\n".join(f"    {line.rstrip()}" for line in diff if line[0] in "-+")
    place = f"mutant {mutant.number}: {HEADER}:{mutant.site.line + 1}: {mutant.section}: {mutant.site.kind}"
    if mutant.asked:
        place += f": caught by {mutant.caught_by}" if mutant.caught_by else ": SURVIVES"
        place += f" ({mutant.seconds:.0f} s, {len(mutant.asked)} files of tests)"
    return f"{place}\n{change}\n"


def options_of() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--part", type=int, default=0)
    parser.add_argument("--of", type=int, default=1)
    parser.add_argument("--numbers", default="", help="these only, by commas, in this order")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="no mutant is begun after so many")
    parser.add_argument("--section", default="", help="of these sections only, by commas")
    parser.add_argument("--tests", default="", help="by these files of tests only, by commas")
    parser.add_argument("--out", default="build/mutate")
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--flags", default="-O1 -DNSVCD_NO_DISPATCH")
    parser.add_argument("--list", action="store_true", help="shows them, and runs nothing")
    return parser.parse_args()


def main() -> int:
    options = options_of()
    begin = time.monotonic()
    bench = Bench(options)
    numbers = list(range(options.part, options.count, options.of))
    if options.numbers:
        numbers = [int(number) for number in options.numbers.split(",")]
    print(f"mutate: {len(bench.sites)} places for a mistake in {len({site.line for site in bench.sites})} lines")
    if options.list:
        print("".join(described(bench.draw(number)) for number in numbers))
        return 0
    if not bench.measure():
        return 1
    print(f"mutate: {len(bench.tests)} files of tests take {sum(bench.usual.values()):.0f} s on the header itself")
    log = (bench.out / f"part_{options.part}_of_{options.of}.txt").open("w")
    judged: list[Mutant] = []
    writes = threading.Lock()

    def one(number: int) -> None:
        if time.monotonic() - begin > options.seconds:
            return
        mutant = bench.judge(number)
        with writes:
            judged.append(mutant)
            log.write(described(mutant))
            log.flush()

    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, numbers))
    survivors = sorted((mutant for mutant in judged if not mutant.caught_by), key=lambda mutant: mutant.site.line)
    discarded = sum(mutant.discarded for mutant in judged)
    left = len(numbers) - len(judged)
    print("".join(described(mutant) for mutant in survivors), end="")
    closing = f"mutate: {len(judged) - len(survivors)} of {len(judged)} mutants caught, {discarded} discarded, seed "
    closing += f"{options.seed}, part {options.part} of {options.of}" + (f"; {left} not begun in time" if left else "")
    print(closing)
    log.write(closing + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
