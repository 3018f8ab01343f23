"""Visuals, collisions and inertials of a link as SDF, its ``<gazebo>`` blocks in them."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import euler_of
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import exact_text
from gazelle.description.sdformat_emulation.parser_urdf.elements import (
    copied,
    found_or_added,
    remove,
    set_value,
)
from gazelle.description.sdformat_emulation.parser_urdf.gazebo_extensions import (
    Extension,
    Extensions,
)
from gazelle.description.sdformat_emulation.parser_urdf.robot import Inertial, Link, Part
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.values import Origin, rpy_from_quaternion

__all__ = [
    "add_collisions",
    "add_inertial",
    "add_visuals",
    "pose_text",
]

_LUMPED = "_fixed_joint_lump__"
_MATERIALS = "file://media/materials/scripts/gazebo.material"
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
        _extend_collision(element, link.name, extensions, console)


def add_visuals(owner: SdfElement, link: Link, extensions: Extensions, console: Console) -> None:
    """Append a link's visuals; sdformat 9 leaves their colours out."""
    for index, part in enumerate(link.visuals):
        element = _part(owner, "visual", link, part, index)
        _add_geometry(element, part, console)
        _extend_visual(element, link.name, extensions, console)
        if part.colour is not None and console.release is not Release.V9:
            _add_colour(element, part.colour)


def pose_text(pose: Origin) -> str:
    """Return a pose as ignition-math's angles."""
    return exact_text((*pose.xyz_m, *euler_of(pose.quat_xyzw)))


def _extend_collision(
    collision: SdfElement, link: str, extensions: Extensions, console: Console
) -> None:
    """Add what the blocks say about a link's collisions.

    Args:
        collision: the element, with its name.
        link: the link it is in.
        extensions: all blocks; those of links lumped into this one are among the link's.
        console: receives remarks about values that overwrite others.
    """
    surface = _Surface(collision)
    for extension in _meant(collision, link, extensions):
        for element in extension.collisions:
            if element.name == "surface":
                surface.replace(copied(element))
            else:
                collision.children.append(copied(element))
        surface.complete()
        _set(surface.friction_ode, extension, {"mu1": "mu", "mu2": "mu2"}, console)
        if extension.fdir1:
            set_value(surface.friction_ode, "fdir1", extension.fdir1, console)
        element_names = {"kp": "kp", "kd": "kd", "maxVel": "max_vel", "minDepth": "min_depth"}
        _set(surface.contact_ode, extension, element_names, console)
        element_names = {"laserRetro": "laser_retro", "maxContacts": "max_contacts"}
        _set(collision, extension, element_names, console)


def _extend_visual(visual: SdfElement, link: str, extensions: Extensions, console: Console) -> None:
    """Add what the blocks say about a link's visuals; arguments as in `_extend_collision`."""
    for extension in _meant(visual, link, extensions):
        for element in extension.visuals:
            old = visual.find("material") if element.name == "material" else None
            if old is not None:
                remove(visual, old)
            visual.children.append(copied(element))
        if extension.material:
            script = found_or_added(found_or_added(visual, "material"), "script")
            set_value(script, "name", extension.material, console)
            set_value(script, "uri", _MATERIALS, console)


class _Surface:
    """The ``<surface>`` of a collision, and where in it frictions and contacts are written.

    A second surface replaces the first one. Where it lacks a part, the library goes on writing
    into the replaced one's, which no longer exists: new elements have taken the memory, the last
    one freed first. So friction is found in contacts then, or is lost (or the library crashes).
    """

    def __init__(self, collision: SdfElement) -> None:
        self._collision = collision
        self._whole: SdfElement | None = None
        self._parts: dict[str, SdfElement | None] = {"contact": None, "friction": None}
        self._odes: dict[str, SdfElement | None] = {"contact": None, "friction": None}
        self._freed: list[SdfElement] = []

    def replace(self, surface: SdfElement) -> None:
        """Put a surface in the place of the one that is there."""
        if self._whole is not None:
            remove(self._collision, self._whole)
            self._freed = list(_walked(self._whole, last_first=True))
        self._collision.children.append(surface)
        self._whole = surface
        for element in _walked(surface, last_first=False):
            self._take_memory(element)
        for name in self._parts:
            part = surface.find(name)
            self._parts[name] = part
            if part is not None:
                self._odes[name] = part.find("ode")

    def complete(self) -> None:
        """Make what is still missing."""
        self._whole = self._whole or self._collision.add("surface")
        for name, part in self._parts.items():
            self._parts[name] = found = part or self._found_or_made(self._whole, name)
            self._odes[name] = self._odes[name] or self._found_or_made(found, "ode")

    def _found_or_made(self, owner: SdfElement, name: str) -> SdfElement:
        found = owner.find(name)
        if found is None:
            found = owner.add(name)
            self._take_memory(found)
        return found

    def _take_memory(self, element: SdfElement) -> None:
        gone = self._freed.pop(0) if self._freed else None
        for name, ode in self._odes.items():
            if ode is not None and ode is gone:
                self._odes[name] = element

    @property
    def friction_ode(self) -> SdfElement:
        """Where ``mu`` and the like go, once the surface is complete."""
        return self._ode("friction")

    @property
    def contact_ode(self) -> SdfElement:
        """Where ``kp`` and the like go, once the surface is complete."""
        return self._ode("contact")

    def _ode(self, name: str) -> SdfElement:
        ode = self._odes[name]
        assert ode is not None
        return ode


def _meant(element: SdfElement, link: str, extensions: Extensions) -> Iterator[Extension]:
    """Yield the blocks for a part: those of the link it was in before lumping, told by names."""
    name = element.attributes["name"]
    for extension in extensions.by_reference.get(link, ()):
        if extension.link == link:
            is_meant = _LUMPED not in name
        else:
            is_meant = f"{_LUMPED}{extension.link}_{element.name}" in name
        if is_meant:
            yield extension


def _set(
    owner: SdfElement, extension: Extension, element_names: dict[str, str], console: Console
) -> None:
    for word, name in element_names.items():
        if word in extension.numbers:
            set_value(owner, name, exact_text([extension.numbers[word]]), console)


def _walked(element: SdfElement, *, last_first: bool) -> Iterator[SdfElement]:
    """Yield an element and all below it, each before what is in it."""
    waiting = [element]
    while waiting:
        found = waiting.pop()
        yield found
        waiting += found.children if last_first else found.children[::-1]


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
