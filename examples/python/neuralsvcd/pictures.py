# SPDX-License-Identifier: MIT
"""Pictures of answers and routes, by matplotlib. Answer.plot and Route.plot come here."""
from __future__ import annotations

import importlib
from collections.abc import Iterable, Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Verdict
from ._arrays import Doubles
from .bodies import Body, _body_of
from .meshes import Mesh
from .motions import _motion, _Motion

_MOST_FACES = 20000  # of a mesh: of a finer one every second, third, ... is drawn
_MOST_ROUND = 200
_BALL = np.array([[np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)]
                  for b in np.linspace(-np.pi / 2, np.pi / 2, 9) for a in np.linspace(0, 2 * np.pi, 16, endpoint=False)])


def _pyplot() -> Any:
    try:
        return importlib.import_module("matplotlib.pyplot")
    except ImportError as error:
        raise ImportError("plot needs matplotlib: pip install matplotlib, or apt install python3-matplotlib") from error


def _triangles_of(body: Body) -> Doubles:
    """(n, 3, 3): the surface of a body as it looks; of one that has no mesh the balls about its patches."""
    mesh, radius = body.mesh, body.facts.convex_radius
    if mesh is not None and not radius:
        return np.asarray(mesh.vertices[mesh.faces[::-(-len(mesh.faces) // _MOST_FACES)]], np.float64)
    if mesh is not None:
        cores = mesh.vertices[mesh.faces[::-(-len(mesh.faces) // _MOST_ROUND)]]
        rounds = [(core[:, None] + radius * _BALL).reshape(-1, 3) for core in cores]
    else:
        patches = [body.patch(k) for k in range(0, body.facts.patches, -(-body.facts.patches // _MOST_ROUND))]
        rounds = [np.add(centre, size * _BALL) for centre, size in patches]
    hulls = [Mesh.hull(points) for points in rounds]
    return np.asarray(np.concatenate([hull.vertices[hull.faces] for hull in hulls]), np.float64)


def _placed(triangles: Doubles, pose: NDArray[Any], scale: float = 1) -> Doubles:
    x, y, z, w = (float(number) for number in pose[3:] / np.linalg.norm(pose[3:]))
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    placed = np.empty_like(triangles)
    placed[:] = scale * triangles @ turn.T + pose[:3]
    return placed


def _pose_at(motion: _Motion, time: float) -> NDArray[Any]:
    """Linear, and slerp."""
    if motion.poses is None:
        return np.array([0, 0, 0, 0, 0, 0, 1.0])
    poses = motion.poses.astype(np.float64)
    if len(poses) == 1:
        return np.asarray(poses[0])
    times = np.linspace(0, 1, len(poses)) if motion.times is None else motion.times
    k = int(np.clip(np.searchsorted(times, time, "right") - 1, 0, len(poses) - 2))
    s = float(np.clip((time - times[k]) / (times[k + 1] - times[k]), 0, 1))
    p, q = poses[k, 3:], poses[k + 1, 3:]
    q = -q if p @ q < 0 else q
    angle = np.arccos(min(1.0, float(p @ q)))
    shares = (1 - s, s) if angle < 1e-6 else np.sin([(1 - s) * angle, s * angle]) / np.sin(angle)
    return np.concatenate([(1 - s) * poses[k, :3] + s * poses[k + 1, :3], shares[0] * p + shares[1] * q])


def _axes_for(axes: Any) -> Any:
    return _pyplot().figure(figsize=(8, 7)).add_subplot(projection="3d", computed_zorder=False) if axes is None else axes


def _draw(axes: Any, triangles: Doubles, colour: Any, alpha: float, order: int) -> None:
    collection = importlib.import_module("mpl_toolkits.mplot3d.art3d").Poly3DCollection
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = 0.65 + 0.35 * np.abs(normals @ [0.4, -0.5, 0.77]) / np.maximum(lengths, 1e-30)
    faces = np.concatenate([np.outer(light, colour), np.full((len(light), 1), alpha)], 1)
    axes.add_collection3d(collection(triangles, facecolors=faces.clip(0, 1), zorder=order))


def _frame(axes: Any, drawn: Iterable[Doubles]) -> None:
    """The same scale along all axes, and all of it within."""
    points = np.concatenate([triangles.reshape(-1, 3) for triangles in drawn])
    least = 0.2 * float(np.ptp(points, axis=0).max())  # of a flat one, so that its labels have room
    middle, half = (points.min(0) + points.max(0)) / 2, np.maximum(np.ptp(points, axis=0), least) / 2
    for set_limits, centre, size in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle, half):
        set_limits(centre - size, centre + size)
    axes.set_box_aspect(half, zoom=1.1)
    for axis, set_label in zip("xyz", (axes.set_xlabel, axes.set_ylabel, axes.set_zlabel)):
        set_label(f"{axis}, m")


_BLUE, _GREY, _RED = (0.25, 0.5, 0.85), (0.62, 0.62, 0.62), (0.85, 0.1, 0.1)


def _plot_answer(answer: Any, bodies: Sequence[Any], poses: Sequence[Optional[ArrayLike]], times: Sequence[Optional[ArrayLike]],
                 scales: Sequence[float], axes: Any) -> Any:
    axes = _axes_for(axes)
    is_hit = answer.verdict is Verdict.HIT
    at = answer.time.high if is_hit else answer.time.low
    drawn: list[Doubles] = []
    for side, body, colour in zip((0, 1), bodies, (_BLUE, _GREY)):
        motion = _motion(poses[side], times[side], ("_a", "_b")[side], one=True)
        triangles = _triangles_of(_body_of(body, "ab"[side]))
        moves = motion.poses is not None and len(motion.poses) > 1
        for time in np.linspace(0, 1, 6 if moves else 0):
            drawn.append(_placed(triangles, _pose_at(motion, float(time)), scales[side]))
            _draw(axes, drawn[-1], colour, 0.06, 1)
        drawn.append(_placed(triangles, _pose_at(motion, at), scales[side]))
        _draw(axes, drawn[-1], colour, 0.75 if side == 0 else 0.35, 3 - side)
        if moves:
            track = np.array([_pose_at(motion, time)[:3] for time in np.linspace(0, 1, 100)])
            axes.plot(*track.T, color=colour, linewidth=1, zorder=4)
    _frame(axes, drawn)
    size = 0.1 * max(np.ptp(limits) for limits in (axes.get_xlim(), axes.get_ylim(), axes.get_zlim()))
    for contact in answer.contacts:
        axes.scatter(*contact.point, color=_RED, s=40, zorder=5)
        axes.quiver(*contact.point, *contact.normal, length=size, color=_RED, zorder=5)
    when = f" at {at:.3g}" if is_hit else ""
    axes.set_title(f"{answer.verdict}{when}, by {answer.by}")
    return axes


def _plot_route(route: Any, robot: Any, count: int, axes: Any) -> Any:
    if route.points is None:
        raise ValueError("no route was found")
    axes = _axes_for(axes)
    times = np.linspace(0, route.duration, count)
    places = np.array([robot.forward_kinematics(joints) for joints in route.at(times)])
    drawn: list[Doubles] = []
    for k, (body, scale) in enumerate(robot._drawn()):
        triangles = _triangles_of(body)
        moves = np.ptp(places[:, k], axis=0).max() > 1e-6
        for n in range(count) if moves else (0,):
            drawn.append(_placed(triangles, places[n, k], scale))
            share = n / max(count - 1, 1)
            colour = _pyplot().get_cmap("viridis")(share)[:3] if moves else _GREY
            _draw(axes, drawn[-1], colour, (0.9 if n in (0, count - 1) else 0.4) if moves else 0.2, 2 if moves else 1)
    _frame(axes, drawn)
    axes.set_title(f"{route.duration:.3g} s, from violet to yellow")
    return axes
