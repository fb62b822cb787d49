# SPDX-License-Identifier: MIT
"""MuJoCo's geoms as bodies: what do they meet on the way from sample to sample? To be copied.

    python3 mujoco_scene.py scene.xml 2      # steps for 2 s, and says who meets whom first, and when

Bodies are exact but for cylinders and ellipsoids, which are hulls around them, larger by 0.5% and 2% of a radius at most, and
planes, which are boxes of 200 m. Between samples geoms move straight and turn evenly. Where geoms rest on each other they are in
contact: slop=0.01 leaves out contacts at the start that are no deeper.
"""
from __future__ import annotations

import importlib
import sys
from typing import Any

import numpy as np

import neuralsvcd as nsvcd

PLANE, HEIGHTS, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)  # mjtGeom


def body_of(model: Any, geom: int, *, hulls: bool = True) -> nsvcd.Body:
    """A geom, in its own frame. hulls: of a mesh its convex hull, which is what MuJoCo's contacts are about; else itself."""
    kind, (x, y, z) = int(model.geom_type[geom]), (float(size) for size in model.geom_size[geom])
    data = int(model.geom_dataid[geom])
    if kind == SPHERE:
        return nsvcd.Body.sphere(x)
    if kind == CAPSULE:  # a radius, and half of the segment's length
        return nsvcd.Body.capsule([0, 0, -y], [0, 0, y], x)
    if kind == BOX:  # halves
        return nsvcd.Body.box([2 * x, 2 * y, 2 * z])
    if kind == PLANE:  # what is below it
        return nsvcd.Body(nsvcd.Mesh.box([200, 200, 10]), origin=[0, 0, 5])
    if kind == CYLINDER:
        angles = np.arange(32) * (np.pi / 16)
        circle = np.stack([np.cos(angles), np.sin(angles)], 1) * (x / np.cos(np.pi / 32))
        return nsvcd.Body.hull([[*point, end] for point in circle for end in (-y, y)])
    if kind == ELLIPSOID:
        heights = (np.arange(200) + 0.5) / 100 - 1
        angles, widths = np.arange(200) * (np.pi * (1 + 5 ** 0.5)), np.sqrt(1 - heights ** 2)
        ball = nsvcd.Mesh.hull(np.stack([widths * np.cos(angles), widths * np.sin(angles), heights], 1))
        a, b, c = np.moveaxis(ball.vertices[ball.faces].astype(float), 1, 0)
        normals = np.cross(b - a, c - a)
        inner = (np.abs((normals * a).sum(1)) / np.linalg.norm(normals, axis=1)).min()  # a ball within the hull
        return nsvcd.Body.hull(ball.vertices / inner * [x, y, z])
    if kind == MESH:  # in the frame of the geom already
        first, last = model.mesh_vertadr[data], model.mesh_vertadr[data] + model.mesh_vertnum[data]
        vertices = model.mesh_vert[first:last]
        faces = model.mesh_face[model.mesh_faceadr[data]:model.mesh_faceadr[data] + model.mesh_facenum[data]]
        return nsvcd.Body.hull(vertices) if hulls else nsvcd.Body(vertices, faces)
    if kind == HEIGHTS:  # solid, down to its base
        rows, columns, start = (int(field[data]) for field in (model.hfield_nrow, model.hfield_ncol, model.hfield_adr))
        half_x, half_y, height, base = (float(size) for size in model.hfield_size[data])
        heights = model.hfield_data[start:start + rows * columns].reshape(rows, columns) * height
        top = nsvcd.Mesh.heights(heights, [2 * half_x / (columns - 1), 2 * half_y / (rows - 1)])
        bottom = top.vertices * [1, 1, 0] - [0, 0, base]
        grid, below = np.arange(rows * columns).reshape(rows, columns), rows * columns
        rim = np.concatenate([grid[0, :-1], grid[:-1, -1], grid[-1, :0:-1], grid[:0:-1, 0]])
        ahead = np.roll(rim, -1)
        walls = np.concatenate([np.stack([rim + below, ahead + below, ahead], 1), np.stack([rim + below, ahead, rim], 1)])
        faces = np.concatenate([top.faces, top.faces[:, ::-1] + below, walls])
        return nsvcd.Body(np.concatenate([top.vertices, bottom]), faces, origin=[half_x, half_y, 0])
    raise ValueError(f"geom {geom}: type {kind} does not collide")


def pairs_of(model: Any) -> list[tuple[int, int]]:
    """Geoms that MuJoCo would let collide: by their masks, not of one body, nor of a body and its parent. <pair> and <exclude> are
    not looked at."""
    welded = model.body_weldid[model.geom_bodyid]
    above = model.body_weldid[model.body_parentid[welded]]
    pairs = []
    for i in range(model.ngeom):
        for j in range(i + 1, model.ngeom):
            masks = (model.geom_contype[i] & model.geom_conaffinity[j]) | (model.geom_contype[j] & model.geom_conaffinity[i])
            are_linked = welded[i] == welded[j] or (welded[i] and welded[j] and (welded[i] == above[j] or welded[j] == above[i]))
            if masks and not are_linked:
                pairs.append((i, j))
    return pairs


def poses_of(data: Any) -> Any:
    """(geoms, 7), as they are now; after mj_step that is where the step began, as data.contact is."""
    return nsvcd.poses(data.geom_xpos, rotations=data.geom_xmat)


def main(mujoco: Any, path: str, seconds: float, **options: Any) -> None:
    """mujoco: the module. options: of neuralsvcd.sweep."""
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    samples = []
    while data.time < seconds:
        mujoco.mj_step(model, data)
        samples.append(poses_of(data))
    pairs = pairs_of(model)
    bodies = {geom: body_of(model, geom) for geom in {geom for pair in pairs for geom in pair}}
    paths = np.stack(samples, 1)  # (geoms, samples, 7)
    a, b = np.array(pairs, int).reshape(-1, 2).T
    answers: Any = nsvcd.sweep([bodies[geom] for geom in a], [bodies[geom] for geom in b], paths[a], paths[b], ask="first",
                          to_time=1e-4, **options)
    duration = model.opt.timestep * (len(samples) - 1)
    for k in np.argsort(answers.time.high):
        if answers[k].verdict != "free":
            names = (mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geom) or f"geom {geom}" for geom in pairs[k])
            print(f"{answers[k].time.high * duration:.4f} s: {answers[k].verdict}: {', '.join(names)}")
    print(f"{(answers.verdict == 'free').sum()} of {len(pairs)} pairs never meet, {len(samples)} samples")


if __name__ == "__main__":
    main(importlib.import_module("mujoco"), sys.argv[1], float(sys.argv[2]))
