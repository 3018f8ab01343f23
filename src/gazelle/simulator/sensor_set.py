"""The sensors of a world: checked before it runs, read on demand with ray scenes and noise."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from gazelle.description.model import (
    CameraSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LidarSpec,
    Light,
    LogicalCameraSpec,
    Model,
    Noise,
    SonarSpec,
    World,
)
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.geometry import Pose
from gazelle.simulator.plugins.context import SensorPlace
from gazelle.simulator.sensor_readings import Measurements

if TYPE_CHECKING:
    from gazelle.engine import Engine, Snapshot
    from gazelle.sensors import (
        CameraRecord,
        ImuRecord,
        LidarRecord,
        NoiseStream,
        PictureNoise,
        RayScene,
        SonarRecord,
        VectorNoise,
    )

__all__ = ["SensorSet", "View", "camera_members", "check_sensor", "sensor_places"]


@dataclass(frozen=True, slots=True)
class View:
    """The world at one moment, safe to read from another thread.

    Attributes:
        world: its description at that moment.
        snapshot: poses of all links.
    """

    world: World
    snapshot: Snapshot

    def link_pose(self, name: str) -> Pose:
        """Return ``T_world_link`` of a ``model::link``; links of static models never move."""
        names = self.snapshot.link_names
        if name in names:
            row = self.snapshot.T[names.index(name)].tolist()
            return Pose((row[0], row[1], row[2]), (row[3], row[4], row[5], row[6]))
        model_name, link_name = name.split("::", 1)
        model = self.world.model(model_name)
        link = model.link(link_name) if model is not None else None
        assert model is not None
        assert link is not None
        return model.T_world_model @ link.T_model_link


class SensorSet:
    """Computes sensor readings from views of the world.

    Scenes are built when first needed and again when the world has changed. One thread at a time
    uses a scene.
    """

    def __init__(self, engine: Engine, seed: int) -> None:
        self._engine = engine
        self._seed = seed
        self._scenes: dict[str, tuple[RayScene, World]] = {}
        self._noises: dict[tuple[str, Noise], NoiseStream] = {}
        self._picture_noises: dict[tuple[str, Noise], PictureNoise | None] = {}
        self._imus: dict[str, _ImuState] = {}
        self._lights: tuple[Light, ...] | None = None
        self._lit: tuple[World, World] | None = None
        self._lock = threading.Lock()
        self.measurements = Measurements(engine, seed)
        """Contacts, forces, positions, fields: what needs no rays."""
        self.computed = 0
        """Readings computed so far; idle sensors do not count up."""

    def view(self) -> View:
        """Return the world as it stands now; for the thread that owns it."""
        return View(self._lit_world(), self._engine.snapshot())

    @property
    def lights(self) -> tuple[Light, ...]:
        """The world's lights as cameras see them; assign to change them."""
        return self._engine.world.lights if self._lights is None else self._lights

    @lights.setter
    def lights(self, lights: tuple[Light, ...]) -> None:
        self._lights = lights
        self._lit = None

    def restart(self) -> None:
        """Start all noise over, as after a reset."""
        self._noises.clear()
        self._picture_noises.clear()
        self._imus.clear()
        self.measurements.restart()

    def scan(self, place: SensorPlace, view: View | None = None) -> LidarRecord:
        """Take a scan with a ``ray``, ``gpu_ray`` or ``lidar`` sensor."""
        from gazelle.sensors import scan, scene_kind

        spec = place.sensor.spec
        assert isinstance(spec, LidarSpec)
        view = view or self.view()
        pose = view.link_pose(place.link_name) @ place.sensor.T_link_sensor
        with self._lock:
            self.computed += 1
            scene = self._scene(scene_kind(spec), view)
            return scan(scene, spec, pose, noise=self._noise(place, spec))

    def sonar(self, place: SensorPlace, view: View | None = None) -> SonarRecord:
        """Listen with a ``sonar`` sensor."""
        from gazelle.sensors import SonarRecord, sonar_range

        spec = place.sensor.spec
        assert isinstance(spec, SonarSpec)
        view = view or self.view()
        pose = view.link_pose(place.link_name) @ place.sensor.T_link_sensor
        with self._lock:
            self.computed += 1
            return SonarRecord(sonar_range(self._scene("collisions", view), spec, pose))

    def render(
        self,
        place: SensorPlace,
        view: View | None = None,
        *,
        want_rgb: bool = True,
        want_depth: bool = False,
    ) -> CameraRecord:
        """Take a picture with a camera of any kind."""
        from gazelle.sensors import render

        spec = place.sensor.spec
        assert isinstance(spec, CameraSpec)
        view = view or self.view()
        pose = view.link_pose(place.link_name) @ place.sensor.T_link_sensor @ spec.T_sensor_camera
        with self._lock:
            self.computed += 1
            scene = self._scene("visuals", view)
            return render(
                scene,
                spec,
                pose,
                want_rgb=want_rgb,
                want_depth=want_depth,
                noise=self._picture_noise(place, spec),
            )

    def read(self, place: SensorPlace) -> Any:
        """Return a fresh record of any sensor; for the thread that owns the world.

        Raises:
            GazelleError: the sensor is of a kind that gives no data.
        """
        spec = place.sensor.spec
        if isinstance(spec, LidarSpec):
            return self.scan(place)
        if isinstance(spec, CameraSpec):
            members = camera_members(place)
            wants_depth = spec.kind != "rgb"
            records = [self.render(member, want_depth=wants_depth) for member in members]
            return tuple(records) if spec.members else records[0]
        if isinstance(spec, SonarSpec):
            return self.sonar(place)
        return self.imu(place) if isinstance(spec, ImuSpec) else self.measurements.read(place)

    def imu(self, place: SensorPlace) -> ImuRecord:
        """Read an IMU; for the thread that owns the world."""
        spec = place.sensor.spec
        assert isinstance(spec, ImuSpec)
        return self.imu_at(place.name, place.link_name, place.sensor.T_link_sensor, spec)

    def imu_at(
        self,
        name: str,
        link_name: str,
        T_link_sensor: Pose,
        spec: ImuSpec,
        *,
        relative: bool = False,
    ) -> ImuRecord:
        """Read an IMU that need not be in the model: some plug-ins describe their own.

        With `relative` its orientation refers to the one it had at the first reading, unless the
        spec names a frame; else to the world.
        """
        from gazelle.sensors import LinkMotion, imu_noise, imu_reading

        link = self._engine.link(link_name)
        linear, angular = link.acceleration_world()
        T_world_link = link.T_world_link()
        motion = LinkMotion(T_world_link, link.velocity_world()[1], linear, angular)
        now_ns = self._engine.time_ns
        state = self._imus.get(name)
        if state is None:
            initial = (T_world_link @ T_link_sensor).quat_xyzw
            state = self._imus[name] = _ImuState(imu_noise(spec, self._seed, name), initial, now_ns)
        dt_s = (now_ns - state.last_ns) * 1e-9
        state.last_ns = now_ns
        self.computed += 1
        return imu_reading(
            motion,
            spec,
            self._engine.gravity_m_s2,
            T_link_sensor=T_link_sensor,
            noise=state.noise,
            dt_s=dt_s,
            initial_xyzw=state.initial_xyzw if relative else (0.0, 0.0, 0.0, 1.0),
        )

    def _lit_world(self) -> World:
        world = self._engine.world
        if self._lights is None:
            return world
        if self._lit is None or self._lit[0] is not world:
            self._lit = (world, replace(world, lights=self._lights))
        return self._lit[1]

    def _scene(self, kind: str, view: View) -> RayScene:
        from gazelle.sensors import RayScene

        found = self._scenes.get(kind)
        if found is None:
            scene = RayScene(view.world, kind="collisions" if kind == "collisions" else "visuals")
        else:
            scene = found[0]
            if found[1] is not view.world:
                scene.rebuild(view.world)
        self._scenes[kind] = (scene, view.world)
        scene.update(view.snapshot)
        return scene

    def _noise(self, place: SensorPlace, spec: LidarSpec) -> NoiseStream:
        from gazelle.sensors import noise_stream

        key = (place.name, spec.noise)
        if key not in self._noises:
            self._noises[key] = noise_stream(spec.noise, self._seed, place.name)
        return self._noises[key]

    def _picture_noise(self, place: SensorPlace, spec: CameraSpec) -> PictureNoise | None:
        from gazelle.sensors import picture_noise

        key = (place.name, spec.noise)
        if key not in self._picture_noises:
            self._picture_noises[key] = picture_noise(spec.noise, self._seed, place.name)
        return self._picture_noises[key]


