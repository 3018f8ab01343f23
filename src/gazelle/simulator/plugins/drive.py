"""How drive plug-ins are told to drive, run and end."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, NamedTuple

from gazelle.engine import JointHandle
from gazelle.parameters import Parameter, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.plugin_parameters import PluginReader

__all__ = [
    "ALWAYS_ON",
    "COMMAND_TOPIC",
    "DEBUG_LEVEL",
    "GZ_COMMANDS",
    "GZ_NO_JERK",
    "GZ_ODOMETRY",
    "GZ_RATE",
    "GZ_SEPARATION",
    "GZ_SIDES",
    "GZ_TOPICS",
    "GZ_WHEEL_RADIUS",
    "UPDATE_RATE",
    "WHEEL_TF",
    "Velocity",
    "covariances",
    "frames",
    "gz_text",
    "gz_topic",
    "needed_joints",
    "odometry_topics",
    "run_drive",
    "take_velocities",
    "topics",
]


ALWAYS_ON = Parameter("alwaysOn", "refused", "", "a model plug-in always runs")

DEBUG_LEVEL = Parameter("rosDebugLevel", "refused", "", "Gazebo's logging level")

UPDATE_RATE = Parameter(
    "updateRate", "number", 100.0, "update and publish rate", "Hz", aliases=("update_rate",)
)

WHEEL_TF = Parameter(
    "publishWheelTF", "flag", False, "publish wheel transforms", "", aliases=("publish_wheel_tf",)
)

COMMAND_TOPIC = Topic("{commandTopic}", "geometry_msgs/msg/Twist", kind="listens", ros2="cmd_vel")

GZ_COMMANDS = Topic("{topic}", "geometry_msgs/msg/Twist", kind="listens")

GZ_ODOMETRY = (
    Parameter("odom_topic", "text", "/model/{model}/odometry", "odometry"),
    Parameter("tf_topic", "text", "/model/{model}/tf", "odom → base"),
    Parameter("frame_id", "text", "{model}/odom", "frame of the odometry"),
    Parameter("child_frame_id", "text", "{model}/{link}", "child frame"),
)

GZ_SIDES = (
    Parameter("left_joint", "text", "", "left wheels' joints, repeatable"),
    Parameter("right_joint", "text", "", "right wheels' joints, repeatable"),
)

GZ_SEPARATION = Parameter("wheel_separation", "number", 1.0, "distance of the wheels", "m")

GZ_WHEEL_RADIUS = Parameter("wheel_radius", "number", 0.2, "radius of the wheels", "m")

GZ_RATE = Parameter("odom_publish_frequency", "number", 50.0, "publish rate", "Hz")

GZ_NO_JERK = (
    Parameter("min_jerk", "refused", "", "jerk is not limited"),
    Parameter("max_jerk", "refused", "", "jerk is not limited"),
)

GZ_TOPICS = tuple(
    Topic(name, type_name, rate="`odom_publish_frequency`", frame="`frame_id`")
    for name, type_name in (
        ("{odom_topic}", "nav_msgs/msg/Odometry"),
        ("{tf_topic}", "tf2_msgs/msg/TFMessage"),
    )
)


def topics(*, in_ros2: bool = True, has_aliases: bool = False) -> tuple[Parameter, ...]:
    """Return the rows of namespace and topics, which ROS 2 says by remaps.

    Args:
        in_ros2: whether there is such a plug-in of ROS 2.
        has_aliases: whether the topics have names in ROS 2's style as well.
    """
    ros_versions = (1,) if in_ros2 else (1, 2)
    command, odometry = (("command_topic",), ("odometry_topic",)) if has_aliases else ((), ())
    return (
        Parameter(
            "robotNamespace", "text", "", "namespace of all topics", ros_versions=ros_versions
        ),
        Parameter(
            "commandTopic", "text", "cmd_vel", "commands",
            aliases=command, ros_versions=ros_versions,
        ),
        Parameter(
            "odometryTopic", "text", "odom", "odometry",
            aliases=odometry, ros_versions=ros_versions,
        ),
    )  # fmt: skip


def frames(base: str, *, in_ros2: bool = True) -> tuple[Parameter, ...]:
    """Return the rows of odometry's frame and of the robot's, which is `base` by default."""
    odometry, robot = (("odometry_frame",), ("robot_base_frame",)) if in_ros2 else ((), ())
    return (
        Parameter("odometryFrame", "text", "odom", "its frame", aliases=odometry),
        Parameter("robotBaseFrame", "text", base, "child frame", aliases=robot),
    )


def covariances(
    place: float, yaw: float, about: str = "covariance {}", ros_versions: tuple[int, ...] = (1, 2)
) -> tuple[Parameter, ...]:
    """Return the rows of odometry's covariances, m² and rad²."""
    return tuple(
        Parameter(
            f"covariance_{axis}", "number", default, about.format(axis), unit,
            ros_versions=ros_versions,
        )
        for axis, default, unit in (("x", place, "m²"), ("y", place, "m²"), ("yaw", yaw, "rad²"))
    )  # fmt: skip


