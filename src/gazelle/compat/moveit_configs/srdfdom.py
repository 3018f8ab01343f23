"""``srdfdom``'s Python classes: an SRDF as objects with the attributes of its elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.description.xml import Tag, parse_xml, read_xml
from gazelle.diagnostics import Diagnostics

__all__ = [
    "SRDF",
    "Chain",
    "DisableCollisions",
    "EndEffector",
    "Group",
    "GroupState",
    "Joint",
    "JointVal",
    "Link",
    "LinkSphereApproximation",
    "PassiveJoint",
    "Robot",
    "Sphere",
    "VirtualJoint",
]


@dataclass
class Link:
    """A ``<link>`` of a group."""

    name: str | None = None


@dataclass
class Joint:
    """A ``<joint>`` of a group."""

    name: str | None = None


@dataclass
class JointVal:
    """A ``<joint>`` of a state with its values."""

    name: str | None = None
    value: list[float] = field(default_factory=list)


@dataclass
class Sphere:
    """A ``<sphere>``; the centre is a text, as in srdfdom."""

    center: str | None = None
    radius: float = 0.0


@dataclass
class VirtualJoint:
    """A ``<virtual_joint>``."""

    name: str | None = None
    child_link: str | None = None
    parent_frame: str | None = None
    type: str | None = None

    @property
    def joint_type(self) -> str | None:
        """The same as `type`."""
        return self.type


@dataclass
class Chain:
    """A ``<chain>``."""

    base_link: str | None = None
    tip_link: str | None = None


@dataclass
class EndEffector:
    """An ``<end_effector>``."""

    name: str | None = None
    group: str | None = None
    parent_link: str | None = None
    parent_group: str | None = None


@dataclass
class PassiveJoint:
    """A ``<passive_joint>``."""

    name: str | None = None


@dataclass
class DisableCollisions:
    """A ``<disable_collisions>``."""

    link1: str | None = None
    link2: str | None = None
    reason: str | None = None


@dataclass
class Group:
    """A ``<group>``."""

    name: str | None = None
    links: list[Link] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    chains: list[Chain] = field(default_factory=list)
    groups: list[Group] = field(default_factory=list)

    @property
    def subgroups(self) -> list[Group]:
        """The same as `groups`."""
        return self.groups


@dataclass
class GroupState:
    """A ``<group_state>``."""

    name: str | None = None
    joints: list[JointVal] = field(default_factory=list)
    group: str | None = None


@dataclass
class LinkSphereApproximation:
    """A ``<link_sphere_approximation>``."""

    link: str | None = None
    spheres: list[Sphere] = field(default_factory=list)


@dataclass
class Robot:
    """An SRDF; nothing in it is checked against a robot."""

    name: str | None = None
    groups: list[Group] = field(default_factory=list)
    group_states: list[GroupState] = field(default_factory=list)
    end_effectors: list[EndEffector] = field(default_factory=list)
    virtual_joints: list[VirtualJoint] = field(default_factory=list)
    disable_collisionss: list[DisableCollisions] = field(default_factory=list)
    passive_joints: list[PassiveJoint] = field(default_factory=list)
    link_sphere_approximations: list[LinkSphereApproximation] = field(default_factory=list)

    @property
    def group_map(self) -> dict[str | None, Group]:
        """Groups by name."""
        return {group.name: group for group in self.groups}

    @property
    def group_state_map(self) -> dict[str | None, GroupState]:
        """States by name."""
        return {state.name: state for state in self.group_states}

    @classmethod
    def from_xml_string(cls, xml_string: str | bytes) -> Robot:
        """Read the text of an SRDF.

        Raises:
            UserFileError: it is not XML.
        """
        diagnostics = Diagnostics()
        text = xml_string.decode() if isinstance(xml_string, bytes) else xml_string
        root = parse_xml(text, "<robot_description_semantic>", diagnostics)
        diagnostics.raise_if_errors()
        return _robot(root) if root is not None else cls()

    @classmethod
    def from_xml_file(cls, file_path: str | Path) -> Robot:
        """Read an SRDF file.

        Raises:
            UserFileError: it is not there, or not XML.
        """
        diagnostics = Diagnostics()
        root = read_xml(Path(file_path), diagnostics)
        diagnostics.raise_if_errors()
        return _robot(root) if root is not None else cls()


SRDF = Robot


def _robot(root: Tag) -> Robot:
    return Robot(
        root.attributes.get("name"),
        [_group(tag) for tag in root.find_all("group")],
        [_state(tag) for tag in root.find_all("group_state")],
        [_made(EndEffector, tag) for tag in root.find_all("end_effector")],
        [_made(VirtualJoint, tag) for tag in root.find_all("virtual_joint")],
        [_made(DisableCollisions, tag) for tag in root.find_all("disable_collisions")],
        [_made(PassiveJoint, tag) for tag in root.find_all("passive_joint")],
        [_spheres(tag) for tag in root.find_all("link_sphere_approximation")],
    )


def _made(kind: Any, tag: Tag) -> Any:
    known = kind.__dataclass_fields__
    return kind(**{key: value for key, value in tag.attributes.items() if key in known})


def _group(tag: Tag) -> Group:
    return Group(
        tag.attributes.get("name"),
        [_made(Link, child) for child in tag.find_all("link")],
        [_made(Joint, child) for child in tag.find_all("joint")],
        [_made(Chain, child) for child in tag.find_all("chain")],
        [_group(child) for child in tag.find_all("group")],
    )


def _state(tag: Tag) -> GroupState:
    joints = [
        JointVal(child.attributes.get("name"), _numbers(child.attributes.get("value", "")))
        for child in tag.find_all("joint")
    ]
    return GroupState(tag.attributes.get("name"), joints, tag.attributes.get("group"))


def _spheres(tag: Tag) -> LinkSphereApproximation:
    spheres = [
        Sphere(child.attributes.get("center"), float(child.attributes.get("radius", "0")))
        for child in tag.find_all("sphere")
    ]
    return LinkSphereApproximation(tag.attributes.get("link"), spheres)


def _numbers(text: str) -> list[float]:
    return [float(token) for token in text.split()]
