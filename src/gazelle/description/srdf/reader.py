"""SRDF to `Srdf`, all mistakes reported at once and what srdfdom leaves out left out.

Names of links, joints and groups that are not known are told where they stand.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.robot_description import read_text
from gazelle.description.source_maps import placed
from gazelle.description.srdf.model import (
    Chain,
    CollisionPair,
    EndEffector,
    Group,
    GroupState,
    LinkSpheres,
    Srdf,
    VirtualJoint,
    VirtualJointType,
)
from gazelle.description.urdf_reader.attributes import (
    check_vocabulary,
    number_attribute,
    vector_attribute,
)
from gazelle.description.xml import Tag, attribute_span, floats_from, read_xml
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.workspace import Workspace

__all__ = [
    "SRDF_ELEMENTS",
    "RobotNames",
    "link_names",
    "load_srdf",
    "read_srdf",
]

_WORLD = "world"
_PHRASES = {
    "link": "Link '{}' is not known to URDF",
    "joint": "Joint '{}' is not known to the URDF",
    "group": "Group '{}' is not known",
}
_COUNTS = {JointType.PLANAR: 3, JointType.FLOATING: 7, JointType.FIXED: 0}
_VIRTUAL_COUNTS = {"planar": 3, "floating": 7, "fixed": 0}
_TOLERANCE = 1e-9
SRDF_ELEMENTS = (
    "disable_collisions",
    "disable_default_collisions",
    "enable_collisions",
    "end_effector",
    "group",
    "group_state",
    "joint_property",
    "link_sphere_approximation",
    "passive_joint",
    "virtual_joint",
)
"""What MoveIt reads below ``<robot>``."""

_VIRTUAL_TYPES: tuple[VirtualJointType, ...] = ("fixed", "floating", "planar")


@dataclass(frozen=True, slots=True)
class RobotNames:
    """Links and joints of the robot; without a robot every name is taken as it is.

    Attributes:
        robot: the robot, None when only the SRDF is at hand.
        virtual: names of the virtual joints.
        groups: names of the groups.
        diagnostics: receives what is wrong.
    """

    robot: Model | None
    virtual: frozenset[str]
    groups: frozenset[str]
    diagnostics: Diagnostics

    @property
    def joints(self) -> dict[str, Joint]:
        """The robot's joints by name."""
        return {joint.name: joint for joint in self.robot.joints} if self.robot else {}

    def required(self, tag: Tag, attribute: str) -> str:
        """Return an attribute's text, trimmed; empty (reported) when it is missing."""
        text = tag.attributes.get(attribute, "").strip()
        if not text:
            message = f"<{tag.name}> has no '{attribute}' and is left out"
            fix = did_you_mean(attribute, tag.attributes)
            self.diagnostics.report("srdf.missing-attribute", message, tag.span, fix=fix)
        return text

    def link(self, tag: Tag, attribute: str) -> str:
        """Return the link that an attribute names; empty (reported) when there is none."""
        known = link_names(self.robot) if self.robot else None
        return self._known(tag, attribute, "link", known)

    def joint(self, tag: Tag, attribute: str) -> str:
        """Return the joint, virtual ones included; empty (reported) when there is none."""
        known = [*self.joints, *sorted(self.virtual)] if self.robot else None
        return self._known(tag, attribute, "joint", known)

    def group(self, tag: Tag, attribute: str) -> str:
        """Return the group that an attribute names; empty (reported) when there is none."""
        return self._known(tag, attribute, "group", sorted(self.groups))

    def _known(self, tag: Tag, attribute: str, kind: str, known: Collection[str] | None) -> str:
        name = self.required(tag, attribute)
        if not name or known is None or name in known:
            return name
        owner = "the SRDF" if kind == "group" else "the robot"
        text = f"<{tag.name} {attribute}=\"{name}\">: {owner} has no {kind} '{name}'"
        text += f" ({_PHRASES[kind].format(name)}); it is left out, as MoveIt does"
        fix = did_you_mean(name, known) or f"there are: {', '.join(known) or 'none'}"
        span = attribute_span(tag.span, attribute)
        self.diagnostics.report("parameters.srdf-name", text, span, fix=fix)
        return ""


def link_names(robot: Model) -> list[str]:
    """Return a robot's links; a root link ``world``, which models have not, is one in MoveIt."""
    names = [link.name for link in robot.links]
    is_root = _WORLD not in names and any(joint.parent == _WORLD for joint in robot.joints)
    return [_WORLD, *names] if is_root else names


