"""Contact sensors: what touches the collisions they watch."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose

if TYPE_CHECKING:
    from gazelle.engine import Contact

__all__ = ["ContactRecord", "link_wrenches", "watched_contacts"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ContactRecord:
    """One reading of a contact sensor.

    Attributes:
        contacts: one per pair of collisions that touch, the watched one first; empty for none.
    """

    contacts: tuple[Contact, ...]

    @property
    def force_n(self) -> Array:
        """Sum of all forces on the watched collisions, (3,), world frame."""
        total = np.zeros(3)
        for contact in self.contacts:
            total += contact.forces_n.sum(axis=0)
        return total


def watched_contacts(contacts: tuple[Contact, ...], watched: Set[str]) -> ContactRecord:
    """Return the contacts of some collisions, seen from their side.

    Args:
        contacts: all contacts of the world.
        watched: ``model::link::collision``; a contact between two of them is kept as it is.
    """
    found = []
    for contact in contacts:
        if contact.collision1 in watched:
            found.append(contact)
        elif contact.collision2 in watched:
            found.append(_from_the_other_side(contact))
    return ContactRecord(tuple(found))


def link_wrenches(contact: Contact, T_world_link: Pose, com_world_m: Array) -> tuple[Array, Array]:
    """Return forces and torques of a contact as Gazebo's ODE reports them.

    They act on the link of `collision1`, are turned into that link's frame and torques are about
    its centre of mass (ODEPhysics::UpdatePhysics), while positions and normals are the world's.

    Args:
        contact: the contact.
        T_world_link: pose of the link of `collision1`.
        com_world_m: its centre of mass, (3,), world frame.

    Returns:
        forces, newton, and torques, newton metres, (N, 3) each.
    """
    to_link = T_world_link.matrix()[:3, :3]
    arms = contact.points_m - com_world_m
    torques = contact.torques_nm + np.cross(arms, contact.forces_n)
    return contact.forces_n @ to_link, torques @ to_link


def _from_the_other_side(contact: Contact) -> Contact:
    return replace(
        contact,
        collision1=contact.collision2,
        collision2=contact.collision1,
        normals=-contact.normals,
        forces_n=-contact.forces_n,
        torques_nm=-contact.torques_nm,
    )
