"""Publishes odometry: ``nav_msgs/Odometry`` and the transform odom → base."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.wheels.odometry import PlanarOdometry, PlanarPose
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose, set_transform
from gazelle.interfaces.stamps import header
from gazelle.parameters.reader import ParameterReader

__all__ = ["Frames", "OdometryOutput", "PublishRate", "read_covariance", "read_frames"]

_DIAGONAL = np.arange(6) * 7


class Frames(NamedTuple):
    """Names of the two frames, with their prefix."""

    odom: str
    base: str


def read_frames(context: ControllerContext, *, namespace_prefix: bool) -> Frames:
    """Read the frames' names and prefix them as ros2_controllers do.

    Args:
        context: of the controller.
        namespace_prefix: without ``tf_frame_prefix`` the namespace is the prefix, as it is in
            diff_drive, mecanum and omni_wheel_drive_controller; steering controllers have none.
    """
    parameters = context.parameters
    names = parameters.text("odom_frame_id"), parameters.text("base_frame_id")
    if context.ros_version == 1:
        return Frames(*names)
    prefix = parameters.text("tf_frame_prefix")
    if namespace_prefix and not parameters.flag("tf_frame_prefix_enable"):
        prefix = ""
    elif not prefix:
        prefix = context.namespace if namespace_prefix else ""
    prefix = prefix.replace("~", context.namespace).strip("/")
    return Frames(*(f"{prefix}/{name}" if prefix else name for name in names))


def read_covariance(
    parameters: ParameterReader, key: str, default: tuple[float, ...] = ()
) -> Array:
    """Read a diagonal of six variances as a covariance (36,).

    Args:
        parameters: of the controller.
        key: the parameter.
        default: the original's default, empty when it has none.

    Raises:
        ControllerError: there are not six.
    """
    covariance = np.zeros(36)
    diagonal = parameters.numbers(key) or default
    if not diagonal:
        text = f"no {key}; zeros are used. ROS 1's controllers stop the whole program here"
        parameters.report("control.no-covariance", text, fix=f"give {key}: six variances")
        return covariance
    if len(diagonal) != 6:
        text = f"controller '{parameters.name}': {key} has {len(diagonal)} values, not 6"
        raise ControllerError(text)
    covariance[_DIAGONAL] = diagonal
    return covariance


class PublishRate:
    """Tells when to publish: in the mean at a rate, as ros_controllers do.

    A period must have passed since the last *due* time, so 50 Hz in steps of 1 ms come 21, 41,
    61 ms after the start.
    """

    def __init__(self, rate_hz: float | None) -> None:
        self.period_ns = 0
        self._due_ns = 0
        self.set_rate(rate_hz)

    def set_rate(self, rate_hz: float | None) -> None:
        """Change the rate; None means at every update, 0 never."""
        never = 1 << 62
        self.period_ns = 0 if rate_hz is None else round(1e9 / rate_hz) if rate_hz > 0 else never

    def start(self, time_ns: int) -> None:
        """Count from now."""
        self._due_ns = time_ns

    def is_due(self, time_ns: int) -> bool:
        """Tell whether to publish at an update; asked once for each."""
        if self.period_ns == 0:
            return True
        if self._due_ns + self.period_ns >= time_ns:
            return False
        self._due_ns += self.period_ns
        return True


class OdometryOutput:
    """Sends odometry while somebody listens.

    Args:
        context: of the controller.
        frames: see `read_frames`.
        odom_topic, tf_topic: where to.
        rate_hz: how often, None for every update.
        covariances: of pose and twist (36,); read from the parameters when None.
    """

    def __init__(
        self,
        context: ControllerContext,
        frames: Frames,
        *,
        odom_topic: str = "~/odom",
        tf_topic: str = "/tf",
        rate_hz: float | None = None,
        covariances: tuple[Array, Array] | None = None,
    ) -> None:
        parameters = context.parameters
        self.frames = frames
        self.sends_tf = parameters.flag("enable_odom_tf")
        self.sends_pose = True
        self.rate = PublishRate(rate_hz)
        self._last_ns = 0
        default = () if context.ros_version == 1 else (0.0,) * 6
        self._covariances = covariances or (
            read_covariance(parameters, "pose_covariance_diagonal", default),
            read_covariance(parameters, "twist_covariance_diagonal", default),
        )
        self._odom = context.ports.publisher(odom_topic, "nav_msgs/Odometry")
        self._tf = context.ports.publisher(tf_topic, "tf2_msgs/TFMessage")

    def start(self, time_ns: int, odometry: PlanarOdometry) -> None:
        """Begin new means; after time went back, as a reset makes it, at the origin."""
        odometry.forget_velocities()
        if time_ns < self._last_ns:
            odometry.put(PlanarPose())
        self._last_ns = time_ns
        self.rate.start(time_ns)

    def publish(self, time_ns: int, odometry: PlanarOdometry) -> None:
        """Publish when it is due and somebody listens."""
        self._last_ns = time_ns
        if not self.rate.is_due(time_ns):
            return
        if self._odom.matched:
            self._odom.publish(self._message(time_ns, odometry))
        if self.sends_tf and self._tf.matched:
            self._tf.publish(self._transform(time_ns, odometry))

    def changed(self, values: Mapping[str, Any]) -> None:
        """Take over whether to send tf, if that is among the changed parameters."""
        if "enable_odom_tf" in values:
            self.sends_tf = bool(values["enable_odom_tf"])

    def _message(self, time_ns: int, odometry: PlanarOdometry) -> Any:
        message = message_type("nav_msgs/Odometry")(
            header=header(time_ns, self.frames.odom), child_frame_id=self.frames.base
        )
        if self.sends_pose:
            set_plane_pose(message.pose.pose, odometry.pose)
        message.twist.twist.linear.x = odometry.linear_x
        message.twist.twist.linear.y = odometry.linear_y
        message.twist.twist.angular.z = odometry.angular_z
        message.pose.covariance, message.twist.covariance = self._covariances
        return message

    def _transform(self, time_ns: int, odometry: PlanarOdometry) -> Any:
        transform = message_type("geometry_msgs/TransformStamped")(
            header=header(time_ns, self.frames.odom), child_frame_id=self.frames.base
        )
        set_transform(transform.transform, Pose.from_xy_yaw(*odometry.pose))
        return message_type("tf2_msgs/TFMessage")(transforms=[transform])
