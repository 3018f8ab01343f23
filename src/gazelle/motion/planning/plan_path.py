"""From a question to a path that was checked finely."""

from __future__ import annotations

import itertools
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gazelle.motion.constraints import Constrained, PathConstraint, narrowed, projection
from gazelle.motion.joint_space import FloatArray, JointSpace, Validity
from gazelle.motion.planning.error_codes import ErrorCode, PlanningError
from gazelle.motion.planning.path_validation import (
    FINE_STEP,
    first_faulty_motion,
    why_faulty,
)
from gazelle.motion.planning.planner_registry import Chosen, choose
from gazelle.motion.planning.problem import (
    GoalSource,
    Path,
    PlannerSettings,
    Problem,
    Search,
    Waypoints,
)
from gazelle.motion.planning.rrt_connect import warm_up
from gazelle.motion.planning.shortcut import shortcut

__all__ = ["plan"]

_START_BEYOND = 0.1
"""MoveIt's start_state_max_bounds_error, rad or m."""
_GOAL_BEYOND = 1e-3
_FINER = 0.4
_MAX_GOALS_TOLD = 3
_USUAL = Search()


def plan(
    space: JointSpace,
    validity: Validity,
    start: FloatArray,
    goals: Sequence[FloatArray] | GoalSource,
    *,
    search: Search = _USUAL,
    constraints: Sequence[PathConstraint] = (),
) -> Path:
    """Return a path from a configuration to one of the goals.

    Every path is checked once more before it is returned, with motions of 0.005 rad, or of 0.001
    where `validity` lets kernels tell of most. The same question with the same seed gives the same
    path, unless the time limit cut the search short.

    Args:
        space: joints and their limits.
        validity: says where the robot may be.
        start: where the path begins (n,), rad or m. Up to 0.1 outside the limits it is led back
            into them first, as MoveIt's FixStartStateBounds does.
        goals: configurations to reach, any of them, or a function that draws one.
        search: how it is looked for.
        constraints: what must hold all along the path.

    Raises:
        PlanningError: there is no path, with MoveIt's error code and why.
        ValueError: an array has the wrong size or is not finite.
    """
    warm_up(space, validity)
    began = time.perf_counter()
    settings = search.settings or PlannerSettings()
    narrow = _narrowed(space, constraints)
    guarded = Constrained(validity, tuple(constraints)) if constraints else validity
    rng = np.random.default_rng(search.seed)
    actual, inside = _start(space, narrow, validity, guarded, start)
    project = projection(narrow, constraints)
    problem = Problem(
        space=narrow,
        validity=guarded,
        start=inside,
        goals=[],
        rng=rng,
        settings=settings,
        step=settings.step,
        deadline=began + search.time_limit_s,
        source=goals if callable(goals) else None,
        project=project,
    )
    _find_goals(problem, space, validity, () if callable(goals) else goals)
    chosen = choose(search.planner, constrained=project is not None)
    path = _solved(problem, chosen, began, search.time_limit_s)
    if not np.array_equal(actual, inside):
        rows = np.vstack([actual, path.waypoints])
        note = f"the start lies outside the limits ({space.outside(actual)[0]}) and is led back"
        path = replace(path, waypoints=rows, notes=(*path.notes, note))
    return path


def _narrowed(space: JointSpace, constraints: Sequence[PathConstraint]) -> JointSpace:
    try:
        return narrowed(space, constraints)
    except ValueError as error:
        code = ErrorCode.START_STATE_VIOLATES_PATH_CONSTRAINTS
        raise PlanningError(code, f"path constraints: {error}") from error


