"""Odometry of a whole robot from its true pose, as several drive plug-ins publish it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.simulator.messages import (
    header,
    message_class,
    pose_message,
    transform_stamped,
    twist_message,
)
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.parameters import PluginReader

__all__ = [
    "UNMEASURED",
    "BodyOdometry",
    "OdometrySetup",
    "body_velocity",
    "frame_prefix",
    "planar_covariance",
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
        sends_tf: whether it sends odom → base on ``/tf``.
        frame: ``header.frame_id``.
        child_frame: ``child_frame_id``.
        pose_covariance, twist_covariance: (36,).
        is_flat: the message's pose has no height, as that of some plug-ins.
    """

    topic: str
    sends_tf: bool
    frame: str
    child_frame: str
    pose_covariance: Covariance
    twist_covariance: Covariance
    is_flat: bool = False


class BodyOdometry:
    """Publishes ``nav_msgs/Odometry`` and odom → base of a model."""

    def __init__(self, context: PluginContext, setup: OdometrySetup) -> None:
        self._context = context
        self._engine = context.host.engine
        self._setup = setup
        resources = context.resources
        self._odometry = (
            resources.publisher(setup.topic, "nav_msgs/Odometry") if setup.topic else None
        )
        self._tf = resources.publisher("/tf", "tf2_msgs/TFMessage") if setup.sends_tf else None

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
        name, setup, time_ns = self._context.model.name, self._setup, self._engine.time_ns
        if pose is None:
            pose = self._engine.model_pose(name)
        if self._tf is not None and self._tf.matched:
            transform = transform_stamped(time_ns, setup.frame, setup.child_frame, pose)
            self._tf.publish(message_class("tf2_msgs/TFMessage")(transforms=[transform]))
        if self._odometry is not None and self._odometry.matched:
            self._publish_odometry(pose, motion or body_velocity(self._context))

    def _publish_odometry(self, pose: Pose, motion: Motion) -> None:
        setup = self._setup
        message = message_class("nav_msgs/Odometry")(
            header=header(self._engine.time_ns, setup.frame), child_frame_id=setup.child_frame
        )
        if setup.is_flat:
            pose = Pose((pose.position_m[0], pose.position_m[1], 0.0), pose.quat_xyzw)
        message.pose.pose = pose_message(pose)
        message.pose.covariance = setup.pose_covariance
        message.twist.twist = twist_message((motion[0], motion[1], 0.0), (0.0, 0.0, motion[2]))
        message.twist.covariance = setup.twist_covariance
        assert self._odometry is not None
        self._odometry.publish(message)


def body_velocity(context: PluginContext) -> Motion:
    """Return forward and sideways speed and yaw rate of a model, turned by its yaw only."""
    engine, name = context.host.engine, context.model.name
    linear, angular = engine.model_velocity(name)
    yaw = engine.model_pose(name).rpy_rad[2]
    cos, sin = math.cos(yaw), math.sin(yaw)
    vx, vy = float(linear[0]), float(linear[1])
    return cos * vx + sin * vy, cos * vy - sin * vx, float(angular[2])


def planar_covariance(x: float, y: float, yaw: float) -> Covariance:
    """Return a covariance (36,) of motion in the plane; the rest is marked as not measured."""
    covariance = np.zeros(36)
    covariance[[14, 21, 28]] = UNMEASURED
    covariance[[0, 7, 35]] = x, y, yaw
    return covariance


def frame_prefix(context: PluginContext, parameters: PluginReader) -> str:
    """Return what ``tf_prefix`` puts before frames, ending in a slash, or nothing."""
    prefix = context.tf_prefix(context.namespace(parameters)).strip("/")
    return f"{prefix}/" if prefix else ""
