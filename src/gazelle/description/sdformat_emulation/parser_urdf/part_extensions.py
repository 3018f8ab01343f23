"""``<gazebo>`` blocks of a link, put into its visuals and collisions."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import exact_text
from gazelle.description.sdformat_emulation.parser_urdf.elements import (
    copied,
    found_or_added,
    remove,
    set_value,
)
from gazelle.description.sdformat_emulation.parser_urdf.extensions import Extension, Extensions

__all__ = ["extend_collision", "extend_visual"]

_LUMPED = "_fixed_joint_lump__"
_MATERIALS = "file://media/materials/scripts/gazebo.material"


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


def extend_collision(
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
        words = {"kp": "kp", "kd": "kd", "maxVel": "max_vel", "minDepth": "min_depth"}
        _set(surface.contact_ode, extension, words, console)
        words = {"laserRetro": "laser_retro", "maxContacts": "max_contacts"}
        _set(collision, extension, words, console)


def extend_visual(visual: SdfElement, link: str, extensions: Extensions, console: Console) -> None:
    """Add what the blocks say about a link's visuals; arguments as in `extend_collision`."""
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


def _set(owner: SdfElement, extension: Extension, words: dict[str, str], console: Console) -> None:
    for word, name in words.items():
        if word in extension.numbers:
            set_value(owner, name, exact_text([extension.numbers[word]]), console)


def _walked(element: SdfElement, *, last_first: bool) -> Iterator[SdfElement]:
    """Yield an element and all below it, each before what is in it."""
    waiting = [element]
    while waiting:
        found = waiting.pop()
        yield found
        waiting += found.children if last_first else found.children[::-1]
