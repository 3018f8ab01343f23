"""The planners of OMPL's Python wheel (``pip install "gazelle-sim[ompl]"``)."""

from __future__ import annotations

import importlib
import importlib.util
import time
from collections.abc import Callable
from functools import cache, partial
from types import ModuleType
from typing import Any

import numpy as np

from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning.problem import Problem, Waypoints

__all__ = ["NATIVE_PARAMETERS", "PIP_LINE", "solver", "why_missing"]

PIP_LINE = 'pip install "gazelle-sim[ompl]"'

_CLASSES = {"BKPIECE": "BKPIECE1", "KPIECE": "KPIECE1", "LBKPIECE": "LBKPIECE1"}

_IMPROVING = frozenset({"AORRTC", "BITstar", "InformedRRTstar", "SORRTstar", "RRTstar", "PRMstar"})

_COARSEST = 0.05
"""Longest motion between two checks: a search in OMPL is not resumed where it was wrong."""

NATIVE_PARAMETERS = {
    "range": ("setRange", float),
    "goal_bias": ("setGoalBias", float),
    "border_fraction": ("setBorderFraction", float),
    "failed_expansion_score_factor": ("setFailedExpansionCellScoreFactor", float),
    "min_valid_path_fraction": ("setMinValidPathFraction", float),
    "rewire_factor": ("setRewireFactor", float),
    "samples_per_batch": ("setSamplesPerBatch", int),
    "num_samples": ("setNumSamples", int),
    "radius_multiplier": ("setRadiusMultiplier", float),
    "nearest_k": ("setNearestK", bool),
    "cache_cc": ("setCacheCC", bool),
    "heuristics": ("setHeuristics", bool),
    "extended_fmt": ("setExtendedFMT", bool),
    "use_k_nearest": ("setUseKNearest", bool),
    "delay_collision_checking": ("setDelayCC", bool),
}
"""Parameters of MoveIt's planner configurations and OMPL's setters for them."""


@cache
def _geometric() -> ModuleType | None:
    if importlib.util.find_spec("ompl") is None:
        return None
    module = importlib.import_module("ompl.geometric")
    # OMPL speaks to standard output, which belongs to the user's program.
    util = importlib.import_module("ompl.util")
    util.setLogLevel(util.LOG_NONE)
    return module


def why_missing(name: str) -> str:
    """Return why a planner of OMPL cannot be run here, an empty string where it can."""
    module = _geometric()
    if module is None:
        return f"{name} is a planner of OMPL, which is not installed ({PIP_LINE})"
    if hasattr(module, _CLASSES.get(name, name)):
        return ""
    return f"{name} is not in OMPL's Python wheel"


def solver(name: str) -> Any:
    """Return a function that solves a problem with a planner of OMPL."""
    return partial(_solve, _CLASSES.get(name, name))


def _solve(class_name: str, problem: Problem) -> Waypoints | None:
    base = importlib.import_module("ompl.base")
    util = importlib.import_module("ompl.util")
    util.RNG.setSeed(int(problem.rng.integers(1, 2**31)))
    # Every draw of a goal would have to enter C++; they are drawn beforehand.
    while problem.another_goal() is not None and len(problem.goals) < 4:
        pass
    space = _state_space(base, problem)
    information = base.SpaceInformation(space)
    size = problem.space.size
    information.setStateValidityChecker(
        lambda state: problem.validity.is_valid(np.array([state[i] for i in range(size)]))
    )
    information.setStateValidityCheckingResolution(
        min(problem.step, _COARSEST) / space.getMaximumExtent()
    )
    information.setup()
    definition = base.ProblemDefinition(information)
    definition.addStartState(_state(space, problem.start))
    goals = base.GoalStates(information)
    for goal in problem.goals:
        way = problem.space.between(problem.start, goal)
        goals.addState(_state(space, problem.start + way))
    definition.setGoal(goals)
    planner = getattr(_geometric(), class_name)(information)
    _configure(base, space, planner, problem)
    planner.setProblemDefinition(definition)
    planner.setup()
    planner.solve(base.PlannerTerminationCondition(_ending(problem, class_name)))
    if not definition.hasExactSolution():
        return None
    path = definition.getSolutionPath()
    rows = range(path.getStateCount())
    return [np.array([path.getState(row)[i] for i in range(size)]) for row in rows]


def _ending(problem: Problem, class_name: str) -> Callable[[], bool]:
    """Return when a planner has to stop.

    Those that go on improving get half of the time that is left: what they find is still checked
    finely, and searched again where it does not stand that.
    """
    if class_name not in _IMPROVING:
        return problem.is_over
    end = problem.deadline - 0.5 * max(0.0, problem.deadline - time.perf_counter())
    return lambda: time.perf_counter() >= end


def _state_space(base: Any, problem: Problem) -> Any:
    """Return a box; a continuous joint may turn once each way from where it starts."""
    own = problem.space
    turn = 2.0 * np.pi
    lower = np.where(own.continuous, problem.start - turn, own.low)
    upper = np.where(own.continuous, problem.start + turn, own.high)
    space = base.RealVectorStateSpace(own.size)
    bounds = base.RealVectorBounds(own.size)
    for joint in range(own.size):
        bounds.setLow(joint, float(min(lower[joint], problem.start[joint])))
        bounds.setHigh(joint, float(max(upper[joint], problem.start[joint])))
    space.setBounds(bounds)
    return space


def _state(space: Any, q: FloatArray) -> Any:
    state = space.allocState()
    for joint, value in enumerate(q):
        state[joint] = float(value)
    return state


def _configure(base: Any, space: Any, planner: Any, problem: Problem) -> None:
    for name, value in problem.settings.native.items():
        setter = NATIVE_PARAMETERS[name][0]
        if hasattr(planner, setter):
            getattr(planner, setter)(value)
    joints = problem.settings.projection
    if joints and hasattr(planner, "setProjectionEvaluator"):
        extent = problem.space.high - problem.space.low
        cells = [float(extent[joint]) / 20.0 for joint in joints]
        evaluator = base.RealVectorOrthogonalProjectionEvaluator(space, cells, list(joints))
        planner.setProjectionEvaluator(evaluator)