def load_srdf(
    source: str | os.PathLike[str],
    *,
    robot: Model | None,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None = None,
) -> Srdf | None:
    """Read an SRDF file, an xacro file that makes one, or the text of one.

    Args:
        source: a path, or XML text (anything whose first character is ``<``).
        robot: the robot it is about; None leaves names unchecked.
        workspace: finds packages for ``$(find)``.
        diagnostics: receives every finding.
        mappings: values of ``<xacro:arg>`` by name.

    Returns:
        The description; None (reported) when there is no SRDF to be read.
    """
    text = str(source)
    if text.lstrip("\ufeff \t\r\n").startswith("<"):
        root, file = read_text(text, diagnostics), None
    else:
        file = Path(text)
        root = _read_file(file, workspace, diagnostics, mappings)
    if root is None:
        return None
    found = read_srdf(root, robot=robot, diagnostics=diagnostics)
    return None if found is None else replace(found, file=file)


def read_srdf(root: Tag, *, robot: Model | None, diagnostics: Diagnostics) -> Srdf | None:
    """Read an SRDF's elements; see `load_srdf`."""
    if root.name != "robot":
        message = f"the outermost element of an SRDF is <robot>, not <{root.name}>"
        diagnostics.report("srdf.no-robot", message, root.span)
        return None
    check_vocabulary(root, diagnostics, attributes=("name", "version"), children=SRDF_ELEMENTS)
    _check_robot_name(root, robot, diagnostics)
    virtual_tags = root.find_all("virtual_joint")
    virtual = frozenset(tag.attributes.get("name", "").strip() for tag in virtual_tags) - {""}
    tags = root.find_all("group")
    groups = frozenset(tag.attributes.get("name", "").strip() for tag in tags) - {""}
    names = RobotNames(robot, virtual, groups, diagnostics)
    virtual_joints = _read_virtual_joints(root, names)
    return Srdf(
        name=root.attributes.get("name", "").strip(),
        groups=_read_groups(root, names),
        states=_read_states(root, names, virtual_joints),
        end_effectors=_read_end_effectors(root, names),
        virtual_joints=virtual_joints,
        passive_joints=_read_passive_joints(root, names),
        disabled_pairs=_read_pairs(root, "disable_collisions", names),
        enabled_pairs=_read_pairs(root, "enable_collisions", names),
        no_default_collisions=_read_default_collisions(root, names),
        spheres=_read_spheres(root, names),
        joint_properties=_read_joint_properties(root, names),
    )


def _read_pairs(root: Tag, element: str, names: RobotNames) -> tuple[CollisionPair, ...]:
    """Return the pairs of ``<disable_collisions>`` or ``<enable_collisions>``."""
    found: list[CollisionPair] = []
    for tag in root.find_all(element):
        check_vocabulary(tag, names.diagnostics, attributes=("link1", "link2", "reason"))
        pair = names.link(tag, "link1"), names.link(tag, "link2")
        if all(pair):
            found.append(CollisionPair(*pair, tag.attributes.get("reason", "").strip()))
    return tuple(found)


def _read_default_collisions(root: Tag, names: RobotNames) -> tuple[str, ...]:
    """Return the links of ``<disable_default_collisions>``."""
    tags = root.find_all("disable_default_collisions")
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("link", "reason"))
    return tuple(name for tag in tags if (name := names.link(tag, "link")))


def _read_spheres(root: Tag, names: RobotNames) -> tuple[LinkSpheres, ...]:
    """Return ``<link_sphere_approximation>``; they are reported, for the shapes collide here."""
    tags = root.find_all("link_sphere_approximation")
    found: list[LinkSpheres] = []
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("link",), children=("sphere",))
        link = names.link(tag, "link")
        if link:
            spheres = [_read_sphere(child, names) for child in tag.find_all("sphere")]
            found.append(LinkSpheres(link, tuple(one for one in spheres if one is not None)))
    if found:
        links = ", ".join(f"'{one.link}'" for one in found)
        message = f"the spheres of {links} have no effect: collisions are checked with the links'"
        message += " own shapes, as MoveIt's FCL and Bullet do (only CHOMP uses spheres)"
        names.diagnostics.report("srdf.spheres", message, tags[0].span)
    return tuple(found)


