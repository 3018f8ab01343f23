"""A model as a URDF."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.writers.gazebo_tags import joint_block, link_block, model_blocks
from gazelle.description.writers.geometry_elements import with_surfaces_apart
from gazelle.description.writers.link_tree import Branches, branches_of
from gazelle.description.writers.output_files import Beside, Converted
from gazelle.description.writers.single_axis_joints import with_single_axes
from gazelle.description.writers.unscoped_names import (
    free_name,
    part_names,
    with_plain_names,
)
from gazelle.description.writers.urdf_elements import (
    LinkWriter,
    add_joint,
    add_origin,
    add_transmission,
)
from gazelle.description.writers.xml_markup import Markup, from_tag, head_comments, report_addresses
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["to_urdf"]

_SAME = 1e-12


def to_urdf(model: Model, *, diagnostics: Diagnostics, beside: Beside | None = None) -> Converted:
    """Write a model as a URDF.

    Every link's frame goes to the joint that holds it, as URDF demands, and everything in the
    link is expressed in it. Contact, sensors, lights and plug-ins become ``<gazebo>`` blocks.

    Args:
        model: any; SDF's own words are said in URDF's where that is possible.
        diagnostics: receives ``convert.…`` for everything that cannot be said or is said
            differently.
        beside: where the text will stand and how files are named; None for a text without files.

    Returns:
        The text, and meshes for shapes that URDF has no word for.
    """
    found = Diagnostics()
    company = beside or Beside()
    whole = with_single_axes(with_plain_names(model, found), found)
    whole = with_surfaces_apart(whole, found)
    branches = branches_of(whole)
    _report_branches(whole, branches, found)
    robot = Markup("robot", {"name": whole.name})
    if branches.root != "world":
        add_origin(robot, model.T_world_model @ branches.frames[branches.root])
    else:
        add_origin(robot, model.T_world_model)
        robot.add("link", name="world")
    _fill(robot, whole, branches, company, found)
    report_addresses(company, found)
    for item in found:
        diagnostics.add(item)
    source = Path(model.file).name if model.file else model.source_format.upper()
    return Converted(robot.to_text(head_comments(source, found)), company.files)


def _fill(
    robot: Markup, model: Model, branches: Branches, beside: Beside, diagnostics: Diagnostics
) -> None:
    writer = LinkWriter(beside, diagnostics, model.source_format == "urdf")
    blocks: list[Markup | None] = []
    start = len(robot.children)
    for link in model.links:
        shift = _between(branches.frames[link.name], link.T_model_link)
        writer.write(robot, link, shift)
        blocks.append(link_block(link, shift, beside, diagnostics))
    robot.children[start:start] = writer.material_tags()
    for joint in (*branches.joints, *_floating(model, branches)):
        parent, child = branches.frames[joint.parent], branches.frames[joint.child]
        add_joint(robot, joint, _between(parent, child), diagnostics)
        blocks.append(joint_block(joint, diagnostics))
    _add_frames(robot, model, branches, diagnostics)
    for transmission in model.transmissions:
        add_transmission(robot, transmission, diagnostics)
    robot.children += [from_tag(item.element) for item in model.ros2_controls]
    robot.children += [block for block in blocks if block is not None]
    robot.children += model_blocks(model, diagnostics)


def _between(first: Pose, second: Pose) -> Pose:
    """Return ``first⁻¹ · second``, exactly the identity where they agree to rounding."""
    if first == second:
        return IDENTITY_POSE
    pose = first.inverse() @ second
    x, y, z, w = pose.quat_xyzw
    small = max(map(abs, (*pose.position_m, x, y, z, abs(w) - 1.0)))
    return IDENTITY_POSE if small < _SAME else pose


def _floating(model: Model, branches: Branches) -> list[Joint]:
    """Return joints that hold loose links without holding anything."""
    taken = {joint.name for joint in model.joints}
    return [
        Joint(free_name(f"{name}_floating", taken), JointType.FLOATING, branches.root, name)
        for name in branches.loose
    ]


def _add_frames(robot: Markup, model: Model, branches: Branches, diagnostics: Diagnostics) -> None:
    """Append SDF's frames as links without mass, the way URDF names places."""
    links = {link.name for link in model.links}
    taken = part_names(model)
    for frame in model.frames:
        if frame.attached_to not in links:
            message = f"frame '{frame.name}' moves with no link of the robot; it is left out"
            diagnostics.report("convert.left-out", message, model.span)
            continue
        robot.add("link", name=frame.name)
        joint = Joint(
            free_name(f"{frame.name}_joint", taken),
            JointType.FIXED,
            frame.attached_to,
            frame.name,
        )
        place = branches.frames[frame.attached_to].inverse() @ frame.T_model_frame
        add_joint(robot, joint, place, diagnostics)


def _report_branches(model: Model, branches: Branches, diagnostics: Diagnostics) -> None:
    for joint in branches.loops:
        message = (
            f"joint '{joint.name}' between '{joint.parent}' and '{joint.child}' closes a kinematic "
            "loop; it is left out"
        )
        diagnostics.report("convert.loop", message, joint.span)
    for name in branches.turned:
        joint = next(item for item in model.joints if item.name == name)
        message = (
            f"joint '{name}' leads from '{joint.child}' to '{joint.parent}' in URDF, whose "
            "joints all lead away from one root; its axis is reversed, its positions stay"
        )
        diagnostics.report("convert.approximated", message, joint.span)
    for name in branches.loose:
        message = (
            f"nothing joins link '{name}' to '{branches.root}'; a floating joint does, for a URDF "
            "has one root"
        )
        link = model.link(name)
        diagnostics.report("convert.approximated", message, link.span if link else model.span)
    for joint in branches.joints:
        link = model.link(joint.child)
        if link is None or _between(branches.frames[link.name], link.T_model_link) == IDENTITY_POSE:
            continue
        message = (
            f"the frame of link '{link.name}' is at joint '{joint.name}' now, where URDF has it; "
            "shapes and sensors stay where they are"
        )
        diagnostics.report("convert.approximated", message, joint.span)
