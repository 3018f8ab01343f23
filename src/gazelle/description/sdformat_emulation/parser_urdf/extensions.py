"""``<gazebo>`` blocks of a robot description, sorted by what they refer to."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    leading_integer,
    leading_number,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import element_of, value_of
from gazelle.description.urdfdom_emulation.poses import Origin
from gazelle.description.xml import Tag

__all__ = ["Blob", "Extension", "Extensions", "read_extensions"]

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
