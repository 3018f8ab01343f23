"""``fake_localization``: a simulator's true pose in the place of amcl's (ROS 1 noetic).

Listens to ``base_pose_ground_truth`` and ``initialpose``; publishes ``amcl_pose``,
``particlecloud`` with one pose, and the transform from map to odometry. A message waits until the
robot's odometry at its time is known.
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.graph.tf import MessageFilter, StampedPose, TransformBroadcaster, TransformError
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose, unit_pose_of
from gazelle.interfaces.stamps import ns_of
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "fake_localization",
    "A simulator's true pose in the place of amcl's.",
    ("fake_localization/fake_localization",),
    (
        Parameter("odom_frame_id", "text", "odom", "frame of odometry"),
        Parameter("base_frame_id", "text", "base_link", "the robot's frame"),
        Parameter("global_frame_id", "text", "/map", "the map's frame"),
        Parameter("delta_x", "number", 0.0, "the map's origin in the simulator's world", "m"),
        Parameter("delta_y", "number", 0.0, "the same across", "m"),
        Parameter("delta_yaw", "number", 0.0, "the same as a turn", "rad"),
        Parameter("transform_tolerance", "number", 0.1, "how far ahead transforms are dated", "s"),
    ),
)

_POSE = "geometry_msgs/msg/PoseWithCovarianceStamped"
_WAITING = 100
_NANO = 1_000_000_000


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Place the robot until told to stop."""
    node = start_node(arguments, graph)
    _FakeLocalization(node, arguments)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


class _FakeLocalization:
    def __init__(self, node: Node, arguments: NodeArguments) -> None:
        with private_parameters(node, arguments, PARAMETERS) as own:
            self._shown_frame = own.text("global_frame_id")
            self._odom = own.text("odom_frame_id").removeprefix("/")
            self._base = own.text("base_frame_id").removeprefix("/")
            self._ahead_ns = round(own.number("transform_tolerance") * _NANO)
            # As in the original: turned back and moved back, without one turning the other.
            self._T_map_world = Pose.from_xyz_rpy(
                (-own.number("delta_x"), -own.number("delta_y"), 0.0),
                (0.0, 0.0, -own.number("delta_yaw")),
            )
        self._map = self._shown_frame.removeprefix("/")
        self._frames = Frames(node)
        self._tf = TransformBroadcaster(node)
        self._lock = threading.Lock()
        self._waiting = MessageFilter(self._placed, self._tell, size=_WAITING)
        self._poses = node.create_publisher("amcl_pose", message_type(_POSE), latch=True)
        cloud = message_type("geometry_msgs/msg/PoseArray")
        self._cloud = node.create_publisher("particlecloud", cloud, latch=True)
        odometry = "nav_msgs/msg/Odometry"
        node.create_subscription(
            "base_pose_ground_truth", odometry, self._on_truth, queue_size=_WAITING
        )
        node.create_subscription("initialpose", _POSE, self._on_initial_pose, queue_size=1)

    def _on_truth(self, message: Any) -> None:
        with self._lock:
            for one, T_odom_base in self._waiting.add(message):
                self._publish(one, T_odom_base)

    def _placed(self, message: Any) -> tuple[Any, Pose]:
        buffer, stamp_ns = self._frames.buffer, ns_of(message.header.stamp)
        return message, buffer.lookup_transform(self._odom, self._base, stamp_ns).pose

    def _tell(self, _message: Any, why: TransformError) -> None:
        text = f"Failed to transform to {self._odom} from {self._base}: {why}"
        self._frames.say("error", text, key="odometry")

    def _publish(self, message: Any, T_odom_base: Pose) -> None:
        T_map_base = self._T_map_world @ unit_pose_of(message.pose.pose)
        stamp_ns = ns_of(message.header.stamp) + self._ahead_ns
        T_map_odom = T_map_base @ T_odom_base.inverse()
        self._tf.send(StampedPose(self._map, self._odom, stamp_ns, T_map_odom))
        pose: Any = message_type(_POSE)()
        pose.header.stamp, pose.header.frame_id = message.header.stamp, self._shown_frame
        set_pose(pose.pose.pose, T_map_base)
        self._poses.publish(pose)
        cloud: Any = message_type("geometry_msgs/msg/PoseArray")()
        cloud.header, cloud.poses = pose.header, [pose.pose.pose]
        self._cloud.publish(cloud)

    def _on_initial_pose(self, message: Any) -> None:
        frame = str(message.header.frame_id)
        if frame.removeprefix("/") != self._map:
            text = f'Frame ID of "initialpose" ({frame}) is different from the global frame '
            self._frames.say("warn", f"{text}{self._shown_frame}")
        T_base_map = self._frames.between(self._base, self._map)
        if isinstance(T_base_map, str):
            self._frames.say("warn", f"Failed to lookup transform! ({T_base_map})")
            return
        with self._lock:
            moved = unit_pose_of(message.pose.pose) @ T_base_map
            self._T_map_world = moved @ self._T_map_world
