"""Tries to pass off certificates of examples/robot/pick.txt, where things are attached and may touch, for what they are not; and
certificates that two bodies never meet.

    python3 tests/forge.py    # from the repository's root; needs build/svcd, and build/verify or, named by VERIFY, another one
"""

import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

FILE = Path("examples/robot/pick.txt").read_text()
PLANS = ("reach", "grip", "carry", "open", "away")
CUP_AND_JAW, CUP_AND_TABLE = (2, 5), (3, 5)  # parts, as the file has them: those that may touch
VERIFY = os.environ.get("VERIFY", "build/verify")
FAR = "two are farther from where they may touch than is allowed"
STANDS = "what is attached, or released, does not stand where it stood"


@dataclass
class Proof:
    """The bytes of a certificate, taken apart."""

    pieces: int = 0
    degree: int = 0
    joints: int = 0
    times: list[float] = field(default_factory=list)
    points: list[float] = field(default_factory=list)
    poses: list[list[float]] = field(default_factory=list)
    pairs: list[tuple[tuple[int, int] | None, bytes]] = field(default_factory=list)
    rest: bytes = b""

    def bytes(self) -> bytes:
        out = b"NSVM" + struct.pack("<3I", self.pieces, self.degree, self.joints)
        out += struct.pack(f"<{len(self.times)}d{len(self.points)}d", *self.times, *self.points)
        for pose in self.poses:
            out += struct.pack("<7f", *pose)
        out += struct.pack("<I", len(self.pairs))
        for pieces, proof in self.pairs:
            out += (struct.pack("<2I", *pieces) if pieces else b"") + struct.pack("<I", len(proof)) + proof
        return out + self.rest


def pairs_of(plan: str) -> list[tuple[int, int]]:
    """Palm, right_jaw, left_jaw, table, rack, cup; in `carry` the cup is on the palm's link."""
    links = [1, 1, 2, 0, 0, 1 if plan == "carry" else 0]
    return [(a, b) for a in range(6) for b in range(max(a + 1, 3), 6) if links[a] != links[b]]


def parse(data: bytes, plan: str) -> Proof:
    p, at = Proof(), 16
    p.pieces, p.degree, p.joints = struct.unpack_from("<3I", data, 4)

    def take(kind: str) -> list[float]:
        nonlocal at
        out = list(struct.unpack_from("<" + kind, data, at))
        at += struct.calcsize("<" + kind)
        return out

    p.times = take(f"{p.pieces + 1}d")
    p.points = take(f"{(p.pieces * p.degree + 1) * p.joints}d")
    p.poses = [take("7f") for _ in range(plan in ("carry", "open"))]
    (count,) = struct.unpack_from("<I", data, at)
    at += 4
    for pair in pairs_of(plan)[:count]:
        pieces = None
        if pair in (CUP_AND_JAW, CUP_AND_TABLE):
            pieces = struct.unpack_from("<2I", data, at)
            at += 8
        (size,) = struct.unpack_from("<I", data, at)
        p.pairs.append((pieces, data[at + 4 : at + 4 + size]))
        at += 4 + size
    p.rest = data[at:]
    return p


