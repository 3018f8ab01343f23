"""Parameters of global planners."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from gazelle.parameters.dataclass_tables import flag, integer, number

__all__ = [
    "GlobalPlannerOptions",
    "Nav2NavfnOptions",
    "NavfnOptions",
    "Smac2DOptions",
    "ThetaStarOptions",
]

_UNKNOWN = "paths may lead through what is unknown"
_FINAL = "the path ends in the direction in which it arrives, not in the goal's"
_DIRECTIONS = (
    "0 none, 1 forward, 2 from start to goal, 3 forward, then to the goal, 4 backward, 5 leftward, "
    "6 rightward"
)
_WINDOW = "the original reads it and plans in the whole costmap as well"
_TIME = "a plan over the largest maps takes a fraction of a second"


@dataclass(frozen=True, slots=True)
class NavfnOptions:
    """``navfn/NavfnROS`` (ROS 1)."""

    allow_unknown: bool = flag(True, _UNKNOWN)
    default_tolerance: float = number(0.0, "how far from the goal a path may end", "m", 0)

    IDLE: ClassVar[Mapping[str, str]] = {
        "planner_window_x": _WINDOW,
        "planner_window_y": _WINDOW,
        "visualize_potential": "the potential is not published",
    }


@dataclass(frozen=True, slots=True)
class GlobalPlannerOptions:
    """``global_planner/GlobalPlanner`` (ROS 1)."""

    allow_unknown: bool = flag(True, _UNKNOWN)
    use_dijkstra: bool = flag(True, "spread a potential in all directions, else A*")
    use_quadratic: bool = flag(True, "interpolate the potential between cells")
    use_grid_path: bool = flag(False, "go from cell to cell, else down the gradient")
    old_navfn_behavior: bool = flag(False, "as NavfnROS: paths begin at the corner of a cell")
    lethal_cost: int = integer(253, "cost from which on nothing leads through", 1, 255)
    neutral_cost: int = integer(50, "cost of a cell that is free", 1, 255)
    cost_factor: float = number(3.0, "weight of the costmap's costs", "", 0.01, 5.0)
    orientation_mode: int = integer(1, _DIRECTIONS, 0, 6)
    orientation_window_size: int = integer(1, "points on either side that count", 1, 255)
    outline_map: bool = flag(True, "the edge of the costmap is an obstacle")

    IDLE: ClassVar[Mapping[str, str]] = {
        "default_tolerance": "the original reads it and does not use it; NavfnROS does",
        "planner_window_x": _WINDOW,
        "planner_window_y": _WINDOW,
        "publish_potential": "the potential is not published",
        "publish_scale": "the potential is not published",
        "visualize_potential": "the potential is not published",
    }


@dataclass(frozen=True, slots=True)
class Nav2NavfnOptions:
    """``nav2_navfn_planner/NavfnPlanner`` (ROS 2)."""

    tolerance: float = number(0.5, "how far from the goal a path may end", "m", 0)
    use_astar: bool = flag(False, "A*, else spread a potential in all directions")
    allow_unknown: bool = flag(True, _UNKNOWN)
    use_final_approach_orientation: bool = flag(False, _FINAL)

    IDLE: ClassVar[Mapping[str, str]] = {}


@dataclass(frozen=True, slots=True)
class Smac2DOptions:
    """``nav2_smac_planner/SmacPlanner2D`` (ROS 2)."""

    tolerance: float = number(0.125, "how far from the goal a path may end", "m", 0)
    cost_travel_multiplier: float = number(1.0, "weight of the costmap's costs", "", 0)
    allow_unknown: bool = flag(True, _UNKNOWN)
    max_iterations: int = integer(1_000_000, "cells that are looked at; −1 for any number", -1)
    use_final_approach_orientation: bool = flag(False, _FINAL)

    IDLE: ClassVar[Mapping[str, str]] = {
        "downsample_costmap": _TIME,
        "downsampling_factor": _TIME,
        "max_on_approach_iterations": "the nearest reachable cell is always found",
        "terminal_checking_interval": _TIME,
        "max_planning_time": _TIME,
        "smoother": "the path is smoothed until it no longer changes",
    }


@dataclass(frozen=True, slots=True)
class ThetaStarOptions:
    """``nav2_theta_star_planner/ThetaStarPlanner`` (ROS 2)."""

    how_many_corners: int = integer(8, "neighbours of a cell, 4 or 8", 4, 8)
    allow_unknown: bool = flag(True, _UNKNOWN)
    w_euc_cost: float = number(1.0, "weight of the length", "", 0)
    w_traversal_cost: float = number(2.0, "weight of the costmap's costs", "", 0)
    use_final_approach_orientation: bool = flag(False, _FINAL)

    IDLE: ClassVar[Mapping[str, str]] = {"terminal_checking_interval": _TIME}
