"""Which models of a world are worth a probe."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.checks.shape_volumes import Outlines
from gazelle.description.model import JointType, Model, World
from gazelle.geometry import Pose

__all__ = ["robots_of", "stood_on_ground"]

_CLEARANCE_M = 1e-3


def robots_of(world: World) -> tuple[Model, ...]:
    """Return the models that can move and have joints or plug-ins; without any, all that move."""
    moving = tuple(model for model in world.models if not model.static and model.links)
    robots = tuple(model for model in moving if model.plugins or _has_moving_joint(model))
    return robots or moving


def stood_on_ground(model: Model) -> Model:
    """Return a model that nobody has placed, lifted until no collision reaches below z = 0."""
    if any(joint.parent == "world" for joint in model.joints):
        return model
    pose = model.T_world_model
    points = [pose.transform(item.points_m) for item in Outlines(model).collisions]
    lowest = min((float(item[:, 2].min()) for item in points), default=0.0)
    if lowest >= 0.0:
        return model
    x, y, z = pose.position_m
    lifted = Pose((x, y, z - lowest + _CLEARANCE_M), pose.quat_xyzw)
    return replace(model, T_world_model=lifted)


def _has_moving_joint(model: Model) -> bool:
    return any(joint.type is not JointType.FIXED for joint in model.joints)
