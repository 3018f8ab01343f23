"""A robot description as SDF: the conversion as a whole, and the model that it makes."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from typing import NamedTuple

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    NumberCrashError,
    exact_text,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import copied, set_value
from gazelle.description.sdformat_emulation.parser_urdf.gazebo_extensions import (
    Extension,
    Extensions,
    read_extensions,
    vector_from,
)
from gazelle.description.sdformat_emulation.parser_urdf.joints import add_joint
from gazelle.description.sdformat_emulation.parser_urdf.link_elements import (
    add_collisions,
    add_inertial,
    add_visuals,
)
from gazelle.description.sdformat_emulation.parser_urdf.reduce_fixed_joints import (
    EndlessRobotError,
    is_reduced,
    lump_fixed_joints,
    warn_of_massless,
)
from gazelle.description.sdformat_emulation.parser_urdf.robot import Link, Robot, read_robot
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation import element_of, verdict_of_element
from gazelle.description.urdfdom_emulation.values import quaternion_from_rpy, rpy_from_quaternion
from gazelle.description.xml import Tag
from gazelle.geometry import Vector3

__all__ = [
    "Fate",
    "Visit",
    "WorldCrashError",
    "accepted_robot",
    "model_of",
    "urdf_to_sdf",
    "visits",
]

_WORLD = "world"
# The library takes masses up to this for none.
_NO_MASS_KG = 1e-6
# URDFs are written as this version by both releases; sdformat 12 upgrades it while reading.
_VERSION = "1.7"
_CRASH = "Segmentation fault"


class WorldCrashError(ValueError):
    """The library reads the inertia that a link called ``world`` does not have, and crashes."""


class Fate(enum.Enum):
    """What becomes of a link that the conversion comes to."""

    MODELLED = "modelled"
    LUMPED = "lumped"
    WITHOUT_INERTIAL = "without inertial"
    WITHOUT_MASS = "without mass"


class Visit(NamedTuple):
    """A link and its fate; what hangs on one without inertia or mass is never visited."""

    link: Link
    fate: Fate


def model_of(robot: Robot, extensions: Extensions, console: Console) -> SdfElement:
    """Return the ``<model>``.

    Raises:
        WorldCrashError: see there.
    """
    model = SdfElement("model", {"name": robot.name})
    for link, fate in visits(robot, extensions, console.release):
        if fate is Fate.MODELLED:
            _add_link(model, link, extensions, console)
        elif fate is not Fate.LUMPED and console.release is Release.V14:
            warn_of_massless(link, fate is Fate.WITHOUT_INERTIAL, console)
    for extension in extensions.by_reference.get("", ()):
        is_static = extension.switches.get("static", False)
        # sdformat 14 says it only where it is asked for.
        if "static" in extension.switches or console.release is not Release.V14:
            set_value(model, "static", "true" if is_static else "false", console)
        model.children += [copied(blob.element) for blob in extension.blobs]
    return model


def visits(robot: Robot, extensions: Extensions, release: Release = Release.V12) -> Iterator[Visit]:
    """Yield the links from the root down, children in order of the joints' names."""
    is_world = robot.root.name == _WORLD
    waiting = robot.root.children[::-1] if is_world else [robot.root]
    while waiting:
        link = waiting.pop()
        fate = _fate(link, extensions, release)
        yield Visit(link, fate)
        if fate in (Fate.MODELLED, Fate.LUMPED):
            waiting += link.children[::-1]