def sensor_places(model: Model) -> Iterator[SensorPlace]:
    """Yield the sensors on a model's links, then those in its joints, in the order of the file."""
    for link in model.links:
        link_name = f"{model.name}::{link.name}"
        for sensor in link.sensors:
            yield SensorPlace(f"{link_name}::{sensor.name}", link_name, sensor)
    for joint in model.joints:
        joint_name, child = f"{model.name}::{joint.name}", f"{model.name}::{joint.child}"
        for sensor in joint.sensors:
            yield SensorPlace(f"{joint_name}::{sensor.name}", child, sensor, joint_name)


def camera_members(place: SensorPlace) -> tuple[SensorPlace, ...]:
    """Return the cameras of a ``multicamera`` as places of their own; any other camera itself."""
    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    if not spec.members:
        return (place,)
    return tuple(
        replace(
            place,
            name=f"{place.name}::{member.name}",
            sensor=replace(place.sensor, spec=member, name=member.name),
        )
        for member in spec.members
    )


def check_sensor(place: SensorPlace, model: Model, world: World, diagnostics: Diagnostics) -> bool:
    """Report what is wrong with a sensor; True when it can be read."""
    spec = place.sensor.spec
    if isinstance(spec, LogicalCameraSpec):
        text = f"sensor '{place.name}' is of type '{place.sensor.type}', which is not simulated"
        diagnostics.report("simulator.sensor-not-simulated", text, place.sensor.span)
        return False
    if isinstance(spec, ForceTorqueSpec) != bool(place.joint_name):
        _report_misplaced(place, model, diagnostics)
        return False
    if isinstance(spec, ContactSpec):
        _check_collisions(place, spec, model, diagnostics)
    if isinstance(spec, GpsSpec) and world.spherical_coordinates is None:
        text = f"sensor '{place.name}' measures where on Earth it is, and the world has no "
        text += "<spherical_coordinates>: it counts from latitude 0, longitude 0"
        diagnostics.report("simulator.no-place-on-earth", text, place.sensor.span)
    return True


