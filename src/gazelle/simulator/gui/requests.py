"""What a viewer may ask of the world beyond ``/gazebo/*``: one method for each ``op``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.description.model import Model
from gazelle.diagnostics import did_you_mean
from gazelle.diagnostics.suggestions import nearest_names
from gazelle.errors import GazelleError, NotFoundError
from gazelle.geometry import Pose
from gazelle.simulator.gui.fields import Fields
from gazelle.simulator.gui.joint_control import Gains, JointControl
from gazelle.simulator.gui.properties import (
    joint_rows,
    link_rows,
    model_rows,
    set_property,
)
from gazelle.simulator.input_validation import InputRefusedError, Limit
from gazelle.simulator.wall_clock import Mode

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["Requests"]

_LIGHT_COLOURS = ("diffuse", "specular")


class Requests:
    """Answers requests; they run between two steps, in the thread that owns the world."""

    def __init__(self, server: WorldServer, touch: Callable[[], None]) -> None:
        """Answer for a world.

        Args:
            server: the world.
            touch: called after a change that only the scene's picture shows.
        """
        self._server = server
        self._touch = touch
        self._joints = JointControl(server)
        self._methods: dict[str, Callable[[Fields], Any]] = {
            "factor": self._factor,
            "joint": self._joint,
            "light": self._light,
            "properties": self._properties,
            "set_pose": self._set_pose,
            "set_property": self._set_property,
        }

    def handle(self, request: Fields) -> Any:
        """Do what is asked for and return JSON's kind of value.

        Raises:
            GazelleError: it is unknown, or cannot be done.
        """
        name = request.text("op", "")
        method = self._methods.get(name)
        if method is None:
            hint = did_you_mean(name, self._methods) or f"there are: {', '.join(self._methods)}"
            raise GazelleError(f"unknown request '{name}'; {hint}")
        return method(request)

    def _factor(self, request: Fields) -> Any:
        """Change the wanted real-time factor; 0 is as fast as possible."""
        wanted = request.number("wanted_rtf")
        if not 0.0 <= wanted <= 1000.0:
            raise GazelleError(f"wanted_rtf is {wanted:g}; it has to be from 0 to 1000")
        server = self._server
        if server.mode is Mode.LOCKSTEP:
            raise GazelleError("the world runs in lock-step: as fast as possible, always")
        server.mode = Mode.REAL_TIME if wanted > 0.0 else Mode.FAST
        server.pace.factor = wanted
        server.pace.restart(server.time_ns)
        return {"wanted_rtf": wanted}

    def _joint(self, request: Fields) -> Any:
        """Give a joint a force, a position or a velocity; with none of them it is freed."""
        name = f"{request.text('model')}::{request.text('joint')}"
        gains = Gains(*(request.number(key, default=default) for key, default in _GAINS.items()))
        if "force" in request:
            self._joints.push(name, request.number("force", Limit.LOAD))
        elif "position" in request:
            self._joints.hold(name, request.number("position", Limit.ANGLE_RAD), gains)
        elif "velocity" in request:
            self._joints.turn(name, request.number("velocity", Limit.SPEED), gains)
        else:
            self._joints.free(name)
        return {}

    def _light(self, request: Fields) -> Any:
        """Change a light's colours, pose, direction, range or shadows."""
        sensors = self._server.sensors
        name = request.text("name")
        light = next((one for one in sensors.lights if one.name == name), None)
        if light is None:
            names = [one.name for one in sensors.lights]
            raise NotFoundError("light", name, nearest=nearest_names(name, names))
        changed = replace(light, **_light_changes(request))
        sensors.lights = tuple(changed if one is light else one for one in sensors.lights)
        self._touch()
        return {}

    def _properties(self, request: Fields) -> Any:
        """Return the inspector's rows of a model, a link or a joint."""
        engine, model = self._server.engine, self._model(request)
        link, joint = request.text("link", ""), request.text("joint", "")
        if link:
            description = engine.description_of_link(f"{model.name}::{link}")
            rows = link_rows(engine, model, description)
        elif joint:
            rows = joint_rows(engine, model, engine.description_of_joint(f"{model.name}::{joint}"))
        else:
            rows = model_rows(engine, model)
        return [row._asdict() for row in rows]

    def _set_property(self, request: Fields) -> Any:
        """Change one row."""
        link, joint = request.text("link", ""), request.text("joint", "")
        set_property(
            self._server.engine,
            self._model(request),
            request.text("name"),
            request.any("value", None),
            link=link,
            joint=joint,
        )
        return {}

    def _set_pose(self, request: Fields) -> Any:
        """Put a model somewhere, at rest: what a gizmo does while it is dragged."""
        engine, model = self._server.engine, self._model(request)
        engine.set_model_pose(model.name, _pose(request))
        if not model.static:
            engine.set_model_velocity(model.name, _STILL, _STILL)
        return {}

    def _model(self, request: Fields) -> Model:
        name = request.text("model")
        world = self._server.engine.world
        model = world.model(name)
        if model is None:
            names = [one.name for one in world.models]
            raise NotFoundError("model", name, nearest=nearest_names(name, names))
        return model


_GAINS = Gains()._asdict()
_STILL = (0.0, 0.0, 0.0)


def _light_changes(request: Fields) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for key in _LIGHT_COLOURS:
        if key in request:
            # Red, green and blue alone are opaque.
            changes[key] = (*request.numbers(key, (3, 4)), 1.0)[:4]
    if "pose" in request:
        changes["T_parent_light"] = _pose(request)
    if "direction" in request:
        direction = changes["direction"] = request.numbers("direction", (3,))
        if not any(direction):
            raise InputRefusedError("field 'direction' is of no length")
    for key in ("range_m", "intensity"):
        if key in request:
            changes[key] = request.number(key)
    if "cast_shadows" in request:
        changes["cast_shadows"] = request.flag("cast_shadows")
    return changes


def _pose(request: Fields) -> Pose:
    """Return the field ``pose``: x y z qx qy qz qw."""
    x, y, z, qx, qy, qz, qw = request.numbers("pose", (7,), *[Limit.POSITION_M] * 3)
    length = sum(value * value for value in (qx, qy, qz, qw)) ** 0.5
    if not 1e-6 < length < 1e6:
        raise InputRefusedError("the quaternion of field 'pose' has no direction")
    return Pose((x, y, z), (qx / length, qy / length, qz / length, qw / length))