def urdf_to_sdf(
    root: Tag, *, release: Release = Release.V12, remarks: list[str] | None = None
) -> SdfElement | None:
    """Convert a robot description as sdformat's parser_urdf does.

    What is written down is sdformat 12.3.0's (Debian 12) and 9.3.0's (Gazebo 11 of Debian 11)
    behaviour, peculiarities included: sdformat 9 forgets the pose of a lumped link's sensor, both
    let everything disappear that hangs on a lumped link without inertia. Later releases of both
    series differ in some of them. Of sdformat 14 there is what a user meets: ``<mimic>``, frames in
    place of lumped links, which need no mass, and ``<static>`` only where it is asked for.

    Args:
        root: the ``<robot>``, xacro already expanded.
        release: whose behaviour.
        remarks: receives what the library prints to standard error, colours included and urdfdom's
            remarks first; these come twice, as it reads every file twice.

    Returns:
        ``<sdf version="1.7"><model>…``, as the library hands it to its SDF parser; None when it
        refuses the description or crashes at it.
    """
    said = remarks if remarks is not None else []
    element = element_of(root)
    verdict = verdict_of_element(element)
    readings = 1 if verdict.robot is None else 2
    said += [str(remark) for remark in verdict.remarks] * readings
    if verdict.robot is None:
        return None
    try:
        return _converted(root, read_robot(element, verdict.robot.root), Console(release, said))
    except NumberCrashError as crash:
        said.append(str(crash))
    except (EndlessRobotError, WorldCrashError):
        said.append(_CRASH)
    return None


def accepted_robot(root: Tag) -> Robot | None:
    """Return the robot as urdfdom sees it, None when it refuses the description."""
    element = element_of(root)
    found = verdict_of_element(element).robot
    return read_robot(element, found.root) if found is not None else None


def _fate(link: Link, extensions: Extensions, release: Release) -> Fate:
    hangs_on_world = link.parent is not None and link.parent.name == _WORLD
    joint = None if hangs_on_world else link.joint_above
    lumped = joint is not None and is_reduced(joint, extensions)
    # Since sdformat 14 a lumped link needs no mass: it is no link any more.
    if link.name != _WORLD and not (lumped and release is Release.V14):
        if link.inertial is None:
            return Fate.WITHOUT_INERTIAL
        mass_kg = link.inertial.mass_kg
        if mass_kg <= 0 if release is Release.V14 else abs(mass_kg) <= _NO_MASS_KG:
            return Fate.WITHOUT_MASS
    return Fate.LUMPED if lumped else Fate.MODELLED


def _add_link(model: SdfElement, link: Link, extensions: Extensions, console: Console) -> None:
    if link.inertial is None:
        raise WorldCrashError(link.name)
    element = SdfElement("link", {"name": link.name})
    if link.joint_above is not None:
        element.add("pose").attributes["relative_to"] = link.joint_above.name
    add_inertial(element, link.inertial)
    add_collisions(element, link, extensions, console)
    add_visuals(element, link, extensions, console)
    for extension in extensions.by_reference.get(link.name, ()):
        _extend(element, extension, console)
    add_joint(model, link, extensions, console)
    model.children.append(element)


def _extend(link: SdfElement, extension: Extension, console: Console) -> None:
    is_v9 = console.release is Release.V9
    # sdformat 9 says this for every block, whether it is asked for or not.
    if extension.has_gravity is not None or is_v9:
        text = "false" if extension.has_gravity is False else "true"
        set_value(link, "gravity", text, console)
    factor = extension.numbers.get("dampingFactor")
    if factor is not None or is_v9:
        decay = link.add("velocity_decay")
        for name in ("linear", "angular") if factor is not None else ():
            decay.add(name, exact_text([factor or 0.0]))
    if "selfCollide" in extension.switches:
        text = "1" if extension.switches["selfCollide"] else "0"
        set_value(link, "self_collide", text, console)
    link.children += [copied(blob.element) for blob in extension.blobs]


def _converted(root: Tag, robot: Robot, console: Console) -> SdfElement:
    extensions = read_extensions(root, console)
    origin = root.find("origin")
    pose = _robot_pose(origin, console) if origin is not None else None
    lump_fixed_joints(robot, extensions, console)
    model = model_of(robot, extensions, console)
    if pose is not None:
        set_value(model, "pose", pose, console)
    return SdfElement("sdf", {"version": _VERSION}, children=[model])


def _robot_pose(origin: Tag, console: Console) -> str:
    xyz = _vector(origin.attributes.get("xyz"), console)
    rpy = _vector(origin.attributes.get("rpy"), console)
    return exact_text((*xyz, *rpy_from_quaternion(quaternion_from_rpy(rpy))))


def _vector(text: str | None, console: Console) -> Vector3:
    return vector_from(text, 1.0, console) if text is not None else (0.0, 0.0, 0.0)
