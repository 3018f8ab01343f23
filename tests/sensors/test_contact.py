"""Contact sensors see what they watch, from their own side."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.engine import Contact
from gazelle.geometry import Pose
from gazelle.sensors import link_wrenches, watched_contacts

FLOOR, FOOT, WALL = "world::l::floor", "robot::leg::foot", "house::l::wall"


def contact(first: str, second: str) -> Contact:
    return Contact(
        first,
        second,
        points_m=np.array([[0.0, 0.1, 0.0], [0.0, -0.1, 0.0]]),
        normals=np.array([[0.0, 0.0, 1.0]] * 2),
        depths_m=np.array([1e-4, 2e-4]),
        forces_n=np.array([[0.0, 0.0, 5.0], [0.0, 0.0, 7.0]]),
        torques_nm=np.zeros((2, 3)),
    )


def test_only_contacts_of_watched_collisions_are_felt() -> None:
    record = watched_contacts((contact(FOOT, FLOOR), contact(WALL, FLOOR)), {FOOT})
    assert [(item.collision1, item.collision2) for item in record.contacts] == [(FOOT, FLOOR)]
    assert watched_contacts((contact(WALL, FLOOR),), {FOOT}).contacts == ()
    assert watched_contacts((), {FOOT}).force_n == pytest.approx([0, 0, 0])


def test_a_contact_is_seen_from_the_watched_side() -> None:
    (turned,) = watched_contacts((contact(FLOOR, FOOT),), {FOOT}).contacts
    assert (turned.collision1, turned.collision2) == (FOOT, FLOOR)
    assert turned.normals[0] == pytest.approx([0, 0, -1])
    assert watched_contacts((contact(FLOOR, FOOT),), {FOOT}).force_n == pytest.approx([0, 0, -12])
    assert turned.depths_m == pytest.approx([1e-4, 2e-4])


def test_wrenches_are_in_the_links_axes_about_its_centre_of_mass() -> None:
    # Rolled by 90 degrees, the link's y axis points up.
    pose = Pose.from_xyz_rpy((0.0, 0.0, 1.0), (math.pi / 2, 0.0, 0.0))
    com = np.array([0.2, 0.0, 1.0])
    forces, torques = link_wrenches(contact(FOOT, FLOOR), pose, com)
    assert forces == pytest.approx(np.array([[0, 5.0, 0], [0, 7.0, 0]]))
    # World: (-0.2, 0.1, -1) x (0, 0, 5) = (0.5, 1, 0); y of the world is -z of the link.
    assert torques[0] == pytest.approx([0.5, 0.0, -1.0])