def _report_misplaced(place: SensorPlace, model: Model, diagnostics: Diagnostics) -> None:
    kind, name = place.sensor.type, place.sensor.name
    if place.joint_name:
        joint = place.joint_name.split("::", 1)[1]
        fix = f"move it to a link, such as '{place.link_name.split('::', 1)[1]}'"
        text = f"sensor '{name}' of type '{kind}' sits in joint '{joint}' and needs a link"
    else:
        link = place.link_name.split("::", 1)[1]
        held = [joint.name for joint in model.joints if joint.child == link]
        text = f"sensor '{name}' of type '{kind}' sits on link '{link}' and needs a joint"
        fix = f"move it to joint '{held[0]}'" if held else "move it to a joint"
    diagnostics.report(
        "simulator.sensor-misplaced", f"{text}; it gives no data", place.sensor.span, fix=fix
    )


def _check_collisions(
    place: SensorPlace, spec: ContactSpec, model: Model, diagnostics: Diagnostics
) -> None:
    link = model.link(place.link_name.split("::", 1)[1])
    assert link is not None
    names = [collision.name for collision in link.collisions]
    of_others = {f"{one.name}::{item.name}" for one in model.links for item in one.collisions}
    for wanted in spec.collisions:
        if wanted not in names and wanted not in of_others:
            text = f"contact sensor '{place.name}' watches collision '{wanted}', which link "
            text += f"'{link.name}' does not have: it never feels anything there"
            fix = did_you_mean(wanted, names) or f"the link's collisions: {', '.join(names) or '-'}"
            diagnostics.report("simulator.no-such-collision", text, place.sensor.span, fix=fix)
    if not spec.collisions:
        text = f"contact sensor '{place.name}' names no collision: it never feels anything"
        fix = f"write <collision>{names[0]}</collision>" if names else ""
        diagnostics.report("simulator.no-such-collision", text, place.sensor.span, fix=fix)


@dataclass(slots=True)
class _ImuState:
    """What an IMU carries from one reading to the next."""

    noise: VectorNoise
    initial_xyzw: tuple[float, float, float, float]
    last_ns: int
