"""Planners by the names that MoveIt knows, and what stands in for those that are not here."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from gazelle.diagnostics import did_you_mean
from gazelle.extensions import ExtensionGroup, Extensions, load_extensions
from gazelle.motion.planning import ompl_planners
from gazelle.motion.planning.prm import prm, prm_star
from gazelle.motion.planning.problem import Problem, Waypoints
from gazelle.motion.planning.rrt import rrt, rrt_star
from gazelle.motion.planning.rrt_connect import rrt_connect

__all__ = ["DEFAULT", "PLANNERS", "Chosen", "Planner", "bare_name", "choose", "find_planner"]

Solve = Callable[[Problem], Waypoints | None]

DEFAULT = "RRTConnect"


@dataclass(frozen=True)
class Planner:
    """A planner of MoveIt's list.

    Attributes:
        name: as in ``type: geometric::NAME`` of ``ompl_planning.yaml``.
        own: Gazelle's implementation, or that of whoever adds a planner.
        stand_in: name of the own planner that is used where there is no `own` and no OMPL.
        parameters: names in ``ompl_planning.yaml`` that mean something to it, besides those of
            every planner; what `PlannerSettings` has no field for is in its `native`.
    """

    name: str
    own: Solve | None = None
    stand_in: str = DEFAULT
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True)
class Chosen:
    """A planner that can be run.

    Attributes:
        name: its name.
        solve: returns a path or None.
        note: why it is not the one asked for; an empty string where it is.
    """

    name: str
    solve: Solve
    note: str = ""


_OWN = (
    Planner("RRTConnect", rrt_connect, parameters=("range",)),
    Planner("RRT", rrt, parameters=("range", "goal_bias")),
    Planner("RRTstar", rrt_star, parameters=("range", "goal_bias")),
    Planner("PRM", prm, parameters=("max_nearest_neighbors",)),
    Planner("PRMstar", prm_star),
)
_PROJECTED = ("KPIECE", "BKPIECE", "LBKPIECE")

_OTHERS = {
    "RRTConnect": "BKPIECE KPIECE LBKPIECE EST BiEST ProjEST SBL STRIDE PDST TRRT BiTRRT",
    "RRTstar": "AnytimePathShortening BITstar ABITstar AITstar InformedRRTstar SORRTstar LBTRRT "
    "FMT BFMT AORRTC",
    "PRM": "LazyPRM SPARS SPARStwo",
    "PRMstar": "LazyPRMstar",
}

PLANNERS: dict[str, Planner] = {planner.name: planner for planner in _OWN} | {
    name: Planner(name, None, stand_in, ("projection_evaluator",) * (name in _PROJECTED))
    for stand_in, names in _OTHERS.items()
    for name in names.split()
}
"""Every planner that MoveIt's OMPL interface knows, and those of OMPL 2's wheel."""


def bare_name(planner_id: str) -> str:
    """Return the type in a planner's id.

    MoveIt writes ``RRTConnect``, ``geometric::RRTConnect``, ``RRTConnectkConfigDefault`` and
    ``arm[RRTConnectkConfigDefault]``.
    """
    name = planner_id.strip()
    if inner := re.fullmatch(r"[^\[\]]*\[([^\[\]]+)\]", name):
        name = inner[1]
    return name.removeprefix("geometric::").removesuffix("kConfigDefault")


def find_planner(name: str) -> Planner | None:
    """Return the planner of a bare name in any case: MoveIt's, or of another pip package."""
    folded = name.casefold()
    own = next((one for one in PLANNERS.values() if one.name.casefold() == folded), None)
    if own is not None:
        return own
    parts = (extension.part for extension in _added().parts)
    return next((one for one in parts if one.name.casefold() == folded), None)


def _added() -> Extensions[Planner]:
    return load_extensions(ExtensionGroup.PLANNERS, Planner)


def choose(planner_id: str, *, constrained: bool = False) -> Chosen:
    """Return the planner to run for an id of MoveIt; an empty id means RRTConnect.

    Args:
        planner_id: any of the forms that `bare_name` knows.
        constrained: whether path constraints need projection, which only own planners do.
    """
    name = bare_name(planner_id) or DEFAULT
    planner = find_planner(name)
    if planner is None:
        hint = did_you_mean(name, PLANNERS)
        note = f"there is no planner '{planner_id}'; {DEFAULT} plans instead, as in MoveIt"
        parts = (note, f"{hint[:1].upper()}{hint[1:]}", *_added().problems)
        return Chosen(DEFAULT, rrt_connect, ". ".join(part for part in parts if part).rstrip(". "))
    if planner.own is not None:
        return Chosen(planner.name, planner.own)
    missing = ompl_planners.why_missing(planner.name)
    if constrained and not missing:
        missing = f"{planner.name} of OMPL is not used with path constraints"
    if not missing:
        return Chosen(planner.name, ompl_planners.solver(planner.name))
    own = PLANNERS[planner.stand_in].own
    assert own is not None
    return Chosen(planner.stand_in, own, f"{missing}; {planner.stand_in} plans instead")
