"""What a global planner is, and what it gives: a path, or why there is none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.rich_display import shown_by

__all__ = [
    "Facing",
    "NoPlan",
    "Plan",
    "PlanFailure",
    "PlannerKind",
    "PlannerOptions",
    "Route",
    "Search",
]


class PlanFailure(Enum):
    """Why there is no path; the values are the words of Nav2's error codes."""

    START_OUTSIDE_MAP = "START_OUTSIDE_MAP"
    GOAL_OUTSIDE_MAP = "GOAL_OUTSIDE_MAP"
    START_OCCUPIED = "START_OCCUPIED"
    GOAL_OCCUPIED = "GOAL_OCCUPIED"
    NO_VALID_PATH = "NO_VALID_PATH"


@shown_by("maps:plan_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A path from where the robot is to the goal.

    Attributes:
        poses: (n, 3), x, y (m) and yaw (rad) in the costmap's frame; the last one is the goal, or
            the reachable place nearest to it.
        cost: of the planner's own measure.
    """

    poses: NDArray[np.float64]
    cost: float

    @property
    def length_m(self) -> float:
        """Length of the path."""
        return float(np.hypot(*np.diff(self.poses[:, :2], axis=0).T).sum())


@dataclass(frozen=True, slots=True)
class NoPlan:
    """Why there is no path.

    Attributes:
        failure: in Nav2's terms.
        reason: in words, with places and costs.
    """

    failure: PlanFailure
    reason: str


class PlannerOptions(Protocol):
    """Options of any planner: frozen dataclasses of `gazelle.parameters.dataclass_tables`."""

    IDLE: ClassVar[Mapping[str, str]]

    @property
    def allow_unknown(self) -> bool:
        """Whether paths may lead through what is unknown."""


class Search(NamedTuple):
    """What is searched.

    Attributes:
        costs: (height, width) of the costmap's cells; the start's cell is free.
        start, goal: numbers of cells, along rows.
        reach: how far from the goal the path may end, cells.
    """

    costs: NDArray[np.uint8]
    start: int
    goal: int
    reach: float


class Route(NamedTuple):
    """What was found.

    Attributes:
        points: (n, 2) columns and rows; centres of cells are whole numbers.
        cost: of the path, in the planner's own measure.
        shift: added to the points when all is done, cells.
    """

    points: NDArray[np.float64]
    cost: float
    shift: float = 0.0


class Facing(NamedTuple):
    """Where a robot looks along a path.

    Attributes:
        mode: of ``OrientationFilter`` of global_planner.
        window: points on either side that count.
        arrives: the path ends in the direction in which it arrives, not in the goal's.
    """

    mode: int = 1
    window: int = 1
    arrives: bool = False


def _none_m(_options: Any) -> float:
    return 0.0


def _no(_options: Any) -> bool:
    return False


def _forward(_options: Any) -> Facing:
    return Facing()


@dataclass(frozen=True, slots=True)
class PlannerKind:
    """A planner.

    Attributes:
        options: class of its options.
        search: finds a way, None where there is none.
        note: what differs from the original, empty for nothing that matters.
        tolerance_m: how far from the goal a path may end.
        is_walled: whether the edge of the costmap is an obstacle.
        facing: where the robot looks.
    """

    options: type[PlannerOptions]
    search: Callable[[Search, Any], Route | None]
    note: str = ""
    tolerance_m: Callable[[Any], float] = _none_m
    is_walled: Callable[[Any], bool] = _no
    facing: Callable[[Any], Facing] = _forward
