"""``libgazebo_ros_hand_of_god``: a link that follows a frame of tf, ROS 1 and 2."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_of_transform, transform_stamped
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

__all__ = ["TABLE", "load"]

_ROOT = "world"
_MAX_DEPTH = 100

TABLE = PluginTable(
    ParameterTable(
        "hand_of_god",
        "Pulls a link to where the frame `{frame}_desired` is in tf, as a spring and damper.",
        ("gazebo_ros_hand_of_god",),
        (
            Parameter("robotNamespace", "refused", "", "tf is global"),
            Parameter("linkName", "text", "", "the link", "", aliases=("link_name",)),
            Parameter(
                "frameId",
                "text",
                "hog",
                "first part of both frames",
                "",
                aliases=("frame_id",),
                ros2_default=_ROOT,
            ),
            Parameter("kl", "number", 200.0, "stiffness", "N/m"),
            Parameter("ka", "number", 200.0, "turning stiffness", "N·m/rad"),
        ),
    ),
    topics=(
        Topic("/tf, /tf_static", "tf2_msgs/msg/TFMessage", kind="listens"),
        Topic("/tf", "tf2_msgs/msg/TFMessage", rate="every step", frame="`world`"),
    ),
    behaviour=(
        "Force kl · Δx − cl · v and torque ka · Δφ − ca · ω at every step, critically damped:"
        " cl = 2 √(kl m), ca = 2 √(ka Ixx).",
        "Gravity does not act on the link: its weight is added to the force.",
        "Where the link really is goes out as `{frame}_actual`. Nothing acts until the frame is"
        " known, directly or over others, from `world`.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start following; nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    name = context.link_name(parameters.text("linkName"))
    if name is not None:
        _Hand(context, parameters, name)
    parameters.report_unread()


class _Frames:
    """The last transform of every frame, by child."""

    def __init__(self) -> None:
        self._parents: dict[str, tuple[str, Pose]] = {}

    def take(self, message: Any) -> None:
        """Remember the transforms of a message."""
        for item in message.transforms:
            pose = pose_of_transform(item.transform)
            parent = item.header.frame_id.lstrip("/")
            self._parents[item.child_frame_id.lstrip("/")] = (parent, pose)

    def find(self, frame: str) -> Pose | None:
        """Return a frame's pose in the world, None while it is not known."""
        pose = Pose()
        for _ in range(_MAX_DEPTH):
            if frame == _ROOT:
                return pose
            if frame not in self._parents:
                return None
            frame, own = self._parents[frame]
            pose = own @ pose
        return None


class _Hand:
    """One running plug-in."""

    def __init__(self, context: PluginContext, parameters: PluginReader, link: str) -> None:
        self._engine = context.host.engine
        self._link = self._engine.link(link)
        default = _ROOT if parameters.is_ros2() else "hog"
        self._frame = parameters.text("frameId", default)
        self._stiffness = np.array([parameters.number("kl"), parameters.number("ka")])
        inertial = self._link.link.inertial
        inertia = inertial.inertia_kg_m2[0] if inertial is not None else 0.0
        self._mass_kg = self._link.mass_kg
        self._damping = 2.0 * np.sqrt(self._stiffness * [self._mass_kg, inertia])
        self._frames = _Frames()
        resources = context.resources
        for topic in ("/tf", "/tf_static"):
            resources.subscription(topic, "tf2_msgs/TFMessage", self._frames.take)
        self._tf = resources.publisher("/tf", "tf2_msgs/TFMessage")
        resources.task(f"{context.plugin.name} pull", Fraction(1), self._pull)

    def _pull(self) -> None:
        wanted = self._frames.find(f"{self._frame}_desired")
        if wanted is None:
            return
        pose, velocity = self._link.T_world_link(), self._link.velocity_world()
        gap = np.subtract(wanted.position_m, pose.position_m)
        turn = pose.rotate(_rotation_vector((pose.inverse() @ wanted).quat_xyzw))
        (kl, ka), (cl, ca) = self._stiffness, self._damping
        force = kl * gap - cl * velocity.linear_m_s
        force -= self._mass_kg * np.asarray(self._engine.gravity_m_s2)
        torque = ka * np.asarray(turn) - ca * velocity.angular_rad_s
        self._link.apply_wrench(force, torque, duration_ns=1)
        if self._tf.matched:
            transform = transform_stamped(
                self._engine.time_ns, _ROOT, f"{self._frame}_actual", pose
            )
            self._tf.publish(message_type("tf2_msgs/TFMessage")(transforms=[transform]))


def _rotation_vector(xyzw: tuple[float, float, float, float]) -> tuple[float, float, float]:
    """Return half the rotation vector: Gazebo takes the quaternion's logarithm as the error."""
    sign = -1.0 if xyzw[3] < 0 else 1.0
    vector = sign * np.asarray(xyzw[:3])
    length = float(np.linalg.norm(vector))
    if length < 1e-12:
        return (0.0, 0.0, 0.0)
    angle = float(np.arctan2(length, sign * xyzw[3]))
    x, y, z = (vector / length * angle).tolist()
    return (x, y, z)
