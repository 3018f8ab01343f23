"""ROS 1's controllers that publish every sensor of a kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.publish_rate import PublishRate
from gazelle.control.controllers.sensor_messages import (
    IMU_INTERFACES,
    WRENCH_INTERFACES,
    fill_imu,
    fill_wrench,
    sensor_indices,
)
from gazelle.control.interface_values import Array
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["ForceTorqueSensorController", "ImuSensorController"]

_PARAMETERS = (Parameter("publish_rate", "number", None, "how often; required", "Hz"),)
_BEHAVIOUR = (
    "Every sensor of the kind is published on a topic of its name, in its own frame.",
    "The first message comes after one period; the rate is kept on average.",
)


class _Kind(NamedTuple):
    """What a controller publishes: interfaces in their order, and the message they fill."""

    interfaces: tuple[str, ...]
    message: str
    fill: Callable[[Any, Array], None]


_IMU = _Kind(IMU_INTERFACES, "sensor_msgs/Imu", fill_imu)
_WRENCH = _Kind(WRENCH_INTERFACES, "geometry_msgs/WrenchStamped", fill_wrench)


class _SensorController(Controller):
    """Publishes every sensor that has all interfaces of a kind."""

    KIND: ClassVar[_Kind]

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensors."""
        super().__init__(context)
        context.parameters.require("publish_rate")
        self._rate = PublishRate(context.parameters.number("publish_rate"))
        sensors = [name for name in self.robot.sensors if self._is_mine(name)]
        self._streams = [
            (
                context.ports.publisher(name, self.KIND.message),
                sensor_indices(context, name, self.KIND.interfaces),
                self.robot.sensor_frames.get(name, name),
            )
            for name in sensors
        ]
        self.states = tuple(f"{name}/{word}" for name in sensors for word in self.KIND.interfaces)
        if not sensors:
            text = f"controller '{context.name}': the hardware has no sensor with "
            context.ports.log("warn", text + ", ".join(self.KIND.interfaces))

    def start(self, time_ns: int) -> None:
        """Begin to count."""
        self._rate.start(time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish what is due and listened to."""
        if not self._rate.due(time_ns):
            return
        for publisher, indices, frame_id in self._streams:
            if publisher.matched:
                message = stamped(self.KIND.message, time_ns, frame_id)
                self.KIND.fill(message, self.robot.interface_values.states[indices])
                publisher.publish(message)

    def _is_mine(self, sensor: str) -> bool:
        there = {name.rpartition("/")[2] for name in self.robot.sensors[sensor]}
        return there.issuperset(self.KIND.interfaces)


class ImuSensorController(_SensorController):
    """Publishes every IMU."""

    KIND = _IMU
    TABLE = ControllerTable(
        ParameterTable(
            "imu_sensor_controller",
            "Publishes every IMU of the hardware.",
            ("imu_sensor_controller/ImuSensorController",),
            _PARAMETERS,
        ),
        interfaces="claims none; reads orientation, angular velocity and linear"
        " acceleration of the IMUs",
        topics=(Topic("<sensor>", _IMU.message, rate="publish_rate", frame="the sensor's"),),
        behaviour=(
            *_BEHAVIOUR,
            "What an IMU does not measure is 0, its covariance begins with -1.",
        ),
    )


class ForceTorqueSensorController(_SensorController):
    """Publishes every force-torque sensor."""

    KIND = _WRENCH
    TABLE = ControllerTable(
        ParameterTable(
            "force_torque_sensor_controller",
            "Publishes every force-torque sensor of the hardware.",
            ("force_torque_sensor_controller/ForceTorqueSensorController",),
            _PARAMETERS,
        ),
        interfaces="claims none; reads forces and torques of the sensors",
        topics=(Topic("<sensor>", _WRENCH.message, rate="publish_rate", frame="the sensor's"),),
        behaviour=_BEHAVIOUR,
    )
