"""What a SLAM node is told, whatever the names of its parameters are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from gazelle.mapping.slam import SlamParameters
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["SlamNode", "SlamOptions", "options_of", "used"]


@dataclass(frozen=True, slots=True)
class SlamOptions:
    """Options of a SLAM node.

    Attributes:
        base_frame, odom_frame, map_frame: ends of transforms.
        scan_topic: of the lidar.
        map_period_s: between two maps, 0 for one per kept scan.
        tf_period_s: between two transforms, 0 for none.
        tf_ahead_s: how far transforms are dated ahead.
        throttle: every so many-th scan is used.
        least_interval_s: between two scans that are used.
        resolution_m: of the map.
        occupied_share: of beams that end in an occupied cell.
        range_limit_m: longer ranges say nothing.
        publishes_tf: whether the transform from the map is sent.
        mode: ``mapping``, or ``localization`` in a map that stays as it is.
        map_file: graph of poses to begin with.
        start_pose: where the robot is in it, (x, y, yaw).
        slam: of the engine.
    """

    base_frame: str = "base_link"
    odom_frame: str = "odom"
    map_frame: str = "map"
    scan_topic: str = "scan"
    map_period_s: float = 5.0
    tf_period_s: float = 0.05
    tf_ahead_s: float = 0.05
    throttle: int = 1
    least_interval_s: float = 0.0
    resolution_m: float = 0.05
    occupied_share: float = 0.25
    range_limit_m: float = 1e9
    publishes_tf: bool = True
    mode: str = "mapping"
    map_file: str = ""
    start_pose: tuple[float, ...] = ()
    slam: SlamParameters = field(default_factory=SlamParameters)


@dataclass(frozen=True, slots=True)
class SlamNode:
    """One package's SLAM node.

    Attributes:
        table: its parameters.
        uses: which option each of them is.
        base: options that it has and no parameter tells.
        services: it answers as slam_toolbox does.
    """

    table: ParameterTable
    uses: Mapping[str, str]
    base: SlamOptions = SlamOptions()
    services: bool = False


_ENGINE = frozenset(one.name for one in fields(SlamParameters))
_MAX_DISTANCE_M = 30.0
"""Fields of all that is seen would be too large, and beams that long err by their angle."""


def used(
    key: str, default: Any, option: str, meaning: str, low: float | None = None, unit: str = ""
) -> tuple[Parameter, str]:
    """Return the row of a parameter that is an option, and that option."""
    kind = {str: "text", bool: "flag", int: "integer", list: "numbers"}.get(type(default), "number")
    return Parameter(key, kind, default, meaning, unit, low), option  # type: ignore[arg-type]


def options_of(slam_node: SlamNode, settings: ParameterReader) -> SlamOptions:
    """Return the options that parameters name; others keep the engine's values."""
    own: dict[str, Any] = {}
    engine: dict[str, Any] = {}
    for key, option in slam_node.uses.items():
        row = slam_node.table.row(key)
        value = settings.value(row)
        (engine if option in _ENGINE else own)[option] = value
    for frame in ("base_frame", "odom_frame", "map_frame"):
        if frame in own:
            own[frame] = str(own[frame]).removeprefix("/")
    if "max_range_m" in engine:
        engine["max_range_m"] = min(_MAX_DISTANCE_M, engine["max_range_m"])
    slam = replace(slam_node.base.slam, **engine)
    return replace(slam_node.base, slam=slam, **own)
