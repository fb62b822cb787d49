# SPDX-License-Identifier: MIT
"""The structs of neuralsvcd.h, as ctypes has them. That they are the library's, _library.py sees to."""
from __future__ import annotations

import ctypes
from ctypes import c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any

_MAX_CONTACTS = 4
_WORLD_CONTACTS = 32
_MAX_JOINTS = 128
_MAX_VIA_POINTS = 32
_PROGRESS = ctypes.CFUNCTYPE(c_int, c_float, c_void_p)
_PLACE = ctypes.CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)
_PLAN_PROGRESS = ctypes.CFUNCTYPE(c_int, c_void_p, c_void_p)


def _struct(name: str, /, **kinds: Any) -> Any:
    return type(name, (ctypes.Structure,), {"_fields_": list(kinds.items())})


_Mesh = _struct("nsvcd_mesh", positions=c_void_p, indices=c_void_p, vertex_count=c_size_t, triangle_count=c_size_t)
_EncodeOptions = _struct(
    "nsvcd_encode_options", patches=c_size_t, patch_radius=c_float, convex_radius=c_float, open=c_int, latents=c_int,
    no_triangles=c_int, coarse=c_int, balls=c_size_t, progress=_PROGRESS, user=c_void_p)
_BodyFacts = _struct(
    "nsvcd_body_facts", size=c_size_t, patches=c_size_t, centre=c_float * 3, radius=c_float, extent=c_float,
    low=c_float * 3, high=c_float * 3, mean_patch_radius=c_float,
    triangles=c_size_t, stored_triangles=c_size_t, quantization_error=c_float, convex_radius=c_float, balls=c_size_t,
    ball_error=c_float, latents=c_int, components=c_size_t, open_components=c_size_t, open_edges=c_size_t, open=c_int)
_Pose = _struct("nsvcd_pose", position=c_float * 3, rotation=c_float * 4)
_NetworkOptions = _struct("nsvcd_network_options", pairs=c_size_t, model=c_int, precision=c_int, recall=c_float,
                          inflate=c_float)
_Mover = _struct("nsvcd_mover", body=c_void_p, poses=c_void_p, count=c_size_t, times=c_void_p, scale=c_float,
                 pivot=c_float * 3)
_Question = _struct(
    "nsvcd_question", a=_Mover, b=_Mover, ask=c_int, to=c_float, to_time=c_float, clearance=c_float, slop=c_float,
    tolerance=c_float, manifold=c_int, method=c_int, work=c_size_t, segments=c_size_t, network=_NetworkOptions,
    surfaces=c_int, stop=c_void_p, user=c_void_p)
_Range = _struct("nsvcd_range", low=c_float, high=c_float)
_Contact = _struct(
    "nsvcd_contact", point=c_float * 3, normal=c_float * 3, gap=c_float, time=c_float, triangle_a=c_uint32,
    triangle_b=c_uint32, patch_a=c_uint32, patch_b=c_uint32, id=c_uint32)
_SafePlace = _struct("nsvcd_safe_pose", time=c_float, a=_Pose, b=_Pose)
_Opinion = _struct(
    "nsvcd_opinion", asked=c_int, logit=c_float, distance=c_float, time=c_float, patch_a=c_uint32, patch_b=c_uint32,
    candidates=c_size_t, limited=c_int)
_Answer = _struct(
    "nsvcd_answer", verdict=c_int, by=c_int, why=c_int, inside=c_int, time=_Range, distance=_Range, safe=_SafePlace,
    depth=c_float, push_out=c_float * 3, contact_count=c_size_t, contacts=_Contact * _MAX_CONTACTS, nearest=_Contact,
    opinion=_Opinion, work=c_size_t)
_BodyPair = _struct("nsvcd_body_pair", a=c_uint32, b=c_uint32)
_PlanProgress = _struct(
    "nsvcd_plan_progress", seed=c_size_t, iteration=c_size_t, iterations=c_size_t, refining=c_int, cost=c_float,
    collision=c_float, control=c_void_p, via_points=c_size_t)
