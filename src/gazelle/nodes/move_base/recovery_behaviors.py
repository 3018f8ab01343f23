"""Recovery behaviours of move_base: clearing, turning, going slowly."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.navigation.costmap import footprint_cost
from gazelle.nodes.move_base.parameters import CLEAR, ROTATE, SLOW
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.parameters import node_reader
from gazelle.parameters.reader import ParameterReader

__all__ = ["Behaviour", "RecoveryContext", "make_behaviours"]

_CLEAR, _ROTATE, _SLOW = (table.types[0] for table in (CLEAR, ROTATE, SLOW))
_HALF_TURN = math.pi


@dataclass(frozen=True, slots=True)
class RecoveryContext:
    """What behaviours act on.

    Attributes:
        global_costmap, local_costmap: both maps.
        drive: sends a velocity along x and around z.
        sleep: waits seconds of the node's clock; False when the behaviour shall end.
        limit_speed: of the local planner, m/s, for the next so many metres.
        log: says something.
    """

    global_costmap: Costmap2DRos
    local_costmap: Costmap2DRos
    drive: Callable[[float, float], None]
    sleep: Callable[[float], bool]
    limit_speed: Callable[[float, float], None]
    log: Callable[[str, str], None]


@dataclass(frozen=True, slots=True)
class Behaviour:
    """One recovery behaviour.

    Attributes:
        name: as the parameters say.
        type: such as ``rotate_recovery/RotateRecovery``.
        run: does it, to its end.
    """

    name: str
    type: str
    run: Callable[[], None]


def make_behaviours(
    tree: Mapping[str, Any],
    name: str,
    around: RecoveryContext,
    diagnostics: Diagnostics,
    *,
    clearing_rotation: bool,
    conservative_m: float,
    aggressive_m: float,
) -> list[Behaviour]:
    """Return what ``recovery_behaviors`` lists, else move_base's default behaviours."""
    rows = tree.get("recovery_behaviors")
    if rows is None:
        return _defaults(tree, name, around, diagnostics, clearing_rotation, conservative_m,
                         aggressive_m)  # fmt: skip
    made = []
    for row in rows if isinstance(rows, list) else [rows]:
        if not isinstance(row, Mapping) or not {"name", "type"} <= set(row):
            text = f"{name}: recovery_behaviors has {row!r}, not {{name, type}}; it is left out"
            diagnostics.report("parameter.bad-value", text, fix="write {name: …, type: …}")
            continue
        own = tree.get(str(row["name"]))
        behaviour = _make(str(row["name"]), str(row["type"]), own, name, around, diagnostics)
        made += [behaviour] if behaviour is not None else []
    return made


def _defaults(
    tree: Mapping[str, Any],
    name: str,
    around: RecoveryContext,
    diagnostics: Diagnostics,
    clearing_rotation: bool,
    conservative_m: float,
    aggressive_m: float,
) -> list[Behaviour]:
    # What move_base itself loads without the parameter (loadDefaultRecoveryBehaviors).
    turn: list[tuple[str, str, dict[str, Any]]] = (
        [("rotate", _ROTATE, {})] if clearing_rotation else []
    )
    rows: list[tuple[str, str, dict[str, Any]]] = [
        ("conservative_reset", _CLEAR, {"reset_distance": conservative_m}),
        *turn,
        ("aggressive_reset", _CLEAR, {"reset_distance": aggressive_m}),
        *turn,
    ]
    made = []
    for key, kind, values in rows:
        below = tree.get(key)
        own = {**(below if isinstance(below, Mapping) else {}), **values}
        planner = tree.get("TrajectoryPlannerROS")
        if kind == _ROTATE and isinstance(planner, Mapping):
            own = {**{k: planner[k] for k in planner if k in set(ROTATE.keys())}, **own}
        behaviour = _make(key, kind, own, name, around, diagnostics)
        made += [behaviour] if behaviour is not None else []
    return made


