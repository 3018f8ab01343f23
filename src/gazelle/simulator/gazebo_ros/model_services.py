"""Services and topics about models."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import did_you_mean
from gazelle.errors import EngineError
from gazelle.geometry import Pose
from gazelle.interfaces.poses import pose_message, pose_of, twist_message
from gazelle.interfaces.stamps import header
from gazelle.simulator.model_replacement import is_fixed

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.simulator.world_server import WorldServer

__all__ = [
    "Entities",
    "Entity",
    "Handler",
    "ModelServices",
    "Row",
    "place_link",
    "place_model",
    "state_from",
]


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


class ModelServices:
    """``get/set_model_state``, ``set_model_configuration`` and their kin."""

    def __init__(self, server: WorldServer, entities: Entities) -> None:
        self._server = server
        self._entities = entities

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            Row("get_model_state", "gazebo_msgs/GetModelState", self._get_state),
            Row("set_model_state", "gazebo_msgs/SetModelState", self._set_state),
            Row("get_model_properties", "gazebo_msgs/GetModelProperties", self._get_properties),
            Row(
                "set_model_configuration",
                "gazebo_msgs/SetModelConfiguration",
                self._set_configuration,
            ),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services of gazebo_ros in ROS 2."""
        return [
            *self.state_rows(),
            Row("get_model_list", "gazebo_msgs/GetModelList", self._get_list),
        ]

    def state_rows(self) -> list[Row]:
        """Return the services of ``libgazebo_ros_state``."""
        return [
            Row("get_entity_state", "gazebo_msgs/GetEntityState", self._get_entity_state),
            Row("set_entity_state", "gazebo_msgs/SetEntityState", self._set_entity_state),
        ]

    def property_rows(self) -> list[Row]:
        """Return the services of ``libgazebo_ros_properties``, which scopes names of links."""
        get = self._get_scoped_properties
        return [Row("get_model_properties", "gazebo_msgs/GetModelProperties", get)]

    def set_state(self, state: Any) -> str:
        """Apply a ``gazebo_msgs/ModelState``; returns what went wrong, empty when nothing did."""
        if self._entities.model(state.model_name) is None:
            return "SetModelState: model does not exist" + self._entities.hint(state.model_name)
        frame = self._entities.frame(state.reference_frame)
        if frame is None:
            return "SetModelState: specified reference frame entity does not exist"
        wanted = state_from(state).in_world(frame)
        return place_model(self._server.engine, state.model_name, wanted)

    def _get_state(self, request: Any, response: Any) -> None:
        state = self._entities.model(request.model_name)
        if state is None:
            text = "GetModelState: model does not exist"
            _fail(response, text + self._entities.hint(request.model_name))
            return
        response.header = header(self._server.time_ns, request.relative_entity_name)
        frame = self._entities.frame(request.relative_entity_name)
        if frame is None:
            text = "GetModelState: reference relative_entity_name not found, did you forget to "
            _fail(response, text + "scope the body by model name?")
            return
        relative = state.relative_to(frame)
        response.pose = pose_message(relative.T_world_entity)
        response.twist = twist_message(relative.linear_m_s, relative.angular_rad_s)
        _succeed(response, "GetModelState: got properties")

    def _set_state(self, request: Any, response: Any) -> None:
        problem = self.set_state(request.model_state)
        if problem:
            _fail(response, problem)
        else:
            _succeed(response, "SetModelState: set model state done")

    def _get_properties(self, request: Any, response: Any) -> None:
        model = self._server.engine.world.model(request.model_name)
        if model is None:
            text = "GetModelProperties: model does not exist"
            _fail(response, text + self._entities.hint(request.model_name))
            return
        response.canonical_body_name = model.canonical_link
        response.body_names = [link.name for link in model.links]
        response.geom_names = [item.name for link in model.links for item in link.collisions]
        response.joint_names = [joint.name for joint in model.joints]
        response.is_static = model.static
        _succeed(response, "GetModelProperties: got properties")

    def _get_scoped_properties(self, request: Any, response: Any) -> None:
        self._get_properties(request, response)
        if response.success:
            scope = f"{request.model_name}::"
            response.canonical_body_name = scope + response.canonical_body_name
            response.body_names = [scope + name for name in response.body_names]

    def _set_configuration(self, request: Any, response: Any) -> None:
        if self._entities.model(request.model_name) is None:
            text = "SetModelConfiguration: model does not exist"
            _fail(response, text + self._entities.hint(request.model_name))
            return
        if len(request.joint_names) != len(request.joint_positions):
            text = "SetModelConfiguration: joint name and position list have different lengths"
            _fail(response, text)
            return
        engine = self._server.engine
        left: list[str] = []
        for name, position in zip(request.joint_names, request.joint_positions, strict=True):
            full = name if "::" in name else f"{request.model_name}::{name}"
            if full not in engine.joint_names:
                left.append(f"there is no joint '{name}'")
                continue
            joint = engine.joint(full)
            wanted = min(max(float(position), joint.lower), joint.upper)
            joint.set_state(wanted, 0.0)
            if wanted != position:
                left.append(
                    f"{position:g} is beyond the limit of joint '{name}', {wanted:g} is set"
                )
        text = "SetModelConfiguration: success"
        if left:
            # Gazebo goes on in silence; launch files with joints of another robot count on it.
            text += f", but {'; '.join(left)}"
            self._server.node.log("WARN", text)
        _succeed(response, text)

    def _get_entity_state(self, request: Any, response: Any) -> None:
        entity = self._entities.any(request.name)
        frame = self._entities.frame(request.reference_frame)
        response.header = header(self._server.time_ns, request.reference_frame or "world")
        response.success = entity is not None and frame is not None
        if entity is None or frame is None:
            self._log_unknown("GetEntityState", request.name, request.reference_frame)
            return
        relative = entity.relative_to(frame)
        response.state.name = request.name
        response.state.pose = pose_message(relative.T_world_entity)
        response.state.twist = twist_message(relative.linear_m_s, relative.angular_rad_s)
        response.state.reference_frame = request.reference_frame

    def _set_entity_state(self, request: Any, response: Any) -> None:
        state = request.state
        frame = self._entities.frame(state.reference_frame)
        response.success = frame is not None and self._entities.any(state.name) is not None
        if frame is None or not response.success:
            self._log_unknown("SetEntityState", state.name, state.reference_frame)
            return
        wanted = state_from(state).in_world(frame)
        if self._entities.model(state.name) is not None:
            problem = place_model(self._server.engine, state.name, wanted)
        elif self._entities.link(state.name) is not None:
            problem = place_link(self._server.engine, state.name, wanted)
        else:
            problem = ""
            self._entities.place_light(state.name, wanted)
        response.success = not problem
        if problem:
            self._server.node.log("ERROR", problem)

    def _log_unknown(self, service: str, name: str, frame: str) -> None:
        """Say what is missing, for the response has no words."""
        if self._entities.any(name) is None:
            text = f"{service}: entity [{name}] does not exist{self._entities.hint(name)}"
        else:
            text = f"{service}: reference entity [{frame}] not found, did you forget to scope the "
            text += f"entity name?{self._entities.hint(frame)}"
        self._server.node.log("ERROR", text)

    def _get_list(self, request: Any, response: Any) -> None:
        response.header = header(self._server.time_ns, "")
        response.model_names = [model.name for model in self._server.engine.world.models]
        response.success = True


