"""The pipeline of OMPL: planners that draw configurations, and times for the path they find."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from gazelle.description.moveit import Pipeline
from gazelle.diagnostics import Diagnostic, Diagnostics
from gazelle.motion.constraints import Constrained, PathConstraint
from gazelle.motion.planning import (
    PLANNERS,
    ErrorCode,
    Path,
    PlanningError,
    Search,
    configured,
    plan,
)
from gazelle.motion.planning.planner_registry import DEFAULT
from gazelle.motion.timing import Trajectory, method_of, parameterise
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.goals import Goal, GoalSampler
from gazelle.nodes.move_group.planning_pipeline import (
    Asked,
    PlannerChoice,
    PlanningJob,
    PlanningPipeline,
)
from gazelle.nodes.move_group.planning_problem import GroupProblem

__all__ = ["OMPL"]

_ELSEWHERE = frozenset({"chomp", "stomp"})
_MIN_TIME_S = 1.0
_SEEDS = 7919


def _planner_ids(pipeline: Pipeline) -> list[str]:
    ids = [*pipeline.planner_configs] or sorted(PLANNERS)
    groups = pipeline.groups.items()
    return [*ids, *(f"{group}[{one}]" for group, own in groups for one in own.planners)]


def _choose(plans: PlanningPipeline, asked: Asked) -> PlannerChoice:
    found, planner, group = asked.pipeline, asked.planner, asked.group
    diagnostics, foreign = Diagnostics(), _foreign(found)
    if foreign:
        # Its planners' names mean nothing to those of OMPL.
        found, planner = replace(found, planner_configs={}, groups={}), ""
    changed = _with(found, group.name, asked.changed)
    chosen = configured(changed, group.name, planner, group.space, diagnostics)
    return PlannerChoice(
        found.name,
        chosen.planner,
        plans,
        settings=chosen.settings,
        adapters=(*found.request_adapters, *found.response_adapters),
        values=found.values,
        notes=(*foreign, *(_told(finding) for finding in diagnostics)),
    )


def _foreign(pipeline: Pipeline) -> tuple[str, ...]:
    """Say who plans in place of a plug-in that is neither OMPL's nor Pilz'."""
    known = [one for one in pipeline.plugins if "ompl" in one.lower()]
    name = next(iter(pipeline.plugins), "")
    if known or not (name or pipeline.name in _ELSEWHERE):
        return ()
    what = f"planning plug-in '{name}'" if name else "planner"
    text = f"the {what} of pipeline '{pipeline.name}' is not here; {DEFAULT} plans instead "
    return (f"{text}(there are the pipelines of OMPL and of Pilz: PTP, LIN and CIRC)",)


def _with(
    pipeline: Pipeline, group: str, changed: Mapping[tuple[str, str], Mapping[str, str]]
) -> Pipeline:
    """Lay what clients set over the file's parameters, that of the group last."""
    configs = {name: dict(values) for name, values in pipeline.planner_configs.items()}
    for owner in ("", group):
        for (of_group, name), values in changed.items():
            if of_group == owner:
                configs.setdefault(name, {}).update(values)
    return replace(pipeline, planner_configs=configs)


def _told(finding: Diagnostic) -> str:
    return f"{finding.message}{f'; {finding.fix}' if finding.fix else ''} [{finding.code}]"


def _plan(job: PlanningJob) -> tuple[Trajectory, tuple[str, ...]]:
    along = job.problem.constraints(job.request.path_constraints)
    goals = _goals(job.problem, job.request.goal_constraints)
    path = _best_path(job, along, goals)
    trajectory, notes = _timed(path, job, along)
    return trajectory, (*job.choice.notes, *path.notes, *notes)


def _best_path(job: PlanningJob, along: tuple[PathConstraint, ...], goals: Sequence[Goal]) -> Path:
    """Plan as often as asked within the time allowed and take the shortest path."""
    limit_s = float(job.request.allowed_planning_time)
    deadline = time.perf_counter() + (limit_s if limit_s > 0 else _MIN_TIME_S)
    best: Path | None = None
    for attempt in range(max(1, int(job.request.num_planning_attempts))):
        left_s = deadline - time.perf_counter()
        if best is not None and left_s <= 0:
            break
        try:
            path = _path(job, along, goals, attempt, max(left_s, 0.01))
        except PlanningError as error:
            if best is not None:
                break
            raise _explained(error, goals) from error
        best = path if best is None or path.length < best.length else best
    assert best is not None
    return best


def _path(
    job: PlanningJob,
    along: tuple[PathConstraint, ...],
    goals: Sequence[Goal],
    attempt: int,
    limit_s: float,
) -> Path:
    problem = job.problem
    exact = [goal.centre for goal in goals if goal.is_exact]
    start = problem.start_q
    sampler = GoalSampler(goals, problem.solver, start, problem.checker)
    return plan(
        problem.group.space,
        problem.checker,
        start,
        exact if len(exact) == len(goals) else sampler,
        search=Search(
            planner=job.choice.planner,
            seed=job.seed + attempt * _SEEDS,
            time_limit_s=limit_s,
            settings=job.choice.settings,
        ),
        constraints=along,
    )


def _timed(
    path: Path, job: PlanningJob, along: tuple[PathConstraint, ...]
) -> tuple[Trajectory, tuple[str, ...]]:
    """Return a path with times, as the pipeline's adapters ask for them.

    Corners are rounded only so far that what must hold along the path still does.
    """
    problem, values = job.problem, job.choice.values
    method, notes = method_of(job.choice.adapters)
    made = parameterise(
        path,
        problem.group.space,
        velocity_scaling=_scaling(job.request, "velocity"),
        acceleration_scaling=_scaling(job.request, "acceleration"),
        method=method,
        resample_dt_s=_positive(values, "resample_dt", 0.1),
        path_tolerance=_positive(values, "path_tolerance", 0.1),
        validity=Constrained(problem.checker, along) if along else problem.checker,
    )
    return made, (*notes, *made.notes)


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


OMPL = PlanningPipeline("ompl", "OMPL", _planner_ids, _choose, _plan)
