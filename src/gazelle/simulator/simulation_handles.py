"""Joints, links, sensors and models as a `Simulation` hands them out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.description.model import Model, Sensor
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose

if TYPE_CHECKING:
    from gazelle.engine import JointHandle, LinkHandle
    from gazelle.simulator.plugins.context import Host, SensorPlace

__all__ = ["JointOfSimulation", "LinkOfSimulation", "ModelOfSimulation", "SensorOfSimulation"]


class JointOfSimulation:
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


class LinkOfSimulation:
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


class ModelOfSimulation:
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

    def link(self, name: str) -> LinkOfSimulation:
        """Return one of its links.

        Raises:
            NotFoundError: it has no such link; the message names the nearest.
        """
        self._require("link", name, self.links)
        return LinkOfSimulation(self._server.engine.link(f"{self.name}::{name}"))

    def joint(self, name: str) -> JointOfSimulation:
        """Return one of its joints.

        Raises:
            NotFoundError: it has no such joint; the message names the nearest.
        """
        self._require("joint", name, self.joints)
        return JointOfSimulation(self._server.engine.joint(f"{self.name}::{name}"))

    def _require(self, kind: str, name: str, names: tuple[str, ...]) -> None:
        if name not in names:
            raise NotFoundError(kind, name, nearest=nearest_names(name, names))


class SensorOfSimulation:
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


def _triple(vector: Any) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return (x, y, z)
