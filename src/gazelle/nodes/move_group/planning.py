"""From a ``MotionPlanRequest`` to a trajectory."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gazelle.motion.constraints import Constrained, PathConstraint
from gazelle.motion.planning import Path, PlanningError, plan
from gazelle.motion.scene import PlanningScene
from gazelle.motion.space import FloatArray
from gazelle.motion.timing import Trajectory, method_of, parameterise
from gazelle.nodes.move_group.error_codes import ErrorCode, MoveGroupError
from gazelle.nodes.move_group.goals import Goal, GoalSampler
from gazelle.nodes.move_group.pilz_requests import plan_with_pilz
from gazelle.nodes.move_group.pipelines import PlannerChoice, choose_planner
from gazelle.nodes.move_group.planning_scene_messages import apply_robot_state
from gazelle.nodes.move_group.problem import GroupProblem, ProblemMaker
from gazelle.nodes.move_group.scene_messages import FrameOf

__all__ = ["Planned", "RequestPlanner", "slowed_to_tip_speed", "timed"]

_LEAST_TIME_S = 1.0
_SEEDS = 7919


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
            if choice.is_pilz:
                trajectory = plan_with_pilz(self.maker.config, problem, choice, request)
                notes: tuple[str, ...] = trajectory.notes
            else:
                trajectory, notes = self._sampled(problem, choice, request)
        except PlanningError as error:
            raise MoveGroupError(ErrorCode(int(error.code)), error.reason) from error
        trajectory = slowed_to_tip_speed(trajectory, problem, request)
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
            group.space,
            group=group.name,
            pipeline=getattr(request, "pipeline_id", ""),
            planner=request.planner_id,
            changed=self.planner_params,
        )

    def _sampled(
        self, problem: GroupProblem, choice: PlannerChoice, request: Any
    ) -> tuple[Trajectory, tuple[str, ...]]:
        along = problem.constraints(request.path_constraints)
        goals = _goals(problem, request.goal_constraints)
        path = self._best_path(problem, choice, request, along, goals)
        scaling = _scaling(request, "velocity"), _scaling(request, "acceleration")
        trajectory, notes = timed(path, problem, choice, *scaling, along=along)
        return trajectory, (*choice.notes, *path.notes, *notes)

    def _best_path(
        self,
        problem: GroupProblem,
        choice: PlannerChoice,
        request: Any,
        along: tuple[PathConstraint, ...],
        goals: Sequence[Goal],
    ) -> Path:
        """Plan as often as asked within the time allowed and take the shortest path."""
        limit_s = float(request.allowed_planning_time)
        deadline = time.perf_counter() + (limit_s if limit_s > 0 else _LEAST_TIME_S)
        best: Path | None = None
        for attempt in range(max(1, int(request.num_planning_attempts))):
            left_s = deadline - time.perf_counter()
            if best is not None and left_s <= 0:
                break
            try:
                path = self._path(problem, choice, along, goals, attempt, max(left_s, 0.01))
            except PlanningError as error:
                if best is not None:
                    break
                raise _explained(error, goals) from error
            best = path if best is None or path.length < best.length else best
        assert best is not None
        return best

    def _path(
        self,
        problem: GroupProblem,
        choice: PlannerChoice,
        along: tuple[PathConstraint, ...],
        goals: Sequence[Goal],
        attempt: int,
        limit_s: float,
    ) -> Path:
        exact = [goal.centre for goal in goals if goal.is_exact]
        start = problem.start_q
        sampler = GoalSampler(goals, problem.solver, start, problem.checker)
        return plan(
            problem.group.space,
            problem.checker,
            start,
            exact if len(exact) == len(goals) else sampler,
            planner=choice.planner,
            seed=self._seed + attempt * _SEEDS,
            time_limit_s=limit_s,
            constraints=along,
            settings=choice.settings,
        )


def timed(
    path: Path | FloatArray,
    problem: GroupProblem,
    choice: PlannerChoice,
    velocity: float,
    acceleration: float,
    *,
    along: tuple[PathConstraint, ...] = (),
) -> tuple[Trajectory, tuple[str, ...]]:
    """Return a path with times, as the pipeline's adapters ask for them.

    Corners are rounded only so far that what must hold along the path still does.
    """
    method, notes = method_of(choice.adapters)
    values = choice.values
    made = parameterise(
        path,
        problem.group.space,
        velocity_scaling=velocity,
        acceleration_scaling=acceleration,
        method=method,
        resample_dt_s=_positive(values, "resample_dt", 0.1),
        path_tolerance=_positive(values, "path_tolerance", 0.1),
        validity=Constrained(problem.checker, along) if along else problem.checker,
    )
    return made, (*notes, *made.notes)


def slowed_to_tip_speed(trajectory: Trajectory, problem: GroupProblem, request: Any) -> Trajectory:
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


def _goals(problem: GroupProblem, messages: Sequence[Any]) -> tuple[Goal, ...]:
    size = problem.group.space.size
    goals = tuple(Goal(problem.constraints(message), size) for message in messages)
    if not goals or not all(goal.constraints for goal in goals):
        text = "No goal constraints specified: the request has no goal, or an empty one"
        raise MoveGroupError(ErrorCode.INVALID_GOAL_CONSTRAINTS, text)
    return goals


def _explained(error: PlanningError, goals: Sequence[Goal]) -> PlanningError:
    """Name the pose where inverse kinematics finds nothing."""
    told = [goal.told() for goal in goals if goal.told()]
    if int(error.code) != ErrorCode.NO_IK_SOLUTION or not told:
        return error
    text = f"inverse kinematics finds no configuration with {'; or '.join(told[:3])}"
    return PlanningError(error.code, f"{text} (out of reach, or beyond the joint limits)")


def _scaling(request: Any, kind: str) -> float:
    """Return a scaling factor; as in MoveIt 0 and what makes no sense is 1."""
    value = float(getattr(request, f"max_{kind}_scaling_factor"))
    return value if 0 < value <= 1 else 1.0


def _positive(values: Mapping[str, Any], key: str, default: float) -> float:
    value = values.get(key)
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return float(value) if is_number and value > 0 else default  # type: ignore[operator, arg-type]
