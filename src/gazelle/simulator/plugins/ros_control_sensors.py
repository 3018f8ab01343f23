"""Sensors of a simulated model as hardware of controllers reads them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from gazelle.control.hardware.sensor_states import (
    FORCE_TORQUE_STATES,
    IMU_STATES,
    SensorReadout,
)
from gazelle.description.model import ForceTorqueSpec, ImuSpec, Model
from gazelle.simulator.plugins.context import Host, SensorPlace
from gazelle.simulator.sensor_set import sensor_places

__all__ = ["ModelSensors"]


class ModelSensors:
    """IMUs and force-torque sensors of one model.

    They have their own noise, so that readings do not depend on who else reads a sensor.
    """

    def __init__(self, host: Host, model: Model) -> None:
        self._host = host
        self._places = {
            place.sensor.name: replace(place, name=f"{place.name} of its controllers")
            for place in reversed(tuple(sensor_places(model)))
            if isinstance(place.sensor.spec, ImuSpec | ForceTorqueSpec)
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the sensors."""
        return tuple(self._places)

    def find(self, name: str) -> SensorReadout | None:
        """Return a sensor by its name; of several the first, as in Gazebo."""
        place = self._places.get(name)
        if place is None:
            return None
        frame = place.link_name.split("::", 1)[1]
        if isinstance(place.sensor.spec, ImuSpec):
            return SensorReadout(IMU_STATES, frame, lambda: self._imu(place))
        return SensorReadout(FORCE_TORQUE_STATES, frame, lambda: self._wrench(place))

    def _imu(self, place: SensorPlace) -> Sequence[float]:
        spec = place.sensor.spec
        assert isinstance(spec, ImuSpec)
        record = self._host.sensors.imu_at(
            place.name, place.link_name, place.sensor.T_link_sensor, spec
        )
        return (
            *record.orientation_xyzw,
            *record.angular_velocity_rad_s,
            *record.linear_acceleration_m_s2,
        )

    def _wrench(self, place: SensorPlace) -> Sequence[float]:
        record = self._host.sensors.measurements.force_torque(place)
        return (*record.force_n.tolist(), *record.torque_nm.tolist())
