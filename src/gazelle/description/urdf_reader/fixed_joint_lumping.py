"""Which links of a URDF Gazebo merges into others, and what their collisions are called then.

Contact sensors name the collisions that they watch by these names.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.model import ContactSpec, Joint, JointType, Link, Model
from gazelle.description.xml import Tag

__all__ = ["collision_names", "lumped_joints", "lumped_links", "with_watched_collisions"]

_LUMP = "_fixed_joint_lump__"
_END = "_collision"


def lumped_joints(model: Model) -> dict[str, Joint]:
    """Return the fixed joints that Gazebo removes, by the name of their child."""
    if model.source_format != "urdf":
        return {}
    return {
        joint.child: joint
        for joint in model.joints
        if joint.type is JointType.FIXED
        and not joint.disable_fixed_joint_lumping
        and joint.parent != "world"
    }


def lumped_links(model: Model) -> dict[str, str]:
    """Return what becomes of the links that Gazebo removes: the link each of them is part of."""
    joints = lumped_joints(model)
    heads: dict[str, str] = {}
    for name in joints:
        head, way = name, dict[str, None]()
        while head in joints and head not in heads and head not in way:
            way[head] = None
            head = joints[head].parent
        heads |= dict.fromkeys(way, heads.get(head, head))
    return heads


def collision_names(root: Tag, model: Model) -> dict[str, tuple[str, ...]]:
    """Return what Gazebo Classic calls the collisions of every link, lumped ones included.

    A collision is named after its own name, else its link, with ``_collision`` and, unless it is
    the body's first, its number behind; those that came from another link get the body's name in
    front, unless they start with it anyway.

    Args:
        root: the ``<robot>`` element, after xacro.
        model: what was read from it.
    """
    written = {
        tag.attributes.get("name", "").strip(): tuple(
            item.attributes.get("name", "").strip() for item in tag.find_all("collision")
        )
        for tag in root.find_all("link")
    }
    joints = lumped_joints(model)
    below: dict[str, list[str]] = {}
    # urdfdom keeps joints, and with them the children of a link, sorted by name.
    for joint in sorted(joints.values(), key=lambda item: item.name):
        below.setdefault(joint.parent, []).append(joint.child)
    names: dict[str, tuple[str, ...]] = {}
    for head in (link.name for link in model.links if link.name not in joints):
        number = 0
        for link in _members(head, below):
            called = []
            for own in written.get(link, ()):
                name = (own or link) + _END + (f"_{number}" if number else "")
                called.append(name if name.startswith(head) else f"{head}{_LUMP}{name}")
                number += 1
            names[link] = tuple(called)
    return names


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


def _members(head: str, below: Mapping[str, list[str]]) -> list[str]:
    """Return a body's links in the order in which sdformat merges them."""
    found, waiting = list[str](), [head]
    while waiting:
        name = waiting.pop()
        found.append(name)
        waiting += reversed(below.get(name, ()))
    return found


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