def _make(
    key: str, kind: str, own: Any, name: str, around: RecoveryContext, diagnostics: Diagnostics
) -> Behaviour | None:
    makers = {_CLEAR: (CLEAR, _clearing), _ROTATE: (ROTATE, _turning), _SLOW: (SLOW, _slowing)}
    if kind not in makers:
        text = f"{name}: recovery behaviour '{key}' is of type '{kind}', which is not known; "
        text += f"there are {', '.join(makers)}. It is left out"
        fix = did_you_mean(kind, makers)
        diagnostics.report("navigation.unknown-plugin", text, fix=fix)
        return None
    table, make = makers[kind]
    tree = own if isinstance(own, Mapping) else {}
    settings = node_reader(table, tree, f"{name}/{key}", diagnostics)
    settings.report_unknown()
    return Behaviour(key, kind, make(settings, around))


def _clearing(settings: ParameterReader, around: RecoveryContext) -> Callable[[], None]:
    size_m = settings.number("reset_distance")
    inside, updates = settings.flag("invert_area_to_clear"), settings.flag("force_updating")
    which = settings.text("affected_maps")
    if which not in ("local", "global", "both"):
        text = f"affected_maps is '{which}', not local, global or both; both are cleared"
        settings.report("parameter.bad-value", text)
        which = "both"
    layers = settings.raw("layer_names", ["obstacle_layer"])
    names = tuple(str(layer) for layer in layers) if isinstance(layers, Sequence) else ()
    maps = {"global": [around.global_costmap], "local": [around.local_costmap]}
    chosen = maps.get(which, [*maps["global"], *maps["local"]])

    def run() -> None:
        where = "inside" if inside else "outside"
        around.log("warn", f"Clearing {which} costmap{'s' if which == 'both' else ''} {where} a "
                   f"square ({size_m:.2f}m) large centered on the robot.")  # fmt: skip
        for costmap in chosen:
            costmap.clear_around(size_m, layers=names, inside=inside)
            if updates:
                costmap.update()

    return run


def _turning(settings: ParameterReader, around: RecoveryContext) -> Callable[[], None]:
    step_rad = settings.number("sim_granularity")
    period_s = 1.0 / settings.number("frequency")
    tolerance_rad = settings.number("yaw_goal_tolerance")
    acceleration = settings.number("acc_lim_th")
    fastest = settings.number("max_rotational_vel")
    slowest = settings.number("min_in_place_rotational_vel")

    def run() -> None:
        around.log("warn", "Rotate recovery behavior started.")
        turned, last = 0.0, None
        while turned < 2 * _HALF_TURN - tolerance_rad:
            pose = around.local_costmap.pose()
            if pose is not None and last is not None:
                turned += max(math.remainder(pose[2] - last, math.tau), 0.0)
            last = pose[2] if pose is not None else last
            left = max(2 * _HALF_TURN - turned, 0.0)
            blocked = _blocked(around, pose, min(left, _HALF_TURN), step_rad)
            if blocked:
                around.log("error", f"Rotate recovery can't rotate in place because {blocked}")
                break
            speed = min(max(math.sqrt(2 * acceleration * left), slowest), fastest)
            around.drive(0.0, speed)
            if not around.sleep(period_s):
                break
        around.drive(0.0, 0.0)

    return run


def _blocked(
    around: RecoveryContext,
    pose: tuple[float, float, float] | None,
    turn_rad: float,
    step_rad: float,
) -> str:
    """Return what is in the way of a turn, empty when nothing is."""
    costmap = around.local_costmap
    if pose is None:
        return "the robot's pose is not known."
    with costmap.lock:
        turned = 0.0
        while turned < turn_rad:
            at = (pose[0], pose[1], pose[2] + turned)
            cost = footprint_cost(costmap.grid, costmap.footprint, at)
            if cost < 0:
                return f"there is a potential collision. Cost: {float(cost):.2f}"
            turned += step_rad
    return ""


def _slowing(settings: ParameterReader, around: RecoveryContext) -> Callable[[], None]:
    radius_m = settings.number("clearing_distance")
    speed, distance_m = settings.number("limited_trans_speed"), settings.number("limited_distance")

    def run() -> None:
        around.log("warn", "Move slow and clear recovery behavior started.")
        for costmap in (around.global_costmap, around.local_costmap):
            costmap.clear_around(2 * radius_m, inside=True)
        around.limit_speed(speed, distance_m)
        around.log("info", f"the robot drives at most {speed:g} m/s for {distance_m:g} m")

    return run
