# SPDX-License-Identifier: MIT
"""The library, loaded: its functions, and whether it is of the header that this package is written for."""
from __future__ import annotations

import ctypes
from ctypes import byref, c_char_p, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path

from .words import LEAVE_OUT, NO_TRIANGLE, _number_of, _PREFIXES
from ._structs import _BodyFacts, _Layout, _MAX_CONTACTS, _MAX_JOINTS, _MAX_VIA_POINTS, _STRUCTS, _WORLD_CONTACTS

_PROTOTYPES = {
    "nsvcd_result_string": (c_char_p, c_int),
    "nsvcd_mesh_cut": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_mesh_hull": (c_int, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_mesh_of_heights": (c_int, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_mesh_mass": (c_int, c_void_p, c_void_p),
    "nsvcd_mesh_free": (None, c_void_p, c_void_p),
    "nsvcd_encode": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_encode_box": (c_int, c_void_p, c_float, c_void_p, c_void_p),
    "nsvcd_body_free": (None, c_void_p, c_void_p),
    "nsvcd_body_load": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_body_scale": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_body_describe": (_BodyFacts, c_void_p),
    "nsvcd_body_patch": (c_int, c_void_p, c_uint32, c_void_p, c_void_p),
    "nsvcd_sweep_workspace_size": (c_size_t, c_void_p),
    "nsvcd_sweep": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_sweep_batch": (c_int, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_contacts": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_sweep_gradient": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_spline": (None, c_void_p, c_size_t, c_size_t, c_float, c_size_t, c_void_p),
    "nsvcd_plan_workspace_size": (c_size_t, c_void_p, c_void_p),
    "nsvcd_plan": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_checker_size": (c_size_t, c_void_p),
    "nsvcd_checker_open": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_forward_kinematics": (None, c_void_p, c_void_p, c_void_p),
    "nsvcd_check": (c_int, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_merge_motions_size": (c_size_t, c_void_p, c_size_t, c_size_t),
    "nsvcd_merge_motions": (c_int, c_void_p, c_size_t, c_size_t, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_proximities": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_nearest_free": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
    "nsvcd_find_pairs": (c_int, c_void_p, c_size_t, c_uint64, c_void_p, c_size_t, c_void_p),
    "nsvcd_reparent": (c_int, c_void_p, c_void_p, c_size_t, c_uint32, c_void_p),
    "nsvcd_reach": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_route_size": (c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_route": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_tree_size": (c_size_t, c_void_p),
    "nsvcd_tree_build": (c_int, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_certify_workspace_size": (c_size_t, c_void_p, c_void_p, c_void_p),
    "nsvcd_certify": (c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_size": (c_size_t, c_size_t),
    "nsvcd_world_begin": (c_int, c_void_p, c_size_t, c_size_t, c_void_p),
    "nsvcd_world_add": (c_int, c_void_p, c_void_p, c_void_p),
    "nsvcd_world_move": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_remove": (c_int, c_void_p, c_size_t),
    "nsvcd_world_get": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_drive": (c_int, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_arrive": (c_int, c_void_p),
    "nsvcd_world_sweep": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_list": (c_int, c_void_p, c_void_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_pairs": (c_int, c_void_p, c_float, c_void_p, c_size_t, c_void_p),
    "nsvcd_world_slide": (c_int, c_void_p, c_size_t, c_void_p, c_float, c_void_p, c_size_t, c_void_p, c_void_p),
    "nsvcd_world_step": (c_int, c_void_p, c_void_p, c_size_t, c_void_p, c_float, c_void_p, c_size_t, c_void_p),
    "neuralsvcd_mesh_parse": (c_char_p, c_char_p, c_char_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p),
    "neuralsvcd_layouts": (c_void_p, c_void_p),
    "neuralsvcd_version": (c_char_p,),
}


def _expected_layouts() -> dict[str, tuple[int, int]]:
    """What neuralsvcd_layouts of _neuralsvcd.c must say, if all above is as in neuralsvcd.h."""
    expected = {"NSVCD_NO_TRIANGLE": (NO_TRIANGLE, 0), "NSVCD_MAX_CONTACTS": (_MAX_CONTACTS, 0),
                "NSVCD_WORLD_CONTACTS": (_WORLD_CONTACTS, 0),
                "NSVCD_MAX_VIA_POINTS": (_MAX_VIA_POINTS, 0), "NSVCD_NONE": (LEAVE_OUT, 0),
                "NSVCD_MAX_JOINTS": (_MAX_JOINTS, 0)}
    for values, prefix in _PREFIXES.items():
        expected.update({f"NSVCD_{prefix}{value.name}": (_number_of(value), 0) for value in values})
    for kind in _STRUCTS:
        expected[kind.__name__] = (0, ctypes.sizeof(kind))
        for name, _ in kind._fields_:
            member = getattr(kind, name)
            expected[f"{kind.__name__}.{name}"] = (member.offset, member.size)
    return expected


def _load_library() -> ctypes.CDLL:
    """The library beside this file, as a wheel has it, or the one that `make python` has built."""
    here = Path(__file__).resolve().parent
    places = [here / "_neuralsvcd.abi3.so", here.parents[2] / "build" / "_neuralsvcd.so"]
    path = next((place for place in places if place.exists()), None)
    if path is None:
        raise ImportError(f"neuralsvcd: the library is not built: make python; looked for {places[0]}, {places[1]}")
    library = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    count = c_size_t()
    first = library.neuralsvcd_layouts(byref(count))
    table = (_Layout * count.value).from_address(first)
    found = {entry.name.decode(): (entry.place, entry.size) for entry in table}
    expected = _expected_layouts()
    wrong = sorted(name for name in {*found, *expected} if found.get(name) != expected.get(name))
    if wrong:
        raise ImportError(f"neuralsvcd: {path} is of another neuralsvcd.h than this module: {', '.join(wrong)}")
    return library


_library = _load_library()
__version__: str = _library.neuralsvcd_version().decode()
