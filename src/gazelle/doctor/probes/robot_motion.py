"""Which models of a world are probed, and how far they have moved between two moments."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from gazelle.description.checks.shape_volumes import Outlines
from gazelle.description.model import JointType, Model, World
from gazelle.geometry import Pose
from gazelle.simulator.simulation import Simulation

__all__ = [
    "Motion",
    "base_name",
    "base_pose",
    "contacts_of",
    "link_poses",
    "motion_between",
    "robots_of",
    "stood_on_ground",
]

_CLEARANCE_M = 1e-3


class Motion(NamedTuple):
    """A motion.

    Attributes:
        moved_m: straight way.
        turned_deg: angle of the rotation.
        ahead_m, aside_m: along x and y of the frame before.
        yaw_rad: about z of the frame before.
    """

    moved_m: float
    turned_deg: float
    ahead_m: float
    aside_m: float
    yaw_rad: float


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


def motion_between(before: Pose, after: Pose) -> Motion:
    """Return the motion of a frame from one pose in the world to another."""
    step = before.inverse() @ after
    x, y, z = step.position_m
    turned = 2.0 * math.acos(min(1.0, abs(step.quat_xyzw[3])))
    ahead = step.rotate((1.0, 0.0, 0.0))
    moved = float(np.linalg.norm((x, y, z)))
    return Motion(moved, math.degrees(turned), x, y, math.atan2(ahead[1], ahead[0]))


def base_name(robot: Model) -> str:
    """Return the link whose pose is the model's."""
    return robot.canonical_link or robot.links[0].name


def base_pose(simulation: Simulation, robot: Model) -> Pose:
    """Return where the model's frame is now."""
    return simulation.server.engine.model_pose(robot.name)


def link_poses(simulation: Simulation, robot: Model) -> dict[str, Pose]:
    """Return the poses of all links of a model, by their names within it."""
    engine = simulation.server.engine
    names = [link.name for link in robot.links]
    return {name: engine.link(f"{robot.name}::{name}").T_world_link() for name in names}


def contacts_of(simulation: Simulation, robot: Model, *, with_itself: bool) -> dict[str, float]:
    """Return the deepest penetration in metres of each pair of collisions a model has part in.

    Args:
        simulation: the world; contacts are those of its last step.
        robot: the model.
        with_itself: contacts between two of its own links, else those with other models.
    """
    found: dict[str, float] = {}
    prefix = f"{robot.name}::"
    for contact in simulation.server.engine.contacts():
        pair = sorted(
            (contact.collision1, contact.collision2), key=lambda name: not name.startswith(prefix)
        )
        own = [name.removeprefix(prefix) for name in pair if name.startswith(prefix)]
        if len(own) == (2 if with_itself else 1) and len(contact.depths_m):
            text = f"'{own[0]}' and '{own[1] if with_itself else pair[1]}'"
            found[text] = max(found.get(text, 0.0), float(contact.depths_m.max()))
    return found


def _has_moving_joint(model: Model) -> bool:
    return any(joint.type is not JointType.FIXED for joint in model.joints)
