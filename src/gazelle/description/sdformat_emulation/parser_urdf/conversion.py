"""The conversion as a whole."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    NumberCrashError,
    exact_text,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import set_value
from gazelle.description.sdformat_emulation.parser_urdf.extensions import read_extensions
from gazelle.description.sdformat_emulation.parser_urdf.lumping import (
    EndlessRobotError,
    lump_fixed_joints,
)
from gazelle.description.sdformat_emulation.parser_urdf.model import WorldCrashError, model_of
from gazelle.description.sdformat_emulation.parser_urdf.offsets import vector_from
from gazelle.description.sdformat_emulation.parser_urdf.reading import read_robot
from gazelle.description.sdformat_emulation.parser_urdf.robot import Robot
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation import element_of, verdict_of_element
from gazelle.description.urdfdom_emulation.values import quaternion_from_rpy, rpy_from_quaternion
from gazelle.description.xml import Tag

__all__ = ["accepted_robot", "urdf_to_sdf"]

Vector3 = tuple[float, float, float]

# URDFs are written as this version by both releases; sdformat 12 upgrades it while reading.
_VERSION = "1.7"
_CRASH = "Segmentation fault"


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