class Forger:
    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.tried = 0
        self.failed = 0
        self.good = self.made(FILE)

    def made(self, text: str) -> dict[str, bytes]:
        """The certificates that svcd makes of a planning file."""
        (self.folder / "made.txt").write_text(text)
        subprocess.run(["build/svcd", "plan", self.folder / "made.txt", "--certificates", self.folder], check=True, capture_output=True)
        return {plan: (self.folder / f"{plan}.cert").read_bytes() for plan in PLANS}

    def said(self, text: str, proofs: dict[str, bytes], *options: str) -> dict[str, str]:
        """What is said of each plan: accepted, or why not."""
        (self.folder / "asked.txt").write_text(text)
        for plan in PLANS:
            (self.folder / f"{plan}.cert").unlink(missing_ok=True)
            if plan in proofs:
                (self.folder / f"{plan}.cert").write_bytes(proofs[plan])
        run = subprocess.run([VERIFY, self.folder / "asked.txt", self.folder, *options], capture_output=True, text=True, check=False)
        if run.returncode not in (0, 1):
            return {plan: f"exit status {run.returncode}: {run.stderr}" for plan in PLANS}
        lines = [line.split("\t") for line in run.stdout.splitlines()]
        return {line[0]: line[1] if line[1] == "accepted" else line[2] for line in lines}

    def expect(self, what: str, said: dict[str, str], **wanted: str) -> None:
        self.tried += 1
        for plan, text in wanted.items():
            if not re.match(text, said.get(plan, "nothing")):
                print(f"FAILED {what}: {plan}: {said.get(plan)}, not {text}")
                self.failed += 1

    def forged(self, what: str, plan: str, proof: Proof | bytes, text: str) -> None:
        data = proof.bytes() if isinstance(proof, Proof) else proof
        self.expect(what, self.said(FILE, {**self.good, plan: data}), **{plan: text})


def is_near(p: Proof, first: int, last: int, there: int, pair: tuple[int, int], metres: float) -> bool:
    """May a pair touch in these pieces? By the joints' own values, at many times, and a lever of its own."""
    for piece in range(first, last):
        for k in range(9):
            rows = [p.points[(piece * p.degree + i) * p.joints : (piece * p.degree + i + 1) * p.joints] for i in range(p.degree + 1)]
            while len(rows) > 1:
                rows = [[x + (y - x) * k / 8 for x, y in zip(a, b)] for a, b in zip(rows, rows[1:])]
            off = [abs(x - y) for x, y in zip(rows[0], p.points[there * p.degree * p.joints :])]
            # the jaw slides on what carries the cup; the cup is round, and turns about its middle, in which the table sees it
            moved = off[4] if p.poses and pair == CUP_AND_JAW else math.hypot(*off[:3]) + (off[4] if pair == CUP_AND_JAW else 0)
            if moved > metres * 1.000001:
                return False
    return True


def of_claims(f: Forger) -> None:
    """Pieces in which two may touch, and poses of what is attached."""
    for plan in PLANS:
        proof = parse(f.good[plan], plan)
        if proof.bytes() != f.good[plan] or proof.rest:
            raise SystemExit(f"{plan}: it is not taken apart rightly")
        for n, (pieces, data) in enumerate(proof.pairs):
            if not pieces or pieces[0] == pieces[1]:
                continue
            until, since = pieces
            for claim in ((until + 1, since), (until, since - 1), (proof.pieces, proof.pieces), (0, 0)):
                changed = parse(f.good[plan], plan)
                changed.pairs[n] = claim, b"" if claim[0] == claim[1] else data
                f.forged(f"{plan}: pair {n} may touch but from {claim[0]} to {claim[1]}", plan, changed, FAR)
            changed = parse(f.good[plan], plan)
            changed.pairs[n] = (since, until) if since > until else (until, proof.pieces + 1), data
            f.forged(f"{plan}: pair {n} from {since} back to {until}", plan, changed, "two may touch in pieces that are none")
            changed.pairs[n] = (until, since), b""
            f.forged(f"{plan}: pair {n} without a proof", plan, changed, "it is|it ends")
        for k in range(7 * len(proof.poses)):
            for off in (2e-6, -2e-6, math.nan, math.inf):
                changed = parse(f.good[plan], plan)
                changed.poses[0][k] += off
                # a longer quaternion turns as far, but is another one
                text = STANDS + ("|it is about another motion" if k == 6 else "")
                f.forged(f"{plan}: a pose {off} off in {k}", plan, changed, text if math.isfinite(off) else "what is attached is at no pose")
    touching = parse(f.good["carry"], "carry")
    n = pairs_of("carry").index(CUP_AND_JAW)
    touching.pairs[n] = touching.pairs[n][0], b"\x00"
    f.forged("a proof where none is due", "carry", touching, "a pair that may touch all the time has a proof")
    longer = f.made(re.sub("^allow cup table", r"\g<0> 0.5", FILE, flags=re.MULTILINE))
    f.expect("more metres than the file has", f.said(FILE, longer), carry=FAR, open=FAR + "|it begins|what was")
    f.expect("... and a file that has them", f.said(FILE.replace("cup table", "cup table 0.5"), longer), carry="accepted", away="accepted")


