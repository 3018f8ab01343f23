"""ROS 2's pose_broadcaster."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.sensor_messages import (
    POSE_INTERFACES,
    sensor_indices,
)
from gazelle.control.interface_values import Array
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose, set_transform
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["PoseBroadcaster"]

_UNIT_TOLERANCE = 10e-3
_SAY_EVERY_NS = 1_000_000_000


class PoseBroadcaster(Controller):
    """Publishes one pose at every update, as message and as transform."""

    TABLE = ControllerTable(
        ParameterTable(
            "pose_broadcaster",
            "Publishes one pose, such as a tracker measures it, and its transform.",
            ("pose_broadcaster/PoseBroadcaster",),
            (
                Parameter("pose_name", "text", None, "the sensor; required"),
                Parameter("frame_id", "text", None, "frame of the message; required"),
                Parameter("tf.enable", "flag", True, "publish the transform"),
                Parameter("tf.child_frame_id", "text", "", "child frame; pose_name if empty"),
                Parameter("tf.publish_rate", "number", 0.0, "of transforms at most; 0: all", "Hz"),
            ),
        ),
        interfaces="claims none; reads position and orientation of the sensor",
        topics=(
            Topic("~/pose", "geometry_msgs/PoseStamped", rate="every update", frame="frame_id"),
            Topic("/tf", "tf2_msgs/TFMessage", rate="every update", frame="frame_id"),
        ),
        behaviour=(
            "A pose that is no number, or whose quaternion is not of length 1, has no transform "
            "(pose_broadcaster.cpp).",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensor."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("pose_name")
        parameters.require("frame_id")
        name, self._frame_id = parameters.text("pose_name"), parameters.text("frame_id")
        self.states = tuple(f"{name}/{word}" for word in POSE_INTERFACES)
        self._indices = sensor_indices(context, name, POSE_INTERFACES)
        self._child_frame_id = parameters.text("tf.child_frame_id") or name
        rate_hz = parameters.number("tf.publish_rate")
        self._tf_period_ns = round(1e9 / rate_hz) if rate_hz > 0.0 else 0
        self._next_tf_ns = self._next_word_ns = 0
        self._publisher = context.ports.publisher("~/pose", "geometry_msgs/PoseStamped")
        self._tf = None
        if parameters.flag("tf.enable"):
            self._tf = context.ports.publisher("/tf", "tf2_msgs/TFMessage")

    def start(self, time_ns: int) -> None:
        """Begin at once."""
        self._next_tf_ns = self._next_word_ns = time_ns

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish what somebody listens to."""
        values = self.robot.interface_values.states[self._indices]
        if self._publisher.matched:
            message = stamped("geometry_msgs/PoseStamped", time_ns, self._frame_id)
            set_pose(message.pose, _pose(values))
            self._publisher.publish(message)
        if not _is_valid(values):
            self._complain(time_ns, values)
        elif self._tf is not None and time_ns >= self._next_tf_ns:
            self._next_tf_ns = time_ns + self._tf_period_ns
            if self._tf.matched:
                self._tf.publish(self._transform(time_ns, values))

    def _transform(self, time_ns: int, values: Array) -> Any:
        message = stamped("geometry_msgs/TransformStamped", time_ns, self._frame_id)
        message.child_frame_id = self._child_frame_id
        set_transform(message.transform, _pose(values))
        return message_type("tf2_msgs/TFMessage")(transforms=[message])

    def _complain(self, time_ns: int, values: Array) -> None:
        if time_ns < self._next_word_ns:
            return
        self._next_word_ns = time_ns + _SAY_EVERY_NS
        text = f"Invalid pose {np.array2string(values[:3])}, {np.array2string(values[3:])}"
        self.context.ports.log("error", f"{self.context.name}: {text}")


def _pose(values: Array) -> Pose:
    x, y, z, qx, qy, qz, qw = values.tolist()
    return Pose((x, y, z), (qx, qy, qz, qw))


def _is_valid(values: Array) -> bool:
    length2 = float(values[3:] @ values[3:])
    return bool(np.isfinite(values).all()) and abs(length2 - 1.0) <= _UNIT_TOLERANCE
