"""Pictures of robots: what is at the pixel that a known point projects to."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from gazelle.description.forward_kinematics import posed_model
from gazelle.description.model import (
    Box,
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Material,
    Model,
    Sphere,
    Visual,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose, box_mass_properties
from gazelle.sensors.view_cameras import VIEWS, looking_at
from gazelle.sensors.view_image import Picture, take_picture
from gazelle.sensors.view_overlays import equivalent_box

SIZE = (200, 150)
GREEN = Material(ambient=(0, 1, 0, 1), diffuse=(0, 1, 0, 1))
WHITE = (255, 255, 255)
PURPLE, YELLOW, TEAL = (153, 51, 217), (255, 217, 0), (0, 179, 191)


def _body(mass_kg: float, size_m: tuple[float, float, float]) -> Inertial:
    made = box_mass_properties(mass_kg, size_m)
    return Inertial(mass_kg, inertia_kg_m2=made.inertia_kg_m2)


@pytest.fixture(scope="module")
def robot() -> World:
    """A green box of 0.4 x 0.3 x 0.2 m, and a bar on a hinge beside it, 1 m to the front."""
    base = Link(
        "base",
        inertial=_body(2.0, (0.4, 0.3, 0.2)),
        visuals=(Visual("v", Box((0.4, 0.3, 0.2)), material=GREEN),),
        collisions=(Collision("c", Box((0.4, 0.3, 0.4))),),
    )
    bar = Link(
        "bar",
        Pose((0.0, 0.5, 0.0)),
        inertial=Inertial(1.0, Pose((0.9, 0.0, 0.0)), (0.1, 0.0, 0.0, 0.1, 0.0, 0.1)),
        visuals=(Visual("v", Box((1.0, 0.05, 0.05)), Pose((0.5, 0.0, 0.0)), material=GREEN),),
    )
    hinge = Joint(
        "hinge", JointType.CONTINUOUS, "base", "bar", bar.T_model_link, JointAxis((0.0, 0.0, 1.0))
    )
    return World(models=(Model("robot", links=(base, bar), joints=(hinge,)),))


def _at(picture: Picture, point_m: tuple[float, float, float], shot: int = 0) -> tuple[int, ...]:
    column, row = picture.shots[shot].pixel(point_m)
    return tuple(picture.rgb[round(row), round(column)].tolist())


def _is_green(colour: tuple[int, ...]) -> bool:
    return colour[1] > 80 and colour[0] < 10 and colour[2] < 10


def _differs(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> bool:
    return bool((first != second).any())


@pytest.mark.parametrize("view", sorted(VIEWS))
def test_known_points_are_where_they_project_to(robot: World, view: str) -> None:
    picture = take_picture(robot, views=[view], size_px=SIZE, background=(1, 1, 1))
    assert picture.rgb.shape == (150, 200, 3)
    assert _is_green(_at(picture, (0.0, 0.0, 0.0)))
    assert _is_green(_at(picture, (0.5, 0.5, 0.0)))
    if view in {"top", "bottom", "iso"}:
        assert _at(picture, (0.6, 0.15, 0.0)) == WHITE


@pytest.mark.parametrize("view", sorted(VIEWS))
def test_everything_is_framed_and_touches_the_margins(robot: World, view: str) -> None:
    picture = take_picture(robot, views=[view], size_px=SIZE, background=(1, 1, 1))
    rows, columns = np.nonzero((picture.rgb != 255).any(axis=2))
    assert rows.min() > 0
    assert columns.min() > 0
    assert rows.max() < 149
    assert columns.max() < 199
    assert max(np.ptp(rows) / 150, np.ptp(columns) / 200) > 0.8


def test_a_sphere_is_framed_and_is_round() -> None:
    link = Link("ball", visuals=(Visual("v", Sphere(0.3), material=GREEN),))
    world = World(models=(Model("m", links=(link,)),))
    picture = take_picture(world, views=["front"], size_px=(101, 101), background=(1, 1, 1))
    rows, columns = np.nonzero((picture.rgb != 255).any(axis=2))
    assert abs(int(np.ptp(rows)) - int(np.ptp(columns))) <= 1
    assert 70 < np.ptp(rows) < 99
    assert rows.min() + rows.max() == pytest.approx(100, abs=1)


def test_the_same_picture_comes_twice(robot: World) -> None:
    show = ["visuals", "collisions", "inertia", "com", "joints", "frames"]
    first = take_picture(robot, show=show, size_px=SIZE)
    second = take_picture(robot, show=show, size_px=SIZE)
    assert not _differs(first.rgb, second.rgb)


def test_a_pose_moves_the_bar(robot: World) -> None:
    model = posed_model(robot.models[0], {"hinge": math.pi / 2})
    turned = World(models=(model,))
    picture = take_picture(turned, views=["top"], size_px=SIZE, background=(1, 1, 1))
    assert _is_green(_at(picture, (0.0, 1.4, 0.0)))
    assert _at(picture, (0.5, 0.5, 0.0)) == WHITE


def test_collisions_alone_are_orange_and_over_visuals_a_tint(robot: World) -> None:
    alone = take_picture(robot, show=["collisions"], views=["side"], size_px=SIZE)
    red, green, blue = _at(alone, (0.0, -0.15, 0.18))
    assert red > green > blue
    assert red == pytest.approx(2 * green, rel=0.1)
    both = take_picture(robot, show=["visuals", "collisions"], views=["top"], size_px=SIZE)
    red, green, _ = _at(both, (0.0, 0.0, 0.2))
    assert red > 60
    assert green > 90
    # The bar has no collision.
    assert _is_green(_at(both, (0.95, 0.5, 0.025)))


def test_the_centre_of_mass_is_a_yellow_dot_that_shines_through(robot: World) -> None:
    picture = take_picture(robot, show=["com"], views=["top"], size_px=SIZE)
    assert _at(picture, (0.9, 0.5, 0.0)) == YELLOW
    assert _at(picture, (0.0, 0.0, 0.0)) == YELLOW
    over = take_picture(robot, show=["visuals", "com"], views=["top"], size_px=SIZE)
    red, green, blue = _at(over, (0.9, 0.5, 0.0))
    assert red == round(0.8 * 255)
    assert green > 180
    assert blue == 0
    assert _is_green(_at(over, (0.5, 0.5, 0.0)))


def test_joint_axes_are_arrows_along_the_axis(robot: World) -> None:
    picture = take_picture(robot, show=["joints"], views=["side"], size_px=(400, 300))
    assert _at(picture, (0.0, 0.5, 0.08)) == TEAL
    assert _at(picture, (0.08, 0.5, 0.0)) != TEAL
    assert _at(picture, (0.0, 0.5, -0.08)) != TEAL


def test_frames_are_red_green_and_blue_axes(robot: World) -> None:
    picture = take_picture(robot, show=["frames"], views=["iso"], size_px=(600, 450))
    for axis, strongest in enumerate((0, 1, 2)):
        point = [0.0, 0.5, 0.0]
        point[axis] += 0.06
        colour = _at(picture, (point[0], point[1], point[2]))
        assert max(range(3), key=lambda channel: colour[channel]) == strongest
        assert min(colour) < 60


def test_the_inertia_box_of_a_uniform_box_is_that_box(robot: World) -> None:
    picture = take_picture(robot, show=["inertia"], views=["top"], size_px=(400, 300))
    for x in (-0.2, 0.2):
        assert _at(picture, (x, 0.0, 0.1)) == PURPLE
    for y in (-0.15, 0.15):
        assert _at(picture, (0.0, y, 0.1)) == PURPLE
    assert _at(picture, (0.1, 0.07, 0.1)) != PURPLE


@pytest.mark.parametrize("size", [(0.4, 0.3, 0.2), (0.1, 0.1, 2.0), (1.0, 1.0, 1.0)])
def test_equivalent_box_inverts_the_inertia_of_a_box(size: tuple[float, float, float]) -> None:
    found = equivalent_box(_body(3.0, size))
    assert found is not None
    edges, pose = found
    turned = np.abs(pose.matrix()[:3, :3]) @ np.array(edges)
    assert turned == pytest.approx(size)
    assert np.linalg.det(pose.matrix()[:3, :3]) == pytest.approx(1.0)


def test_an_inertia_that_no_box_has_is_reported() -> None:
    bad = Inertial(1.0, inertia_kg_m2=(1.0, 0.0, 0.0, 1.0, 0.0, 5.0))
    link = Link("odd", inertial=bad, visuals=(Visual("v", Sphere(0.1)),))
    found = Diagnostics()
    world = World(models=(Model("m", links=(link,)),))
    take_picture(world, show=["visuals", "inertia"], size_px=SIZE, diagnostics=found)
    (item,) = found
    assert item.code == "picture.no-inertia-box"
    assert item.message == "link 'odd' of 'm': no box has its mass 1 kg and its inertia"


def test_several_views_share_a_picture(robot: World) -> None:
    picture = take_picture(robot, views=["front", "side", "top"], size_px=SIZE)
    assert [(shot.left_px, shot.top_px) for shot in picture.shots] == [(0, 0), (100, 0), (0, 75)]
    for number in range(3):
        assert _is_green(_at(picture, (0.95, 0.5, 0.0), number))
    # The fourth place stays empty.
    assert len(np.unique(picture.rgb[75:, 100:].reshape(-1, 3), axis=0)) == 1


def test_a_camera_of_ones_own_sees_its_target_in_the_middle(robot: World) -> None:
    camera = looking_at((3.0, 2.0, 1.5), (0.95, 0.5, 0.0))
    picture = take_picture(robot, T_world_camera=camera, size_px=SIZE)
    assert picture.shots[0].view == "camera"
    assert picture.shots[0].pixel((0.95, 0.5, 0.0)) == pytest.approx((99.5, 74.5), abs=1e-6)
    assert _is_green(_at(picture, (0.95, 0.5, 0.0)))
    with pytest.raises(ValueError, match="behind the camera of view 'camera'"):
        picture.shots[0].pixel((5.0, 4.0, 1.5))


def test_wrong_words_and_sizes_are_refused(robot: World) -> None:
    with pytest.raises(NotFoundError, match="overlay 'colisions' not found; did you mean 'coll"):
        take_picture(robot, show=["colisions"])
    with pytest.raises(NotFoundError, match="view 'fron' not found; did you mean 'front'"):
        take_picture(robot, views=["fron"])
    with pytest.raises(ValueError, match="8x8 pixels do not do for 1 view"):
        take_picture(robot, size_px=(8, 8))
    with pytest.raises(ValueError, match="the world has no links"):
        take_picture(World())
    with pytest.raises(ValueError, match="the very point it is to look at"):
        looking_at((1.0, 1.0, 1.0), (1.0, 1.0, 1.0))
