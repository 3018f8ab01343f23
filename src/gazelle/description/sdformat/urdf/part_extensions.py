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
    for extension in _meant(collision, link, extensions):
        _insert(collision, extension.collisions, "surface")
        surface = found_or_added(collision, "surface")
        contact = found_or_added(found_or_added(surface, "contact"), "ode")
        friction = found_or_added(found_or_added(surface, "friction"), "ode")
        _set(friction, extension, {"mu1": "mu", "mu2": "mu2"}, console)
        if extension.fdir1:
            set_value(friction, "fdir1", extension.fdir1, console)
        words = {"kp": "kp", "kd": "kd", "maxVel": "max_vel", "minDepth": "min_depth"}
        _set(contact, extension, words, console)
        words = {"laserRetro": "laser_retro", "maxContacts": "max_contacts"}
        _set(collision, extension, words, console)


def extend_visual(visual: SdfElement, link: str, extensions: Extensions, console: Console) -> None:
    """Add what the blocks say about a link's visuals; arguments as in `extend_collision`."""
    for extension in _meant(visual, link, extensions):
        _insert(visual, extension.visuals, "material")
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


def _insert(owner: SdfElement, elements: list[SdfElement], single: str) -> None:
    """Append copies; of the element called `single` only the last one stays."""
    for element in elements:
        old = owner.find(single) if element.name == single else None
        if old is not None:
            remove(owner, old)
        owner.children.append(copied(element))


def _set(owner: SdfElement, extension: Extension, words: dict[str, str], console: Console) -> None:
    for word, name in words.items():
        if word in extension.numbers:
            set_value(owner, name, exact_text([extension.numbers[word]]), console)
