"""Pairs of links that are not looked at, and spheres that stand for links."""

from __future__ import annotations

from gazelle.description.srdf.model import CollisionPair, LinkSpheres
from gazelle.description.srdf.names import Names
from gazelle.description.urdf_reader.attributes import (
    check_vocabulary,
    number_attribute,
    vector_attribute,
)
from gazelle.description.xml import Tag

__all__ = ["read_default_collisions", "read_pairs", "read_spheres"]


def read_pairs(root: Tag, element: str, names: Names) -> tuple[CollisionPair, ...]:
    """Return the pairs of ``<disable_collisions>`` or ``<enable_collisions>``."""
    found: list[CollisionPair] = []
    for tag in root.find_all(element):
        check_vocabulary(tag, names.diagnostics, attributes=("link1", "link2", "reason"))
        pair = names.link(tag, "link1"), names.link(tag, "link2")
        if all(pair):
            found.append(CollisionPair(*pair, tag.attributes.get("reason", "").strip()))
    return tuple(found)


def read_default_collisions(root: Tag, names: Names) -> tuple[str, ...]:
    """Return the links of ``<disable_default_collisions>``."""
    tags = root.find_all("disable_default_collisions")
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("link", "reason"))
    return tuple(name for tag in tags if (name := names.link(tag, "link")))


def read_spheres(root: Tag, names: Names) -> tuple[LinkSpheres, ...]:
    """Return ``<link_sphere_approximation>``; they are reported, for the shapes collide here."""
    tags = root.find_all("link_sphere_approximation")
    found: list[LinkSpheres] = []
    for tag in tags:
        check_vocabulary(tag, names.diagnostics, attributes=("link",), children=("sphere",))
        link = names.link(tag, "link")
        if link:
            spheres = [_read_sphere(child, names) for child in tag.find_all("sphere")]
            found.append(LinkSpheres(link, tuple(one for one in spheres if one is not None)))
    if found:
        links = ", ".join(f"'{one.link}'" for one in found)
        message = f"the spheres of {links} have no effect: collisions are checked with the links'"
        message += " own shapes, as MoveIt's FCL and Bullet do (only CHOMP uses spheres)"
        names.diagnostics.report("srdf.spheres", message, tags[0].span)
    return tuple(found)


def _read_sphere(tag: Tag, names: Names) -> tuple[float, float, float, float] | None:
    check_vocabulary(tag, names.diagnostics, attributes=("center", "radius"))
    if not names.required(tag, "center") or not names.required(tag, "radius"):
        return None
    center = vector_attribute(tag, "center", names.diagnostics)
    radius = number_attribute(tag, "radius", names.diagnostics)
    return None if center is None or radius is None else (*center, radius)
