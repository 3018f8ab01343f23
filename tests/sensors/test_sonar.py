"""Sonars find the nearest surface inside their cone."""

from __future__ import annotations

import math

import pytest

from gazelle.description.model import Box, Plane, SonarSpec, Sphere
from gazelle.geometry import Pose
from gazelle.sensors import sonar_range

CONE = SonarSpec(min_m=0.02, max_m=4.0, radius_m=1.0)
# The cone opens along -z; so turned it looks along x.
AHEAD = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, -math.pi / 2, 0.0))


def test_cone_opens_downwards_as_gazebos_does(scene_of, link) -> None:
    below = scene_of(link("floor", Plane(), Pose((0, 0, -1.5))), kind="collisions")
    assert sonar_range(below, CONE, Pose()) == pytest.approx(1.5, abs=1e-3)
    above = scene_of(link("lid", Box((9, 9, 0.2)), Pose((0, 0, 1.5))), kind="collisions")
    assert sonar_range(above, CONE, Pose()) == 4.0


def test_wall_ahead_is_measured_along_the_axis(scene_of, link) -> None:
    scene = scene_of(link("wall", Box((0.2, 9, 9)), Pose((3.1, 0, 0))), kind="collisions")
    assert sonar_range(scene, CONE, AHEAD) == pytest.approx(3.0, abs=1e-3)


def test_things_beside_the_cone_are_not_heard(scene_of, link) -> None:
    inside, outside = Pose((2.0, 0.4, 0.0)), Pose((2.0, 0.8, 0.0))
    for pose, wanted in ((inside, math.hypot(2.0, 0.4) - 0.1), (outside, 4.0)):
        scene = scene_of(link("ball", Sphere(0.1), pose), kind="collisions")
        assert sonar_range(scene, CONE, AHEAD) == pytest.approx(wanted, abs=0.005)


def test_edge_of_the_cone_reaches_a_floor_first(scene_of, link) -> None:
    scene = scene_of(link("floor", Plane(), Pose((0, 0, -0.5))), kind="collisions")
    slope = math.atan2(CONE.radius_m, CONE.max_m)
    assert sonar_range(scene, CONE, AHEAD) == pytest.approx(0.5 / math.sin(slope), rel=0.01)


def test_nothing_gives_the_largest_range(scene_of) -> None:
    assert sonar_range(scene_of(kind="collisions"), CONE, Pose()) == 4.0


def test_sphere_hears_everywhere_as_far_as_its_radius(scene_of, link) -> None:
    sphere = SonarSpec(geometry="sphere", max_m=9.0, radius_m=2.0)
    behind = scene_of(link("wall", Box((0.2, 9, 9)), Pose((-1.6, 0, 0))), kind="collisions")
    assert sonar_range(behind, sphere, Pose()) == pytest.approx(1.5, abs=0.01)
    far = scene_of(link("wall", Box((0.2, 9, 9)), Pose((-3.0, 0, 0))), kind="collisions")
    assert sonar_range(far, sphere, Pose()) == 2.0