def _read_states(
    root: Tag, names: RobotNames, virtual_joints: tuple[VirtualJoint, ...]
) -> tuple[GroupState, ...]:
    """Return the group states; values that no joint can have are reported.

    Args:
        root: the ``<robot>``.
        names: what there is.
        virtual_joints: joints besides those of the robot.
    """
    counts = {joint.name: _VIRTUAL_COUNTS[joint.type] for joint in virtual_joints}
    counts |= {name: _COUNTS.get(joint.type, 1) for name, joint in names.joints.items()}
    states: dict[tuple[str, str], GroupState] = {}
    for tag in root.find_all("group_state"):
        check_vocabulary(tag, names.diagnostics, attributes=("name", "group"), children=("joint",))
        name, group = names.required(tag, "name"), names.group(tag, "group")
        if not name or not group:
            continue
        if (group, name) in states:
            message = f"group '{group}' has a second state '{name}'; the last one counts"
            names.diagnostics.report("srdf.double-name", message, tag.span)
        values: dict[str, tuple[float, ...]] = {}
        for child in tag.find_all("joint"):
            joint, value = _read_value(child, names, counts)
            if joint:
                values[joint] = value
        states[group, name] = GroupState(name, group, values, tag.span)
    return tuple(states.values())


def _read_groups(root: Tag, names: RobotNames) -> tuple[Group, ...]:
    """Return the groups that stand directly below the root, without those that cannot be."""
    found: dict[str, Group] = {}
    for tag in root.find_all("group"):
        name = names.required(tag, "name")
        if name in found:
            message = f"a second <group> is named '{name}'; the first one counts, as in MoveIt"
            names.diagnostics.report("srdf.double-name", message, tag.span)
        elif name:
            found[name] = _read_group(tag, name, names)
    return _satisfied(found, names.diagnostics)


def _read_sphere(tag: Tag, names: RobotNames) -> tuple[float, float, float, float] | None:
    check_vocabulary(tag, names.diagnostics, attributes=("center", "radius"))
    if not names.required(tag, "center") or not names.required(tag, "radius"):
        return None
    center = vector_attribute(tag, "center", names.diagnostics)
    radius = number_attribute(tag, "radius", names.diagnostics)
    return None if center is None or radius is None else (*center, radius)


def _read_value(
    tag: Tag, names: RobotNames, counts: dict[str, int]
) -> tuple[str, tuple[float, ...]]:
    check_vocabulary(tag, names.diagnostics, attributes=("name", "value"))
    joint = names.joint(tag, "name")
    text = names.required(tag, "value") if joint else ""
    if text and counts.get(joint) == 0:
        message = f"joint '{joint}' is fixed and has no position; its value has no effect"
        names.diagnostics.report("srdf.fixed-state", message, tag.span)
        return "", ()
    if not text:
        return "", ()
    value = floats_from(
        text,
        counts.get(joint, len(text.split())),
        (),
        what="<joint value>",
        span=tag.span,
        diagnostics=names.diagnostics,
        attribute="value",
    )
    if not value:
        return "", ()
    robot_joint = names.joints.get(joint)
    if robot_joint is not None:
        _check_limits(tag, robot_joint, value, names)
    return joint, value


def _check_limits(tag: Tag, joint: Joint, value: tuple[float, ...], names: RobotNames) -> None:
    axis = joint.axis
    if axis is None or joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC):
        return
    if axis.lower - _TOLERANCE <= value[0] <= axis.upper + _TOLERANCE:
        return
    state = f"joint '{joint.name}' is at {value[0]:g}, its limits are {axis.lower:g} and"
    message = f"{state} {axis.upper:g}; no plan can reach this state"
    span = attribute_span(tag.span, "value")
    names.diagnostics.report("srdf.state-outside-limits", message, span)


def _read_group(tag: Tag, name: str, names: RobotNames) -> Group:
    check_vocabulary(
        tag,
        names.diagnostics,
        attributes=("name",),
        children=("link", "joint", "chain", "group"),
    )
    chains = (_read_chain(child, name, names) for child in tag.find_all("chain"))
    group = Group(
        name,
        _filled(names.link(child, "name") for child in tag.find_all("link")),
        _filled(names.joint(child, "name") for child in tag.find_all("joint")),
        tuple(chain for chain in chains if chain is not None),
        _filled(names.group(child, "name") for child in tag.find_all("group")),
        tag.span,
    )
    if not (group.links or group.joints or group.chains or group.subgroups):
        message = f"group '{name}' has no link, joint, chain or group in it; nothing can be"
        message += " planned for it"
        names.diagnostics.report("srdf.empty-group", message, tag.span)
    return group


def _read_chain(tag: Tag, group: str, names: RobotNames) -> Chain | None:
    check_vocabulary(tag, names.diagnostics, attributes=("base_link", "tip_link"))
    base, tip = names.link(tag, "base_link"), names.link(tag, "tip_link")
    if not base or not tip:
        return None
    if names.robot is not None and not _are_connected(base, tip, names.robot):
        message = f"no joints lead from '{base}' to '{tip}'; the chain is left out of group"
        message += f" '{group}' (Links '{base}' and '{tip}' do not form a chain)"
        names.diagnostics.report("srdf.no-chain", message, tag.span)
        return None
    return Chain(base, tip)