def of_sequences(f: Forger) -> None:
    """Other planning files than that of which the certificates are."""
    lost = "what was attached or released above is not known|it begins where no plan above is accepted"
    none = "it begins where no plan above is accepted"
    moved = "its motion has another start or goal"
    other = {
        "another joint": (("attach cup turn", "attach cup z"), {"grip": "accepted", "carry": STANDS + "|it is about", "open": lost}),
        "the jaw": (("attach cup turn", "attach cup jaw"), {"grip": "accepted", "carry": STANDS, "open": lost}),
        "another cup": (("-0.3 0.1 0.05", "-0.3 0.10001 0.05"), {"grip": "(?!accepted)", "carry": lost, "away": none}),
        "nothing attached": (("attach cup turn\n", ""), {"carry": "(?!accepted)"}),
        "nothing released": (("release cup\n", ""), {"carry": "accepted", "open": "(?!accepted)", "away": none}),
        "attached before": (("plan grip", "attach cup turn\nplan grip"), {"grip": "(?!accepted)", "carry": lost}),
        "another start": (("kitchen  0.3 0 0", "kitchen  0.3 0 0.001"), {"reach": moved, "grip": "accepted", "away": "accepted"}),
        "another goal": (("goal carry pose 0.3", "goal carry pose 0.30001"), {"carry": moved, "open": lost, "away": none}),
        "no plan above": ((re.search("plan grip.*\n", FILE)[0], ""), {"reach": "accepted", "carry": moved, "open": lost}),  # type: ignore[index]
        "nothing allowed": (("allow cup table\n", ""), {"grip": "accepted", "carry": "(?!accepted)", "open": lost}),
        "less allowed": (("cup table\n", "cup table 0.001\n"), {"carry": FAR, "open": lost}),
        "allowed late": (("allow cup left_jaw\n", ""), {"grip": "(?!accepted)", "carry": lost}),
        "a path above": (("plan carry", "path p kitchen 1\n-0.3 0.1 -0.515 0 -0.0007\nplan carry"), {"grip": "accepted", "carry": lost}),
        "the palm": (("attach cup", "attach palm"), {plan: "exit status 2" for plan in PLANS}),
    }
    for what, ((old, new), wanted) in other.items():
        if FILE.count(old) != 1:
            raise SystemExit(f"{what}: {old} is there {FILE.count(old)} times")
        f.expect(what, f.said(FILE.replace(old, new), f.good), **wanted)
    for n, plan in enumerate(PLANS):
        rest = {one: data for one, data in f.good.items() if one != plan}
        wanted = {one: lost for one in PLANS[max(n + 1, 2) :]}
        f.expect(f"no certificate of {plan}", f.said(FILE, rest), **(wanted if plan != "reach" else {"grip": "accepted", "away": "accepted"}))
    f.expect("one alone", f.said(FILE, f.good, "--only", "carry"), carry=none)
    f.expect("one with those above", f.said(FILE, f.good, "--only", "grip,carry"), carry="accepted")
    own = FILE.replace("plan away kitchen", "plan away kitchen 0.3 -0.2 -0.515 0 0.02")
    f.expect("its own start, and lost things", f.said(own, {"away": f.good["away"]}), away="what was attached or released above")
    f.expect("... that are not lost", f.said(own, f.good), away="accepted")
    twice = FILE.replace("release cup\n", "release cup\nattach cup jaw\nrelease cup\n")
    f.expect("taken and released at once", f.said(twice, f.made(twice)), **{plan: "accepted" for plan in PLANS})


