"""``robot_state_publisher``: joint states and a robot description become tf.

ROS 2's node of the same name differs: the description may be a file named on the command line,
``frame_prefix`` is put before frames as it is, and the description is published, latched, on
``robot_description``.
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_transform
from gazelle.interfaces.stamps import ns_of, set_stamp
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.link_tree import (
    DESCRIPTION,
    TreeJoint,
    description_of,
    joint_tree,
    robot_in,
    segment_names,
    take_description_file,
)
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "StateToTf", "run"]

PARAMETERS = ParameterTable(
    "robot_state_publisher",
    "Joint states and a robot's description become tf.",
    ("robot_state_publisher/robot_state_publisher",),
    (
        Parameter(
            "robot_description", "text", None, "the robot; ROS 1 looks in the namespaces above, too"
        ),
        Parameter(
            "publish_frequency", "number", 50.0, "the most that one joint is published", "Hz",
            ros2_default=20.0,
        ),
        Parameter("use_tf_static", "flag", True, "fixed joints go to `/tf_static`, once, latched"),
        Parameter("ignore_timestamp", "flag", False, "publish every message, however fast"),
        Parameter(
            "tf_prefix", "text", "", "put before every frame, with a slash between",
            ros_versions=(1,),
        ),
        Parameter(
            "frame_prefix", "text", "", "put before every frame as it is", ros_versions=(2,)
        ),
    ),
)  # fmt: skip


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish tf until told to stop."""
    node = start_node(arguments, graph)
    ros2 = arguments.ros_version == 2
    if ros2 and arguments.rest:
        text: str | None = take_description_file(node, arguments.rest[0])
    else:
        text = description_of(node)
    model = None if text is None else robot_in(node, text)
    if text is None or model is None:
        node.shutdown()
        return 1
    with private_parameters(node, arguments, PARAMETERS) as own:
        states = StateToTf(
            joint_tree(model),
            prefix=_prefix(own, arguments),
            period_ns=int(1e9 / own.number("publish_frequency")),
            ignore_timestamp=own.flag("ignore_timestamp"),
        )
        is_static = own.flag("use_tf_static")
        wants_sim_time = own.raw("use_sim_time") is True
    if ros2:
        for name in segment_names(model):
            node.log("info", f"got segment {name}")
        kind: Any = message_type("std_msgs/msg/String")
        node.create_publisher(DESCRIPTION, kind, latch=True).publish(kind(data=text))
    _connect(node, states, is_static, _begin_ns(node, wants_sim_time=wants_sim_time))
    stop.wait()
    node.shutdown()
    return 0


def _prefix(own: ParameterReader, arguments: NodeArguments) -> str:
    """Return what stands before every frame, a slash at its end included."""
    if arguments.ros_version == 2:
        return own.text("frame_prefix")
    prefix = own.text("tf_prefix").strip("/")
    return f"{prefix}/" if prefix else ""


class StateToTf:
    """Turns joint states into transforms, no joint more often than the frequency allows."""

    def __init__(
        self,
        joints: tuple[TreeJoint, ...],
        *,
        prefix: str = "",
        period_ns: int = 20_000_000,
        ignore_timestamp: bool = False,
    ) -> None:
        self._moving = {item.joint.name: item for item in joints if not item.is_fixed}
        self._fixed = [item for item in joints if item.is_fixed]
        self._mimics = {
            name: item.joint.mimic for name, item in self._moving.items() if item.joint.mimic
        }
        self._prefix = prefix
        self._period_ns = period_ns
        self._ignore_timestamp = ignore_timestamp
        self._last_ns: dict[str, int] = {}
        self._latest_ns = 0
        self._type: Any = message_type("geometry_msgs/msg/TransformStamped")

    def fixed(self, stamp_ns: int) -> list[Any]:
        """Return the transforms of the fixed joints."""
        return [self._transform(item, item.T_parent_joint, stamp_ns) for item in self._fixed]

    def moving(self, message: Any) -> list[Any]:
        """Return the transforms that a JointState is due for; empty when it comes too soon."""
        stamp = message.header.stamp
        stamp_ns = ns_of(stamp)
        if stamp_ns < self._latest_ns:
            # Time has jumped back: a bag started again, or the simulation was reset.
            self._last_ns.clear()
        self._latest_ns = stamp_ns
        names = [name for name in message.name if name in self._moving]
        last_ns = min((self._last_ns.get(name, -self._period_ns) for name in names), default=0)
        if not names or not (self._ignore_timestamp or stamp_ns >= last_ns + self._period_ns):
            return []
        positions = dict(zip(message.name, map(float, message.position), strict=False))
        for name, mimic in self._mimics.items():
            if name not in positions and mimic.joint in positions:
                positions[name] = positions[mimic.joint] * mimic.multiplier + mimic.offset
        self._last_ns.update(dict.fromkeys(names, stamp_ns))
        return [
            self._transform(item, item.T_parent_child(positions[name]), stamp_ns)
            for name, item in self._moving.items()
            if name in positions
        ]

    def _transform(self, item: TreeJoint, pose: Pose, stamp_ns: int) -> Any:
        message = self._type()
        message.header.frame_id = self._frame(item.joint.parent)
        set_stamp(message.header.stamp, stamp_ns)
        message.child_frame_id = self._frame(item.joint.child)
        set_transform(message.transform, pose)
        return message

    def _frame(self, name: str) -> str:
        return f"{self._prefix}{name}"


def _begin_ns(node: Node, *, wants_sim_time: bool) -> int:
    """Return the time of transforms that hold always; simulated time is 0 before ``/clock``."""
    return 0 if wants_sim_time and not node.clock.use_sim_time else node.clock.now_ns()


def _connect(node: Node, states: StateToTf, use_tf_static: bool, begin_ns: int) -> None:
    tf_message: Any = message_type("tf2_msgs/msg/TFMessage")
    tf = node.create_publisher("/tf", tf_message, queue_size=100)
    static = node.create_publisher("/tf_static", tf_message, latch=True) if use_tf_static else None
    if static is not None:
        static.publish(tf_message(transforms=states.fixed(begin_ns)))

    def on_joint_states(message: Any) -> None:
        transforms = states.moving(message)
        if transforms and static is None:
            stamp = message.header.stamp
            transforms += states.fixed(ns_of(stamp))
        if transforms:
            tf.publish(tf_message(transforms=transforms))

    node.create_subscription(
        "joint_states", message_type("sensor_msgs/msg/JointState"), on_joint_states
    )
