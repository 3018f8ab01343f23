"""A planning problem as planners see it: where from, where to, and which motions are allowed."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace, SweptMotions, SweptValidity, Validity
from gazelle.motion.planning.path_validation import FINE_STEP, SWEPT_STEP, ends_of
from gazelle.rich_display import shown_by

__all__ = ["GoalSource", "Path", "PlannerSettings", "Problem", "Projection", "Search", "Waypoints"]


@shown_by("joint_motions:path_bundle")
@dataclass(frozen=True)
class Path:
    """Straight motions between waypoints.

    Attributes:
        names: names of the joints.
        waypoints: shape (m, n), rad or m, m ≥ 2. Continuous joints go on past pi.
        planner: the planner that found it, by its MoveIt name.
        planning_time_s: time until there was a path.
        simplification_time_s: time that shortcuts took.
        validation_time_s: time that the fine check took.
        notes: what was done otherwise than asked, one sentence each.
        timed_out: whether the time limit ended an optimising planner; where it did not, the same
            seed gives the same path.
    """

    names: tuple[str, ...]
    waypoints: FloatArray
    planner: str = ""
    planning_time_s: float = 0.0
    simplification_time_s: float = 0.0
    validation_time_s: float = 0.0
    notes: tuple[str, ...] = ()
    timed_out: bool = False

    @property
    def length(self) -> float:
        """The Euclidean length, rad or m."""
        return float(np.linalg.norm(np.diff(self.waypoints, axis=0), axis=1).sum())

    def densified(self, step: float) -> FloatArray:
        """Return the path's states (k, n), no two neighbours further than `step` apart."""
        rows = [self.waypoints[:1]]
        for first, last in zip(self.waypoints[:-1], self.waypoints[1:], strict=True):
            count = max(1, int(np.ceil(np.linalg.norm(last - first) / step)))
            rows.append(first + (last - first) * (np.arange(1, count + 1) / count)[:, None])
        return np.concatenate(rows)


@dataclass(frozen=True)
class PlannerSettings:
    """Parameters of a planner; the defaults are those of a planner that nobody configured.

    Attributes:
        range: longest motion added to a tree, rad or m; 0 lets the planner choose.
        goal_bias: how often RRT and RRT* head for a goal, 0 to 1.
        max_nearest_neighbors: neighbours that PRM connects a configuration with.
        step: longest motion between two checks while searching, rad or m.
        max_goal_samples: goals drawn where the goal leaves a choice.
        max_iterations: configurations that an optimising planner draws before it is content.
        minimum_waypoint_count: waypoints that a path has at least.
        simplify: whether shortcuts are taken.
        native: parameters by name for planners of OMPL and of other packages.
        projection: joints that KPIECE and its kin look at; OMPL chooses where there are none.

    Raises:
        ValueError: a motion or a step is of no length that there is.
    """

    range: float = 0.0
    goal_bias: float = 0.05
    max_nearest_neighbors: int = 10
    step: float = 0.1
    max_goal_samples: int = 10
    max_iterations: int = 2000
    minimum_waypoint_count: int = 2
    simplify: bool = True
    native: Mapping[str, float] = field(default_factory=dict)
    projection: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        if not self.range >= 0.0:
            raise ValueError(f"range is {self.range:g}: the longest motion is 0 or more")
        if not 0.0 < self.step < math.inf:
            raise ValueError(f"step is {self.step:g}: checks are more than 0 apart, and finite")


@dataclass(frozen=True)
class Search:
    """How a path is looked for.

    Attributes:
        planner: a planner's name or id as MoveIt writes it; empty for the default.
        seed: of all chance.
        time_limit_s: MoveIt's allowed_planning_time.
        settings: parameters of the planner; its usual ones when None.
    """

    planner: str = ""
    seed: int = 0
    time_limit_s: float = 5.0
    settings: PlannerSettings | None = None


GoalSource = Callable[[np.random.Generator], FloatArray | None]

"""Draws one more configuration that reaches the goal, None where the draw found none."""

Projection = Callable[[FloatArray], FloatArray | None]

"""Moves a configuration to the nearest one that satisfies the path constraints."""

Waypoints = list[FloatArray]

_CHAIN_STEP = 0.1

_MAX_OF_CHAIN = 400

_TRIES_PER_GOAL = 3


