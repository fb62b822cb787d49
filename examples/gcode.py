#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""gcode.py - the way of a tool, from G-code to a table for `svcd sweep --poses`.

    python3 examples/gcode.py part.nc >way.csv &&
    svcd sweep tool.stl fixture.stl --scale 0.001 --poses way.csv --all

Reads G0 to G3 (arcs in any plane, by I J K or R, helices too), G4 (P in seconds), G17 to G19, G20, G21, G90, G91, G90.1,
G91.1, G92 and F. The places are those of the tool's tip, as the program has them: it is to be the origin of the tool's
mesh. The tool does not turn. Prints `t, x, y, z  # line N`: seconds, metres, the line of the program. An arc becomes chords
that leave it by --chord at most: ask svcd for that much --clearance. Time is way by feed, without acceleration. No motion
is dropped in silence: a code that is not known, an axis other than X, Y and Z, and a variable end it, with the line, the
exit status 1 and no table at all;
--skip G28,G53 passes over lines with these codes and says so. M, S, T, H, D, N and O are skipped, and so are G40, G43,
G49, G54, G64, G80, G94 and the like.
"""
import argparse
import math
import os
import re
import sys

HARMLESS = {40, 43, 49, 50, 61, 61.1, 64, 69, 80, 94, 97, 98, 99}
PLANES = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}  # the two axes of an arc, and the one across


class Refused(Exception):
    pass


def words_of(line):
    """[(letter, number)] of a line, without what is in comments."""
    text = re.sub(r"\([^)]*\)|;.*", "", line).strip().upper()
    if text.startswith(("%", "/")):
        return []
    text = re.sub(r"\s", "", text)
    found = re.findall(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))", text)
    if "".join(letter + number for letter, number in found) != text:
        raise Refused(f"not understood: {line.strip()}")
    return [(letter, float(number)) for letter, number in found]


def arc_points(start, end, centre, plane, clockwise, chord):
    """Points of an arc after its start, of a helix where the ends differ across the plane."""
    u, v, w = plane
    radius = math.hypot(start[u] - centre[u], start[v] - centre[v])
    other = math.hypot(end[u] - centre[u], end[v] - centre[v])
    if radius == 0 or abs(radius - other) > 1e-5 + 1e-3 * radius:
        raise Refused(f"an arc begins {radius:g} m from its centre and ends {other:g} m from it")
    begins = math.atan2(start[v] - centre[v], start[u] - centre[u])
    turn = math.atan2(end[v] - centre[v], end[u] - centre[u]) - begins
    turn = -((-turn) % (2 * math.pi)) if clockwise else turn % (2 * math.pi)
    if abs(turn) < 1e-9:
        turn = -2 * math.pi if clockwise else 2 * math.pi
    step = 2 * math.acos(max(0.0, 1 - chord / max(radius, other)))
    count = max(1, math.ceil(abs(turn) / min(step, math.pi / 4)))
    for i in range(1, count + 1):
        share = i / count
        r, angle = radius + share * (other - radius), begins + share * turn
        point = [0.0, 0.0, 0.0]
        point[u], point[v] = centre[u] + r * math.cos(angle), centre[v] + r * math.sin(angle)
        point[w] = start[w] + share * (end[w] - start[w])
        yield point if i < count else list(end)


def centre_of(words, start, end, plane, clockwise, unit, absolute):
    """Of an arc, by its words."""
    u, v, _ = plane
    if "R" in words:
        radius = words["R"] * unit
        du, dv = end[u] - start[u], end[v] - start[v]
        way = math.hypot(du, dv)
        if way == 0 or way > 2 * abs(radius) * (1 + 1e-4):
            raise Refused("an arc of such a radius does not join its ends")
        aside = math.sqrt(max(0.0, radius * radius - way * way / 4)) * (1 if (radius > 0) != clockwise else -1)
        centre = list(start)
        centre[u] += du / 2 - aside * dv / way
        centre[v] += dv / 2 + aside * du / way
        return centre
    if not any(letter in words for letter in "IJK"):
        raise Refused("an arc without I, J, K or R")
    return [words.get(letter, 0.0) * unit + (0.0 if absolute else start[k]) if letter in words or not absolute
            else start[k] for k, letter in enumerate("IJK")]


def table(lines, start, rapid, chord, skipped):
    """Yields (seconds, [x, y, z] in metres, line)."""
    unit, relative, arc_absolute, plane, mode, feed = 0.001, False, False, PLANES[17], None, None
    at, offset, now = start, [0.0, 0.0, 0.0], 0.0
    yield now, list(at), 0
    for number, line in enumerate(lines, 1):
        try:
            found = words_of(line)
            codes = [value for letter, value in found if letter == "G"]
            words = {letter: value for letter, value in found if letter not in "GMNOSTHD"}
            if skipped.intersection(codes):
                print(f"gcode.py: line {number} is skipped: {line.strip()}", file=sys.stderr)
                continue
            pauses = sets = False
            for code in codes:
                if code in (0, 1, 2, 3):
                    mode = int(code)
                elif code in PLANES:
                    plane = PLANES[int(code)]
                elif code in (20, 21):
                    unit = 0.0254 if code == 20 else 0.001
                elif code in (90, 91):
                    relative = code == 91
                elif code in (90.1, 91.1):
                    arc_absolute = code == 90.1
                elif code == 4:
                    pauses = True
                elif code == 92:
                    sets = True
                elif code not in HARMLESS and not 54 <= code <= 59.3:
                    raise Refused(f"G{code:g} is not known (--skip G{code:g} passes over lines with it)")
            rotary = sorted(set("ABCUVW") & set(words))
            if rotary:
                raise Refused(f"axis {rotary[0]}: only X, Y and Z are known")
            if "F" in words:
                feed = words["F"] * unit / 60
            if pauses:
                now += words.get("P", words.get("X", 0.0))
                continue
            target = list(at)
            for k, letter in enumerate("XYZ"):
                if letter in words and sets:
                    offset[k] = at[k] - words[letter] * unit
                elif letter in words:
                    target[k] = words[letter] * unit + (at[k] if relative else offset[k])
            if sets or not any(letter in words for letter in "XYZIJKR"):
                continue
            if mode is None:
                raise Refused("a place before any of G0 to G3")
            speed = rapid if mode == 0 else feed
            if not speed:
                raise Refused("no feed: F is missing, or 0")
            points = [target]
            if mode > 1:
                centre = centre_of(words, at, target, plane, mode == 2, unit, arc_absolute)
                points = arc_points(at, target, centre, plane, mode == 2, chord)
            for point in points:
                way = math.dist(at, point)
                if way == 0:
                    continue
                now, at = now + way / speed, point
                yield now, list(at), number
        except Refused as refused:
            raise SystemExit(f"gcode.py: line {number}: {refused}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="a file of G-code; -: standard input")
    parser.add_argument("--start", default="0,0,0", metavar="X,Y,Z",
                        help="mm: where the tool is as it begins; with =, as in --start=-300,0,50, if a minus is first (%(default)s)")
    parser.add_argument("--rapid", type=float, default=5000, help="mm a minute of G0 (%(default)s)")
    parser.add_argument("--chord", type=float, default=0.005, help="mm that a chord may leave its arc by (%(default)s)")
    parser.add_argument("--skip", default="", metavar="G28,...", help="pass over lines with these codes")
    options = parser.parse_args()
    start = [float(x) / 1000 for x in options.start.split(",")]
    skipped = re.split("[,G]+", options.skip.upper().strip(",G")) if options.skip else []
    if not options.rapid > 0 or not options.chord > 0 or len(start) != 3:
        parser.error("--start is X,Y,Z; --rapid and --chord are above 0")
    with sys.stdin if options.program == "-" else open(options.program, encoding="utf-8", errors="replace") as lines:
        rows = list(table(lines, start, options.rapid / 60000, options.chord / 1000, {float(code) for code in skipped}))
    # a part of a table would be proven free as if it were all: so it is printed once it is whole
    print("t, x, y, z")
    for when, (x, y, z), line in rows:
        print(f"{when:.9g}, {x:.9g}, {y:.9g}, {z:.9g}  # line {line}")
    sys.stdout.flush()


if __name__ == "__main__":
    try:
        main()
    except OSError as error:  # of the program, or of whoever reads the table
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # else python flushes into it once more, and complains
        sys.exit(f"gcode.py: {error}")
