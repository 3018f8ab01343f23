"""ROS 2's imu_sensor_broadcaster."""

from __future__ import annotations

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.sensor_messages import IMU_INTERFACES, fill_imu, sensor_indices
from gazelle.control.interface_values import Array
from gazelle.geometry import Pose, quat_xyzw_from_rpy
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["ImuSensorBroadcaster"]

_PARTS = ("orientation", "angular_velocity", "linear_acceleration")
_AXES = ("roll", "pitch", "yaw")
_ZERO = (0.0,) * 9


class ImuSensorBroadcaster(Controller):
    """Publishes one IMU at every update."""

    TABLE = ControllerTable(
        ParameterTable(
            "imu_sensor_broadcaster",
            "Publishes one IMU.",
            ("imu_sensor_broadcaster/IMUSensorBroadcaster",),
            (
                Parameter("sensor_name", "text", None, "the sensor; required"),
                Parameter("frame_id", "text", None, "frame of the message; required"),
                *(
                    Parameter(
                        f"static_covariance_{part}", "numbers", _ZERO, "nine values, row by row"
                    )
                    for part in _PARTS
                ),
                *(
                    Parameter(f"rotation_offset.{axis}", "number", 0.0, "of the frame", "rad")
                    for axis in _AXES
                ),
            ),
        ),
        interfaces="claims none; reads orientation, angular velocity and linear"
        " acceleration of the sensor",
        topics=(Topic("~/imu", "sensor_msgs/Imu", rate="every update", frame="frame_id"),),
        behaviour=(
            "rotation_offset turns rates and accelerations and their covariances, and takes itself "
            "off the orientation (imu_transform.hpp).",
            "What the IMU does not measure is 0, its covariance begins with -1.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensor."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("sensor_name")
        parameters.require("frame_id")
        sensor, self._frame_id = parameters.text("sensor_name"), parameters.text("frame_id")
        self.states = tuple(f"{sensor}/{word}" for word in IMU_INTERFACES)
        self._indices = sensor_indices(context, sensor, IMU_INTERFACES)
        roll, pitch, yaw = (parameters.number(f"rotation_offset.{axis}") for axis in _AXES)
        self._offset: Pose | None = None
        if roll or pitch or yaw:
            self._offset = Pose(quat_xyzw=quat_xyzw_from_rpy((roll, pitch, yaw)))
        self._covariances = [self._covariance(part) for part in _PARTS]
        self._publisher = context.ports.publisher("~/imu", "sensor_msgs/Imu")

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish if somebody listens."""
        if not self._publisher.matched:
            return
        message = stamped("sensor_msgs/Imu", time_ns, self._frame_id)
        for part, covariance in zip(_PARTS, self._covariances, strict=True):
            setattr(message, f"{part}_covariance", covariance.copy())
        values = self.robot.interface_values.states[self._indices]
        fill_imu(message, values if self._offset is None else _turned(values, self._offset))
        self._publisher.publish(message)

    def _covariance(self, part: str) -> Array:
        key = f"static_covariance_{part}"
        values = np.array(self.context.parameters.numbers(key))
        if len(values) != len(_ZERO):
            text = f"'{key}' has {len(values)} values, not 9; zeros are used"
            self.context.parameters.report("parameter.bad-value", text, key=key)
            return np.zeros(len(_ZERO))
        if self._offset is None or part == "orientation":
            return values
        turn = self._offset.matrix()[:3, :3]
        return np.asarray(turn @ values.reshape(3, 3) @ turn.T, dtype=np.float64).ravel()


def _turned(values: Array, offset: Pose) -> Array:
    turn = offset.matrix()[:3, :3]
    result = values.copy()
    if not np.isnan(values[:4]).any():
        x, y, z, w = values[:4].tolist()
        result[:4] = (Pose(quat_xyzw=(x, y, z, w)) @ offset.inverse()).quat_xyzw
    result[4:7], result[7:10] = turn @ values[4:7], turn @ values[7:10]
    return result
