"""What lumping does to ``<gazebo>`` blocks: new link names, new poses, new offsets.

The two releases differ in every part of it. sdformat 9 forgets the pose a sensor had; sdformat 12
keeps it, and no longer finds the link names inside contact sensors, grippers and joints.
"""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import chained, composed
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    brief_text,
    streamed_numbers,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import remove, value_of
from gazelle.description.sdformat_emulation.parser_urdf.extensions import Blob, Extensions
from gazelle.description.sdformat_emulation.parser_urdf.offsets import replace_body
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.poses import Origin
from gazelle.description.urdfdom_emulation.values import quaternion_from_rpy, rpy_from_quaternion

__all__ = ["move_extensions"]

_PLACED = ("sensor", "projector")
_NO_POSE = "0 0 0 0 0 0"


def move_extensions(
    link: str, parent: str, T_parent_link: Origin, extensions: Extensions, console: Console
) -> None:
    """Hand a lumped link's blocks to its parent and rename the link in all blocks."""
    by_reference = extensions.by_reference
    if link in by_reference:
        for extension in by_reference[link]:
            extension.T_link_reduced = chained(T_parent_link, extension.T_link_reduced)
            for blob in extension.blobs:
                _move(blob, extension.T_link_reduced, console)
        moved = by_reference[link]
        by_reference[link] = []
        by_reference.setdefault(parent, []).extend(moved)
    for reference in sorted(by_reference):
        for extension in by_reference[reference]:
            for blob in extension.blobs:
                for word in ("bodyName", "frameName"):
                    poses = (extension.T_link_reduced, T_parent_link)
                    replace_body(blob.element, word, (link, parent), poses, console)
                _rename(blob, link, parent, console)


def _move(blob: Blob, T_link_reduced: Origin, console: Console) -> None:
    element = blob.element
    if element.name not in _PLACED:
        return
    if console.release is Release.V9:
        _drop_first(element, "pose")
        pose: Origin | None = T_link_reduced
    else:
        pose = _kept_pose(blob, T_link_reduced, console)
    if pose is not None:
        rpy = rpy_from_quaternion(pose.quat_xyzw)
        element.add("pose", f"{brief_text(pose.xyz_m)} {brief_text(rpy)}")


def _kept_pose(blob: Blob, T_link_reduced: Origin, console: Console) -> Origin | None:
    """Return where a sensor is in the parent; None when its pose stays as it is."""
    element, kind = blob.element, blob.element.name
    text = _NO_POSE
    old = element.find("pose")
    if old is not None:
        if "relative_to" in old.attributes:
            return None
        if old.text and blob.first_pose is None:
            text = old.text
        elif blob.first_pose is not None:
            text = blob.first_pose
        else:
            message = f"Unexpected case in {kind} pose computation"
            console.error(f"{kind} without pose", message)
            return None
        remove(element, old)
    numbers = streamed_numbers(text, 6)
    if numbers is None:
        console.error(f"bad {kind} pose", f"Could not parse <{kind}><pose>: [{text}]")
        return None
    if blob.first_pose is None:
        blob.first_pose = text
    x, y, z, roll, pitch, yaw = numbers
    own = Origin((x, y, z), quaternion_from_rpy((roll, pitch, yaw)))
    return composed(T_link_reduced, own)


def _rename(blob: Blob, link: str, parent: str, console: Console) -> None:
    element = blob.element
    if console.release.is_new:
        # It looks beside the element instead of inside: only a bare <projector> is ever found.
        if element.name == "projector":
            replaced = _renamed_projector(element, link, parent, console)
            blob.element = replaced or element
        return
    if element.name == "sensor":
        contact = element.find("contact")
        if contact is not None:
            names = (f"{link}_collision", f"{parent}_collision_{link}")
            _replace_text(contact, "collision", *names, console)
    projector = element.find("projector")
    if projector is not None:
        replaced = _renamed_projector(projector, link, parent, console)
        if replaced is not None:
            remove(element, projector)
            element.children.append(replaced)
    words = {"gripper": ("gripper_link", "palm_link"), "joint": ("parent", "child")}
    for word in words.get(element.name, ()):
        _replace_text(element, word, link, parent, console)


def _renamed_projector(
    projector: SdfElement, link: str, parent: str, console: Console
) -> SdfElement | None:
    value = value_of(projector, console)
    owner, slash, name = value.partition("/")
    if not slash:
        message = f"no slash in projector reference tag [{value}], expecting"
        console.error("no slash", f"{message} linkName/projector_name.")
    elif owner == link:
        return SdfElement("projector", {}, f"{parent}/{name}")
    return None


def _replace_text(owner: SdfElement, name: str, old: str, new: str, console: Console) -> None:
    child = owner.find(name)
    if child is not None and value_of(child, console) == old:
        remove(owner, child)
        owner.add(name, new)


def _drop_first(owner: SdfElement, name: str) -> None:
    child = owner.find(name)
    if child is not None:
        remove(owner, child)