def odometry_topics(
    rate: str, *, ros2: str = "odom", tf_frame: str = "`odometryFrame`"
) -> tuple[Topic, Topic]:
    """Return odometry and transforms, at the rate that a key says.

    Args:
        rate: the key.
        ros2: the odometry's name in ROS 2, empty where there is none.
        tf_frame: of transforms, in words.
    """
    return (
        Topic(
            "{odometryTopic}", "nav_msgs/msg/Odometry",
            rate=f"`{rate}`", frame="`odometryFrame`", ros2=ros2,
        ),
        Topic("/tf", "tf2_msgs/msg/TFMessage", rate=f"`{rate}`", frame=tf_frame),
    )  # fmt: skip


class Velocity(NamedTuple):
    """A command.

    Attributes:
        forward, sideways: m/s.
        turn: rad/s; an angle for what is steered.
    """

    forward: float = 0.0
    sideways: float = 0.0
    turn: float = 0.0


def needed_joints(
    context: PluginContext, parameters: PluginReader, keys: Iterable[str]
) -> dict[str, str] | None:
    """Return the joints of some keys, ``model::joint``; None when one is missing, reported."""
    found = {key: context.joint_name(parameters.text(key)) for key in keys}
    names = {key: name for key, name in found.items() if name is not None}
    return names if len(names) == len(found) else None


def take_velocities(context: PluginContext, topic: str, take: Callable[[Velocity], None]) -> None:
    """Listen to commands; a topic takes ``Twist`` and ``TwistStamped``."""

    def hear(message: Any) -> None:
        twist = getattr(message, "twist", message)
        linear = twist.linear
        take(Velocity(float(linear.x), float(linear.y), float(twist.angular.z)))

    context.resources.subscription(topic, None, hear, announced="geometry_msgs/msg/Twist")


def run_drive(
    context: PluginContext,
    joints: Iterable[JointHandle],
    period: Fraction,
    update: Callable[[], None],
    reset: Callable[[], None],
) -> None:
    """Update a drive every so many steps until it is closed, which lets its joints go."""
    moved = tuple(joints)

    def release() -> None:
        for joint in moved:
            joint.release()

    context.resources.task(f"{context.plugin.name} drive", period, update)
    context.resources.on_reset(reset)
    context.resources.on_close(release)


def gz_text(context: PluginContext, parameters: PluginReader, key: str) -> str:
    """Return a name of the new Gazebo's, in which a table says ``{model}`` and ``{link}``."""
    text, model = parameters.text(key), context.model
    return text.replace("{model}", model.name).replace("{link}", model.canonical_link)


def gz_topic(context: PluginContext, parameters: PluginReader, key: str) -> str:
    """Return a topic of the new Gazebo's: absolute, whatever the namespace."""
    return join_names("/", gz_text(context, parameters, key))
