"""Where a body of a planning file is, by matrices: forward kinematics that shares nothing with the library.

    python3 tests/place.py FILE.txt BODY JOINT...       prints its pose, x y z qx qy qz qw
"""

import math
import sys
from pathlib import Path

Row = list[float]
Place = tuple[list[Row], Row]  # a rotation and a position


def turned(q: Row) -> list[Row]:
    length = math.sqrt(sum(c * c for c in q))
    x, y, z, w = (c / length for c in q)
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def then(outer: Place, inner: Place) -> Place:
    m, p = outer
    n, at = inner
    turn = [[sum(m[i][k] * n[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return turn, [p[i] + sum(m[i][k] * at[k] for k in range(3)) for i in range(3)]


def pose(words: list[str]) -> Place:
    numbers = [float(word) for word in words[:7]]
    return turned(numbers[3:]), numbers[:3]


def moved(words: list[str], value: float) -> Place:
    axis = [float(word) for word in words[10:13]]
    length = math.sqrt(sum(c * c for c in axis))
    if words[13] == "prismatic":
        return turned([0, 0, 0, 1]), [value * c / length for c in axis]
    return turned([math.sin(value / 2) * c / length for c in axis] + [math.cos(value / 2)]), [0, 0, 0]


def place(text: str, body: str, joints: Row) -> Place:
    frames: dict[str, Place] = {"world": (turned([0, 0, 0, 1]), [0, 0, 0])}
    values = iter(joints)
    for line in text.splitlines():
        f = line.split("#")[0].split()
        if f[:1] == ["joint"]:
            frames[f[1]] = then(then(frames[f[2]], pose(f[3:10])), moved(f, next(values)))
        if f[:2] == ["body", body]:
            own = pose(f[f.index("pose") + 1 :]) if "pose" in f else frames["world"]
            return then(frames[f[2]], own)
    raise SystemExit(f"no body {body}")


def quaternion(m: list[Row]) -> Row:
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        s = 2 * math.sqrt(1 + trace)
        return [(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4]
    i = max(range(3), key=lambda k: m[k][k])
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2 * math.sqrt(1 + m[i][i] - m[j][j] - m[k][k])
    q = [0.0, 0.0, 0.0, (m[k][j] - m[j][k]) / s]
    q[i], q[j], q[k] = s / 4, (m[i][j] + m[j][i]) / s, (m[i][k] + m[k][i]) / s
    return q


rotation, position = place(Path(sys.argv[1]).read_text(encoding="utf-8"), sys.argv[2], [float(x) for x in sys.argv[3:]])
print(*(f"{x:.9f}" for x in position + quaternion(rotation)))
