"""A whole file as urdfdom 3.0.1 reads it: what it accepts, refuses and says on the way."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description.urdfdom_emulation.console import Console, Rejected, Remark
from gazelle.description.urdfdom_emulation.joints import ReadJoint, read_joint
from gazelle.description.urdfdom_emulation.links import VisualMaterial, check_material, read_link
from gazelle.description.urdfdom_emulation.tinyxml import Element, TinyXmlError, parse_tinyxml

__all__ = ["Robot", "Verdict", "urdfdom_verdict", "verdict_of_element"]

_INTEGER = re.compile(r"[ \t\n\v\f\r]*[+-]?[0-9]+")


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot that urdfdom accepts, by its names.

    Attributes:
        name: the robot's.
        root: the one link that is nobody's child.
        children: link → the links that hang on it, in order of the joints' names.
        joint_above: link → the joint it hangs on; with several parents the last by name.
    """

    name: str
    root: str
    children: dict[str, list[str]] = field(default_factory=dict)
    joint_above: dict[str, ReadJoint] = field(default_factory=dict)


class Verdict(NamedTuple):
    """What urdfdom makes of a text.

    Attributes:
        robot: None when it refuses the file.
        remarks: what it writes to standard error, in order.
    """

    robot: Robot | None
    remarks: tuple[Remark, ...]


def urdfdom_verdict(text: str) -> Verdict:
    """Return what urdfdom 3.0.1 (Debian 12, Ubuntu 22.04) makes of a robot description.

    It passes much that is wrong, such as two parents of a link or a negative mass, and refuses
    some of what later versions take; `read_urdf` has the findings that matter for a simulation.
    """
    console = Console()
    try:
        robot = _read_robot(_robot_tag(text, console), console)
    except Rejected:
        robot = None
    return Verdict(robot, tuple(console.remarks))


def verdict_of_element(tag: Element) -> Verdict:
    """Return the verdict on an outermost element that another parser has read."""
    console = Console()
    try:
        robot = _read_robot(_named_robot([tag], console), console)
    except Rejected:
        robot = None
    return Verdict(robot, tuple(console.remarks))


def _read_robot(tag: Element, console: Console) -> Robot:
    name = tag.attributes.get("name")
    if name is None:
        raise console.reject(("model", 118), "No name given for the robot.")
    mistake = _version_mistake(tag.attributes.get("version"))
    if mistake:
        raise console.reject(("model", 134), mistake)
    materials = _read_materials(tag, console)
    links = _read_links(tag, materials, console)
    joints = _read_joints(tag, console)
    robot = Robot(name, "")
    for joint in sorted(joints.values(), key=lambda item: item.name):
        _hang(robot, joint, links, console)
    return Robot(name, _root_of(robot, links, console), robot.children, robot.joint_above)


def _robot_tag(text: str, console: Console) -> Element:
    try:
        top = parse_tinyxml(text)
    except TinyXmlError as error:
        raise console.reject(("model", 100), str(error)) from None
    return _named_robot(top, console)


def _named_robot(top: list[Element], console: Console) -> Element:
    tag = next((item for item in top if item.name == "robot"), None)
    if tag is None:
        message = "Could not find the 'robot' element in the xml file"
        raise console.reject(("model", 109), message)
    return tag


def _version_mistake(text: str | None) -> str:
    """Return what is wrong with a version, empty when it is 1.0 or not written."""
    if text is None:
        return ""
    # A separator at the very end has no part behind it in urdfdom.
    parts = text.removesuffix(".").split(".") if text else []
    if len(parts) != 2:
        return "The version attribute should be in the form 'x.y'"
    for part in parts:
        mistake = _number_mistake(part)
        if mistake:
            return mistake
    if [int(part) for part in parts] != [1, 0]:
        return "Invalid 'version' specified; only version 1.0 is currently supported"
    return ""


def _number_mistake(part: str) -> str:
    found = _INTEGER.match(part)
    if not part:
        return "One of the fields of the version attribute is blank"
    if found is None:
        return "Version attribute is not an integer"
    if found.end() < len(part):
        return "Extra characters after the version number"
    return "Version number must be positive" if int(part) < 0 else ""


def _read_materials(robot: Element, console: Console) -> set[str]:
    names: set[str] = set()
    for tag in robot.all("material"):
        check_material(tag, console, name_is_enough=False)
        name = tag.attributes.get("name", "")
        if name in names:
            raise console.reject(("model", 149), f"material '{name}' is not unique.")
        names.add(name)
    return names


def _read_links(robot: Element, materials: set[str], console: Console) -> set[str]:
    names: set[str] = set()
    for tag in robot.all("link"):
        link = read_link(tag, console)
        if link.name in names:
            raise console.reject(("model", 178), f"link '{link.name}' is not unique.")
        for material in link.visuals:
            _look_up(material, link.name, materials, console)
        names.add(link.name)
    if not names:
        raise console.reject(("model", 206), "No link elements found in urdf file")
    return names


def _look_up(material: VisualMaterial, link: str, materials: set[str], console: Console) -> None:
    if not material.name or material.name in materials:
        return
    if material.is_defined:
        materials.add(material.name)
        return
    message = f"link '{link}' material '{material.name}' undefined."
    console.warning(("model", 84), message)


def _read_joints(robot: Element, console: Console) -> dict[str, ReadJoint]:
    joints: dict[str, ReadJoint] = {}
    for tag in robot.all("joint"):
        try:
            joint = read_joint(tag, console)
        except Rejected:
            message = "joint xml is not initialized correctly"
            raise console.reject(("model", 233), message) from None
        if joint.name in joints:
            raise console.reject(("model", 221), f"joint '{joint.name}' is not unique.")
        joints[joint.name] = joint
    return joints


def _hang(robot: Robot, joint: ReadJoint, links: set[str], console: Console) -> None:
    mistake = ""
    if not joint.parent or not joint.child:
        mistake = f"Joint [{joint.name}] is missing a parent and/or child link specification."
    elif joint.child not in links:
        mistake = f"child link [{joint.child}] of joint [{joint.name}] not found"
    elif joint.parent not in links:
        mistake = _no_parent(joint)
    if mistake:
        raise console.reject(("model", 252), f"Failed to build tree: {mistake}")
    robot.children.setdefault(joint.parent, []).append(joint.child)
    robot.joint_above[joint.child] = joint


def _no_parent(joint: ReadJoint) -> str:
    return (
        f"parent link [{joint.parent}] of joint [{joint.name}] not found.  "
        "This is not valid according to the URDF spec. Every link you refer to from a joint "
        "needs to be explicitly defined in the robot description. To fix this problem you can "
        f"either remove this joint [{joint.name}] from your urdf file, or add "
        f'"<link name="{joint.parent}" />" to your urdf file.'
    )


def _root_of(robot: Robot, links: set[str], console: Console) -> str:
    roots = sorted(links - robot.joint_above.keys())
    if len(roots) == 1:
        return roots[0]
    if roots:
        mistake = f"Two root links found: [{roots[0]}] and [{roots[1]}]"
    else:
        mistake = "No root link found. The robot xml is not a valid tree."
    raise console.reject(("model", 264), f"Failed to find root link: {mistake}")
