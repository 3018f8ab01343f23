"""Which planner a name in a parameter file means."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from gazelle.navigation.planners import global_planners
from gazelle.navigation.planners.planner import Facing, PlannerKind, PlannerOptions
from gazelle.navigation.planners.planner_parameters import (
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    Smac2DOptions,
    ThetaStarOptions,
)

__all__ = ["PLANNERS", "REFUSED_PLANNERS", "kind_of"]


class _OfNav2(Protocol):
    @property
    def use_final_approach_orientation(self) -> bool: ...


class _Tolerant(Protocol):
    @property
    def tolerance(self) -> float: ...


def _facing(options: _OfNav2) -> Facing:
    return Facing(arrives=options.use_final_approach_orientation)


def _turned(options: GlobalPlannerOptions) -> Facing:
    return Facing(options.orientation_mode, options.orientation_window_size)


def _tolerance_m(options: _Tolerant) -> float:
    return options.tolerance


def _default_tolerance_m(options: NavfnOptions) -> float:
    return options.default_tolerance


def _always(_options: PlannerOptions) -> bool:
    return True


def _outlined(options: GlobalPlannerOptions) -> bool:
    return options.outline_map


_NAVFN = PlannerKind(
    NavfnOptions, global_planners.navfn, tolerance_m=_default_tolerance_m, is_walled=_always
)
_GLOBAL = PlannerKind(
    GlobalPlannerOptions, global_planners.global_planner, is_walled=_outlined, facing=_turned
)
_NAV2_NAVFN = PlannerKind(
    Nav2NavfnOptions,
    global_planners.nav2_navfn,
    tolerance_m=_tolerance_m,
    is_walled=_always,
    facing=_facing,
)
_SMAC = PlannerKind(
    Smac2DOptions,
    global_planners.smac_2d,
    "the path is smoothed by the same forces, not the same code",
    tolerance_m=_tolerance_m,
    facing=_facing,
)
_THETA = PlannerKind(ThetaStarOptions, global_planners.any_angle, facing=_facing)
_HYBRID = (
    "paths of cars with a turning circle are not planned; SmacPlanner2D plans for robots that turn "
    "on the spot"
)

PLANNERS: Mapping[str, PlannerKind] = {
    "navfn/NavfnROS": _NAVFN,
    "global_planner/GlobalPlanner": _GLOBAL,
    **{
        f"{package}{separator}{name}": kind
        for separator in ("/", "::")
        for package, name, kind in (
            ("nav2_navfn_planner", "NavfnPlanner", _NAV2_NAVFN),
            ("nav2_smac_planner", "SmacPlanner2D", _SMAC),
            ("nav2_theta_star_planner", "ThetaStarPlanner", _THETA),
        )
    },
}
"""Planners by their names in ROS 1's and ROS 2's files."""

_BY_OPTIONS = {kind.options: kind for kind in PLANNERS.values()}

REFUSED_PLANNERS: Mapping[str, str] = {
    **{
        f"nav2_smac_planner{separator}{name}": reason
        for separator in ("/", "::")
        for name, reason in (
            ("SmacPlannerHybrid", _HYBRID),
            ("SmacPlannerLattice", _HYBRID),
            ("SmacPlanner", _HYBRID),
        )
    },
    "carrot_planner/CarrotPlanner": "it only drives straight on; navfn/NavfnROS plans around "
    "obstacles",
    "sbpl_lattice_planner/SBPLLatticePlanner": "it is a package of its own, compiled; "
    "navfn/NavfnROS takes its place for robots that turn on the spot",
}
"""Why a planner is not there, and what is."""


def kind_of(options: PlannerOptions) -> PlannerKind:
    """Return the planner that options are for."""
    return _BY_OPTIONS[type(options)]
