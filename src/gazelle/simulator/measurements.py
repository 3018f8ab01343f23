"""Readings of the sensors that need no rays: contact, force, position, field, pressure."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    MagnetometerSpec,
    PressureSpec,
    SphericalCoordinates,
)
from gazelle.errors import GazelleError
from gazelle.geometry import Pose, cross
from gazelle.simulator.joint_loads import joint_load
from gazelle.simulator.plugins.context import SensorPlace

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gazelle.engine import Engine, LinkHandle
    from gazelle.sensors import (
        AltimeterRecord,
        ContactRecord,
        GpsRecord,
        MagnetometerRecord,
        PressureRecord,
        VectorNoise,
        WrenchRecord,
    )

__all__ = ["Measurements"]

_SOMEWHERE = SphericalCoordinates()


class Measurements:
    """Reads them from the engine, for the thread that owns the world; keeps their noise."""

    def __init__(self, engine: Engine, seed: int) -> None:
        self._engine = engine
        self._seed = seed
        self._noises: dict[str, VectorNoise] = {}
        self._last_ns: dict[str, int] = {}
        self._readers: dict[type, Callable[[SensorPlace], Any]] = {
            AltimeterSpec: self.altimeter,
            ContactSpec: self.contacts,
            ForceTorqueSpec: self.force_torque,
            GpsSpec: self.gps,
            MagnetometerSpec: self.magnetometer,
            PressureSpec: self.pressure,
        }

    def restart(self) -> None:
        """Start all noise over, as after a reset."""
        self._noises.clear()
        self._last_ns.clear()

    def read(self, place: SensorPlace) -> Any:
        """Return a fresh record.

        Raises:
            GazelleError: the sensor is of a kind that gives no data, or sits where it cannot.
        """
        reader = self._readers.get(type(place.sensor.spec))
        if reader is None:
            kind = place.sensor.type
            raise GazelleError(f"sensor '{place.name}' is of type '{kind}', which is not simulated")
        return reader(place)

    def contacts(self, place: SensorPlace) -> ContactRecord:
        """Return what touches the collisions that a ``contact`` sensor watches."""
        from gazelle.sensors import watched_contacts

        spec = place.sensor.spec
        assert isinstance(spec, ContactSpec)
        model = place.link_name.partition("::")[0]
        names = frozenset(
            f"{owner}::{name}" for name in spec.collisions for owner in (place.link_name, model)
        )
        return watched_contacts(self._engine.contacts(), names)

    def force_torque(self, place: SensorPlace) -> WrenchRecord:
        """Return what a ``force_torque`` sensor measures.

        Raises:
            GazelleError: it does not sit in a joint.
        """
        from gazelle.sensors import force_torque_reading

        spec = place.sensor.spec
        assert isinstance(spec, ForceTorqueSpec)
        if not place.joint_name:
            raise GazelleError(f"force_torque sensor '{place.name}' does not sit in a joint")
        noises = (*spec.force_noise, *spec.torque_noise)
        dt_s = self._elapsed_s(place.name)
        noise = self._noise(place.name, noises)
        load = joint_load(self._engine, place.joint_name)
        return force_torque_reading(load, spec, place.sensor.T_link_sensor, noise=noise, dt_s=dt_s)

    def gps(self, place: SensorPlace) -> GpsRecord:
        """Return a fix of a ``gps`` or ``navsat`` sensor."""
        from gazelle.sensors import classic_origin, gps_noise, gps_reading
        from gazelle.simulator.plugins.gz_worlds import is_gz_world

        spec, world = place.sensor.spec, self._engine.world
        assert isinstance(spec, GpsSpec)
        origin = world.spherical_coordinates or _SOMEWHERE
        if place.sensor.type == "gps" and not is_gz_world(world):
            origin = classic_origin(origin)
        if place.name not in self._noises:
            self._noises[place.name] = gps_noise(spec, self._seed, place.name)
        link = self._engine.link(place.link_name)
        pose = link.T_world_link() @ place.sensor.T_link_sensor
        velocity = _point_velocity(link, pose)
        noise, dt_s = self._noises[place.name], self._elapsed_s(place.name)
        return gps_reading(pose.position_m, velocity, origin, noise=noise, dt_s=dt_s)

    def magnetometer(self, place: SensorPlace) -> MagnetometerRecord:
        """Return the field at a ``magnetometer``, in its frame."""
        from gazelle.sensors import MagnetometerRecord, magnetic_field

        spec = place.sensor.spec
        assert isinstance(spec, MagnetometerSpec)
        field = magnetic_field(self._engine.world.magnetic_field_t, self._pose(place))
        noise = self._noise(place.name, spec.noise)
        return MagnetometerRecord(noise.apply(field, dt_s=self._elapsed_s(place.name)))

    def altimeter(self, place: SensorPlace) -> AltimeterRecord:
        """Return how far an ``altimeter`` has risen since its model was put into the world."""
        from gazelle.sensors import AltimeterRecord, altitude_change_m

        spec = place.sensor.spec
        assert isinstance(spec, AltimeterSpec)
        link = self._engine.link(place.link_name)
        pose = link.T_world_link() @ place.sensor.T_link_sensor
        start = self._start(place)
        values = np.array([altitude_change_m(pose, start), _point_velocity(link, pose)[2]])
        noise = self._noise(place.name, (spec.position_noise, spec.velocity_noise))
        height, speed = noise.apply(values, dt_s=self._elapsed_s(place.name)).tolist()
        return AltimeterRecord(height, speed, start.position_m[2])

    def pressure(self, place: SensorPlace) -> PressureRecord:
        """Return the pressure at an ``air_pressure`` sensor."""
        from gazelle.sensors import PressureRecord, air_pressure_pa

        spec = place.sensor.spec
        assert isinstance(spec, PressureSpec)
        height_m = spec.reference_altitude_m + self._pose(place).position_m[2]
        noise = self._noise(place.name, (spec.noise,))
        values = noise.apply(
            np.array([air_pressure_pa(height_m)]), dt_s=self._elapsed_s(place.name)
        )
        return PressureRecord(float(values[0]))

    def _pose(self, place: SensorPlace) -> Pose:
        return self._engine.link(place.link_name).T_world_link() @ place.sensor.T_link_sensor

    def _start(self, place: SensorPlace) -> Pose:
        model_name = place.link_name.split("::", 1)[0]
        model, link = self._engine.world.model(model_name), self._engine.link(place.link_name).link
        assert model is not None
        return model.T_world_model @ link.T_model_link @ place.sensor.T_link_sensor

    def _noise(self, name: str, noises: tuple[Any, ...]) -> VectorNoise:
        from gazelle.sensors import VectorNoise

        if name not in self._noises:
            self._noises[name] = VectorNoise(noises, self._seed, name)
        return self._noises[name]

    def _elapsed_s(self, name: str) -> float:
        """Return the simulated time since this was last asked for a sensor."""
        now_ns = self._engine.time_ns
        last_ns = self._last_ns.get(name, now_ns)
        self._last_ns[name] = now_ns
        return (now_ns - last_ns) * 1e-9


def _point_velocity(link: LinkHandle, pose: Pose) -> NDArray[np.float64]:
    """Return the velocity of a point that moves with a link, (3,), world frame."""
    linear, angular = link.velocity_world()
    arm = np.subtract(pose.position_m, link.T_world_link().position_m)
    return np.asarray(linear + cross(angular, arm))
