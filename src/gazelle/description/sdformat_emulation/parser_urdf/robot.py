"""A robot as urdfdom hands it to sdformat, read with everything the conversion needs and changes.

Whether it is accepted and what is said about it is the business of
`gazelle.description.urdfdom_emulation`; a part that is broken is left out here as it is there,
with all that follows it in its link.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import brief_text, exact_text
from gazelle.description.urdfdom_emulation.console import Console, Rejected
from gazelle.description.urdfdom_emulation.tinyxml import Element
from gazelle.description.urdfdom_emulation.values import (
    BadValueError,
    Origin,
    check_colour,
    number_of,
    origin_of,
    vector_of,
)
from gazelle.geometry import Vector3

__all__ = ["Inertial", "Joint", "Limits", "Link", "Mimic", "Part", "Robot", "Shape", "read_robot"]

Colour = tuple[float, float, float, float]
_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_WITHOUT_AXIS = ("floating", "fixed")
_PLAIN: Colour = (0.0, 0.0, 0.0, 1.0)


@dataclass(slots=True)
class Inertial:
    """Mass in kg and inertia in kg m² about the origin; `tensor` is ixx ixy ixz iyy iyz izz."""

    origin: Origin = field(default_factory=Origin)
    mass_kg: float = 0.0
    tensor: tuple[float, ...] = (0.0,) * 6


class Shape(NamedTuple):
    """A geometry: the element's name and the names and texts of what goes into it."""

    kind: str
    values: tuple[tuple[str, str], ...]


@dataclass(slots=True, eq=False)
class Part:
    """A visual or a collision; lumping moves it to another link and gives it a name.

    Attributes:
        name: as written, later with what lumping put before it.
        origin: pose in its link's frame.
        shape: its geometry.
        material: the name asked for, empty when there is none.
        colour: rgba of the material; None when it says nothing about looks.
    """

    name: str
    origin: Origin
    shape: Shape
    material: str = ""
    colour: Colour | None = None


@dataclass(slots=True)
class Limits:
    """A joint's limits in m or rad, N or N m, m/s or rad/s."""

    lower: float = 0.0
    upper: float = 0.0
    effort: float = 0.0
    velocity: float = 0.0


class Mimic(NamedTuple):
    """The joint that another one follows."""

    joint: str
    multiplier: float
    offset: float


@dataclass(slots=True, eq=False)
class Joint:
    """A joint; lumping changes where it is and what it hangs on.

    Attributes:
        name: unique.
        kind: revolute, continuous, prismatic, floating, planar or fixed.
        parent: name of the link above.
        child: name of the link below.
        T_parent_joint: its pose in the frame of the link above.
        axis: as written, not normalised.
        limits: None when there is no ``<limit>``.
        dynamics: damping and friction; None when there is no ``<dynamics>``.
        mimic: what it follows; None when there is no ``<mimic>``.
    """

    name: str
    kind: str
    parent: str
    child: str
    T_parent_joint: Origin
    axis: Vector3
    limits: Limits | None = None
    dynamics: tuple[float, float] | None = None
    mimic: Mimic | None = None


@dataclass(slots=True, eq=False)
class Link:
    """A link with what hangs on it, in order of the joints' names."""

    name: str
    inertial: Inertial | None = None
    visuals: list[Part] = field(default_factory=list)
    collisions: list[Part] = field(default_factory=list)
    parent: Link | None = None
    joint_above: Joint | None = None
    children: list[Link] = field(default_factory=list)


@dataclass(slots=True)
class Robot:
    """All links by name, and the one that is nobody's child."""

    name: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    root: Link


def read_robot(tag: Element, root: str) -> Robot:
    """Return the robot in a ``<robot>`` that urdfdom accepts; `root` is the root link's name."""
    links = {link.name: link for link in map(_link, tag.all("link"))}
    joints = {joint.name: joint for joint in map(_joint, tag.all("joint"))}
    _assign_materials(tag, links)
    for name in sorted(joints):
        joint = joints[name]
        child, parent = links[joint.child], links[joint.parent]
        child.parent, child.joint_above = parent, joint
        parent.children.append(child)
    return Robot(tag.attributes.get("name", ""), links, joints, links[root])


def _link(tag: Element) -> Link:
    link = Link(tag.attributes.get("name", ""))
    if "name" not in tag.attributes:
        return link
    inertial = tag.first("inertial")
    try:
        if inertial is not None:
            link.inertial = Inertial()
            _read_inertial(inertial, link.inertial)
        for child in tag.all("visual"):
            link.visuals.append(_visual(child))
        for child in tag.all("collision"):
            link.collisions.append(_part(child))
    except (BadValueError, Rejected):
        # What was read so far stays, a mass without its inertia too.
        return link
    return link


