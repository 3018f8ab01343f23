"""Which planner a name in a parameter file means."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.navigation.planners.options import (
    GlobalPlannerOptions,
    Nav2NavfnOptions,
    NavfnOptions,
    PlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
)

__all__ = ["PLANNERS", "REFUSED_PLANNERS", "PlannerKind"]


@dataclass(frozen=True, slots=True)
class PlannerKind:
    """A planner.

    Attributes:
        options: class of its options.
        note: what differs from the original, empty for nothing that matters.
    """

    options: type[PlannerOptions]
    note: str = ""


_SMAC = PlannerKind(Smac2DOptions, "the path is smoothed by the same forces, not the same code")
_HYBRID = (
    "paths of cars with a turning circle are not planned; SmacPlanner2D plans for robots that turn "
    "on the spot"
)

PLANNERS: Mapping[str, PlannerKind] = {
    "navfn/NavfnROS": PlannerKind(NavfnOptions),
    "global_planner/GlobalPlanner": PlannerKind(GlobalPlannerOptions),
    **{
        f"{package}{separator}{name}": kind
        for separator in ("/", "::")
        for package, name, kind in (
            ("nav2_navfn_planner", "NavfnPlanner", PlannerKind(Nav2NavfnOptions)),
            ("nav2_smac_planner", "SmacPlanner2D", _SMAC),
            ("nav2_theta_star_planner", "ThetaStarPlanner", PlannerKind(ThetaStarOptions)),
        )
    },
}
"""Planners by their names in ROS 1's and ROS 2's files."""

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