_PlanProblem = _struct(
    "nsvcd_plan_problem", joints=c_size_t, low=c_void_p, high=c_void_p, start=c_void_p, goal=c_void_p, bodies=c_void_p,
    body_count=c_size_t, pairs=c_void_p, pair_count=c_size_t, kinematics=_PLACE, jacobian=_PLACE, collision=c_void_p,
    progress=_PLAN_PROGRESS, user=c_void_p)
_PlanStage = _struct("nsvcd_plan_stage", via_points=c_size_t, segments=c_size_t, iterations=c_size_t, draws=c_size_t,
                     noise=c_float)
_PlanOptions = _struct(
    "nsvcd_plan_options", seed=c_uint64, seeds=c_size_t, explore=_PlanStage, refine=_PlanStage, velocity=c_float,
    acceleration=c_float, jerk=c_float, collision=c_float, duration=c_float, margin=c_float,
    discrete=c_int, check=c_size_t, sweep=_Question)
_PlanAnswer = _struct(
    "nsvcd_plan_answer", status=c_int, collides=c_int, joint=c_size_t, pair=c_size_t, logit=c_float, time=c_float,
    deviation=c_float, cost=c_float, smoothness=c_float, via_points=c_size_t, seeds=c_size_t,
    iterations=c_size_t, trajectories=c_size_t, sweeps=c_size_t)
_STOP = ctypes.CFUNCTYPE(c_int, c_void_p)
_Joint = _struct("nsvcd_joint", kind=c_int, parent=c_uint32, origin=_Pose, axis=c_float * 3, low=c_double,
                 high=c_double, speed=c_double, acceleration=c_double, mimic=c_uint32, multiplier=c_double, offset=c_double)
_Part = _struct("nsvcd_part", body=c_void_p, link=c_uint32, pose=_Pose, scale=c_float)
_Scene = _struct("nsvcd_scene", joints=c_void_p, joint_count=c_size_t, parts=c_void_p, part_count=c_size_t,
                 pairs=c_void_p, pair_count=c_size_t, clearances=c_void_p, allowances=c_void_p, allowance_count=c_size_t,
                 cones=c_void_p, cone_count=c_size_t)
_Allowance = _struct("nsvcd_allowance", pair=c_size_t, joints=c_void_p, distance=c_double)
_Cone = _struct("nsvcd_cone", part=c_uint32, axis=c_float * 3, direction=c_float * 3, angle=c_double)
_JointMotion = _struct("nsvcd_joint_motion", pieces=c_size_t, degree=c_size_t, points=c_void_p, times=c_void_p)
_PartialMotion = _struct("nsvcd_partial_motion", motion=_JointMotion, joints=c_void_p, joint_count=c_size_t, delay=c_double)
_CheckOptions = _struct("nsvcd_check_options", clearance=c_float, finest=c_float, work=c_size_t, stop=_STOP,
                        user=c_void_p, to_time=c_double)
_CheckAnswer = _struct(
    "nsvcd_check_answer", verdict=c_int, why=c_int, pair=c_size_t, piece=c_size_t, fraction=c_double, contact=_Contact,
    joint=c_size_t, placed=c_size_t, sweeps=c_size_t, free_until=c_double, cone=c_size_t)
_Proximity = _struct("nsvcd_proximity", pair=c_size_t, verdict=c_int, why=c_int, distance=_Range, depth=c_float, contact=_Contact,
               slope=c_double * _MAX_JOINTS)
_ProximityOptions = _struct("nsvcd_proximity_options", max_distance=c_float, to=c_float, max_depth=c_float, work=c_size_t)
_NearestFreeOptions = _struct("nsvcd_nearest_free_options", clearance=c_float, farthest=c_double, seed=c_uint64, stop=_STOP,
                         user=c_void_p)
_PairCounts = _struct("nsvcd_pair_counts", asked=c_size_t, adjacent=c_size_t, touching=c_size_t)
_ReachProblem = _struct(
    "nsvcd_reach_problem", start=c_void_p, link=c_uint32, tool=_Pose, target_link=c_uint32, target=_Pose, half=c_float * 3,
    free_axis=c_float * 3, stop=_STOP, user=c_void_p, held=c_void_p)
_ReachOptions = _struct("nsvcd_reach_options", position_tolerance=c_double, angle_tolerance=c_double, apart=c_double,
                        starts=c_size_t, seed=c_uint64, clearance=c_float, may_touch=c_int)
