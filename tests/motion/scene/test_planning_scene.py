"""Planning scenes: things that come, go, are taken up and put down."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.description.model import Box, Sphere
from gazelle.description.srdf import CollisionPair, Srdf
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import AllowedCollisions, PlanningScene, SceneMesh, WorldObject


def _box(name: str = "box", x: float = 1.0) -> WorldObject:
    return WorldObject.single(name, Box((0.1, 0.1, 0.1)), Pose((x, 0.0, 0.0)))


def test_scenes_do_not_change(seven: RobotModel) -> None:
    empty = PlanningScene.of(seven)
    full = empty.with_object(_box())
    assert list(empty.objects) == [] and list(full.objects) == ["box"]
    assert list(full.with_object(_box(x=2.0)).objects) == ["box"]
    assert list(full.without_object("box").objects) == []


def test_a_thing_keeps_its_place_when_it_is_attached_and_left(seven: RobotModel) -> None:
    scene = PlanningScene.of(seven).with_positions({"joint1": 0.5})
    scene = scene.with_object(_box()).attach("box", "tcp", ["finger_left"])
    assert list(scene.objects) == [] and scene.attached["box"].link == "tcp"
    assert scene.pose_of("box").position_m == pytest.approx((1.0, 0.0, 0.0))
    turned = scene.with_positions({"joint1": 0.5 + np.pi / 2})
    assert turned.pose_of("box").position_m == pytest.approx((0.0, 1.0, 0.0))
    left = turned.detach("box")
    assert left.objects["box"].T_frame_object.position_m == pytest.approx((0.0, 1.0, 0.0))
    assert list(turned.without_attached("box").objects) == []


def test_frames_of_links_things_and_their_subframes(seven: RobotModel) -> None:
    item = WorldObject(
        "mug", (), Pose((1.0, 0.0, 0.5)), subframes={"handle": Pose((0.0, 0.1, 0.0))}
    )
    scene = PlanningScene.of(seven).with_object(item)
    assert scene.pose_of("mug/handle").position_m == (1.0, 0.1, 0.5)
    assert scene.pose_of("world") == Pose()
    assert scene.pose_of("link1").position_m == pytest.approx((0.0, 0.0, 0.333))
    with pytest.raises(NotFoundError, match="did you mean 'handle'"):
        scene.pose_of("mug/handel")
    with pytest.raises(NotFoundError, match="did you mean 'mug'"):
        scene.pose_of("mgu")


def test_names_of_links_are_not_for_things(seven: RobotModel) -> None:
    with pytest.raises(ValueError, match="'hand' is a link of the robot"):
        PlanningScene.of(seven).with_object(_box("hand"))
    with pytest.raises(NotFoundError, match="object 'bos' not found; did you mean 'box'"):
        PlanningScene.of(seven).with_object(_box()).without_object("bos")
    with pytest.raises(NotFoundError, match="link 'hnad' not found; did you mean 'hand'"):
        PlanningScene.of(seven).with_object(_box()).attach("box", "hnad")


def test_the_matrix_asks_pairs_before_defaults() -> None:
    srdf = Srdf(
        disabled_pairs=(CollisionPair("a", "b"), CollisionPair("a", "c")),
        enabled_pairs=(CollisionPair("a", "c"), CollisionPair("d", "e")),
        no_default_collisions=("d",),
    )
    matrix = AllowedCollisions.from_srdf(srdf)
    assert matrix.allows("b", "a") and not matrix.allows("b", "c")
    assert matrix.allows("a", "c"), "disabled pairs have the last word"
    assert matrix.allows("d", "x") and not matrix.allows("d", "e")
    changed = matrix.with_default("x", False)
    assert not changed.allows("d", "x"), "both defaults have to allow"
    assert changed.with_pair("d", "x", True).allows("x", "d")
    assert changed.without("x") == matrix
    assert matrix.with_pairs("f", ["a", "f", "b"], True).allows("a", "f")


@pytest.mark.parametrize(
    ("vertices", "faces", "words"),
    [
        (np.zeros((0, 3)), np.zeros((0, 3), np.int32), r"shape \(0, 3\)"),
        (np.full((3, 3), np.inf), np.zeros((0, 3), np.int32), "not finite"),
        (np.zeros((3, 3)), np.array([[0, 1, 3]], np.int32), "vertices that are not there"),
    ],
)
def test_broken_meshes_are_refused(vertices: object, faces: object, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        SceneMesh(vertices, faces)  # type: ignore[arg-type]


def test_shapes_of_one_thing_are_placed_in_its_frame() -> None:
    item = WorldObject.single("ball", Sphere(0.1), Pose((1.0, 2.0, 3.0)))
    assert item.at(Pose()).T_frame_object == Pose() and item.shapes[0].shape == Sphere(0.1)
