"""A model as a URDF."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.writers.gazebo_tags import joint_block, link_block, model_blocks
from gazelle.description.writers.geometry_elements import with_surfaces_apart
from gazelle.description.writers.link_tree import LinkTree, link_tree_of
from gazelle.description.writers.output_files import Converted, OutputFiles
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


def to_urdf(
    model: Model, *, diagnostics: Diagnostics, output_files: OutputFiles | None = None
) -> Converted:
    """Write a model as a URDF.

    Every link's frame goes to the joint that holds it, as URDF demands, and everything in the
    link is expressed in it. Contact, sensors, lights and plug-ins become ``<gazebo>`` blocks.

    Args:
        model: any; SDF's own words are said in URDF's where that is possible.
        diagnostics: receives ``convert.…`` for everything that cannot be said or is said
            differently.
        output_files: where the text will stand, how files are named; None for no files.

    Returns:
        The text, and meshes for shapes that URDF has no word for.
    """
    found = Diagnostics()
    outputs = output_files or OutputFiles()
    whole = with_single_axes(with_plain_names(model, found), found)
    whole = with_surfaces_apart(whole, found)
    tree = link_tree_of(whole)
    _report_branches(whole, tree, found)
    robot = Markup("robot", {"name": whole.name})
    if tree.root != "world":
        add_origin(robot, model.T_world_model @ tree.frames[tree.root])
    else:
        add_origin(robot, model.T_world_model)
        robot.add("link", name="world")
    _fill(robot, whole, tree, outputs, found)
    report_addresses(outputs, found)
    for item in found:
        diagnostics.add(item)
    source = Path(model.file).name if model.file else model.source_format.upper()
    return Converted(robot.to_text(head_comments(source, found)), outputs.files)


def _fill(
    robot: Markup, model: Model, tree: LinkTree, output_files: OutputFiles, diagnostics: Diagnostics
) -> None:
    writer = LinkWriter(output_files, diagnostics, model.source_format == "urdf")
    blocks: list[Markup | None] = []
    start = len(robot.children)
    for link in model.links:
        shift = _between(tree.frames[link.name], link.T_model_link)
        writer.write(robot, link, shift)
        blocks.append(link_block(link, shift, output_files, diagnostics))
    robot.children[start:start] = writer.material_tags()
    for joint in (*tree.joints, *_floating(model, tree)):
        parent, child = tree.frames[joint.parent], tree.frames[joint.child]
        add_joint(robot, joint, _between(parent, child), diagnostics)
        blocks.append(joint_block(joint, diagnostics))
    _add_frames(robot, model, tree, diagnostics)
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


def _floating(model: Model, tree: LinkTree) -> list[Joint]:
    """Return joints that hold loose links without holding anything."""
    taken = {joint.name for joint in model.joints}
    return [
        Joint(free_name(f"{name}_floating", taken), JointType.FLOATING, tree.root, name)
        for name in tree.loose
    ]


def _add_frames(robot: Markup, model: Model, tree: LinkTree, diagnostics: Diagnostics) -> None:
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
        T_link_frame = tree.frames[frame.attached_to].inverse() @ frame.T_model_frame
        add_joint(robot, joint, T_link_frame, diagnostics)


def _report_branches(model: Model, tree: LinkTree, diagnostics: Diagnostics) -> None:
    for joint in tree.loops:
        message = (
            f"joint '{joint.name}' between '{joint.parent}' and '{joint.child}' closes a kinematic "
            "loop; it is left out"
        )
        diagnostics.report("convert.loop", message, joint.span)
    for name in tree.turned:
        joint = next(item for item in model.joints if item.name == name)
        message = (
            f"joint '{name}' leads from '{joint.child}' to '{joint.parent}' in URDF, whose "
            "joints all lead away from one root; its axis is reversed, its positions stay"
        )
        diagnostics.report("convert.approximated", message, joint.span)
    for name in tree.loose:
        message = (
            f"nothing joins link '{name}' to '{tree.root}'; a floating joint does, for a URDF "
            "has one root"
        )
        link = model.link(name)
        diagnostics.report("convert.approximated", message, link.span if link else model.span)
    for joint in tree.joints:
        link = model.link(joint.child)
        if link is None or _between(tree.frames[link.name], link.T_model_link) == IDENTITY_POSE:
            continue
        message = (
            f"the frame of link '{link.name}' is at joint '{joint.name}' now, where URDF has it; "
            "shapes and sensors stay where they are"
        )
        diagnostics.report("convert.approximated", message, joint.span)