_ReachAnswer = _struct(
    "nsvcd_reach_answer", solutions=c_size_t, starts=c_size_t, reached=c_size_t, touching=c_size_t, best=c_double * _MAX_JOINTS,
    position_error=c_double, angle_error=c_double, check=_CheckAnswer)
_RouteProblem = _struct("nsvcd_route_problem", start=c_void_p, goals=c_void_p, goal_count=c_size_t, guess=c_void_p,
                        guess_count=c_size_t, stop=_STOP, abandon=_STOP, user=c_void_p, held=c_void_p)
_RouteOptions = _struct("nsvcd_route_options", seed=c_uint64, clearance=c_float, nodes=c_size_t, tries=c_size_t,
                        edge=c_double, looks=c_size_t, shortcuts=c_size_t, smoothings=c_size_t)
_RouteAnswer = _struct(
    "nsvcd_route_answer", status=c_int, goal=c_size_t, motion=_JointMotion, stops=c_size_t, duration=c_double,
    unhindered=c_double, check=_CheckAnswer, nodes=c_size_t, checks=c_size_t, proven=c_size_t,
    looks=c_size_t)
_CertifyOptions = _struct("nsvcd_certify_options", answer=c_void_p, visits=c_size_t)
_Certificate = _struct(
    "nsvcd_certificate", verdict=c_int, why=c_int, inside=c_int, time=c_double, size=c_size_t, visits=c_size_t)
_WorldBody = _struct("nsvcd_world_body", body=c_void_p, pose=_Pose, scale=c_float, pivot=c_float * 3, groups=c_uint32,
                     passes=c_uint32, fixed=c_int, sensor=c_int)
_WorldContact = _struct("nsvcd_world_contact", body=c_size_t, contact=_Contact, impulse=c_float)
_WorldQuestion = _struct("nsvcd_world_question", question=_Question, self=c_size_t, groups=c_uint32, passes=c_uint32)
_WorldAnswer = _struct(
    "nsvcd_world_answer", verdict=c_int, why=c_int, body=c_size_t, time=_Range, safe_time=c_float, safe=_Pose, depth=c_float,
    push_out=c_float * 3, contact_count=c_size_t, contacts=_WorldContact * _WORLD_CONTACTS, questions=c_size_t, work=c_size_t)
_SlideOptions = _struct(
    "nsvcd_slide_options", clearance=c_float, margin=c_float, mass=c_float, inertia=c_float * 3, friction=c_float,
    restitution=c_float, up=c_float * 3, step=c_float, slope=c_float, rounds=c_size_t, work=c_size_t)
_Velocity = _struct("nsvcd_velocity", linear=c_float * 3, angular=c_float * 3)
_SlideAnswer = _struct(
    "nsvcd_slide_answer", pose=_Pose, spent=c_float, rests=c_int, ground=c_size_t, ground_normal=c_float * 3, caught=c_size_t,
    contact_count=c_size_t, contacts=_WorldContact * _WORLD_CONTACTS, questions=c_size_t, work=c_size_t, told=_SlideOptions,
    given=_Velocity, seconds=c_float, clock=c_uint64, slides=c_uint64)
_WorldMover = _struct(
    "nsvcd_world_mover", id=c_size_t, how=_SlideOptions, velocity=_Velocity, push_mass=c_float, damping=c_float,
    spin_damping=c_float, asleep=c_int, sleepless=c_int, calm=c_float, answer=_SlideAnswer)
_StepOptions = _struct("nsvcd_step_options", gravity=c_float * 3, quiet=c_float, calm=c_float)
_StepAnswer = _struct("nsvcd_step_answer", awake=c_size_t, asleep=c_size_t, caught=c_size_t, contacts=c_size_t, questions=c_size_t,
                      work=c_size_t, refused=c_size_t)
_Mass = _struct("nsvcd_mass", volume=c_float, centre=c_float * 3, inertia=c_float * 3, is_of_box=c_int)
# All above: what _library.py compares with the header.
_STRUCTS: list[Any] = [
    kind for kind in globals().values() if isinstance(kind, type) and issubclass(kind, ctypes.Structure)]
_Layout = _struct("neuralsvcd_layout", name=c_char_p, place=c_size_t, size=c_size_t)
