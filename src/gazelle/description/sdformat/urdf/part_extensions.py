"""``<gazebo>`` blocks of a link, put into its visuals and collisions."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat.element import SdfElement
from gazelle.description.sdformat.urdf.console import Console
from gazelle.description.sdformat.urdf.elements import copied, found_or_added, remove, set_value
from gazelle.description.sdformat.urdf.extensions import Extension, Extensions
from gazelle.description.sdformat.urdf.numbers import exact_text

__all__ = ["extend_collision", "extend_visual"]

_LUMPED = "_fixed_joint_lump__"
_MATERIALS = "file://media/materials/scripts/gazebo.material"


class _Surface:
    """The ``<surface>`` of a collision, and where in it frictions and contacts are written.

    A second surface replaces the first one, but where it lacks a part, numbers go on being written
    into the replaced one's and are lost: the library keeps its pointers (and may crash at it).
    """

    def __init__(self, collision: SdfElement) -> None:
        self._collision = collision
        self._whole: SdfElement | None = None
        self._parts: dict[str, SdfElement | None] = {"contact": None, "friction": None}
        self._odes: dict[str, SdfElement | None] = {"contact": None, "friction": None}

    def replace(self, surface: SdfElement) -> None:
        """Put a surface in the place of the one that is there."""
        if self._whole is not None:
            remove(self._collision, self._whole)
        self._collision.children.append(surface)
        self._whole = surface
        for name in self._parts:
            part = surface.find(name)
            self._parts[name] = part
            if part is not None:
                self._odes[name] = part.find("ode")

    def complete(self) -> None:
        """Make what is still missing."""
        if self._whole is None:
            self._whole = self._collision.add("surface")
        for name, part in self._parts.items():
            found = part or found_or_added(self._whole, name)
            self._parts[name] = found
            self._odes[name] = self._odes[name] or found_or_added(found, "ode")

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
