"""A robot as urdfdom hands it to sdformat: links and joints that the conversion changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description.urdfdom_emulation.poses import Origin

__all__ = ["Inertial", "Joint", "Limits", "Link", "Mimic", "Part", "Robot", "Shape"]

Vector3 = tuple[float, float, float]
Colour = tuple[float, float, float, float]


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