NEVER = """nsvcd-plans 1
joint lift world  0 0 0  0 0 0 1  0 1 0 revolute -1 1 1
joint aside world  0 0.25 0  0 0 0 1  0 0 1 prismatic -0.1 0.1 1
joint bend lift  0 0 0.5  0 0 0 1  0 1 0 revolute -0.5 0.5 1
body post aside box: 0.1 0.2 1
body hand bend capsule: 0.05 0.3  pose 0 0 0.2  0 0 0 1
"""
Box = tuple[int, float, bytes]  # a code, and, of one that has a proof, its clearance and that


def boxes_of(data: bytes) -> list[Box]:
    out, at = [], 4
    while at < len(data):
        code, at = data[at], at + 1
        clearance, proof = 0.0, b""
        if code < 128:
            clearance, size = struct.unpack_from("<fI", data, at)
            proof = data[at + 8 : at + 8 + size]
            at += 8 + size
        out.append((code, clearance, proof))
    return out


def bytes_of(boxes: list[Box]) -> bytes:
    return b"NSVN" + b"".join(bytes([c]) + (b"" if c > 127 else struct.pack("<fI", m, len(p)) + p) for c, m, p in boxes)


def of_never(f: Forger, count: int) -> None:
    """A proof that a hand never meets a post: parts of it left out, and what is not of this robot."""
    (f.folder / "made.txt").write_text(NEVER)
    subprocess.run(["build/svcd", "pairs", f.folder / "made.txt", "--certificates", f.folder], check=True, capture_output=True)
    path = f.folder / "post-hand.cert"
    good = path.read_bytes()
    boxes = boxes_of(good)
    if bytes_of(boxes) != good or len(boxes) < 9:
        raise SystemExit(f"it is not taken apart rightly, or has only {len(boxes)} boxes")

    def said(text: str, data: bytes) -> str:
        (f.folder / "asked.txt").write_text(text)
        path.write_bytes(data)
        run = subprocess.run([VERIFY, "--pairs", f.folder / "asked.txt", f.folder], capture_output=True, text=True, check=False)
        words = run.stdout.split("\t")
        return words[1] if words[1:2] == ["accepted"] else (words + [run.stderr] * 3)[2]

    def expect(what: str, text: str, data: bytes, wanted: str) -> None:
        f.expect(what, {"never": said(text, data)}, never=wanted)

    expect("as it is", NEVER, good, "accepted")
    refused = "(?!accepted)"
    for old, new in (("revolute -1 1", "revolute -1 1.001"), ("revolute -1 1", "revolute -1.001 1"), ("-0.5 0.5 1", "-0.5 0.51 1"),
                     ("-0.1 0.1", "-0.1 0.11"), ("0.25 0", "0.249 0"), ("0 0 0.2", "0 0.01 0.2"), ("capsule: 0.05", "capsule: 0.051"),
                     ("box: 0.1", "box: 0.11"), ("revolute -1 1", "continuous -1 1"), ("0 0 0.5", "0 0 0.51")):
        expect(f"{new} for {old}", NEVER.replace(old, new, 1), good, refused)
    expect("limits that are none", NEVER.replace("-0.5 0.5", "0.5 -0.5"), good, ".*LOW is above HIGH")
    leaves = [n for n, box in enumerate(boxes) if box[0] < 128]
    for n in leaves[:20]:
        code, metres, proof = boxes[n]
        less = "joints of a box move a point farther than its clearance"
        for change in ((code, metres * 0.9, proof), (code, 0.0, proof), (code, math.nan, proof)):
            expect(f"a clearance of {change[1]}", NEVER, bytes_of(boxes[:n] + [change] + boxes[n + 1 :]), less)
        expect("more clearance", NEVER, bytes_of(boxes[:n] + [(code, metres * 1.1, proof)] + boxes[n + 1 :]), "it is about another motion")
        expect("a box twice", NEVER, bytes_of(boxes[: n + 1] + boxes[n:]), refused)
        expect("no box", NEVER, bytes_of(boxes[:n] + boxes[n + 1 :]), refused)
        expect("along another joint", NEVER, bytes_of(boxes[:n] + [((code + 1) % 3, metres, proof)] + boxes[n + 1 :]), refused)
        expect("along none", NEVER, bytes_of(boxes[:n] + [(3, metres, proof)] + boxes[n + 1 :]), "a joint is not between the two")
    for n in range(len(boxes)):
        if boxes[n][0] > 127 and n < 20:
            expect("not cut", NEVER, bytes_of(boxes[:n] + boxes[n + 1 :]), refused)
            expect("cut along another joint", NEVER, bytes_of(boxes[:n] + [(128 + (boxes[n][0] - 127) % 3, 0, b"")] + boxes[n + 1 :]), refused)
    expect("all of it", NEVER, bytes_of([(0, 1e-3, b"")]), refused)
    expect("cut for ever", NEVER, bytes_of([(128, 0, b"")] * 1000), "it is too deep")
    expect("more of it", NEVER, good + b"\0", "something follows its end")
    expect("less of it", NEVER, good[:-1], "it ends early")
    expect("nothing", NEVER, b"", "it is no certificate of two bodies")
    rng = random.Random(2)
    for n in range(count):
        data = bytearray(good)
        at = rng.randrange(len(data))
        data[at] ^= 1 << rng.randrange(8)
        if said(NEVER, bytes(data)) == "accepted":
            changed = boxes_of(bytes(data))
            # a clearance is rounded once the hand's radius is added
            same = [box[0] for box in changed] == [box[0] for box in boxes]
            same = same and all(abs(a[1] - b[1]) < 1e-7 for a, b in zip(changed, boxes))
            f.expect(f"{n}: accepted bytes", {"never": str(same)}, never="True")


