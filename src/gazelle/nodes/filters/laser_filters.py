"""``laser_filters scan_to_scan_filter_chain``."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.tf import TransformError
from gazelle.interfaces import message_type
from gazelle.navigation.filters import (
    FILTERS,
    REFUSED_FILTERS,
    FilterSetup,
    ScanArrays,
    apply_chain,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.frames import Frames
from gazelle.nodes.parameters import parameter_tree, start_node

__all__ = ["chain_of", "run"]

_MOST = 100


def chain_of(tree: Mapping[str, Any]) -> list[FilterSetup]:
    """Return the filters of ``scan_filter_chain`` (ROS 1) or ``filter1``, ``filter2`` … (ROS 2).

    Raises:
        LaunchError: filters are not known; all of them at once.
    """
    listed = tree.get("scan_filter_chain")
    if not isinstance(listed, list):
        listed = [tree[key] for key in (f"filter{k}" for k in range(1, _MOST)) if key in tree]
    chain, wrong = [], []
    for position, item in enumerate(listed):
        if not isinstance(item, Mapping) or "type" not in item:
            wrong.append(f"filter {position + 1} is {item!r}, not {{name, type, params}}")
            continue
        name = str(item["type"]).rpartition("/")[2]
        if name not in FILTERS:
            why = REFUSED_FILTERS.get(name) or did_you_mean(name, FILTERS)
            wrong.append(f"filter '{item.get('name', '')}' is a {item['type']}, which is not there"
                         f"; {why or 'there are ' + ', '.join(FILTERS)}")  # fmt: skip
            continue
        params = item.get("params") or {}
        chain.append(FilterSetup(str(item.get("name", name)), name, dict(params)))
    if wrong:
        raise LaunchError("scan_to_scan_filter_chain: " + "\n  ".join(wrong))
    return chain


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Filter scans until told to stop.

    Raises:
        LaunchError: filters are not known.
    """
    node = start_node(arguments, graph)
    tree = parameter_tree(node, arguments)
    try:
        chain = chain_of(tree)
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
