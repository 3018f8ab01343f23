"""Changes to what is in the world."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.world.world_control import WorldLink, pose_message, pose_of

__all__ = [
    "apply_wrench",
    "command_joint",
    "delete_model",
    "get_properties",
    "set_light",
    "set_pose",
    "set_property",
]

_TARGETS = ("force", "position", "velocity")
_GAINS = ("p", "i", "d")
_LIGHT = ("pose", "direction", "diffuse", "specular", "range_m", "intensity", "cast_shadows")
_MAX_DURATION_S = 1e6


def delete_model(world: WorldLink, params: Params) -> Any:
    """``world.delete``."""
    name = params.text("model")
    world.call("delete_model", "gazebo_msgs/DeleteModel", model_name=name)
    return {}


def set_pose(world: WorldLink, params: Params) -> Any:
    """``world.set_pose``: a model, which then stands still, or one of its links."""
    model, link, pose = params.text("model"), params.text("link", ""), pose_of(params)
    if not link:
        return world.ask(op="set_pose", model=model, pose=pose)
    state = message_type("gazebo_msgs/LinkState")(
        link_name=f"{model}::{link}", pose=pose_message(pose)
    )
    world.call("set_link_state", "gazebo_msgs/SetLinkState", link_state=state)
    return {}


def apply_wrench(world: WorldLink, params: Params) -> Any:
    """``world.wrench``: a force and a torque in the world's axes on a body, for some seconds."""
    force = params.numbers("force", [0.0, 0.0, 0.0], count=3)
    torque = params.numbers("torque", [0.0, 0.0, 0.0], count=3)
    seconds = params.number("seconds", 0.001, least=0.0, most=_MAX_DURATION_S)
    wrench = message_type("geometry_msgs/Wrench")()
    for vector, values in ((wrench.force, force), (wrench.torque, torque)):
        vector.x, vector.y, vector.z = values
    whole = int(seconds)
    duration = message_type("builtin_interfaces/Duration")(
        sec=whole, nanosec=round((seconds - whole) * 1e9) % 1_000_000_000
    )
    world.call(
        "apply_body_wrench",
        "gazebo_msgs/ApplyBodyWrench",
        body_name=params.text("body"),
        wrench=wrench,
        duration=duration,
    )
    return {}


def command_joint(world: WorldLink, params: Params) -> Any:
    """``world.joint``: a force, a position or a velocity; none of them frees the joint."""
    given = [name for name in _TARGETS if name in params]
    if len(given) > 1:
        raise StudioError(f"world.joint: one of {', '.join(_TARGETS)}, not {' and '.join(given)}")
    values = {name: params.number(name) for name in (*given, *_GAINS) if name in params}
    model, joint = params.text("model"), params.text("joint")
    return world.ask(op="joint", model=model, joint=joint, **values)


def get_properties(world: WorldLink, params: Params) -> Any:
    """``world.properties``: the inspector's rows."""
    return world.ask(op="properties", **_part(params))


def set_property(world: WorldLink, params: Params) -> Any:
    """``world.set_property``; a model's pose is set with `set_pose`."""
    name, value = params.text("name"), params.values.get("value")
    return world.ask(op="set_property", name=name, value=value, **_part(params))


def set_light(world: WorldLink, params: Params) -> Any:
    """``world.light``."""
    changes = {name: params.any(name) for name in _LIGHT if name in params}
    return world.ask(op="light", name=params.text("name"), **changes)


def _part(params: Params) -> dict[str, str]:
    return {name: params.text(name, "") for name in ("model", "link", "joint")}
