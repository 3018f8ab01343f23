"""Visuals, collisions and inertials of a link as SDF."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import euler_of
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import exact_text
from gazelle.description.sdformat_emulation.parser_urdf.extensions import Extensions
from gazelle.description.sdformat_emulation.parser_urdf.part_extensions import (
    extend_collision,
    extend_visual,
)
from gazelle.description.sdformat_emulation.parser_urdf.robot import Inertial, Link, Part
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.poses import Origin
from gazelle.description.urdfdom_emulation.values import rpy_from_quaternion

__all__ = ["add_collisions", "add_inertial", "add_visuals", "pose_text"]

_LUMPED = "_fixed_joint_lump__"
_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")

# What Gazebo's own materials do to a colour; URDF has one where SDF has several.
_DIFFUSE = 0.8
_AMBIENT = 0.4


def add_inertial(owner: SdfElement, inertial: Inertial) -> None:
    """Append an ``<inertial>``."""
    element = owner.add("inertial")
    element.add("pose", pose_text(inertial.origin))
    element.add("mass", exact_text([inertial.mass_kg]))
    tensor = element.add("inertia")
    for name, value in zip(_TENSOR, inertial.tensor, strict=True):
        tensor.add(name, exact_text([value]))


def add_collisions(owner: SdfElement, link: Link, extensions: Extensions, console: Console) -> None:
    """Append a link's collisions, lumped ones included."""
    for index, part in enumerate(link.collisions):
        element = _part(owner, "collision", link, part, index)
        _add_geometry(element, part, console)
        extend_collision(element, link.name, extensions, console)


def add_visuals(owner: SdfElement, link: Link, extensions: Extensions, console: Console) -> None:
    """Append a link's visuals; sdformat 9 leaves their colours out."""
    for index, part in enumerate(link.visuals):
        element = _part(owner, "visual", link, part, index)
        _add_geometry(element, part, console)
        extend_visual(element, link.name, extensions, console)
        if part.colour is not None and console.release is not Release.V9:
            _add_colour(element, part.colour)


def pose_text(pose: Origin) -> str:
    """Return a pose as ignition-math's angles."""
    return exact_text((*pose.xyz_m, *euler_of(pose.quat_xyzw)))


def _part(owner: SdfElement, kind: str, link: Link, part: Part, index: int) -> SdfElement:
    name = f"{part.name or link.name}_{kind}" + (f"_{index}" if index else "")
    if not name.startswith(link.name):
        name = f"{link.name}{_LUMPED}{name}"
    element = owner.add(kind)
    element.attributes["name"] = name
    rpy = rpy_from_quaternion(part.origin.quat_xyzw)
    element.add("pose", exact_text((*part.origin.xyz_m, *rpy)))
    return element


def _add_geometry(owner: SdfElement, part: Part, console: Console) -> None:
    shape = owner.add("geometry").add(part.shape.kind)
    for name, text in part.shape.values:
        if name == "uri" and not text:
            console.error("no filename", "urdf2sdf: mesh geometry with no filename given.")
        shape.add(name, text)


def _add_colour(visual: SdfElement, colour: tuple[float, float, float, float]) -> None:
    material = visual.find("material") or visual.add("material")
    if material.find("diffuse") is not None or material.find("ambient") is not None:
        return
    *rgb, alpha = colour
    diffuse = [_clamped(value / _DIFFUSE) for value in rgb]
    ambient = [_clamped(0.5 * value / _AMBIENT) for value in rgb]
    material.add("diffuse", exact_text([*diffuse, alpha]))
    material.add("ambient", exact_text([*ambient, alpha]))


def _clamped(value: float) -> float:
    return max(min(value, 1.0), 0.0)