@dataclass
class Problem:
    """What planners work on.

    Attributes:
        space: the joints, with limits that path constraints may have narrowed.
        validity: collisions, limits and path constraints in one.
        start: a valid configuration (n,), rad or m.
        goals: valid configurations, (n,) each; planners may find more of them here as time passes.
        rng: the only source of chance.
        settings: ranges and biases.
        step: longest motion that goes unchecked while searching, rad or m.
        deadline: value of ``time.perf_counter`` at which to give up.
        source: draws further goals.
        project: set where path constraints leave too little room for drawing by chance.
        why_no_goal: why the last goal that was drawn cannot be one.
        checked: both ends of motions that stand the last check already, see `ends_of`.
    """

    space: JointSpace
    validity: Validity
    start: FloatArray
    goals: list[FloatArray]
    rng: np.random.Generator
    settings: PlannerSettings
    step: float
    deadline: float
    source: GoalSource | None = None
    project: Projection | None = None
    why_no_goal: str = ""
    checked: set[tuple[bytes, bytes]] = field(default_factory=set)
    _drawn: int = 0

    def is_over(self) -> bool:
        """Return whether the time is used up."""
        return time.perf_counter() >= self.deadline

    @cached_property
    def range(self) -> float:
        """The longest motion that is added to a tree in one go."""
        return self.settings.range or min(0.2 * self.space.extent, 1.0)

    def sample(self) -> FloatArray:
        """Return a configuration (n,) within the limits, near the path constraints if any."""
        q = self.space.sample(self.rng)
        if self.project is None:
            return q
        projected = self.project(q)
        return q if projected is None else projected

    @cached_property
    def swept_motions(self) -> SweptMotions | None:
        """What kernels need to check motions, None where only `validity` can tell."""
        if self.project is not None or not isinstance(self.validity, SweptValidity):
            return None
        return self.validity.swept_motions()

    @property
    def fine_step(self) -> float:
        """Longest motion between two states of the last check."""
        return FINE_STEP if self.swept_motions is None else SWEPT_STEP

    @property
    def has_no_more_goals(self) -> bool:
        """Whether as many goals were drawn as MoveIt draws."""
        most = self.settings.max_goal_samples
        return len(self.goals) >= most or self._drawn >= _TRIES_PER_GOAL * most

    def another_goal(self) -> FloatArray | None:
        """Return a goal (n,) that was not known before; None where none was drawn."""
        if self.source is None or self.has_no_more_goals:
            return None
        self._drawn += 1
        q = self.source(self.rng)
        if q is None:
            return None
        q = self.space.clamped(q)
        if not self.validity.is_valid(q):
            self.why_no_goal = f"goal: {self.validity.why(q)}"
            return None
        self.goals.append(q)
        return q

    def towards(self, q: FloatArray, target: FloatArray, most: float) -> tuple[Waypoints, bool]:
        """Go from `q` in the direction of `target`, (n,) both, `most` far at most.

        Returns:
            the waypoints gone to (none where an obstacle is next) and whether the last is `target`.
        """
        if self.project is not None:
            return self._along_constraints(q, target, most)
        way = self.space.between(q, target)
        distance = float(np.sqrt(way @ way))
        arrives = distance <= most
        end = q + (way if arrives else way * (most / distance))
        if distance > 0.0:
            if not self.validity.motion_is_valid(q, end, self.step):
                return [], False
            if self.step <= self.fine_step:
                self.checked.add(ends_of(q, end))
        return [end], arrives

    def connect(self, q: FloatArray, target: FloatArray) -> Waypoints | None:
        """Return the waypoints of a motion from `q` to `target`, (n,); None where not allowed."""
        waypoints, arrives = self.towards(q, target, np.inf)
        return waypoints if arrives else None

    def _along_constraints(
        self, q: FloatArray, target: FloatArray, most: float
    ) -> tuple[Waypoints, bool]:
        """Go in small steps, each of them projected (Berenson's CBiRRT)."""
        assert self.project is not None
        chain: Waypoints = []
        gone, here = 0.0, q
        while gone < most and len(chain) < _MAX_OF_CHAIN:
            way = self.space.between(here, target)
            distance = float(np.linalg.norm(way))
            if distance <= _CHAIN_STEP:
                if not self.validity.motion_is_valid(here, here + way, self.step):
                    return chain, False
                return [*chain, here + way], True
            following = self.project(here + way * (_CHAIN_STEP / distance))
            if following is None or not self._is_progress(here, following, target):
                break
            if not self.validity.motion_is_valid(here, following, self.step):
                break
            gone += float(np.linalg.norm(following - here))
            chain.append(following)
            here = following
        return chain, False

    def _is_progress(self, here: FloatArray, following: FloatArray, target: FloatArray) -> bool:
        step = float(np.linalg.norm(following - here))
        nearer = self.space.distance(following, target) < self.space.distance(here, target) - 1e-4
        return nearer and step <= 2.0 * _CHAIN_STEP
