"""Joints, links, sensors, models and controllers as a `Simulation` hands them out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_manager import ControllerManager, ControllerRecord
from gazelle.description.model import Model, Sensor
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.parameters.trees import flattened
from gazelle.rich_display import shown_by

if TYPE_CHECKING:
    from gazelle.engine import JointHandle, LinkHandle
    from gazelle.simulator.plugins.context import Host, SensorPlace
    from gazelle.simulator.world_server import WorldServer

__all__ = [
    "SimControllers",
    "SimJoint",
    "SimLink",
    "SimModel",
    "SimSensor",
]


class SimJoint:
    """A joint: rad, rad/s and N·m for turning joints, m, m/s and N for sliding ones."""

    def __init__(self, handle: JointHandle) -> None:
        """Use `Simulation.joint`."""
        self.handle = handle

    @property
    def name(self) -> str:
        """``model::joint``."""
        return self.handle.name

    @property
    def position(self) -> float:
        """Position, not wrapped."""
        return self.handle.position

    @property
    def velocity(self) -> float:
        """Velocity."""
        return self.handle.velocity

    @property
    def effort(self) -> float:
        """Effort applied in the last step."""
        return self.handle.effort

    def command(self, position: float) -> None:
        """Drive to a position and hold it, within the joint's effort limit."""
        self.handle.set_position_target(position)

    def command_velocity(self, velocity: float, *, max_effort: float = float("inf")) -> None:
        """Drive at a velocity with at most an effort."""
        self.handle.set_velocity_target(velocity, max_effort)

    def command_effort(self, effort: float) -> None:
        """Apply an effort until another command."""
        self.handle.set_effort(effort)

    def release(self) -> None:
        """Let the joint move freely."""
        self.handle.release()


class SimLink:
    """A link."""

    def __init__(self, handle: LinkHandle) -> None:
        """Use `Simulation.link`."""
        self.handle = handle

    @property
    def name(self) -> str:
        """``model::link``."""
        return self.handle.name

    @property
    def pose(self) -> Pose:
        """Pose in the world."""
        return self.handle.T_world_link()

    @property
    def linear_velocity_m_s(self) -> tuple[float, float, float]:
        """Velocity of the link's origin, world frame."""
        return _triple(self.handle.velocity_world()[0])

    @property
    def angular_velocity_rad_s(self) -> tuple[float, float, float]:
        """Angular velocity, world frame."""
        return _triple(self.handle.velocity_world()[1])

    def apply_wrench(
        self,
        force_n: tuple[float, float, float] = (0.0, 0.0, 0.0),
        torque_nm: tuple[float, float, float] = (0.0, 0.0, 0.0),
        *,
        seconds: float | None = None,
    ) -> None:
        """Push at the centre of mass, world frame; for ever when `seconds` is None."""
        duration_ns = None if seconds is None else round(seconds * 1e9)
        self.handle.apply_wrench(force_n, torque_nm, duration_ns=duration_ns)


