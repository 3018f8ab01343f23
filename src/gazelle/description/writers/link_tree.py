"""The tree of a model: URDF has one root, and every joint leads away from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from gazelle.description.model import Joint, Model
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["WORLD", "LinkTree", "link_tree_of"]

WORLD = "world"
_FIXED = frozenset({"fixed", "floating"})


class LinkTree(NamedTuple):
    """A model's joints as a tree.

    Attributes:
        root: name of the root link, ``world`` when a joint holds something to the world.
        joints: joints of the tree in the model's order, all leading away from the root.
        turned: names of those that lead towards it in the model.
        loose: first links of the trees that nothing joins to the root's.
        loops: joints that close a kinematic loop.
        frames: frame that URDF demands of every link, in the model's: that of the joint above
            it. Links held by fixed joints keep their own.
    """

    root: str
    joints: tuple[Joint, ...]
    turned: tuple[str, ...]
    loose: tuple[str, ...]
    loops: tuple[Joint, ...]
    frames: Mapping[str, Pose]


def link_tree_of(model: Model) -> LinkTree:
    """Choose the tree: joints in the order of the file as long as they close no loop.

    A joint that leads towards the root is turned round: its ends are exchanged and its axis is
    reversed, so that its positions mean the same.
    """
    chosen, loops = _chosen(model)
    to_world = any(WORLD in (joint.parent, joint.child) for joint in chosen)
    names = [link.name for link in model.links]
    start = model.canonical_link if model.canonical_link in names else names[0]
    root = WORLD if to_world else _head(start, chosen)
    seen: dict[str, None] = {}
    turned = _reach(root, chosen, seen)
    loose: list[str] = []
    for name in names:
        if name not in seen:
            loose.append(_head(name, chosen))
            turned |= _reach(loose[-1], chosen, seen)
    joints = tuple(_turned(joint) if joint.name in turned else joint for joint in chosen)
    kept = tuple(joint.name for joint in chosen if joint.name in turned)
    return LinkTree(root, joints, kept, tuple(loose), loops, _frames(model, joints))


def _chosen(model: Model) -> tuple[list[Joint], tuple[Joint, ...]]:
    """Return the joints that join what nothing joined before them, and the others."""
    group: dict[str, str] = {}

    def head(name: str) -> str:
        while group.get(name, name) != name:
            name = group[name]
        return name

    chosen, loops = [], []
    for joint in model.joints:
        parent, child = head(joint.parent or WORLD), head(joint.child)
        if parent == child:
            loops.append(joint)
        else:
            group[child] = parent
            chosen.append(joint)
    return chosen, tuple(loops)


def _head(name: str, joints: Sequence[Joint]) -> str:
    """Return the link found by going from child to parent as far as that leads."""
    above = {joint.child: joint.parent for joint in reversed(joints)}
    while name in above:
        name = above[name]
    return name


def _reach(root: str, joints: Sequence[Joint], seen: dict[str, None]) -> set[str]:
    """Mark what hangs on a link; returns the joints that lead towards it."""
    at: dict[str, list[Joint]] = {}
    for joint in joints:
        at.setdefault(joint.parent or WORLD, []).append(joint)
        at.setdefault(joint.child, []).append(joint)
    turned: set[str] = set()
    stack = [root]
    seen[root] = None
    while stack:
        name = stack.pop()
        for joint in at.get(name, ()):
            forward = (joint.parent or WORLD) == name
            other = joint.child if forward else joint.parent or WORLD
            if other in seen:
                continue
            seen[other] = None
            stack.append(other)
            if not forward:
                turned.add(joint.name)
    return turned


def _turned(joint: Joint) -> Joint:
    axis = joint.axis
    if axis is not None:
        x, y, z = axis.xyz
        axis = replace(axis, xyz=(-x, -y, -z))
    return replace(joint, parent=joint.child, child=joint.parent or WORLD, axis=axis)


def _frames(model: Model, joints: Sequence[Joint]) -> dict[str, Pose]:
    frames = {WORLD: IDENTITY_POSE, **{link.name: link.T_model_link for link in model.links}}
    for joint in joints:
        if joint.type.value not in _FIXED:
            frames[joint.child] = joint.T_model_joint
    return frames
