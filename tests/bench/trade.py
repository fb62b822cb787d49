"""README's picture of the trade: time against wrong answers, both on logarithmic axes, a panel for each set of problems.

  trade.py TABLE.tsv PICTURE.svg [RUN.tsv]

With RUN.tsv, which `build/bench --trade` writes, TABLE.tsv is made first: the proof, the network's three sizes, all samples of
the mesh hierarchy, and of the other methods the settings that no other one of theirs beats in time and in answers at once.
"""

import csv
import math
import sys

METHODS = {  # name in the table: colour (Okabe and Ito's, which the colour-blind can tell apart), name in the picture
    "proof": ("#d55e00", "proof, the default"),
    "NeuralSVCD": ("#0072b2", "network: tiny, small, base"),
    "full mesh, BVH": ("#000000", "mesh hierarchy, 4 to 64 samples"),
    "convex parts + GJK": ("#009e73", "convex parts, sampled"),
    "spheres, sphere-mesh distance": ("#cc79a7", "spheres, sampled"),
}
SETS = {"real": "In the open", "hollow": "In hollows", "rest": "At rest and sliding"}
WIDTH, HEIGHT = 270, 300  # of a panel's axes
LEFT, TOP, STEP = 90, 100, 300
FASTEST, SLOWEST = 0.2, 1000  # microseconds
MOST, LEAST = 30, 0.1  # per cent wrong
NONE = 30  # pixels from the top: the line of those that were never wrong


def read(path: str) -> list[dict[str, str]]:
    with open(path, encoding="utf-8") as file:
        rows = [line for line in file if not line.startswith("#")]
    return list(csv.DictReader(rows, delimiter="\t"))


def is_shown(row: dict[str, str]) -> bool:
    if row["method"] not in METHODS or row["set"] not in SETS:
        return False
    return row["front"] == "1" or row["method"] in ("proof", "NeuralSVCD", "full mesh, BVH")


def make_table(rows: list[dict[str, str]], path: str) -> None:
    columns = ["set", "method", "setting", "accuracy", "missed", "stopped", "median_us", "p99_us", "bytes"]
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("# What trade.svg shows. Made by `make trade-picture MEASURE=1 MESHES=folder`: 600 problems a set.\n")
        table = csv.DictWriter(file, columns, delimiter="\t", lineterminator="\n", extrasaction="ignore")
        table.writeheader()
        table.writerows(row for row in rows if is_shown(row))


def x_of(microseconds: float) -> float:
    return WIDTH * math.log(min(microseconds, SLOWEST) / FASTEST) / math.log(SLOWEST / FASTEST)


def y_of(wrong: float) -> float:
    if wrong == 0:
        return NONE
    return 2 * NONE + (HEIGHT - 2 * NONE) * math.log(wrong / LEAST) / math.log(MOST / LEAST)


def text(x: float, y: float, words: str, more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{words}</text>\n'


def axes(name: str, is_first: bool) -> str:
    out = f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff" stroke="#d5dae1"/>\n'
    out += f'<rect width="{WIDTH}" height="{1.5 * NONE}" fill="#eaf5ee"/>\n'
    out += text(0, -12, name, 'font-size="16" font-weight="700" fill="#1b2430"')
    for time in (1, 10, 100, 1000):
        at = x_of(time)
        out += f'<path d="M{at:.1f} 0V{HEIGHT}" stroke="#e6e9ee"/>' if time < SLOWEST else ""
        out += text(at, HEIGHT + 20, "1 ms" if time == 1000 else f"{time} µs", 'text-anchor="middle"')
    for wrong in (0.1, 1, 10):
        at = y_of(wrong)
        out += f'<path d="M0 {at:.1f}H{WIDTH}" stroke="#e6e9ee"/>'
        out += text(-10, at + 5, f"{100 - wrong:g} %", 'text-anchor="end"') if is_first else ""
    out += text(-10, NONE + 5, "all right", 'text-anchor="end" font-weight="700"') if is_first else ""
    return out


def marks(rows: list[dict[str, str]]) -> str:
    out = ""
    for method, (colour, _) in reversed(METHODS.items()):
        points = [
            (x_of(float(row["median_us"])), y_of(round(100 - float(row["accuracy"]), 3)), x_of(float(row["p99_us"])))
            for row in rows
            if row["method"] == method
        ]
        points.sort()
        line = "L".join(f"{x:.1f} {y:.1f}" for x, y, _ in points)
        out += f'<g stroke="{colour}" fill="{colour}">'
        for x, y, slow in points:
            out += f'<path d="M{x:.1f} {y:.1f}H{slow:.1f}" stroke-width="1.2" opacity=".35"/>'
        out += f'<path d="M{line}" fill="none" stroke-width="2"/>'
        for x, y, _ in points:
            out += f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{7 if method == "proof" else 4}" stroke="#fff"/>'
        out += "</g>\n"
    return out


def legend() -> str:
    out = ""
    for i, (colour, name) in enumerate(METHODS.values()):
        x, y = LEFT + STEP * (i % 3), TOP + HEIGHT + 58 + 26 * (i // 3)
        out += f'<circle cx="{x + 7}" cy="{y - 5}" r="6" fill="{colour}"/>' + text(x + 22, y, name)
    x, y = LEFT + 2 * STEP, TOP + HEIGHT + 58 + 26
    out += f'<circle cx="{x + 7}" cy="{y - 5}" r="4" fill="#5a6675"/><path d="M{x + 7} {y - 5}h30" stroke="#5a6675" opacity=".6"/>'
    return out + text(x + 46, y, "median, and as far as 99 of 100")


def picture(rows: list[dict[str, str]]) -> str:
    wide, tall = LEFT + 2 * STEP + WIDTH + 30, TOP + HEIGHT + 104
    out = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{tall}" viewBox="0 0 {wide} {tall}" '
        'font-family="Helvetica, Arial, sans-serif" font-size="14" fill="#5a6675">\n'
        f'<rect width="{wide}" height="{tall}" rx="10" fill="#f6f7f9"/>\n'
    )
    out += text(LEFT, 34, "How often right, and how fast?", 'font-size="20" font-weight="700" fill="#1b2430"')
    out += text(LEFT, 58, "600 motions a panel, most of which pass or touch within millimetres; one thread")
    for i, (name, words) in enumerate(SETS.items()):
        out += f'<g transform="translate({LEFT + STEP * i} {TOP})">\n'
        out += axes(words, i == 0) + marks([row for row in rows if row["set"] == name]) + "</g>\n"
    return out + legend() + "</svg>\n"


def main() -> None:
    table, svg = sys.argv[1:3]
    if len(sys.argv) > 3:
        make_table(read(sys.argv[3]), table)
    with open(svg, "w", encoding="utf-8") as file:
        file.write(picture(read(table)))


if __name__ == "__main__":
    main()