@shown_by("robots:sim_model_bundle")
class SimModel:
    """A model."""

    def __init__(self, server: Host, name: str) -> None:
        """Use `Simulation.model`."""
        self._server = server
        self.name = name

    @property
    def description(self) -> Model:
        """What it was built from."""
        model = self._server.engine.world.model(self.name)
        assert model is not None
        return model

    @property
    def pose(self) -> Pose:
        """Pose of its frame in the world; assign to move it."""
        return self._server.engine.model_pose(self.name)

    @pose.setter
    def pose(self, T_world_model: Pose) -> None:
        self._server.engine.set_model_pose(self.name, T_world_model)

    @property
    def links(self) -> tuple[str, ...]:
        """Names of its links."""
        return tuple(link.name for link in self.description.links)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of its joints."""
        return tuple(joint.name for joint in self.description.joints)

    def link(self, name: str) -> SimLink:
        """Return one of its links.

        Raises:
            NotFoundError: it has no such link; the message names the nearest.
        """
        self._require("link", name, self.links)
        return SimLink(self._server.engine.link(f"{self.name}::{name}"))

    def joint(self, name: str) -> SimJoint:
        """Return one of its joints.

        Raises:
            NotFoundError: it has no such joint; the message names the nearest.
        """
        self._require("joint", name, self.joints)
        return SimJoint(self._server.engine.joint(f"{self.name}::{name}"))

    def _require(self, kind: str, name: str, names: tuple[str, ...]) -> None:
        if name not in names:
            raise NotFoundError(kind, name, nearest=nearest_names(name, names))


class SimSensor:
    """A sensor that is read on demand, with or without topics."""

    def __init__(self, server: Host, place: SensorPlace) -> None:
        """Use `Simulation.sensor`."""
        self._server = server
        self._place = place

    @property
    def name(self) -> str:
        """``model::link::sensor``."""
        return self._place.name

    @property
    def description(self) -> Sensor:
        """What the file says about it."""
        return self._place.sensor

    def read(self) -> Any:
        """Return a fresh record of this moment.

        Returns:
            a record of `gazelle.sensors`: `LidarRecord`, `CameraRecord` (colour, and depth for
            depth cameras; a tuple of them for a multicamera), `ImuRecord`, `ContactRecord`,
            `WrenchRecord`, `GpsRecord`, `MagnetometerRecord`, `AltimeterRecord`,
            `PressureRecord` or `SonarRecord`.

        Raises:
            GazelleError: the sensor is of a kind that is not simulated.
        """
        return self._server.sensors.read(self._place)


@shown_by("robots:controllers_bundle")
class SimControllers:
    """Loads, starts and stops controllers; no time passes for it.

    Attributes:
        namespace: of the controller manager, such as ``/mira``.
    """

    def __init__(self, server: WorldServer, manager: ControllerManager) -> None:
        self._server = server
        self._manager = manager
        self.namespace = manager.namespace

    @property
    def controllers(self) -> Mapping[str, ControllerRecord]:
        """The loaded controllers by name, with type, state and interfaces."""
        return self._manager.controllers

    def load(
        self,
        name: str,
        type_name: str | None = None,
        *,
        parameters: Mapping[str, Any] | None = None,
    ) -> ControllerRecord:
        """Load a controller, and configure it.

        Args:
            name: its name below the namespace.
            type_name: its type; that of its parameters when None.
            parameters: values to set before, nested or with dots.

        Raises:
            ControllerError: it is loaded already, or cannot be made.
        """

        def act() -> ControllerRecord:
            for key, value in flattened(parameters or {}):
                self._manager.source.set(name, key, value)
            record = self._manager.load(name, type_name)
            self._manager.configure(name)
            return record

        return self._server.commands.call(act)

    def start(self, *names: str) -> None:
        """Start controllers, all or none.

        Raises:
            ControllerError: one of them cannot be started.
        """
        self._server.commands.call(lambda: self._manager.switch(start=names))

    def stop(self, *names: str) -> None:
        """Stop controllers.

        Raises:
            ControllerError: one of them does not run.
        """
        self._server.commands.call(lambda: self._manager.switch(stop=names))

    def switch(self, *, start: tuple[str, ...] = (), stop: tuple[str, ...] = ()) -> None:
        """Stop and start controllers in one go.

        Raises:
            ControllerError: it cannot be done; nothing has changed.
        """
        self._server.commands.call(lambda: self._manager.switch(start, stop))

    def spawn(
        self,
        name: str,
        type_name: str | None = None,
        *,
        parameters: Mapping[str, Any] | None = None,
    ) -> ControllerRecord:
        """Load and start a controller; see `load`.

        Raises:
            ControllerError: it cannot be loaded or started.
        """
        record = self.load(name, type_name, parameters=parameters)
        self.start(name)
        return record

    def unload(self, name: str) -> None:
        """Forget a controller; one that runs is stopped before.

        Raises:
            ControllerError: it is not loaded.
        """

        def act() -> None:
            record = self._manager.controllers.get(name)
            if record is not None and record.is_active:
                self._manager.switch(stop=(name,))
            self._manager.unload(name)

        self._server.commands.call(act)


def _triple(vector: Any) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return (x, y, z)
