"""Odometry as drive plug-ins publish it, from the true pose or from wheels."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine import JointHandle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_message, transform_stamped, twist_message
from gazelle.interfaces.stamps import header
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.drive import gz_text, gz_topic
from gazelle.simulator.plugins.plugin_parameters import PluginReader

__all__ = [
    "UNMEASURED",
    "DriveOdometry",
    "OdometrySetup",
    "body_velocity",
    "frame_prefix",
    "given_covariance",
    "gz_odometry_setup",
    "planar_covariance",
    "turned_back",
    "wheel_transform",
]

UNMEASURED = 1e12
"""Variance by which Gazebo's plug-ins mark what they do not measure (z, roll, pitch)."""

Covariance = NDArray[np.float64]
Motion = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class OdometrySetup:
    """What a plug-in sends.

    Attributes:
        topic: absolute name of the odometry's topic, empty for none.
        sends_tf: whether it sends odom → base.
        frame: ``header.frame_id``.
        child_frame: ``child_frame_id``.
        pose_covariance, twist_covariance: (36,).
        is_flat: the message's pose has no height, as that of some plug-ins.
        tf_topic: where transforms go.
        is_odometry_first: odometry goes before the transform, as gz-sim's does.
    """

    topic: str
    sends_tf: bool
    frame: str
    child_frame: str
    pose_covariance: Covariance = field(default_factory=lambda: np.zeros(36))
    twist_covariance: Covariance = field(default_factory=lambda: np.zeros(36))
    is_flat: bool = False
    tf_topic: str = "/tf"
    is_odometry_first: bool = False


class DriveOdometry:
    """Publishes ``nav_msgs/Odometry`` and odom → base of a model."""

    def __init__(
        self,
        context: PluginContext,
        setup: OdometrySetup,
        wheels: Callable[[], list[Any]] | None = None,
    ) -> None:
        """Offer the topics.

        Args:
            context: of the plug-in.
            setup: what is sent.
            wheels: returns transforms that go along with odom → base.
        """
        self._context = context
        self._engine = context.host.engine
        self._setup = setup
        self._wheels = wheels
        resources = context.resources
        self._odometry = (
            resources.publisher(setup.topic, "nav_msgs/Odometry") if setup.topic else None
        )
        sends_tf = setup.sends_tf or wheels is not None
        self._tf = resources.publisher(setup.tf_topic, "tf2_msgs/TFMessage") if sends_tf else None

    @property
    def matched(self) -> bool:
        """True when somebody listens to either."""
        return any(port is not None and port.matched for port in (self._odometry, self._tf))

    def publish(self, pose: Pose | None = None, motion: Motion | None = None) -> None:
        """Send both to those who listen.

        Args:
            pose: in the odometry frame; the model's true pose when None.
            motion: forward and sideways speed and yaw rate; the true ones when None.
        """
        if not self.matched:
            return
        if pose is None:
            pose = self._engine.model_pose(self._context.model.name)
        if self._setup.is_odometry_first:
            self._publish_odometry(pose, motion)
            self._publish_tf(pose)
        else:
            self._publish_tf(pose)
            self._publish_odometry(pose, motion)

    def _publish_tf(self, pose: Pose) -> None:
        if self._tf is None or not self._tf.matched:
            return
        setup, time_ns = self._setup, self._engine.time_ns
        transforms = []
        if setup.sends_tf:
            transforms.append(transform_stamped(time_ns, setup.frame, setup.child_frame, pose))
        if self._wheels is not None:
            transforms += self._wheels()
        self._tf.publish(message_type("tf2_msgs/TFMessage")(transforms=transforms))

    def _publish_odometry(self, pose: Pose, motion: Motion | None) -> None:
        if self._odometry is None or not self._odometry.matched:
            return
        setup = self._setup
        forward, sideways, turn = motion or body_velocity(self._context)
        message = message_type("nav_msgs/Odometry")(
            header=header(self._engine.time_ns, setup.frame), child_frame_id=setup.child_frame
        )
        if setup.is_flat:
            pose = Pose((pose.position_m[0], pose.position_m[1], 0.0), pose.quat_xyzw)
        message.pose.pose = pose_message(pose)
        message.pose.covariance = setup.pose_covariance
        message.twist.twist = twist_message((forward, sideways, 0.0), (0.0, 0.0, turn))
        message.twist.covariance = setup.twist_covariance
        self._odometry.publish(message)


def body_velocity(context: PluginContext) -> Motion:
    """Return forward and sideways speed and yaw rate of a model, turned by its yaw only."""
    engine, name = context.host.engine, context.model.name
    linear, angular = engine.model_velocity(name)
    forward, sideways = turned_back(
        float(linear[0]), float(linear[1]), engine.model_pose(name).rpy_rad[2]
    )
    return forward, sideways, float(angular[2])


def turned_back(x: float, y: float, yaw_rad: float) -> tuple[float, float]:
    """Return a vector of the ground plane in axes that are turned by a yaw."""
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    return cos * x + sin * y, cos * y - sin * x


def planar_covariance(x: float, y: float, yaw: float) -> Covariance:
    """Return a covariance (36,) of motion in the plane; the rest is marked as not measured."""
    covariance = np.zeros(36)
    covariance[[14, 21, 28]] = UNMEASURED
    covariance[[0, 7, 35]] = x, y, yaw
    return covariance


def given_covariance(parameters: PluginReader) -> Covariance:
    """Return the covariance that ``covariance_x``, ``_y`` and ``_yaw`` say."""
    x, y, yaw = (parameters.number(f"covariance_{axis}") for axis in ("x", "y", "yaw"))
    return planar_covariance(x, y, yaw)


def frame_prefix(context: PluginContext, parameters: PluginReader) -> str:
    """Return what ``tf_prefix`` puts before frames, ending in a slash, or nothing."""
    prefix = context.tf_prefix(context.namespace(parameters)).strip("/")
    return f"{prefix}/" if prefix else ""


def gz_odometry_setup(context: PluginContext, parameters: PluginReader) -> OdometrySetup:
    """Return what the new Gazebo's drives send, by their keys; they know no covariance."""
    return OdometrySetup(
        gz_topic(context, parameters, "odom_topic"),
        True,
        gz_text(context, parameters, "frame_id"),
        gz_text(context, parameters, "child_frame_id"),
        tf_topic=gz_topic(context, parameters, "tf_topic"),
        is_odometry_first=True,
    )


def wheel_transform(context: PluginContext, joint: JointHandle, parent: str, child: str) -> Any:
    """Return where a joint's child link is on its parent link, under these frames."""
    engine, model = context.host.engine, context.model.name
    ends = (joint.joint.parent, joint.joint.child)
    T_world_parent, T_world_child = (engine.link(f"{model}::{end}").T_world_link() for end in ends)
    T_parent_child = T_world_parent.inverse() @ T_world_child
    return transform_stamped(engine.time_ns, parent, child, T_parent_child)
