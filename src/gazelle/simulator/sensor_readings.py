"""Readings of the sensors that need no rays: contact, force, position, field, pressure.

What joints carry has the parts that the engine leaves out for things that cannot move.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    MagnetometerSpec,
    Model,
    PressureSpec,
    SphericalCoordinates,
)
from gazelle.errors import GazelleError
from gazelle.geometry import IDENTITY_POSE, Pose, cross
from gazelle.simulator.plugins.context import SensorPlace

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gazelle.engine import Engine, LinkHandle
    from gazelle.sensors import (
        AltimeterRecord,
        ContactRecord,
        GpsRecord,
        JointLoad,
        MagnetometerRecord,
        PressureRecord,
        VectorNoise,
        WrenchRecord,
    )

__all__ = ["Measurements", "joint_load"]


Array = NDArray[np.float64]
# Where it acts, force and torque, (3,) each, world frame.
_Load = tuple[Array, Array, Array]
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
        from gazelle.simulator.plugins.gz_builtin_systems import is_gz_world

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


def joint_load(engine: Engine, joint_name: str) -> JointLoad:
    """Return what the parent of a ``model::joint`` exerted on its child in the last step."""
    from gazelle.sensors import JointLoad

    joint, model_name = engine.joint(joint_name).joint, joint_name.split("::", 1)[0]
    child = engine.link(f"{model_name}::{joint.child}")
    T_world_joint = _joint_pose(engine, joint_name)
    if child.is_static:
        point = np.array(T_world_joint.position_m)
        force, torque = _static_load(engine, model_name, joint.child, point)
    else:
        force, torque = engine.joint(joint_name).reaction_wrench()
    parent_name = f"{model_name}::{joint.parent}"
    has_parent = parent_name in engine.link_names
    T_world_parent = engine.link(parent_name).T_world_link() if has_parent else IDENTITY_POSE
    return JointLoad(force, torque, T_world_joint, T_world_parent, child.T_world_link())


def _joint_pose(engine: Engine, joint_name: str) -> Pose:
    joint = engine.joint(joint_name).joint
    child = engine.link(f"{joint_name.split('::', 1)[0]}::{joint.child}")
    return child.T_world_link() @ child.link.T_model_link.inverse() @ joint.T_model_joint


def _static_load(
    engine: Engine, model_name: str, link_name: str, point_m: Array
) -> tuple[Array, Array]:
    """Return what holds the static links from one outwards, force and torque about a point.

    MuJoCo computes no forces inside of what cannot move: they are its weight, what presses on it
    and what hangs on it.
    """
    model = engine.world.model(model_name)
    assert model is not None
    names = {f"{model_name}::{name}" for name in _outwards(model, link_name)}
    names = {name for name in names if engine.link(name).is_static}
    gravity = np.array(engine.gravity_m_s2)
    loads = [
        *_weights(engine, sorted(names), gravity),
        *_contacts(engine, names),
        *_hanging(engine, model, names),
    ]
    force, torque = np.zeros(3), np.zeros(3)
    for place_m, pull_n, turn_nm in loads:
        force -= pull_n
        torque -= turn_nm + cross(place_m - point_m, pull_n)
    return force, torque


def _weights(engine: Engine, names: list[str], gravity: Array) -> Iterator[_Load]:
    for name in names:
        link = engine.link(name)
        # The engine gives static links no mass; the file does.
        inertial = link.link.inertial
        if inertial is not None:
            com = link.T_world_link().transform(np.array(inertial.T_link_com.position_m))
            yield com, inertial.mass_kg * gravity, np.zeros(3)


def _contacts(engine: Engine, names: set[str]) -> Iterator[_Load]:
    for contact in engine.contacts():
        pair = (contact.collision1, contact.collision2)
        first, second = (name.rsplit("::", 1)[0] in names for name in pair)
        # A contact inside the part that is held does not reach the joint.
        sign = float(first) - float(second)
        for place_m, force, torque in zip(
            contact.points_m, contact.forces_n, contact.torques_nm, strict=True
        ):
            yield place_m, sign * force, sign * torque


def _hanging(engine: Engine, model: Model, names: set[str]) -> Iterator[_Load]:
    for joint in model.joints:
        ends = [f"{model.name}::{end}" for end in (joint.parent, joint.child)]
        if ends[0] in names and ends[1] not in names:
            name = f"{model.name}::{joint.name}"
            force, torque = engine.joint(name).reaction_wrench()
            # What the joint does to its child, the child does to the part, the other way round.
            yield np.array(_joint_pose(engine, name).position_m), -force, -torque


def _outwards(model: Model, link_name: str) -> list[str]:
    found, waiting = [], [link_name]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.append(name)
            waiting += [joint.child for joint in model.joints if joint.parent == name]
    return found


def _point_velocity(link: LinkHandle, pose: Pose) -> NDArray[np.float64]:
    """Return the velocity of a point that moves with a link, (3,), world frame."""
    linear, angular = link.velocity_world()
    arm = np.subtract(pose.position_m, link.T_world_link().position_m)
    return np.asarray(linear + cross(angular, arm))
