"""The collisions that contact sensors of a URDF watch, by the names that lumping gives them.

Files written for Gazebo name what lumping makes of a collision: that of link ``foot`` is
``calf_fixed_joint_lump__foot_collision_1`` of link ``calf`` there. Links are never lumped here, so
the sensor is given the collision of the link it really belongs to, as ``foot::foot_collision``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.model import ContactSpec, Link, Model
from gazelle.description.urdf_reader.fixed_joint_lumping import collision_names
from gazelle.description.xml import Tag

__all__ = ["with_watched_collisions"]

_LUMP = "_fixed_joint_lump__"


def with_watched_collisions(model: Model, robot: Tag) -> Model:
    """Return the model with its contact sensors watching collisions by their URDF names.

    Args:
        model: the robot with its sensors.
        robot: the ``<robot>`` it was read from.
    """
    if not any(isinstance(item.spec, ContactSpec) for link in model.links for item in link.sensors):
        return model
    by_gazebo = _by_gazebo_name(model, robot)
    return replace(
        model, links=tuple(_with_watched(link, model, by_gazebo) for link in model.links)
    )


def _by_gazebo_name(model: Model, robot: Tag) -> dict[str, tuple[str, str]]:
    """Return link and collision by what Gazebo Classic calls the collision."""
    found: dict[str, tuple[str, str]] = {}
    for name, called in collision_names(robot, model).items():
        link = model.link(name)
        if link is not None and len(called) == len(link.collisions):
            for gazebo_name, collision in zip(called, link.collisions, strict=True):
                found.setdefault(gazebo_name, (name, collision.name))
    return found


def _with_watched(link: Link, model: Model, by_gazebo: Mapping[str, tuple[str, str]]) -> Link:
    def watched(name: str) -> str:
        own = {item.name for item in link.collisions}
        found = (link.name, name) if name in own else by_gazebo.get(name) or _near(name, model)
        if found is None:
            return name
        return found[1] if found[0] == link.name else "::".join(found)

    sensors = tuple(
        replace(
            sensor,
            spec=replace(sensor.spec, collisions=tuple(map(watched, sensor.spec.collisions))),
        )
        if isinstance(sensor.spec, ContactSpec)
        else sensor
        for sensor in link.sensors
    )
    return replace(link, sensors=sensors)


def _near(name: str, model: Model) -> tuple[str, str] | None:
    """Return the collision that a name means which no release of Gazebo gives exactly."""
    for reading in _readings(name):
        for link in model.links:
            if any(item.name == reading for item in link.collisions):
                return link.name, reading
    return None


def _readings(name: str) -> tuple[str, ...]:
    """Return what a collision of Gazebo's may be called in URDF, the likeliest first."""
    own = name.rpartition(_LUMP)[2]
    numbered = re.sub(r"_\d+$", "", own)
    return name, own, numbered, numbered.removesuffix("_collision")
