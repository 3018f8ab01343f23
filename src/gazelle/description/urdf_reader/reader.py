"""URDF to `Model`: every problem of the file reported at once."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from gazelle.description.model import Joint, Link, Model, Ros2ControlTag, TransmissionTag
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.attributes import check_vocabulary, origin_of
from gazelle.description.urdf_reader.gazebo_extension_insertion import (
    inserted_joints,
    with_insertions,
)
from gazelle.description.urdf_reader.gazebo_tags import apply_gazebo, blocks_by_reference
from gazelle.description.urdf_reader.inertia import with_inertia
from gazelle.description.urdf_reader.joints import ReadJoint, read_joint
from gazelle.description.urdf_reader.kinematic_tree import (
    check_tree,
    poses_of,
    without_second_parents,
)
from gazelle.description.urdf_reader.links import read_link
from gazelle.description.urdf_reader.materials import global_materials
from gazelle.description.urdf_reader.transmissions import read_transmission
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose

__all__ = ["read_urdf"]

_CHILDREN = (
    "gazebo",
    "joint",
    "link",
    "material",
    "origin",
    "ros2_control",
    "sensor",
    "transmission",
)
_VERSIONS = ("1.0", "1.1", "1.2")
_WORLD = "world"


def read_urdf(text: str | Tag, *, context: ReadContext, name: str | None = None) -> Model | None:
    """Read a robot description.

    Frames, names and fixed joints stay as they are: nothing is lumped and no link is dropped.
    A root link called ``world`` is the world itself, as in sdformat's conversion, and is not
    among the model's links.

    Args:
        text: the XML, or its root element.
        context: workspace for files, where to report, the file's name.
        name: name of the model; the robot's own when None.

    Returns:
        The model; None when there is no robot or its links form no tree. Errors of severity
        error may be reported although a model comes back: what they touch is left out.
    """
    diagnostics = context.diagnostics
    robot = _root_of(text, context)
    if robot is None:
        return None
    known = (*_CHILDREN, *_foreign(robot))
    check_vocabulary(robot, diagnostics, attributes=("name", "version"), children=known)
    own_name = _robot_name(robot, context)
    links = _read_links(robot, context)
    joints = _read_joints(robot, context)
    whole_robot = blocks_by_reference(robot).get("", [])
    names = (*joints, *inserted_joints(whole_robot))
    transmissions = _read_transmissions(robot, names, context)
    for sensor in robot.find_all("sensor"):
        message = "<sensor> directly under <robot> was never used by ROS or Gazebo; it is ignored"
        diagnostics.report("urdf.sensor-ignored", message, sensor.span)
    whole = len(joints) == len(robot.find_all("joint"))
    joints = without_second_parents(joints, context)
    root = check_tree(links, tuple(joints.values()), context, whole=whole) if links else None
    if root is None:
        return None
    model = _placed(name or own_name, robot, root, links, joints, context)
    model = apply_gazebo(model, robot, context)
    model = with_inertia(model, _broken_inertials(robot, links), context)
    model = replace(
        model,
        joints=tuple(_with_known_leader(joint, model, context) for joint in model.joints),
        transmissions=transmissions,
        ros2_controls=tuple(_read_ros2_control(tag) for tag in robot.find_all("ros2_control")),
    )
    return with_insertions(model, whole_robot, context) if context.inserts else model


def _root_of(text: str | Tag, context: ReadContext) -> Tag | None:
    root = parse_xml(text, context.file, context.diagnostics) if isinstance(text, str) else text
    if root is not None and root.name != "robot":
        message = f"could not find the 'robot' element: the file's root is <{root.name}>"
        context.diagnostics.report("urdf.no-robot", message, root.span)
        return None
    return root


def _robot_name(robot: Tag, context: ReadContext) -> str:
    version = robot.attributes.get("version", "1.0").strip()
    if version not in _VERSIONS:
        message = f"version '{version}' of URDF is not known; known are {', '.join(_VERSIONS)}"
        context.diagnostics.report("urdf.version", message, robot.span)
    name = robot.attributes.get("name", "").strip()
    if not name:
        context.diagnostics.report("urdf.no-robot-name", "<robot> has no name", robot.span)
    return name or "robot"


def _foreign(robot: Tag) -> tuple[str, ...]:
    """Elements with a prefix of their own are other programs' business."""
    prefixed = (child.name for child in robot.children if ":" in child.name)
    return tuple(name for name in prefixed if not name.startswith("xacro:"))


