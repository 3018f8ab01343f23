"""From a ``MotionPlanRequest`` to a trajectory, by the planning pipeline that it means."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gazelle.description.moveit import MoveItConfig, Pipeline
from gazelle.diagnostics import did_you_mean
from gazelle.extensions import ExtensionGroup, load_extensions
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import JointGroup
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.scene import PlanningScene
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.collision_object_messages import FrameOf
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.ompl_pipeline import OMPL
from gazelle.nodes.move_group.pilz_pipeline import PILZ
from gazelle.nodes.move_group.planning_pipeline import (
    Asked,
    PlannerChoice,
    PlanningJob,
    PlanningPipeline,
)
from gazelle.nodes.move_group.planning_problem import GroupProblem, ProblemMaker
from gazelle.nodes.move_group.planning_scene_messages import apply_robot_state

__all__ = ["Planned", "RequestPlanner", "choose_planner", "pipeline_of", "planning_pipeline"]


_OWN = (PILZ, OMPL)


@dataclass(frozen=True)
class Planned:
    """The answer to a request.

    Attributes:
        trajectory: positions with times.
        start: the robot's positions at its beginning.
        scene: what it was planned in.
        group: what it moves.
        planner: what planned it.
        time_s: how long that took.
        notes: what was done otherwise than asked.
    """

    trajectory: Trajectory
    start: FloatArray
    scene: PlanningScene
    group: str
    planner: str
    time_s: float
    notes: tuple[str, ...] = ()


class RequestPlanner:
    """Plans requests; several threads may use it.

    Attributes:
        maker: makes collision models and solvers.
        planner_params: what ``/set_planner_params`` changed, by group and planner.
    """

    def __init__(self, maker: ProblemMaker, *, seed: int = 0) -> None:
        """Plan with chance that begins at a seed: the same requests get the same answers."""
        self.maker = maker
        self.planner_params: dict[tuple[str, str], dict[str, str]] = {}
        self._seed = seed

    def plan(self, scene: PlanningScene, request: Any, frame_of: FrameOf) -> Planned:
        """Plan a ``MotionPlanRequest``.

        Args:
            scene: with the robot where it is.
            request: the request; its start state is laid over the scene's.
            frame_of: resolves frames.

        Raises:
            MoveGroupError: there is no plan, with MoveIt's code and why.
        """
        began = time.perf_counter()
        choice = self.choice(request)
        scene = apply_robot_state(scene, request.start_state, frame_of)
        problem = self.maker.problem(scene, request.group_name, frame_of)
        try:
            job = PlanningJob(self.maker.config, problem, choice, request, self._seed)
            trajectory, notes = choice.plans.plan(job)
        except PlanningError as error:
            raise MoveGroupError(error.code, error.reason) from error
        trajectory = _slowed_to_tip_speed(trajectory, problem, request)
        took_s = time.perf_counter() - began
        name = request.group_name
        return Planned(trajectory, scene.positions, scene, name, choice.planner, took_s, notes)

    def choice(self, request: Any) -> PlannerChoice:
        """Return what plans a request.

        Raises:
            MoveGroupError: there is no such group or pipeline.
        """
        group = self.maker.group(request.group_name)
        return choose_planner(
            self.maker.config,
            group,
            pipeline=getattr(request, "pipeline_id", ""),
            planner=request.planner_id,
            changed=self.planner_params,
        )


def pipeline_of(config: MoveItConfig, name: str) -> Pipeline:
    """Return a pipeline of the robot's files, the default one for an empty name.

    Raises:
        MoveGroupError: there is none of this name.
    """
    wanted = name or config.default_pipeline
    found = config.pipelines.get(wanted)
    if found is None and not name:
        return next(iter(config.pipelines.values()), Pipeline(OMPL.name))
    if found is None:
        hint = did_you_mean(name, config.pipelines)
        text = f"No planning pipeline available for name '{name}'; {hint}"
        raise MoveGroupError(ErrorCode.FAILURE, text)
    return found


def planning_pipeline(pipeline: Pipeline) -> tuple[PlanningPipeline, tuple[str, ...]]:
    """Return what plans for a pipeline of the robot's files.

    Returns:
        OMPL's where nobody has the planner that is meant, and why others' packages do not.
    """
    own = next((one for one in _OWN if one.is_meant(pipeline)), None)
    if own is not None:
        return own, ()
    added = load_extensions(ExtensionGroup.PIPELINES, PlanningPipeline)
    meant = (one.part for one in added.parts if one.part.is_meant(pipeline))
    found = next(meant, None)
    return (found, ()) if found is not None else (OMPL, added.problems)


def choose_planner(
    config: MoveItConfig,
    group: JointGroup,
    *,
    pipeline: str,
    planner: str,
    changed: Mapping[tuple[str, str], Mapping[str, str]] | None = None,
) -> PlannerChoice:
    """Return the planner for a request.

    Args:
        config: the robot's.
        group: what moves.
        pipeline: as the request has it, empty for the default one.
        planner: as the request has it, empty for the group's default one.
        changed: parameters that clients set, by group (or empty) and planner.

    Raises:
        MoveGroupError: there is no such pipeline.
    """
    found = pipeline_of(config, pipeline)
    plans, problems = planning_pipeline(found)
    choice = plans.choose(plans, Asked(found, group, planner, changed or {}))
    return replace(choice, notes=(*problems, *choice.notes)) if problems else choice


def _slowed_to_tip_speed(trajectory: Trajectory, problem: GroupProblem, request: Any) -> Trajectory:
    """Return the trajectory so slow that a link keeps to ``max_cartesian_speed``, m/s."""
    most = float(getattr(request, "max_cartesian_speed", 0.0))
    if most <= 0 or len(trajectory.times_s) < 2:
        return trajectory
    link = getattr(request, "cartesian_speed_limited_link", "") or problem.solver.tip_link
    if link not in problem.scene.robot.links:
        text = f"cartesian_speed_limited_link is '{link}', which the robot has not"
        raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, text)
    speeds = [
        float(np.linalg.norm(problem.solver.jacobian(q, link)[:3] @ v))
        for q, v in zip(trajectory.positions, trajectory.velocities, strict=True)
    ]
    factor = max(1.0, max(speeds) / most)
    return replace(
        trajectory,
        times_s=trajectory.times_s * factor,
        velocities=trajectory.velocities / factor,
        accelerations=trajectory.accelerations / factor**2,
    )
