"""``laser_filters scan_to_scan_filter_chain``."""

from __future__ import annotations

import math
import threading
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.tf import TransformError
from gazelle.interfaces import message_type
from gazelle.navigation.laser_scans import (
    FILTERS,
    REFUSED_FILTERS,
    FilterSetup,
    ScanArrays,
    apply_chain,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.dataclass_tables import table_of
from gazelle.parameters.reader import (
    ParameterOwner,
    ParameterReader,
    TreeSource,
    flag_of,
    number_of,
)

__all__ = ["FILTER_TABLES", "PARAMETERS", "chain_of", "run"]

_NO_WAITING = "transforms are looked up when a filter needs them, no scan waits for one"
PARAMETERS = ParameterTable(
    "scan_to_scan_filter_chain",
    "Takes out of scans what does not belong there, by filters one after the other. What a filter"
    " cannot use ends it.",
    ("laser_filters/scan_to_scan_filter_chain",),
    (
        Parameter("scan_filter_chain", "any", None, "ROS 1: a list of `{name, type, params}`"),
        Parameter("filter<number>.name", "text", None, "ROS 2: how filter1, filter2 … are called"),
        Parameter("filter<number>.type", "text", None, "such as `laser_filters/ScanShadowsFilter`"),
        Parameter("filter<number>.params", "group", None, "the parameters of the filter"),
        *refused("scans are always listened to", "lazy_subscription", unless=False),
        *refused(_NO_WAITING, "tf_message_filter_target_frame", unless=""),
        *refused(_NO_WAITING, "tf_message_filter_tolerance", unless=0.03),
        *refused("there are no diagnostics", "diagnostic_updater"),
    ),
)
FILTER_TABLES = {
    name: table_of(one.options, name, one.does, (f"laser_filters/{name}",)).plus(one.idle)
    for name, one in FILTERS.items()
}

_MAX = 100
_NO_NUMBERS = {".inf": math.inf, "-.inf": -math.inf, ".nan": math.nan}


def chain_of(tree: Mapping[str, Any], owner: str, found: Diagnostics) -> list[FilterSetup]:
    """Return the filters of ``scan_filter_chain`` (ROS 1) or ``filter1``, ``filter2`` … (ROS 2).

    Args:
        tree: the node's parameters.
        owner: what messages call the node.
        found: receives parameters of filters that are unknown or have no effect.

    Raises:
        LaunchError: filters are not known or cannot be used; all of them at once.
    """
    listed = tree.get("scan_filter_chain")
    if not isinstance(listed, list):
        listed = [tree[key] for key in (f"filter{k}" for k in range(1, _MAX)) if key in tree]
    chain, wrong = [], []
    for position, item in enumerate(listed):
        if not isinstance(item, Mapping) or "type" not in item:
            wrong.append(f"filter {position + 1} is {item!r}, not {{name, type, params}}")
            continue
        kind = str(item["type"]).rpartition("/")[2]
        name = str(item.get("name", kind))
        if kind not in FILTERS:
            why = REFUSED_FILTERS.get(kind) or did_you_mean(kind, FILTERS)
            wrong.append(f"filter '{item.get('name', '')}' is a {item['type']}, which is not there"
                         f"; {why or 'there are ' + ', '.join(FILTERS)}")  # fmt: skip
            continue
        given = item.get("params") or {}
        problems = _problems(kind, given)
        wrong += [f"filter '{name}': {problem}" for problem in problems]
        if not problems:
            own = _reader(kind, given, f"{owner}: filter '{name}'", found)
            chain.append(FilterSetup(name, kind, own.fill(FILTERS[kind].options)))
            own.report_unknown()
    if wrong:
        raise LaunchError("scan_to_scan_filter_chain: " + "\n  ".join(wrong))
    return chain


def _problems(kind: str, given: Any) -> list[str]:
    """Return what is wrong with values of a filter: what it cannot use must not pass silently."""
    if not isinstance(given, Mapping):
        return [f"params is {given!r}, not a group of parameters"]
    problems = []
    for key, value in given.items():
        row = FILTER_TABLES[kind].row_for(str(key))
        if row is None or row.is_refused:
            continue
        if row.kind in ("number", "integer") and number_of(_number_in(value)) is None:
            problems.append(f"{key} is {value!r}, not a number")
        elif row.kind == "flag" and flag_of(value) is None:
            problems.append(f"{key} is {value!r}, not true or false")
    return problems


def _reader(kind: str, given: Mapping[str, Any], owner: str, found: Diagnostics) -> ParameterReader:
    tree = {key: _number_in(value) for key, value in given.items()}
    named = ParameterOwner(owner, takes_nan=True)
    return ParameterReader(FILTER_TABLES[kind], TreeSource(tree), named, found)


def _number_in(value: Any) -> Any:
    """Return infinity, or no number, for how YAML writes them: ROS 1's store may hold the text."""
    return _NO_NUMBERS.get(value, value) if isinstance(value, str) else value


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Filter scans until told to stop.

    Raises:
        LaunchError: filters are not known, or cannot be used.
    """
    node = start_node(arguments, graph)
    try:
        with private_parameters(node, arguments, PARAMETERS) as own:
            chain = chain_of(own.tree, own.name, own.diagnostics)
    except LaunchError:
        node.shutdown()
        raise
    if not chain:
        node.log("warn", "the filter chain is empty: scans pass as they are")
    _connect(node, chain)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


def _connect(node: Node, chain: list[FilterSetup]) -> None:
    frames = Frames(node)
    kind: Any = message_type("sensor_msgs/msg/LaserScan")
    out = node.create_publisher("scan_filtered", kind)

    def on_scan(message: Any) -> None:
        source = str(message.header.frame_id)

        def transform(frame: str, points: NDArray[np.float64]) -> NDArray[np.float64]:
            if frame in ("", source):
                return points
            return frames.buffer.lookup_transform(frame, source).pose.transform(points)

        try:
            scan = apply_chain(_arrays(message), chain, transform)
        except (TransformError, ValueError) as error:
            frames.say("error", f"Filtering the scan failed: {error}")
            return
        out.publish(_message(kind, scan, message))

    node.create_subscription("scan", kind, on_scan, queue_size=10)


def _arrays(message: Any) -> ScanArrays:
    return ScanArrays(
        float(message.angle_min),
        float(message.angle_increment),
        np.asarray(message.ranges, float),
        np.asarray(message.intensities, float),
        float(message.range_min),
        float(message.range_max),
    )


def _message(kind: Any, scan: ScanArrays, source: Any) -> Any:
    message = kind()
    message.header = source.header
    message.angle_min, message.angle_increment = scan.angle_min_rad, scan.increment_rad
    message.angle_max = scan.angle_min_rad + scan.increment_rad * max(len(scan.ranges_m) - 1, 0)
    message.time_increment, message.scan_time = source.time_increment, source.scan_time
    message.range_min, message.range_max = source.range_min, source.range_max
    message.ranges = scan.ranges_m.astype(np.float32)
    message.intensities = scan.intensities.astype(np.float32)
    return message