def of_bytes(f: Forger, count: int) -> None:
    """Bytes at random: what is accepted of them moves as before, and claims what is so."""
    rng = random.Random(1)
    accepted = 0
    for n in range(count):
        plan = rng.choice(PLANS)
        data = bytearray(f.good[plan])
        for _ in range(rng.choice((1, 1, 2, 4))):
            at = rng.randrange(len(data))
            if rng.random() < 0.7:
                data[at] ^= 1 << rng.randrange(8)
            elif rng.random() < 0.5:
                data[at] = rng.choice((0, 1, 127, 128, 255))
            else:
                del data[at : at + rng.randrange(1, 9)]
        said = f.said(FILE, {**f.good, plan: bytes(data)}).get(plan, "nothing")
        f.expect(f"{n}: bytes of {plan}", {plan: said}, **{plan: "(?!exit|nothing)"})
        if said != "accepted":
            continue
        accepted += 1
        was, now = parse(f.good[plan], plan), parse(bytes(data), plan)
        same = (was.points, was.times, len(was.pairs)) == (now.points, now.times, len(now.pairs))
        for pair, (pieces, _) in zip(pairs_of(plan), now.pairs):
            if pieces:
                same = same and is_near(now, 0, pieces[0], 0, pair, 0.005) and is_near(now, pieces[1], now.pieces, now.pieces, pair, 0.005)
        for a, b in zip(was.poses, now.poses):
            same = same and max(abs(x - y) for x, y in zip(a, b)) < 3e-7
        f.expect(f"{n}: accepted bytes of {plan}", {plan: str(same)}, **{plan: "True"})
    print(f"{count} changes of bytes, {accepted} of which leave a proof")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        f = Forger(Path(folder))
        f.expect("as they are", f.said(FILE, f.good), **{plan: "accepted" for plan in PLANS})
        of_claims(f)
        of_sequences(f)
        of_never(f, int(os.environ.get("TEST_MANY", "1")) * 100)
        of_bytes(f, int(os.environ.get("TEST_MANY", "1")) * 300)
        print(f"{f.tried} attempts, {f.failed} of which are not refused as they should be")
        sys.exit(f.failed > 0)


if __name__ == "__main__":
    main()
