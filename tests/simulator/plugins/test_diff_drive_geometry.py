from __future__ import annotations

import math
from pathlib import Path

import pytest

from gazelle.description.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Joint,
    JointAxis,
    JointType,
    Link,
    MeshShape,
    Model,
    Shape,
    Sphere,
)
from gazelle.geometry import Pose
from gazelle.simulator.plugins.diff_drive_geometry import drive_geometry, wheel_radius_m

ROUND = Cylinder(0.1, 0.05)
LYING = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (-math.pi / 2, 0.0, 0.0))


def wheel(name: str, y: float, shape: Shape, axis: float = 1.0) -> tuple[Link, Joint]:
    place = Pose((0.0, y, 0.1)) @ LYING
    link = Link(f"{name}_wheel", place, collisions=(Collision("c", shape),))
    joint = Joint(name, JointType.CONTINUOUS, "base", link.name, place, JointAxis((0.0, 0.0, axis)))
    return link, joint


def model(left_y: float = 0.2, shape: Shape = ROUND, axis: float = 1.0) -> Model:
    parts = [wheel("left", left_y, shape, axis), wheel("right", -left_y, shape, axis)]
    return Model("m", links=tuple(p[0] for p in parts), joints=tuple(p[1] for p in parts))


@pytest.mark.parametrize(
    ("shape", "radius_m"),
    [
        (Cylinder(0.1, 0.05), 0.1),
        (Sphere(0.12), 0.12),
        (Capsule(0.08, 0.02), 0.08),
        (Box((0.2, 0.2, 0.04)), 0.1 * math.sqrt(2)),
    ],
)
def test_the_radius_is_the_farthest_point_from_the_axis(shape: Shape, radius_m: float) -> None:
    robot = model(shape=shape)
    assert wheel_radius_m(robot, robot.joints[0]) == pytest.approx(radius_m)


def test_the_separation_is_that_of_the_joints_along_their_axis() -> None:
    robot = model()
    geometry = drive_geometry(robot, *robot.joints)
    assert geometry.separation_m == pytest.approx(0.4)
    assert geometry.left_is_left
    assert geometry.forward == 1
    assert geometry.turns_left(exchanged=False)


@pytest.mark.parametrize(
    ("left_y", "axis", "exchanged", "turns_left"),
    [
        (0.2, 1.0, False, True),
        (0.2, 1.0, True, False),
        (-0.2, 1.0, False, False),
        (-0.2, 1.0, True, True),
        (0.2, -1.0, False, False),
    ],
)
def test_the_direction_of_turning_follows_sides_axes_and_mode(
    left_y: float, axis: float, exchanged: bool, turns_left: bool
) -> None:
    robot = model(left_y, axis=axis)
    geometry = drive_geometry(robot, *robot.joints)
    assert geometry.turns_left(exchanged=exchanged) is turns_left
    assert geometry.forward == axis


def test_a_wheel_without_a_shape_has_no_radius() -> None:
    bare = Model("m", links=(Link("left_wheel"),), joints=(wheel("left", 0.2, Sphere(1.0))[1],))
    assert wheel_radius_m(bare, bare.joints[0]) is None


def test_an_unreadable_mesh_has_no_radius(tmp_path: Path) -> None:
    path = tmp_path / "wheel.stl"
    path.write_bytes(b"not a mesh")
    robot = model(shape=MeshShape("wheel.stl", path))
    assert wheel_radius_m(robot, robot.joints[0]) is None
