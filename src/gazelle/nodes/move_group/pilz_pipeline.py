"""The pipeline ``pilz_industrial_motion_planner``: PTP, LIN, CIRC, and sequences of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.description.moveit import MoveItConfig
from gazelle.diagnostics import did_you_mean
from gazelle.motion.constraints import OrientationConstraint, PositionConstraint
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.pilz import (
    Auxiliary,
    AuxiliaryKind,
    Command,
    CommandKind,
    PilzPlanner,
    plan_sequence,
)
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.goals import Goal
from gazelle.nodes.move_group.planning_pipeline import (
    Asked,
    PlannerChoice,
    PlanningJob,
    PlanningPipeline,
    SequenceJob,
    as_named,
)
from gazelle.nodes.move_group.planning_problem import GroupProblem

__all__ = ["PILZ"]


def _choose(plans: PlanningPipeline, asked: Asked) -> PlannerChoice:
    planner = asked.planner or asked.pipeline.default_planner or "PTP"
    return as_named(plans, asked._replace(planner=planner))


def _plan(job: PlanningJob) -> tuple[Trajectory, tuple[str, ...]]:
    command, link = _command(job.problem, job.choice.planner, job.request)
    made = _planner(job.config, job.problem, link).plan(job.problem.start_q, command)
    return made, made.notes


def _plan_sequence(job: SequenceJob) -> Trajectory:
    commands, link = [], ""
    for planner, request, radius_m in zip(job.planners, job.requests, job.radii_m, strict=True):
        command, own_link = _command(job.problem, planner, request, radius_m)
        commands.append(command)
        link = link or own_link
    planner_of_all = _planner(job.config, job.problem, link)
    return plan_sequence(planner_of_all, job.problem.start_q, commands)


def _planner(config: MoveItConfig, problem: GroupProblem, link: str) -> PilzPlanner:
    return PilzPlanner(
        problem.group.space,
        problem.solver,
        link=link,
        cartesian=config.cartesian_limits,
        deceleration=_decelerations(config, problem),
        validity=problem.checker,
    )


def _decelerations(config: MoveItConfig, problem: GroupProblem) -> FloatArray:
    """Return ``max_deceleration`` of each joint, its acceleration where there is none."""
    found = problem.group.space.acceleration.copy()
    for place, name in enumerate(problem.group.variables):
        limit = config.joint_limits.get(name)
        if limit is not None and limit.max_deceleration is not None:
            found[place] = -limit.max_deceleration
    return found


def _command(
    problem: GroupProblem, planner: str, request: Any, radius_m: float = 0.0
) -> tuple[Command, str]:
    """Return the command and the link that its goal is for, empty for joints."""
    names = [kind.value for kind in CommandKind]
    if planner.upper() not in names:
        text = f"Pilz has no planner '{planner}'; {did_you_mean(planner, names)}"
        raise MoveGroupError(ErrorCode.PLANNING_FAILED, text)
    kind = CommandKind(planner.upper())
    goal, link = _goal(problem, request)
    command = Command(
        kind,
        goal,
        _auxiliary(problem, request) if kind is CommandKind.CIRC else None,
        float(request.max_velocity_scaling_factor) or 1.0,
        float(request.max_acceleration_scaling_factor) or 1.0,
        radius_m,
    )
    return command, link


def _goal(problem: GroupProblem, request: Any) -> tuple[FloatArray, str]:
    if len(request.goal_constraints) != 1:
        text = f"Pilz takes exactly one goal, the request has {len(request.goal_constraints)}"
        raise MoveGroupError(ErrorCode.INVALID_GOAL_CONSTRAINTS, text)
    size = problem.group.space.size
    goal = Goal(problem.constraints(request.goal_constraints[0]), size)
    if goal.is_exact:
        return goal.centre, ""
    places = [one for one in goal.constraints if isinstance(one, PositionConstraint)]
    turns = [one for one in goal.constraints if isinstance(one, OrientationConstraint)]
    if len(places) != 1 or len(turns) != 1 or places[0].link != turns[0].link:
        text = "Pilz takes a position of every joint, or a position and an orientation of one link"
        raise MoveGroupError(ErrorCode.INVALID_GOAL_CONSTRAINTS, text)
    target = np.eye(4)
    target[:3, :3] = turns[0].orientation
    point = places[0].regions[0].pose[:3, 3]
    target[:3, 3] = point - target[:3, :3] @ np.array(places[0].offset_m)
    return target, places[0].link


def _auxiliary(problem: GroupProblem, request: Any) -> Auxiliary | None:
    """Return the point of a CIRC request; without it Pilz refuses the command itself."""
    along = request.path_constraints
    kinds = {kind.value: kind for kind in AuxiliaryKind}
    if along.name not in kinds or not len(along.position_constraints):
        return None
    place = along.position_constraints[0]
    poses = place.constraint_region.primitive_poses
    if not len(poses):
        return None
    T_frame = problem.T_planning_frame(place.header.frame_id)
    point = (T_frame @ pose_of(poses[0]).matrix())[:3, 3]
    return Auxiliary(kinds[along.name], point)


PILZ = PlanningPipeline(
    "pilz_industrial_motion_planner",
    "Pilz Industrial Motion Planner",
    lambda _: ["CIRC", "LIN", "PTP"],
    _choose,
    _plan,
    _plan_sequence,
)
