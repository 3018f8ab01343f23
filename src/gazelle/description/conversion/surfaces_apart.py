"""Collisions of one link that touch differently, each kind on a link of its own.

A ``<gazebo reference>`` says how a whole link touches. A collision with another surface, such as a
castor without friction, goes to a link without mass that a fixed joint holds; sdformat puts both
back into one link and keeps their surfaces apart.
"""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.conversion.plain_names import free_name, part_names
from gazelle.description.model import Collision, Joint, JointType, Link, Model, Surface
from gazelle.diagnostics import Diagnostics

__all__ = ["with_surfaces_apart"]


def with_surfaces_apart(model: Model, diagnostics: Diagnostics) -> Model:
    """Return the model with links whose collisions all have the same surface.

    Args:
        model: any.
        diagnostics: receives ``convert.approximated`` for each link that is added.
    """
    links: list[Link] = []
    joints = list(model.joints)
    taken = set(part_names(model))
    for link in model.links:
        kinds: dict[tuple[Surface, float], list[Collision]] = {}
        for collision in link.collisions:
            key = (replace(collision.surface, span=None), collision.laser_retro)
            kinds.setdefault(key, []).append(collision)
        first, *others = list(kinds.values()) or [[]]
        links.append(replace(link, collisions=tuple(first)) if others else link)
        for group in others:
            name = free_name(f"{link.name}_{group[0].name}", taken)
            joint = free_name(f"{name}_joint", taken)
            taken |= {name, joint}
            links.append(_shell(link, name, group))
            joints.append(
                Joint(joint, JointType.FIXED, link.name, name, link.T_model_link, span=link.span)
            )
            _report(link, name, group, diagnostics)
    return replace(model, links=tuple(links), joints=tuple(joints))


def _shell(link: Link, name: str, collisions: list[Collision]) -> Link:
    return Link(
        name,
        link.T_model_link,
        collisions=tuple(collisions),
        self_collide=link.self_collide,
        span=link.span,
    )


def _report(link: Link, name: str, group: list[Collision], diagnostics: Diagnostics) -> None:
    shown = ", ".join(f"'{item.name}'" for item in group)
    message = (
        f"collision {shown} of link '{link.name}' touches in another way than the link's first "
        f"one; it is on a link of its own, '{name}', for URDF says this for whole links"
    )
    diagnostics.report("convert.approximated", message, group[0].span)