def _start(
    space: JointSpace,
    narrow: JointSpace,
    validity: Validity,
    guarded: Validity,
    start: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Return the start as given and within the limits, or say why it cannot be one."""
    actual = space.array(start)
    if beyond := space.outside(actual, tolerance=_START_BEYOND):
        raise PlanningError(ErrorCode.INVALID_ROBOT_STATE, f"start: {'; '.join(beyond)}")
    inside = space.clamped(actual)
    if not validity.is_valid(inside):
        reason = f"start: {validity.why(inside)}"
        raise PlanningError(ErrorCode.START_STATE_IN_COLLISION, reason)
    if narrow.outside(inside, tolerance=1e-6) or not guarded.is_valid(inside):
        why = guarded.why(inside) or "; ".join(narrow.outside(inside))
        code = ErrorCode.START_STATE_VIOLATES_PATH_CONSTRAINTS
        raise PlanningError(code, f"start: {why}")
    return actual, inside


def _find_goals(
    problem: Problem, space: JointSpace, validity: Validity, goals: Sequence[FloatArray]
) -> None:
    """Put the goals that may be planned to into the problem."""
    faults: list[tuple[ErrorCode, str]] = []
    for goal in goals:
        q = space.array(goal)
        beyond = space.outside(q, tolerance=_GOAL_BEYOND)
        q = space.clamped(q)
        if beyond:
            faults.append((ErrorCode.INVALID_GOAL_CONSTRAINTS, f"goal: {'; '.join(beyond)}"))
        elif not validity.is_valid(q):
            faults.append((ErrorCode.GOAL_IN_COLLISION, f"goal: {validity.why(q)}"))
        elif problem.space.outside(q, tolerance=1e-6) or not problem.validity.is_valid(q):
            why = problem.validity.why(q) or "; ".join(problem.space.outside(q))
            code = ErrorCode.GOAL_VIOLATES_PATH_CONSTRAINTS
            faults.append((code, f"goal: {why}"))
        else:
            problem.goals.append(q)
    while not problem.goals and problem.source is not None and not problem.is_over():
        if problem.another_goal() is None and problem.has_no_more_goals:
            if problem.why_no_goal:
                raise PlanningError(ErrorCode.GOAL_IN_COLLISION, problem.why_no_goal)
            reason = "no configuration that reaches the goal was found"
            raise PlanningError(ErrorCode.NO_IK_SOLUTION, reason)
    if not problem.goals:
        told = list(dict.fromkeys(reason for _, reason in faults))[:_MAX_GOALS_TOLD]
        code = faults[0][0] if faults else ErrorCode.INVALID_GOAL_CONSTRAINTS
        raise PlanningError(code, "; ".join(told) or "there is no goal")


def _solved(problem: Problem, chosen: Chosen, began: float, time_limit_s: float) -> Path:
    """Search, shorten and check; search again with finer steps where the check finds a fault."""
    finish = _Finish(problem)
    searching = 0.0
    while not problem.is_over():
        mark = time.perf_counter()
        raw = chosen.solve(problem)
        searching += time.perf_counter() - mark
        if raw is None:
            break
        timed_out = problem.is_over()
        waypoints = finish.shortened(raw)
        if waypoints is not None:
            rows = _at_least(waypoints, problem.settings.minimum_waypoint_count)
            notes = (chosen.note,) if chosen.note else ()
            times = (searching, finish.simplifying_s, finish.checking_s)
            return Path(problem.space.names, rows, chosen.name, *times, notes, timed_out)
        problem.step = max(FINE_STEP, problem.step * _FINER)
    why = f"{chosen.name} found no path within {time_limit_s:g} s"
    if finish.fault is not None:
        fault = why_faulty(problem.space, problem.validity, finish.fault, problem.fine_step)
        why += f" that stands the check every {problem.fine_step} rad: {fault}"
    elif time.perf_counter() < began + time_limit_s:
        why = f"{chosen.name} gave up before {time_limit_s:g} s were over"
        raise PlanningError(ErrorCode.PLANNING_FAILED, why)
    raise PlanningError(ErrorCode.TIMED_OUT, why)


class _Finish:
    """Shortens paths and checks them finely; knows how long that took."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self.simplifying_s = 0.0
        self.checking_s = 0.0
        self.fault: FloatArray | None = None

    def shortened(self, raw: Waypoints) -> Waypoints | None:
        """Return a short path that stands the check, None where `raw` does not."""
        problem = self._problem
        if not problem.settings.simplify:
            return raw if self._stands(raw) else None
        while True:
            mark = time.perf_counter()
            short = self._shortcut(raw)
            self.simplifying_s += time.perf_counter() - mark
            if self._stands(short):
                return short
            # Shortcuts went through something thin: take them again with finer steps.
            if not self._stands(raw):
                return None
            if problem.step <= FINE_STEP:
                return raw
            problem.step = max(FINE_STEP, problem.step * _FINER)

    def _shortcut(self, raw: Waypoints) -> Waypoints:
        """Cut short, with motions that stand the last check where finer steps cost little."""
        problem = self._problem
        step = problem.step
        if problem.swept_motions is not None:
            problem.step = min(step, problem.fine_step)
        short = shortcut(problem, raw)
        problem.step = step
        return short

    def _stands(self, waypoints: Waypoints) -> bool:
        mark = time.perf_counter()
        problem = self._problem
        rows = np.array(waypoints)
        fault = first_faulty_motion(
            problem.space, problem.validity, rows, problem.fine_step, problem.checked
        )
        self.checking_s += time.perf_counter() - mark
        if fault is not None:
            self.fault = fault
        return fault is None


def _at_least(waypoints: Waypoints, count: int) -> FloatArray:
    """Return the waypoints, with further ones on the longest motions up to a number."""
    rows = [np.asarray(q) for q in waypoints]
    if len(rows) == 1:
        rows = [rows[0], rows[0]]
    while len(rows) < count:
        lengths = [float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(rows)]
        longest = int(np.argmax(lengths))
        rows.insert(longest + 1, (rows[longest] + rows[longest + 1]) / 2.0)
    return np.array(rows)
