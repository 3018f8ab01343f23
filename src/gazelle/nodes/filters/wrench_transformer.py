"""``force_torque_sensor_broadcaster wrench_transformer_node``: wrenches in other frames.

``~/wrench`` is turned into each frame, and sent on ``FRAME/wrench`` below the node's namespace, or
below its name where it has none; ``_filtered`` is added where the topic that comes has that word.
Force and torque are turned only, as ``tf2`` does it: the torque is about the same point as before.

Names and texts are those of ros2_controllers (Rolling).
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.tf import TransformError
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_xyz, xyz_of
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import log_findings, node_reader, offer_parameters, start_ros2_node
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["PARAMETERS", "run"]

_WHY = "the original declares it and does not read it; topics are remapped"

PARAMETERS = ParameterTable(
    "wrench_transformer_node",
    "Turns wrenches into other frames.",
    ("force_torque_sensor_broadcaster/wrench_transformer_node",),
    (
        Parameter("target_frames", "words", (), "frames; the node's own words count more"),
        Parameter("tf_timeout", "number", 0.1, "how long a transform is waited for", "s", low=0),
        *refused(_WHY, "broadcaster_namespace", "use_filtered_input", "output_topic_prefix"),
    ),
)

_WRENCH = "geometry_msgs/msg/WrenchStamped"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Turn wrenches until told to stop.

    Raises:
        LaunchError: no frame is given.
    """
    node, tree = start_ros2_node(arguments, graph)
    found = Diagnostics()
    settings = node_reader(PARAMETERS, tree, node.name, found)
    frames = arguments.rest or settings.texts("target_frames")
    timeout_s = settings.number("tf_timeout")
    settings.report_unknown()
    log_findings(node, found)
    if not frames:
        node.shutdown()
        raise LaunchError(
            "Invalid value set during initialization for parameter 'target_frames': it cannot be "
            "empty; name the frames that wrenches are to be turned into"
        )
    offer_parameters(node, {"target_frames": list(frames), "tf_timeout": timeout_s, **tree})
    _connect(node, frames, timeout_s)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


def _connect(node: Node, targets: tuple[str, ...], timeout_s: float) -> None:
    frames = Frames(node)
    kind: Any = message_type(_WRENCH)
    suffix = "_filtered" if "filtered" in node.resolve_name("~/wrench") else ""
    below = node.namespace.rstrip("/") or node.name
    outputs = {
        frame: node.create_publisher(f"{below}/{frame}/wrench{suffix}", kind) for frame in targets
    }

    def on_wrench(message: Any) -> None:
        source = str(message.header.frame_id)
        if not source:
            frames.say("error", "Invalid wrench message or frame_id is empty")
            return
        for target, output in outputs.items():
            try:
                pose = frames.buffer.lookup_transform(target, source, timeout_s=timeout_s).pose
            except TransformError as error:
                frames.say("error", f"Transform exception: {error}", f"error {target}")
                text = f"Failed to transform wrench for frame {target}, skipping publication"
                frames.say("warn", text)
                continue
            turned = kind()
            turned.header.stamp, turned.header.frame_id = message.header.stamp, target
            for part in ("force", "torque"):
                given, made = getattr(message.wrench, part), getattr(turned.wrench, part)
                set_xyz(made, pose.rotate(xyz_of(given)))
            output.publish(turned)

    node.create_subscription("~/wrench", kind, on_wrench)
