"""``kinematics.yaml``: how inverse kinematics of a group are solved."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from gazelle.description.moveit.parameter_reader import Settings
from gazelle.description.moveit.parameter_tables import KINEMATICS, keys_of

__all__ = ["KinematicsSettings", "read_kinematics"]

# Solvers of other packages bring keys of their own.
_OTHERS = ("bio_ik", "cached_ik", "pick_ik", "trac_ik")


@dataclass(frozen=True, slots=True)
class KinematicsSettings:
    """Parameters of a group's solver, with the defaults of MoveIt's KDL plug-in.

    Attributes:
        solver: the plug-in's name; Gazelle's own solver does the work.
        search_resolution: step of a search over a redundant joint, rad.
        timeout_s: how long one request may take.
        position_only: the orientation of the tip does not matter.
        orientation_vs_position: weight of a rad of orientation error against a m of position.
        epsilon: largest error of a solution, m and rad.
        max_iterations: steps from one seed.
        tips: ``kinematics_solver_ik_links``: the tips of a group that has several.
    """

    solver: str = "kdl_kinematics_plugin/KDLKinematicsPlugin"
    search_resolution: float = 0.1
    timeout_s: float = 0.05
    position_only: bool = False
    orientation_vs_position: float = 1.0
    epsilon: float = 1e-5
    max_iterations: int = 500
    tips: tuple[str, ...] = ()


def read_kinematics(
    branch: Settings, groups: Collection[str], links: Collection[str]
) -> dict[str, KinematicsSettings]:
    """Read ``robot_description_kinematics``: settings by group.

    Args:
        branch: the branch.
        groups: names of the groups of the SRDF.
        links: of the robot.
    """
    found: dict[str, KinematicsSettings] = {}
    for name, settings in branch.entries():
        if branch.check_name(name, "group", groups):
            found[name] = _read_group(settings, links)
    return found


def _read_group(settings: Settings, links: Collection[str]) -> KinematicsSettings:
    default = KinematicsSettings()
    solver = settings.text("kinematics_solver")
    if not any(word in solver for word in _OTHERS):
        settings.check_keys(keys_of(KINEMATICS))
    if not solver:
        message = f"{settings.name()} names no kinematics_solver; MoveIt gives the group no inverse"
        message += " kinematics, Gazelle solves it as usual"
        settings.diagnostics.report("moveit.no-solver", message, settings.span())
    tips = settings.texts("kinematics_solver_ik_links")
    weight = _positive(settings, "orientation_vs_position", 1.0, zero=True)
    return KinematicsSettings(
        solver or default.solver,
        _positive(settings, "kinematics_solver_search_resolution", default.search_resolution),
        _positive(settings, "kinematics_solver_timeout", default.timeout_s),
        bool(settings.flag("position_only_ik")) or weight == 0,
        weight,
        _positive(settings, "epsilon", default.epsilon),
        int(_positive(settings, "max_solver_iterations", default.max_iterations)),
        tuple(name for name in tips if settings.check_name(name, "link", links)),
    )


def _positive(settings: Settings, key: str, default: float, *, zero: bool = False) -> float:
    value = settings.number(key)
    if value is None:
        return default
    if value > 0 or (zero and value == 0):
        return value
    message = f"{settings.name(key)} is {value:g}, it has to be above 0; {default:g} is used"
    settings.diagnostics.report("moveit.bad-limit", message, settings.span(key))
    return default
