"""What an SRDF says: groups, states, end effectors, virtual joints and collisions not looked at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from gazelle.diagnostics import SourceSpan

__all__ = [
    "Chain",
    "CollisionPair",
    "EndEffector",
    "Group",
    "GroupState",
    "LinkSpheres",
    "Srdf",
    "VirtualJoint",
]

VirtualJointType = Literal["fixed", "planar", "floating"]


@dataclass(frozen=True, slots=True)
class Chain:
    """The joints between two links; neither link's own name need be above the other's."""

    base_link: str
    tip_link: str


@dataclass(frozen=True, slots=True)
class Group:
    """A planning group as it is written: what it is made of, not yet which joints that means.

    Attributes:
        links: links whose parent joint belongs to the group.
        joints: joints of the robot, and virtual joints.
        chains: pairs of links with all joints between them.
        subgroups: names of groups whose joints belong to this one.
    """

    name: str
    links: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    chains: tuple[Chain, ...] = ()
    subgroups: tuple[str, ...] = ()
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class GroupState:
    """Named positions of a group's joints.

    Attributes:
        values: positions by joint, rad or m; several numbers for planar (x, y, theta) and
            floating (x, y, z, quaternion x, y, z, w) joints.
    """

    name: str
    group: str
    values: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class EndEffector:
    """A group that is mounted at the end of another.

    Attributes:
        group: the group of the hand's own joints and links.
        parent_link: the link it is mounted on.
        parent_group: the arm; empty when it shall be found by `parent_link`.
    """

    name: str
    group: str
    parent_link: str
    parent_group: str = ""
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class VirtualJoint:
    """What connects the robot's root link with the world."""

    name: str
    type: VirtualJointType
    parent_frame: str
    child_link: str
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class CollisionPair:
    """Two links with a reason, such as ``Adjacent`` or ``Never``."""

    link1: str
    link2: str
    reason: str = ""


@dataclass(frozen=True, slots=True)
class LinkSpheres:
    """Spheres that stand for a link: centre x, y, z and radius, m. Gazelle collides its shapes."""

    link: str
    spheres_m: tuple[tuple[float, float, float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Srdf:
    """A semantic robot description.

    Attributes:
        name: of the robot.
        disabled_pairs: pairs of links that are never looked at (``<disable_collisions>``).
        enabled_pairs: pairs that are, in spite of `no_default_collisions`.
        no_default_collisions: links that collide with nothing unless a pair is enabled.
        passive_joints: joints that nothing drives.
        joint_properties: texts by joint and property (``<joint_property>``).
        file: where it came from, None for a text.
    """

    name: str = ""
    groups: tuple[Group, ...] = ()
    states: tuple[GroupState, ...] = ()
    end_effectors: tuple[EndEffector, ...] = ()
    virtual_joints: tuple[VirtualJoint, ...] = ()
    passive_joints: tuple[str, ...] = ()
    disabled_pairs: tuple[CollisionPair, ...] = ()
    enabled_pairs: tuple[CollisionPair, ...] = ()
    no_default_collisions: tuple[str, ...] = ()
    spheres: tuple[LinkSpheres, ...] = ()
    joint_properties: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    file: Path | None = None

    def group(self, name: str) -> Group | None:
        """Return the group of this name, or None."""
        return next((group for group in self.groups if group.name == name), None)

    def states_of(self, group: str) -> tuple[GroupState, ...]:
        """Return the states of a group, in the file's order."""
        return tuple(state for state in self.states if state.group == group)
