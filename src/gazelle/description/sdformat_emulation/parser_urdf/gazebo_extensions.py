"""``<gazebo>`` blocks of a robot description, sorted by what they refer to, and what lumping does.

Lumping gives them new link names, new poses and new offsets; plug-ins that name a lumped link get
its parent's name and an offset. The two releases differ in every part of it. sdformat 9 forgets the
pose a sensor had; sdformat 12 keeps it, and no longer finds the link names inside contact sensors,
grippers and joints.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import (
    chained,
    composed,
    composed_by_inverse,
)
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    NumberCrashError,
    brief_text,
    leading_integer,
    leading_number,
    streamed_numbers,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import element_of, remove, value_of
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.values import (
    Origin,
    quaternion_from_rpy,
    rpy_from_quaternion,
)
from gazelle.description.xml import Tag
from gazelle.geometry import Vector3

__all__ = [
    "Blob",
    "Extension",
    "Extensions",
    "move_extensions",
    "read_extensions",
    "vector_from",
]

_NUMBERS = frozenset(
    {
        "dampingFactor",
        "fudgeFactor",
        "kd",
        "kp",
        "laserRetro",
        "maxVel",
        "minDepth",
        "mu1",
        "mu2",
        "springReference",
        "springStiffness",
        "stopCfm",
        "stopErp",
    }
)
_SWITCHES = {
    "cfmDamping": "implicitSpringDamper",
    "implicitSpringDamper": "implicitSpringDamper",
    "provideFeedback": "provideFeedback",
    "selfCollide": "selfCollide",
    "static": "static",
}
_DEPRECATED = (
    "Note that cfmDamping is being deprecated by implicitSpringDamper, please replace instances "
    "of cfmDamping with implicitSpringDamper in your model."
)
_ZERO: Vector3 = (0.0, 0.0, 0.0)
_CORRECTED = "ignition::corrected_offsets"
_PLACED = ("sensor", "projector")
_NO_POSE = "0 0 0 0 0 0"


@dataclass(slots=True)
class Blob:
    """An element that goes into the SDF as it is.

    Attributes:
        element: the element itself.
        first_pose: text of the pose it had before it was first moved to another link.
    """

    element: SdfElement
    first_pose: str | None = None


@dataclass(slots=True)
class Extension:
    """One ``<gazebo>`` block.

    Attributes:
        link: what it referred to before lumping; empty when it has no children.
        material: name of a Gazebo material.
        fdir1: text of the friction direction.
        numbers: values by the URDF's element names.
        switches: truth values by the URDF's element names.
        has_gravity: what ``<turnGravityOff>`` says, None when it is not there.
        blobs: what is not known to the conversion.
        collisions: what stands in ``<collision>``, for every collision of the link.
        visuals: what stands in ``<visual>``, for every visual of the link.
        T_link_reduced: where the link it was written for is in the link it was lumped into.
    """

    link: str = ""
    material: str = ""
    fdir1: str = ""
    numbers: dict[str, float] = field(default_factory=dict)
    switches: dict[str, bool] = field(default_factory=dict)
    has_gravity: bool | None = None
    blobs: list[Blob] = field(default_factory=list)
    collisions: list[SdfElement] = field(default_factory=list)
    visuals: list[SdfElement] = field(default_factory=list)
    T_link_reduced: Origin = field(default_factory=Origin)


@dataclass(slots=True)
class Extensions:
    """All blocks of a description.

    Attributes:
        by_reference: blocks by link or joint; empty for the robot itself.
        kept_fixed: fixed joints that stay fixed joints.
        kept_revolute: fixed joints that become revolute ones without any freedom.
    """

    by_reference: dict[str, list[Extension]] = field(default_factory=dict)
    kept_fixed: set[str] = field(default_factory=set)
    kept_revolute: set[str] = field(default_factory=set)


def read_extensions(robot: Tag, console: Console) -> Extensions:
    """Read the ``<gazebo>`` blocks of a ``<robot>``.

    Raises:
        NumberCrashError: the library ends the program at one of the numbers.
    """
    extensions = Extensions()
    for tag in robot.find_all("gazebo"):
        reference = tag.attributes.get("reference", "")
        extension = Extension(reference if tag.children else "")
        for child in tag.children:
            element = element_of(child, console.release)
            if not _joint_is_kept(element, reference, extensions, console):
                _read(element, extension, console)
        extensions.by_reference.setdefault(reference, []).append(extension)
    extensions.kept_revolute -= extensions.kept_fixed
    return extensions


def vector_from(text: str, scale: float, console: Console) -> Vector3:
    """Return three numbers with spaces between them, zeros when they are none or not three.

    Raises:
        NumberCrashError: one of them is beyond any double.
    """
    values: list[float] = []
    for index, piece in enumerate(text.split(" ")):
        if not piece:
            continue
        try:
            values.append(scale * leading_number(piece))
        except NumberCrashError as crash:
            if crash.kind != "invalid_argument":
                raise
            message = f"xml key [{text}][{index}] value [{piece}]"
            console.error("no vector", f"{message} is not a valid double from a 3-tuple")
            return _ZERO
    return (values[0], values[1], values[2]) if len(values) == 3 else _ZERO


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
                    _replace_body(blob.element, word, (link, parent), poses, console)
                _rename(blob, link, parent, console)


def _replace_body(
    plugin: SdfElement,
    word: str,
    links: tuple[str, str],
    poses: tuple[Origin, Origin],
    console: Console,
) -> None:
    """Replace a link's name in a plug-in's ``bodyName`` or ``frameName``, and shift its offsets.

    Args:
        plugin: an element; anything but a ``<plugin>`` stays as it is.
        word: name of the child.
        links: the lumped link and its parent.
        poses: where the block's own link went by lumping, and the lumped link in its parent.
        console: receives complaints about the offsets.

    Raises:
        NumberCrashError: an offset is beyond any double.
    """
    child = plugin.find(word) if plugin.name == "plugin" else None
    if child is None or value_of(child, console) != links[0]:
        return
    is_v9 = console.release is Release.V9
    remove(plugin, child)
    plugin.add(word, links[1])
    offset = _offset(plugin, poses[0], console)
    moved = (composed_by_inverse if is_v9 else chained)(poses[1], offset)
    plugin.add("xyzOffset", brief_text(moved.xyz_m))
    plugin.add("rpyOffset", brief_text(rpy_from_quaternion(moved.quat_xyzw)))
    if not is_v9:
        plugin.add(_CORRECTED, "1")


def _joint_is_kept(
    element: SdfElement, reference: str, extensions: Extensions, console: Console
) -> bool:
    kept = {
        "disableFixedJointLumping": extensions.kept_revolute,
        "preserveFixedJoint": extensions.kept_fixed,
    }.get(element.name)
    if kept is None:
        return False
    if _is_true(value_of(element, console)):
        kept.add(reference)
    return True


def _read(element: SdfElement, extension: Extension, console: Console) -> None:
    name = element.name
    if name == "material":
        extension.material = value_of(element, console)
    elif name == "fdir1":
        extension.fdir1 = value_of(element, console)
    elif name == "collision":
        extension.collisions += element.children
    elif name == "visual":
        extension.visuals += element.children
    elif name in _NUMBERS:
        extension.numbers[name] = leading_number(value_of(element, console))
    elif name == "maxContacts":
        extension.numbers[name] = leading_integer(value_of(element, console))
    elif name == "turnGravityOff":
        word = value_of(element, console)
        extension.has_gravity = word.lower() in ("false", "no") or word == "0"
    elif name in _SWITCHES:
        if name == "cfmDamping":
            console.warning("cfmDamping", _DEPRECATED)
        extension.switches[_SWITCHES[name]] = _is_true(value_of(element, console))
    elif name != "canonicalBody":
        extension.blobs.append(Blob(element))


def _is_true(word: str) -> bool:
    return word.lower() in ("true", "yes") or word == "1"


def _offset(plugin: SdfElement, offset: Origin, console: Console) -> Origin:
    """Take the written offsets out of a plug-in; what is not written stays as given."""
    is_v9 = console.release is Release.V9
    xyz = plugin.find("xyzOffset")
    if xyz is not None:
        offset = offset._replace(xyz_m=vector_from(value_of(xyz, console), 1.0, console))
        remove(plugin, xyz)
    rpy = plugin.find("rpyOffset")
    if rpy is not None:
        # Degrees in sdformat 9, though every plug-in's documentation says radians.
        scale = math.pi / 180.0 if is_v9 else 1.0
        angles = vector_from(value_of(rpy, console), scale, console)
        offset = offset._replace(quat_xyzw=quaternion_from_rpy(angles))
        remove(plugin, rpy)
    corrected = plugin.find(_CORRECTED)
    if corrected is not None and not is_v9:
        remove(plugin, corrected)
    return offset


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
    references = {"gripper": ("gripper_link", "palm_link"), "joint": ("parent", "child")}
    for word in references.get(element.name, ()):
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
