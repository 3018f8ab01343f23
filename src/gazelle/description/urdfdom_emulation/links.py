"""``<link>`` and ``<material>`` as urdfdom 3.0.1 reads them.

Only what it says about them is kept: of a link's parts nothing but material names is printed.
"""

from __future__ import annotations

from typing import NamedTuple

from gazelle.description.urdfdom_emulation.console import Console, Rejected
from gazelle.description.urdfdom_emulation.tinyxml import Element
from gazelle.description.urdfdom_emulation.values import (
    BadValueError,
    check_colour,
    number_of,
    origin_of,
    vector_of,
)

__all__ = ["ReadLink", "VisualMaterial", "check_material", "read_link"]

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


class VisualMaterial(NamedTuple):
    """The name in a visual's ``<material>``, and whether it says how that looks."""

    name: str
    is_defined: bool


class ReadLink(NamedTuple):
    """What urdfdom keeps of a link; after a mistake that is what it had read so far.

    `visuals` are the materials in the order in which urdfdom looks them up: the first visual
    comes twice unless an error in a later one keeps it from being "the" visual.
    """

    name: str
    visuals: tuple[VisualMaterial, ...] = ()


def check_material(tag: Element, console: Console, *, name_is_enough: bool) -> bool:
    """Tell whether a material says how it looks; complain as urdfdom does."""
    name = tag.attributes.get("name")
    if name is None:
        console.error(("link", 64), "Material must contain a name attribute")
        return False
    texture, colour = tag.first("texture"), tag.first("color")
    has_image = texture is not None and "filename" in texture.attributes
    rgba = colour.attributes.get("rgba") if colour is not None else None
    if rgba is not None:
        try:
            check_colour(rgba)
        except BadValueError as mistake:
            message = f"Material [{name}] has malformed color rgba values: {mistake}"
            console.error(("link", 93), message)
            rgba = None
    if rgba is None and not has_image and not name_is_enough:
        console.error(("link", 101), f"Material [{name}] color has no rgba")
        console.error(("link", 102), f"Material [{name}] not defined in file")
    return rgba is not None or has_image


def read_link(tag: Element, console: Console) -> ReadLink:
    """Read a link; its mistakes only go to the console."""
    name = tag.attributes.get("name")
    if name is None:
        console.error(("link", 423), "No name given for the link.")
        return ReadLink("")
    visuals: list[VisualMaterial] = []
    try:
        _read_inertial(tag, name, console)
        for child in tag.all("visual"):
            visuals.append(_read_visual(child, name, console))
    except Rejected:
        return ReadLink(name, tuple(visuals))
    for child in tag.all("collision"):
        try:
            origin_of(child, console)
            _check_geometry(child, console)
        except Rejected:
            console.error(("link", 475), f"Could not parse collision element for Link [{name}]")
            break
    return ReadLink(name, (*visuals[:1], *visuals))


def _read_inertial(link: Element, name: str, console: Console) -> None:
    tag = link.first("inertial")
    if tag is None:
        return
    try:
        origin_of(tag, console)
        _check_mass(tag, console)
        _check_inertia(tag, console)
    except Rejected:
        console.error(("link", 435), f"Could not parse inertial element for Link [{name}]")
        raise


def _check_mass(inertial: Element, console: Console) -> None:
    mass = inertial.first("mass")
    if mass is None:
        raise console.reject(("link", 284), "Inertial element must have a mass element")
    value = mass.attributes.get("value")
    if value is None:
        raise console.reject(("link", 289), "Inertial: mass element must have value attribute")
    _check_number(value, 299, f"Inertial: mass [{value}] is not a float", console)


def _check_inertia(inertial: Element, console: Console) -> None:
    inertia = inertial.first("inertia")
    if inertia is None:
        raise console.reject(("link", 306), "Inertial element must have inertia element")
    for word in _TENSOR:
        if word not in inertia.attributes:
            message = f"Inertial: inertia element missing {word} attribute"
            raise console.reject(("link", 325), message)
        message = f"Inertial: inertia element {word} is not a valid double"
        _check_number(inertia.attributes[word], 334, message, console)


def _read_visual(tag: Element, link: str, console: Console) -> VisualMaterial:
    try:
        origin_of(tag, console)
        _check_geometry(tag, console)
        material = tag.first("material")
        if material is None:
            return VisualMaterial("", False)
        if "name" not in material.attributes:
            raise console.reject(("link", 375), "Visual material must contain a name attribute")
    except Rejected:
        console.error(("link", 453), f"Could not parse visual element for Link [{link}]")
        raise
    is_defined = check_material(material, console, name_is_enough=True)
    return VisualMaterial(material.attributes["name"], is_defined)


def _check_geometry(owner: Element, console: Console) -> None:
    geometry = owner.first("geometry")
    if geometry is None:
        raise Rejected("urdfdom says nothing of its own about a missing <geometry>")
    if not geometry.children:
        raise console.reject(("link", 227), "Geometry tag contains no child element.")
    shape = geometry.children[0]
    if shape.name == "sphere":
        _check_sphere(shape, console)
    elif shape.name == "box":
        _check_box(shape, console)
    elif shape.name == "cylinder":
        _check_cylinder(shape, console)
    elif shape.name == "mesh":
        _check_mesh(shape, console)
    else:
        raise console.reject(("link", 262), f"Unknown geometry type '{shape.name}'")


def _check_sphere(shape: Element, console: Console) -> None:
    radius = shape.attributes.get("radius")
    if radius is None:
        raise console.reject(("link", 117), "Sphere shape must have a radius attribute")
    _check_number(radius, 126, f"radius [{radius}] is not a valid float", console)


def _check_box(shape: Element, console: Console) -> None:
    size = shape.attributes.get("size")
    if size is None:
        raise console.reject(("link", 140), "Box shape has no size attribute")
    try:
        vector_of(size)
    except BadValueError as mistake:
        raise console.reject(("link", 150), str(mistake)) from None


def _check_cylinder(shape: Element, console: Console) -> None:
    length, radius = shape.attributes.get("length"), shape.attributes.get("radius")
    if length is None or radius is None:
        message = "Cylinder shape must have both length and radius attributes"
        raise console.reject(("link", 164), message)
    _check_number(length, 173, f"length [{length}] is not a valid float", console)
    _check_number(radius, 182, f"radius [{radius}] is not a valid float", console)


def _check_mesh(shape: Element, console: Console) -> None:
    if "filename" not in shape.attributes:
        raise console.reject(("link", 196), "Mesh must contain a filename attribute")
    scale = shape.attributes.get("scale")
    if scale is None:
        return
    try:
        vector_of(scale)
    except BadValueError as mistake:
        message = f"Mesh scale was specified, but could not be parsed: {mistake}"
        raise console.reject(("link", 208), message) from None


def _check_number(text: str, line: int, message: str, console: Console) -> None:
    try:
        number_of(text)
    except BadValueError:
        raise console.reject(("link", line), message) from None
