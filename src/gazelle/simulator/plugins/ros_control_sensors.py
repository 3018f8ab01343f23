"""Sensors of a simulated model as hardware of controllers reads them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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

    They have their own noise, so that readings do not depend on who else reads a sensor. As in
    Gazebo a reading stands for a period of the sensor's update rate.
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
            return SensorReadout(IMU_STATES, frame, self._held(place, self._imu))
        return SensorReadout(FORCE_TORQUE_STATES, frame, self._held(place, self._wrench))

    def _held(
        self, place: SensorPlace, read: Callable[[SensorPlace], Sequence[float]]
    ) -> Callable[[], Sequence[float]]:
        rate_hz = place.sensor.update_rate_hz
        period_ns = max(1, round(1e9 / rate_hz)) if rate_hz > 0 else 1
        engine = self._host.engine
        last: list[tuple[int, Sequence[float]]] = []

        def reading() -> Sequence[float]:
            now_ns = engine.time_ns
            is_due = not last or now_ns < last[0][0]
            if is_due or now_ns // period_ns != last[0][0] // period_ns:
                last[:] = [(now_ns, read(place))]
            return last[0][1]

        return reading

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
