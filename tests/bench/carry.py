#!/usr/bin/env python3
"""Makes both bodies of every problem of a file move: all is carried along by one common motion.

    tests/bench/carry.py IN.txt OUT.txt [ANGLE]

Without a turn (ANGLE 0, radians) the one is to the other what it was, at all times, and labels stay exact. With one that
holds at the poses only.
"""
import math
import os
import sys

Quaternion = tuple[float, float, float, float]  # x y z w
Pose = tuple[float, ...]  # x y z, and a quaternion


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    x, y, z, w = a
    i, j, k, r = b
    return (w * i + x * r + y * k - z * j, w * j - x * k + y * r + z * i,
            w * k + x * j - y * i + z * r, w * r - x * i - y * j - z * k)


def carry(t: float, angle: float, pose: Pose) -> Pose:
    """The pose after the common motion, at time t."""
    half = angle * t / 2
    turn = (0.6 * math.sin(half), 0.0, 0.8 * math.sin(half), math.cos(half))
    back = (-turn[0], -turn[1], -turn[2], turn[3])
    place = multiply(multiply(turn, (pose[0], pose[1], pose[2], 0.0)), back)
    way = (0.5 * t, 0.3 * t, 0.2 * t)
    moved = tuple(place[k] + way[k] for k in range(3))
    return moved + multiply(turn, (pose[3], pose[4], pose[5], pose[6]))


def line_of(pose: Pose) -> str:
    return ' '.join(f'{x:.9g}' for x in pose) + '\n'


def main(source: str, target: str, angle: float) -> None:
    folder = os.path.dirname(os.path.abspath(source))
    with open(source, encoding='ascii') as file:
        lines = file.read().splitlines()
    with open(target, 'w', encoding='ascii') as out:
        at = 0
        while at < len(lines):
            fields = lines[at].split('#')[0].split()
            at += 1
            if fields[:1] == ['mesh']:
                out.write(f'mesh {fields[1]} {os.path.join(folder, fields[2])}\n')
            elif fields[:1] == ['problem']:
                count = int(fields[15])
                other = tuple(float(x) for x in fields[6:13])
                poses = [tuple(float(x) for x in lines[at + k].split()) for k in range(count)]
                times = [k / max(count - 1, 1) for k in range(count)]
                at += count
                out.write(' '.join(fields) + f' {count}\n')
                out.writelines(line_of(carry(t, angle, pose)) for t, pose in zip(times, poses))
                out.writelines(line_of(carry(t, angle, other)) for t in times)
            elif fields:
                out.write(' '.join(fields) + '\n')


if __name__ == '__main__':
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) > 3 else 0.0)
