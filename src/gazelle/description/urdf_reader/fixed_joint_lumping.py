"""Which links of a URDF Gazebo merges into others, and what their collisions are called then.

sdformat turns a URDF into SDF with fixed joints reduced: the child becomes part of the parent
and its name is gone, unless the joint has ``preserveFixedJoint`` or ``disableFixedJointLumping``.
"""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.xml import Tag

__all__ = ["collision_names", "lumped_joints", "lumped_links"]

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


def _members(head: str, below: Mapping[str, list[str]]) -> list[str]:
    """Return a body's links in the order in which sdformat merges them."""
    found, waiting = list[str](), [head]
    while waiting:
        name = waiting.pop()
        found.append(name)
        waiting += reversed(below.get(name, ()))
    return found
