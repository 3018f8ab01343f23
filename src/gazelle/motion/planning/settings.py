"""What can be set about a planner, by the names that OMPL and MoveIt give it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["PlannerSettings", "Search"]


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
