"""``ros_gz_bridge/parameter_bridge``: topics of Gazebo under names of ROS.

In Gazelle both live on one graph: what a plug-in of the new Gazebo publishes has its name of
Gazebo and the type of ROS that the bridge pairs with it. So a topic that keeps its name needs
nothing; one that is renamed (``-r``, or two names in the file) is passed on, but for a world's
clock, which is on ``/clock`` anyway.

Parameters: ``config_file``, ``lazy`` (false), ``expand_gz_topic_names`` (false);
``override_timestamps_with_wall_time`` is told to have no effect.
"""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path

from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private, start_node
from gazelle.nodes.ros_gz.pairs import full_ros_type, is_pair, pair_error
from gazelle.nodes.ros_gz.relay import End, Relay
from gazelle.nodes.ros_gz.rows import Direction, ServiceRow, TopicRow, read_file, read_word
from gazelle.nodes.ros_gz.services import offer

__all__ = ["run", "run_image"]

_LOOK_S = 0.2
_CLOCK = "/clock"
_IMAGE = ("sensor_msgs/msg/Image", "gz.msgs.Image")


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Bridge what the words and the file say until told to stop."""
    rows = [read_word(word) for word in arguments.rest]
    node = start_node(arguments, graph)
    file = str(private(node, arguments, "config_file", ""))
    if file:
        found, wrong = read_file(Path(file))
        rows += found
        for text in wrong:
            node.log("error", text)
    return _bridge(node, arguments, rows, stop)


def run_image(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Bridge the topics of images that the words name (``ros_gz_image/image_bridge``)."""
    node = start_node(arguments, graph)
    rows = [TopicRow(word, word, *_IMAGE, Direction.GZ_TO_ROS) for word in arguments.rest]
    return _bridge(node, arguments, list(rows), stop)


def _bridge(
    node: Node,
    arguments: NodeArguments,
    rows: list[TopicRow | ServiceRow],
    stop: threading.Event,
) -> int:
    if private(node, arguments, "override_timestamps_with_wall_time", False):
        node.log("warn", "override_timestamps_with_wall_time has no effect: stamps stay")
    lazy = bool(private(node, arguments, "lazy", False))
    gz = _gazebo_side(node, bool(private(node, arguments, "expand_gz_topic_names", False)))
    relays: list[Relay] = []
    for row in rows:
        if isinstance(row, ServiceRow):
            offer(node, row)
        elif not is_pair(row.ros_type, row.gz_type):
            node.log("error", f"Failed to create a bridge: {pair_error(row.ros_type, row.gz_type)}")
        else:
            relays += _relays(node, gz, replace(row, lazy=row.lazy or lazy))
    if not rows:
        node.log("warn", "nothing to bridge: neither words nor config_file name a topic")
    while not stop.wait(_LOOK_S):
        for relay in relays:
            relay.look()
    gz.shutdown()
    node.shutdown()
    return 0


def _gazebo_side(node: Node, expands: bool) -> Node:
    """Return a hidden node for the names of Gazebo, which remaps do not change."""
    space = node.namespace if expands else "/"
    name = f"_{node.name.rpartition('/')[2]}_gz"
    return node.graph.create_node(name, namespace=space, rosout=False, is_ros2=True)


def _relays(ros: Node, gz: Node, row: TopicRow) -> list[Relay]:
    """Start to pass a topic on, in one direction or two; say so as the original does."""
    ends = {True: End(ros, row.ros_topic), False: End(gz, row.gz_topic)}
    names = {
        True: f"{ends[True].name} ({row.ros_type})",
        False: f"{ends[False].name} ({row.gz_type})",
    }
    relays = []
    for way, from_ros in ((Direction.GZ_TO_ROS, False), (Direction.ROS_TO_GZ, True)):
        if row.direction not in (way, Direction.BIDIRECTIONAL):
            continue
        arrow = way.name.replace("_TO_", "->")
        text = f"Creating {arrow} Bridge: [{names[from_ros]} -> {names[not from_ros]}]"
        ros.log("info", f"{text} (Lazy {int(row.lazy)})")
        if not from_ros and ends[True].name == _CLOCK:
            # The world tells it already: a second, later voice would turn time back.
            continue
        relay = Relay(
            ends[from_ros],
            ends[not from_ros],
            full_ros_type(row.ros_type),
            log=ros.log,
            queue_size=row.queue_size,
            lazy=row.lazy,
            to_gz=from_ros,
        )
        relays.append(relay)
    return relays
