"""``ros_gz_bridge/parameter_bridge``: topics of Gazebo under names of ROS.

In Gazelle both live on one graph: what a plug-in of the new Gazebo publishes has its name of
Gazebo and the type of ROS that the bridge pairs with it. So a topic that keeps its name needs
nothing; one that is renamed (``-r``, or two names in the file) is passed on, but for a world's
clock, which is on ``/clock`` anyway.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import GraphError
from gazelle.graph import Graph, Node
from gazelle.graph.gazebo_names import SHOWN_SPACE, offered_name
from gazelle.interfaces import service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.nodes.ros_gz.bridge_config import (
    Direction,
    ServiceRow,
    TopicRow,
    read_argument,
    read_file,
)
from gazelle.nodes.ros_gz.mappings import full_ros_type, is_pair, pair_error
from gazelle.nodes.ros_gz.relay import End, Relay
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader

__all__ = ["IMAGE_PARAMETERS", "KINDS", "PARAMETERS", "offer", "run", "run_image"]


_WAIT_S = 5.0

_ROWS = (
    Parameter("lazy", "flag", False, "listen only while somebody listens to what comes out"),
    Parameter(
        "expand_gz_topic_names", "flag", False, "names of Gazebo begin with the node's namespace"
    ),
    *refused("stamps stay", "override_timestamps_with_wall_time", unless=False),
    *refused("frames stay", "override_frame_id", unless=""),
)

PARAMETERS = ParameterTable(
    "parameter_bridge",
    "Passes topics of the new Gazebo on under names of ROS, and services.",
    ("ros_gz_bridge/parameter_bridge",),
    (
        Parameter("config_file", "text", "", "a YAML file of what is bridged, besides the words"),
        *_ROWS,
        *refused("messages are passed on as they come", "subscription_heartbeat", unless=1000),
        *refused("write them in config_file, or as words", "bridge_names", "bridges.<name>"),
    ),
)

IMAGE_PARAMETERS = ParameterTable(
    "image_bridge",
    "Passes images of the new Gazebo on.",
    ("ros_gz_image/image_bridge",),
    (*_ROWS, *refused("publishers suit whoever listens", "qos", unless="default")),
)
_LOOK_S = 0.2
_CLOCK = "/clock"
_IMAGE = ("sensor_msgs/msg/Image", "gz.msgs.Image")


def offer(node: Node, row: ServiceRow) -> None:
    """Offer one service; what cannot be offered is logged."""
    forward = KINDS.get(row.ros_type)
    if forward is None:
        hint = did_you_mean(row.ros_type, KINDS) or f"there are {', '.join(sorted(KINDS))}"
        node.log("error", f"Failed to create a bridge for service [{row.ros_type}]; {hint}")
        return
    kind: Any = service_type(row.ros_type)

    def answer(request: Any) -> Any:
        response = kind.Response()
        try:
            response.success = forward(node, request)
        except GraphError as error:
            node.log("error", f"{row.name}: {error}")
            response.success = False
        return response

    node.create_service(row.name, kind, answer)
    node.log("info", f"Creating ROS->GZ service bridge [{row.name} ({row.ros_type})]")


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Bridge what the words and the file say until told to stop."""
    rows = [read_argument(word) for word in arguments.rest]
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        file, gz, lazy = own.text("config_file"), _gazebo_side(node, own), own.flag("lazy")
    if file:
        found, wrong = read_file(Path(file))
        rows += found
        for text in wrong:
            node.log("error", text)
    return _bridge(node, gz, [_with_laziness(row, lazy=lazy) for row in rows], stop)


def run_image(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Bridge the topics of images that the words name (``ros_gz_image/image_bridge``)."""
    node = start_node(arguments, graph)
    rows = [TopicRow(word, word, *_IMAGE, Direction.GZ_TO_ROS) for word in arguments.rest]
    with private_parameters(node, arguments, IMAGE_PARAMETERS) as own:
        gz, lazy = _gazebo_side(node, own), own.flag("lazy")
    return _bridge(node, gz, [_with_laziness(row, lazy=lazy) for row in rows], stop)


def _control(node: Node, request: Any) -> bool:
    return bool(_call(node, "control_world", "ros_gz_interfaces/ControlWorld", request).success)


def _spawn(node: Node, request: Any) -> bool:
    from gazelle.nodes.ros_gz.create import model_text

    wanted = request.entity_factory
    kind = "gazebo_msgs/SpawnModel"
    fields = service_type(kind).Request(
        model_name=wanted.name,
        model_xml=wanted.sdf or model_text(wanted.sdf_filename),
        initial_pose=wanted.pose,
        reference_frame=wanted.relative_to,
    )
    return _said(node, _call(node, "spawn_sdf_model", kind, fields))


def _delete(node: Node, request: Any) -> bool:
    kind = "gazebo_msgs/DeleteModel"
    fields = service_type(kind).Request(model_name=request.entity.name)
    return _said(node, _call(node, "delete_model", kind, fields))


def _set_pose(node: Node, request: Any) -> bool:
    kind = "gazebo_msgs/SetModelState"
    fields = service_type(kind).Request()
    fields.model_state.model_name = request.entity.name
    fields.model_state.pose = request.pose
    return _said(node, _call(node, "set_model_state", kind, fields))


def _call(node: Node, name: str, kind: str, request: Any) -> Any:
    offered = offered_name(node.graph, f"{SHOWN_SPACE}/{name}", _WAIT_S)
    client = node.create_client(offered, service_type(kind))
    try:
        if not client.available:
            raise GraphError(f"no world answers at {SHOWN_SPACE}/{name}: is gz sim running?")
        return client.call(request, timeout_s=_WAIT_S)
    finally:
        client.unregister()


def _said(node: Node, answer: Any) -> bool:
    if not answer.success:
        node.log("error", str(answer.status_message))
    return bool(answer.success)


KINDS: dict[str, Callable[[Node, Any], bool]] = {
    "ros_gz_interfaces/srv/ControlWorld": _control,
    "ros_gz_interfaces/srv/DeleteEntity": _delete,
    "ros_gz_interfaces/srv/SetEntityPose": _set_pose,
    "ros_gz_interfaces/srv/SpawnEntity": _spawn,
}


def _with_laziness(row: TopicRow | ServiceRow, *, lazy: bool) -> TopicRow | ServiceRow:
    return row if isinstance(row, ServiceRow) else replace(row, lazy=row.lazy or lazy)


def _bridge(node: Node, gz: Node, rows: list[TopicRow | ServiceRow], stop: threading.Event) -> int:
    relays: list[Relay] = []
    for row in rows:
        if isinstance(row, ServiceRow):
            offer(node, row)
        elif not is_pair(row.ros_type, row.gz_type):
            node.log("error", f"Failed to create a bridge: {pair_error(row.ros_type, row.gz_type)}")
        else:
            relays += _relays(node, gz, row)
    if not rows:
        node.log("warn", "nothing to bridge: neither words nor config_file name a topic")
    while not stop.wait(_LOOK_S):
        for relay in relays:
            relay.look()
    gz.shutdown()
    node.shutdown()
    return 0


def _gazebo_side(node: Node, own: ParameterReader) -> Node:
    """Return a hidden node for the names of Gazebo, which remaps do not change."""
    space = node.namespace if own.flag("expand_gz_topic_names") else "/"
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
