"""Which models of a world are worth a probe."""

from __future__ import annotations

from gazelle.description.model import JointType, Model, World

__all__ = ["robots_of"]


def robots_of(world: World) -> tuple[Model, ...]:
    """Return the models that can move and have joints or plug-ins; without any, all that move."""
    moving = tuple(model for model in world.models if not model.static and model.links)
    robots = tuple(model for model in moving if model.plugins or _has_moving_joint(model))
    return robots or moving


def _has_moving_joint(model: Model) -> bool:
    return any(joint.type is not JointType.FIXED for joint in model.joints)
