"""SRDF to `Srdf`, all mistakes reported at once and what srdfdom leaves out left out."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from gazelle.description.model import Model
from gazelle.description.robot_description import read_text
from gazelle.description.source_maps import placed
from gazelle.description.srdf.collisions import read_default_collisions, read_pairs, read_spheres
from gazelle.description.srdf.groups import read_groups, read_states
from gazelle.description.srdf.model import EndEffector, Srdf, VirtualJoint, VirtualJointType
from gazelle.description.srdf.names import Names
from gazelle.description.urdf_reader.attributes import check_vocabulary
from gazelle.description.xml import Tag, attribute_span, read_xml
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.workspace import Workspace

__all__ = ["load_srdf", "read_srdf"]

_CHILDREN = (
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
_VIRTUAL_TYPES: tuple[VirtualJointType, ...] = ("fixed", "floating", "planar")


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
    check_vocabulary(root, diagnostics, attributes=("name", "version"), children=_CHILDREN)
    _check_robot_name(root, robot, diagnostics)
    virtual_tags = root.find_all("virtual_joint")
    virtual = frozenset(tag.attributes.get("name", "").strip() for tag in virtual_tags) - {""}
    tags = root.find_all("group")
    groups = frozenset(tag.attributes.get("name", "").strip() for tag in tags) - {""}
    names = Names(robot, virtual, groups, diagnostics)
    virtual_joints = _read_virtual_joints(root, names)
    return Srdf(
        name=root.attributes.get("name", "").strip(),
        groups=read_groups(root, names),
        states=read_states(root, names, virtual_joints),
        end_effectors=_read_end_effectors(root, names),
        virtual_joints=virtual_joints,
        passive_joints=_read_passive_joints(root, names),
        disabled_pairs=read_pairs(root, "disable_collisions", names),
        enabled_pairs=read_pairs(root, "enable_collisions", names),
        no_default_collisions=read_default_collisions(root, names),
        spheres=read_spheres(root, names),
        joint_properties=_read_joint_properties(root, names),
    )


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


def _read_virtual_joints(root: Tag, names: Names) -> tuple[VirtualJoint, ...]:
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


def _read_end_effectors(root: Tag, names: Names) -> tuple[EndEffector, ...]:
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


def _read_passive_joints(root: Tag, names: Names) -> tuple[str, ...]:
    tags = root.find_all("passive_joint")
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("name",))
    return tuple(name for tag in tags if (name := names.joint(tag, "name")))


def _read_joint_properties(root: Tag, names: Names) -> dict[str, dict[str, str]]:
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