def _read_links(robot: Tag, context: ReadContext) -> dict[str, Link]:
    materials = global_materials(robot, context)
    links: dict[str, Link] = {}
    tags = robot.find_all("link")
    for tag in tags:
        name = tag.attributes.get("name", "").strip()
        if not name:
            context.diagnostics.report("urdf.link-no-name", "a <link> has no name", tag.span)
        elif name in links:
            message = f"link '{name}' is not unique; first defined at {links[name].span}"
            wanted = _wanted_link(robot, tags)
            fix = f'write name="{wanted}"' if wanted else ""
            message += f"; joints name '{wanted}', and no link has that name" if wanted else ""
            context.diagnostics.report("urdf.duplicate-link", message, tag.span, fix=fix)
        else:
            links[name] = read_link(tag, name, materials, context)
    if not tags:
        message = "no link elements found: the robot has no <link>"
        context.diagnostics.report("urdf.no-links", message, robot.span)
    return links


def _wanted_link(robot: Tag, links: Sequence[Tag]) -> str:
    """Return the one name that joints have for a link and no link has, empty when it is not one."""
    ends = (end for joint in robot.find_all("joint") for end in joint.children)
    named = {end.attributes.get("link", "") for end in ends if end.name in {"parent", "child"}}
    wanted = named - {tag.attributes.get("name", "") for tag in links} - {""}
    return wanted.pop() if len(wanted) == 1 else ""


def _read_joints(robot: Tag, context: ReadContext) -> dict[str, ReadJoint]:
    joints: dict[str, ReadJoint] = {}
    seen: dict[str, Tag] = {}
    tags = robot.find_all("joint")
    for tag in tags:
        name = tag.attributes.get("name", "").strip()
        if not name:
            context.diagnostics.report("urdf.joint-no-name", "a <joint> has no name", tag.span)
        elif name in seen:
            message = f"joint '{name}' is not unique; first defined at {seen[name].span}"
            context.diagnostics.report("urdf.duplicate-joint", message, tag.span)
        else:
            seen[name] = tag
            joint = read_joint(tag, name, context, tags)
            if joint is not None:
                joints[name] = joint
    return joints


def _read_transmissions(
    robot: Tag, joints: Collection[str], context: ReadContext
) -> tuple[TransmissionTag, ...]:
    found = (read_transmission(tag, joints, context) for tag in robot.find_all("transmission"))
    return tuple(item for item in found if item is not None)


def _read_ros2_control(tag: Tag) -> Ros2ControlTag:
    return Ros2ControlTag(tag.attributes.get("name", ""), tag.attributes.get("type", ""), tag)


def _placed(
    name: str,
    robot: Tag,
    root: str,
    links: Mapping[str, Link],
    joints: Mapping[str, ReadJoint],
    context: ReadContext,
) -> Model:
    poses: dict[str, Pose] = poses_of(root, tuple(joints.values()))
    world = links[root] if root == _WORLD else None
    if world is not None and (world.collisions or world.visuals or world.inertial):
        message = "the root link 'world' is the world itself; its shapes and mass are left out"
        context.diagnostics.report("urdf.world-link", message, world.span)
    kept = tuple(
        replace(link, T_model_link=poses[link.name])
        for link in links.values()
        if link.name != _WORLD or root != _WORLD
    )
    path = None if context.file.startswith("<") else Path(context.file)
    return Model(
        name,
        T_world_model=origin_of(robot, context.diagnostics),
        links=kept,
        joints=tuple(
            replace(item.joint, T_model_joint=poses[item.joint.child]) for item in joints.values()
        ),
        canonical_link=_canonical(root, kept, joints),
        source_format="urdf",
        file=path,
        span=robot.span,
    )


def _broken_inertials(robot: Tag, links: Mapping[str, Link]) -> set[str]:
    """Return the links whose ``<inertial>`` was written and could not be used."""
    written = {
        tag.attributes.get("name", "").strip()
        for tag in robot.find_all("link")
        if tag.find("inertial") is not None
    }
    return {name for name, link in links.items() if name in written and link.inertial is None}


def _with_known_leader(joint: Joint, model: Model, context: ReadContext) -> Joint:
    """Return the joint without a mimic that nothing can lead."""
    if joint.mimic is None:
        return joint
    leader = model.joint(joint.mimic.joint)
    if leader is not None and leader is not joint and leader.axis is not None and joint.axis:
        return joint
    if leader is None:
        reason = f"joint '{joint.mimic.joint}', which does not exist"
    elif leader is joint:
        reason = "itself"
    else:
        reason = f"'{leader.name}', but one of the two has no axis to move along"
    hint = did_you_mean(joint.mimic.joint, (item.name for item in model.joints if item.axis))
    message = f"joint '{joint.name}' mimics {reason}; it moves freely"
    context.diagnostics.report(
        "urdf.mimic-unknown", message, joint.span, fix=hint if leader is None else ""
    )
    return replace(joint, mimic=None)


def _canonical(root: str, links: tuple[Link, ...], joints: Mapping[str, ReadJoint]) -> str:
    if root != _WORLD:
        return root
    return next((item.joint.child for item in joints.values() if item.joint.parent == root), "")
