"""Topics, joint states and transforms of built-in nodes that do one thing each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from gazelle.doctor.launch.launched import Launched, LaunchedNode

__all__ = ["BuiltinTopics", "builtin_topics"]

_TWIST = "geometry_msgs/msg/Twist"
_ODOMETRY = "nav_msgs/msg/Odometry"
_IMU = "sensor_msgs/msg/Imu"
_POSE = "turtlesim/msg/Pose"
_TF = "tf2_msgs/msg/TFMessage"


@dataclass(frozen=True, slots=True)
class BuiltinTopics:
    """What one node has, by the names of its code.

    Attributes:
        publishes, listens: types by topic.
        other_names: services and namespaces that can be remapped too.
        transforms: parent and child of each it sends.
        joints: whose states it sends.
        is_complete: there are no further topics.
    """

    publishes: Mapping[str, str] = field(default_factory=dict)
    listens: Mapping[str, str] = field(default_factory=dict)
    other_names: tuple[str, ...] = ()
    transforms: tuple[tuple[str, str], ...] = ()
    joints: tuple[str, ...] = ()
    is_complete: bool = True


def builtin_topics(node: LaunchedNode, launched: Launched) -> BuiltinTopics | None:
    """Return what a built-in node has; None when that is not known here."""
    builtin = node.executable.builtin if node.executable is not None else None
    if builtin is None:
        return None
    name = (builtin.package, builtin.executable)
    if name in _COMPUTED:
        return _COMPUTED[name](node, launched)
    return _FIXED.get(name)


_DRIVING = BuiltinTopics({"cmd_vel": _TWIST})
_FIXED = {
    ("turtlesim", "turtlesim_node"): BuiltinTopics(
        {"turtle1/pose": _POSE, "turtle1/color_sensor": "turtlesim/msg/Color"},
        {"turtle1/cmd_vel": _TWIST},
        # More turtles can be spawned.
        is_complete=False,
    ),
    ("turtlesim", "turtle_teleop_key"): BuiltinTopics({"turtle1/cmd_vel": _TWIST}),
    ("turtlesim", "draw_square"): BuiltinTopics(
        {"turtle1/cmd_vel": _TWIST}, {"turtle1/pose": _POSE}, ("reset",)
    ),
    ("turtlebot3_slam", "flat_world_imu_node"): BuiltinTopics({"imu_out": _IMU}, {"imu_in": _IMU}),
    ("turtlebot3_teleop", "turtlebot3_teleop_key"): _DRIVING,
    ("turtlebot3_teleop", "teleop_keyboard"): _DRIVING,
    ("teleop_twist_keyboard", "teleop_twist_keyboard"): _DRIVING,
}


def _mimic(node: LaunchedNode, _launched: Launched) -> BuiltinTopics:
    source, target = node.resolve("input"), node.resolve("output")
    names = ("input", "output", "input/pose", "output/cmd_vel")
    return BuiltinTopics({f"{target}/cmd_vel": _TWIST}, {f"{source}/pose": _POSE}, names)


def _twist_keyboard(node: LaunchedNode, launched: Launched) -> BuiltinTopics:
    is_stamped = bool(launched.private(node, "stamped", False))
    return BuiltinTopics({"cmd_vel": "geometry_msgs/msg/TwistStamped" if is_stamped else _TWIST})


def _drive(node: LaunchedNode, launched: Launched) -> BuiltinTopics:
    topic = _parameter(node, launched, "cmd_vel_topic_name", "cmd_vel")
    return BuiltinTopics({topic: _TWIST}, {"scan": "sensor_msgs/msg/LaserScan", "odom": _ODOMETRY})


def _fake(node: LaunchedNode, launched: Launched) -> BuiltinTopics:
    def name(key: str, default: str) -> str:
        return _parameter(node, launched, key, default)

    return BuiltinTopics(
        {"odom": _ODOMETRY, "joint_states": "sensor_msgs/msg/JointState", "/tf": _TF},
        {"cmd_vel": _TWIST},
        transforms=((name("odom_frame", "odom"), name("base_frame", "base_footprint")),),
        joints=(
            name("wheel_left_joint_name", "wheel_left_joint"),
            name("wheel_right_joint_name", "wheel_right_joint"),
        ),
    )


_COMPUTED: dict[tuple[str, str], Callable[[LaunchedNode, Launched], BuiltinTopics]] = {
    ("turtlesim", "mimic"): _mimic,
    ("turtlebot3_fake", "turtlebot3_fake_node"): _fake,
    ("turtlebot3_gazebo", "turtlebot3_drive"): _drive,
    ("teleop_twist_keyboard", "teleop_twist_keyboard.py"): _twist_keyboard,
}


def _parameter(node: LaunchedNode, launched: Launched, name: str, default: str) -> str:
    """Return a parameter of the node's namespace."""
    full = node.resolve(name)
    return str(launched.parameters.get(full)) if launched.parameters.has(full) else default