def _are_connected(base: str, tip: str, robot: Model) -> bool:
    parents = {joint.child: joint.parent for joint in robot.joints}

    def above(link: str) -> list[str]:
        found: list[str] = []
        while link and link not in found:
            found.append(link)
            link = parents.get(link, "")
        return found

    return bool(set(above(base)) & set(above(tip)))


def _satisfied(groups: dict[str, Group], diagnostics: Diagnostics) -> tuple[Group, ...]:
    """Leave out groups that hold themselves, by way of their subgroups."""
    known: set[str] = set()
    size = -1
    while len(known) > size:
        size = len(known)
        known |= {group.name for group in groups.values() if known.issuperset(group.subgroups)}
    for group in groups.values():
        if group.name not in known:
            message = f"group '{group.name}' holds itself by way of {', '.join(group.subgroups)};"
            message += f" it is left out (Group '{group.name}' has unsatisfied subgroups)"
            diagnostics.report("srdf.group-ring", message, group.span)
    return tuple(group for group in groups.values() if group.name in known)


def _filled(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(name for name in names if name)


def _read_file(
    file: Path,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str] | None,
) -> Tag | None:
    root = read_xml(file, diagnostics)
    if root is None:
        return None
    if file.suffix != ".xacro" and not any(tag.name.startswith("xacro:") for tag in root.walk()):
        return placed(root)
    from gazelle.description.xacro import expand_xacro

    expanded = expand_xacro(file, mappings=mappings, workspace=workspace, diagnostics=diagnostics)
    return None if expanded is None else expanded.tag(diagnostics)


def _check_robot_name(root: Tag, robot: Model | None, diagnostics: Diagnostics) -> None:
    name = root.attributes.get("name", "").strip()
    if not name:
        diagnostics.report("srdf.robot-name", "the SRDF's <robot> has no name", root.span)
    elif robot is not None and robot.name and name != robot.name:
        message = f"the SRDF is for robot '{name}', the URDF is '{robot.name}'"
        diagnostics.report("srdf.robot-name", message, attribute_span(root.span, "name"))


def _read_virtual_joints(root: Tag, names: RobotNames) -> tuple[VirtualJoint, ...]:
    found: list[VirtualJoint] = []
    for tag in root.find_all("virtual_joint"):
        known = ("name", "type", "parent_frame", "child_link")
        check_vocabulary(tag, names.diagnostics, attributes=known)
        name, parent = names.required(tag, "name"), names.required(tag, "parent_frame")
        child, written = names.link(tag, "child_link"), names.required(tag, "type")
        if not (name and parent and child and written):
            continue
        kind = next((item for item in _VIRTUAL_TYPES if item == written.lower()), None)
        if kind is None:
            message = f"virtual joint '{name}' has type '{written}'; it is taken as fixed, as in"
            message += " MoveIt (Assuming 'fixed' instead)"
            fix = did_you_mean(written, _VIRTUAL_TYPES) or f"types: {', '.join(_VIRTUAL_TYPES)}"
            span = attribute_span(tag.span, "type")
            names.diagnostics.report("srdf.virtual-joint", message, span, fix=fix)
        found.append(VirtualJoint(name, kind or "fixed", parent, child, tag.span))
    return tuple(found)


def _read_end_effectors(root: Tag, names: RobotNames) -> tuple[EndEffector, ...]:
    found: list[EndEffector] = []
    for tag in root.find_all("end_effector"):
        known = ("name", "group", "parent_link", "parent_group")
        check_vocabulary(tag, names.diagnostics, attributes=known)
        name, group = names.required(tag, "name"), names.group(tag, "group")
        link = names.link(tag, "parent_link")
        has_group = bool(tag.attributes.get("parent_group", "").strip())
        parent = names.group(tag, "parent_group") if has_group else ""
        if name and group and link:
            found.append(EndEffector(name, group, link, parent, tag.span))
    return tuple(found)


def _read_passive_joints(root: Tag, names: RobotNames) -> tuple[str, ...]:
    tags = root.find_all("passive_joint")
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("name",))
    return tuple(name for tag in tags if (name := names.joint(tag, "name")))


def _read_joint_properties(root: Tag, names: RobotNames) -> dict[str, dict[str, str]]:
    found: dict[str, dict[str, str]] = {}
    for tag in root.find_all("joint_property"):
        check_vocabulary(
            tag, names.diagnostics, attributes=("joint_name", "property_name", "value")
        )
        joint, key = names.joint(tag, "joint_name"), names.required(tag, "property_name")
        value = names.required(tag, "value")
        if joint and key and value:
            found.setdefault(joint, {})[key] = value
    return found