def place_model(engine: Engine, name: str, wanted: Entity) -> str:
    """Move a model; returns what went wrong, empty when nothing did."""
    try:
        engine.set_model_pose(name, wanted.T_world_entity)
        model = engine.world.model(name)
        at_rest = not (wanted.linear_m_s.any() or wanted.angular_rad_s.any())
        if not (at_rest and model is not None and is_fixed(model)):
            engine.set_model_velocity(name, wanted.linear_m_s, wanted.angular_rad_s)
    except EngineError as error:
        return f"SetModelState: {error}"
    return ""


def place_link(engine: Engine, name: str, wanted: Entity) -> str:
    """Move a link; returns what went wrong, empty when nothing did."""
    link = engine.link(name)
    try:
        link.set_pose(wanted.T_world_entity)
        link.set_velocity(wanted.linear_m_s, wanted.angular_rad_s)
    except EngineError as error:
        return f"SetLinkState: {error}"
    return ""


def state_from(message: Any) -> Entity:
    """Read the pose and twist of a ModelState, LinkState or EntityState."""
    linear, angular = message.twist.linear, message.twist.angular
    return Entity(
        pose_of(message.pose).normalised(),
        np.array([linear.x, linear.y, linear.z], float),
        np.array([angular.x, angular.y, angular.z], float),
    )


def _succeed(response: Any, text: str) -> None:
    response.success = True
    response.status_message = text


def _fail(response: Any, text: str) -> None:
    response.success = False
    response.status_message = text
