"""Paths over a costmap: NavFn's potential, A*, any angle; under the names of ROS's planners."""

from __future__ import annotations

from gazelle.navigation.planners.make_plan import make_plan
from gazelle.navigation.planners.planner import (
    NoPlan,
    Plan,
    PlanFailure,
    PlannerKind,
    PlannerOptions,
)
from gazelle.navigation.planners.planner_parameters import (
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    Smac2DOptions,
    ThetaStarOptions,
)
from gazelle.navigation.planners.registry import PLANNERS, REFUSED_PLANNERS

__all__ = [
    "PLANNERS",
    "REFUSED_PLANNERS",
    "GlobalPlannerOptions",
    "Nav2NavfnOptions",
    "NavfnOptions",
    "NoPlan",
    "Plan",
    "PlanFailure",
    "PlannerKind",
    "PlannerOptions",
    "Smac2DOptions",
    "ThetaStarOptions",
    "make_plan",
]