def _read_inertial(tag: Element, inertial: Inertial) -> None:
    inertial.origin = origin_of(tag, Console())
    inertial.mass_kg = _needed(tag.first("mass"), "value")
    inertia = tag.first("inertia")
    inertial.tensor = tuple(_needed(inertia, word) for word in _TENSOR)


def _needed(tag: Element | None, word: str) -> float:
    if tag is None or word not in tag.attributes:
        raise BadValueError(word)
    return number_of(tag.attributes[word])


def _part(tag: Element) -> Part:
    origin = origin_of(tag, Console())
    return Part(tag.attributes.get("name", ""), origin, _shape(tag.first("geometry")))


def _visual(tag: Element) -> Part:
    part = _part(tag)
    material = tag.first("material")
    if material is not None:
        if "name" not in material.attributes:
            raise BadValueError("name")
        part.material = material.attributes["name"]
        part.colour = _colour(material)
    return part


def _shape(geometry: Element | None) -> Shape:
    if geometry is None or not geometry.children:
        raise BadValueError("geometry")
    shape = geometry.children[0]
    if shape.name == "sphere":
        return Shape("sphere", (("radius", _size(shape, "radius")),))
    if shape.name == "cylinder":
        sizes = (("length", _size(shape, "length")), ("radius", _size(shape, "radius")))
        return Shape("cylinder", sizes)
    if shape.name == "box":
        return Shape("box", (("size", exact_text(vector_of(_attribute(shape, "size")))),))
    if shape.name == "mesh":
        return _mesh(shape)
    raise BadValueError(shape.name)


def _mesh(shape: Element) -> Shape:
    # ROS's packages are Gazebo's models; only the first such word in the name is replaced.
    uri = _attribute(shape, "filename").replace("package://", "model://", 1)
    scale = vector_of(shape.attributes.get("scale", "1 1 1"))
    return Shape("mesh", (("scale", brief_text(scale)), ("uri", uri)))


def _size(shape: Element, word: str) -> str:
    return exact_text([_needed(shape, word)])


def _attribute(tag: Element, word: str) -> str:
    if word not in tag.attributes:
        raise BadValueError(word)
    return tag.attributes[word]


def _assign_materials(robot: Element, links: dict[str, Link]) -> None:
    known: dict[str, Colour] = {}
    for tag in robot.all("material"):
        # A broken one is known all the same, black.
        known[tag.attributes.get("name", "")] = _colour(tag) or _PLAIN
    for tag in robot.all("link"):
        for part in links[tag.attributes.get("name", "")].visuals:
            if part.material in known and part.material:
                part.colour = known[part.material]
            elif part.material and part.colour is not None:
                known[part.material] = part.colour


def _colour(material: Element) -> Colour | None:
    """Return a material's colour in single precision; None when it has neither one nor an image."""
    texture, colour = material.first("texture"), material.first("color")
    has_image = texture is not None and "filename" in texture.attributes
    rgba = colour.attributes.get("rgba") if colour is not None else None
    if rgba is not None:
        try:
            check_colour(rgba)
        except BadValueError:
            return _PLAIN if has_image else None
        return _single_precision(rgba)
    return _PLAIN if has_image else None


def _single_precision(rgba: str) -> Colour:
    values = [number_of(piece) for piece in filter(None, rgba.split(" "))]
    if len(values) != 4:
        return _PLAIN
    r, g, b, a = struct.unpack("4f", struct.pack("4f", *values))
    return r, g, b, a


def _joint(tag: Element) -> Joint:
    kind = tag.attributes["type"]
    axis = tag.first("axis")
    direction = (1.0, 0.0, 0.0) if axis is None else (0.0, 0.0, 0.0)
    if axis is not None and "xyz" in axis.attributes and kind not in _WITHOUT_AXIS:
        direction = vector_of(axis.attributes["xyz"])
    ends = (_end(tag, "parent"), _end(tag, "child"))
    joint = Joint(tag.attributes["name"], kind, *ends, origin_of(tag, Console()), direction)
    limit, dynamics = tag.first("limit"), tag.first("dynamics")
    if limit is not None:
        names = ("lower", "upper", "effort", "velocity")
        joint.limits = Limits(*(_number(limit, word) for word in names))
    if dynamics is not None:
        joint.dynamics = (_number(dynamics, "damping"), _number(dynamics, "friction"))
    mimic = tag.first("mimic")
    if mimic is not None:
        multiplier = _number(mimic, "multiplier") if "multiplier" in mimic.attributes else 1.0
        joint.mimic = Mimic(mimic.attributes.get("joint", ""), multiplier, _number(mimic, "offset"))
    return joint


def _end(tag: Element, which: str) -> str:
    end = tag.first(which)
    return end.attributes.get("link", "") if end is not None else ""


def _number(tag: Element, word: str) -> float:
    text = tag.attributes.get(word)
    return number_of(text) if text is not None else 0.0
