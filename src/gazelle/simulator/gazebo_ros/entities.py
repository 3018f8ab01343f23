"""Models and links by Gazebo's scoped names, and poses relative to them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["Entities", "Entity", "Handler", "Row"]

Handler = Callable[[Any, Any], None]
Array = NDArray[np.float64]
# gazebo_ros takes these for the world (it says itself that "map" is not right).
_WORLD_NAMES = frozenset({"", "world", "map", "/map"})


@dataclass(frozen=True, slots=True)
class Row:
    """A service: name below the namespace, type, and what fills the response."""

    name: str
    type: str
    handler: Handler


@dataclass(frozen=True, slots=True)
class Entity:
    """A model or link at one moment; the world itself is the identity at rest."""

    T_world_entity: Pose
    linear_m_s: Array
    angular_rad_s: Array

    def relative_to(self, frame: Entity) -> Entity:
        """Return pose and velocity as seen from another entity, in its axes."""
        back = frame.T_world_entity.inverse()
        return Entity(
            back @ self.T_world_entity,
            _rotated(back, self.linear_m_s - frame.linear_m_s),
            _rotated(back, self.angular_rad_s - frame.angular_rad_s),
        )

    def in_world(self, frame: Entity) -> Entity:
        """Return the world pose and velocity of what is given relative to `frame`.

        As in gazebo_ros, the frame's own velocity is not added.
        """
        place = frame.T_world_entity
        return Entity(
            place @ self.T_world_entity,
            _rotated(place, self.linear_m_s),
            _rotated(place, self.angular_rad_s),
        )


WORLD = Entity(Pose(), np.zeros(3), np.zeros(3))


class Entities:
    """Looks names up in the running world."""

    def __init__(self, server: WorldServer) -> None:
        self._server = server

    def model(self, name: str) -> Entity | None:
        """Return a model's state, None when there is no such model."""
        engine = self._server.engine
        if engine.world.model(name) is None:
            return None
        linear, angular = engine.model_velocity(name)
        return Entity(engine.model_pose(name), linear, angular)

    def link(self, name: str) -> Entity | None:
        """Return a link's state by ``model::link``, None when there is no such link."""
        engine = self._server.engine
        if name not in engine.link_names:
            return None
        link = engine.link(name)
        linear, angular = link.velocity_world()
        return Entity(link.T_world_link(), linear, angular)

    def any(self, name: str) -> Entity | None:
        """Return a model, a link or a light of the world; None when there is none of them."""
        found = self.model(name) or self.link(name)
        lights = () if found is not None else self._server.sensors.lights
        light = next((one for one in lights if one.name == name), None)
        return found if light is None else replace(WORLD, T_world_entity=light.T_parent_light)

    def place_light(self, name: str, wanted: Entity) -> None:
        """Move a light of the world."""
        sensors = self._server.sensors
        sensors.lights = tuple(
            replace(one, T_parent_light=wanted.T_world_entity) if one.name == name else one
            for one in sensors.lights
        )

    def frame(self, name: str) -> Entity | None:
        """Return a reference frame: an entity or the world; None for anything else."""
        found = self.any(name)
        return WORLD if found is None and name in _WORLD_NAMES else found

    def hint(self, name: str) -> str:
        """Return ``; did you mean …`` for an unknown model or link."""
        engine = self._server.engine
        names = [*(model.name for model in engine.world.models), *engine.link_names]
        scoped = [item for item in names if item.endswith(f"::{name}")]
        text = f"did you mean '{scoped[0]}'?" if scoped else did_you_mean(name, names)
        return f"; {text}" if text else ""


def _rotated(pose: Pose, vector: Array) -> Array:
    x, y, z = vector.tolist()
    return np.array(pose.rotate((x, y, z)))
