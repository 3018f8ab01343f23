"""What collides, against places where that is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import Box, Cone, Cylinder, Plane, Sphere
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray, Validity
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import (
    PlacedShape,
    PlanningScene,
    SceneMesh,
    SceneShape,
    WorldObject,
)

Make = Callable[..., RobotModel]

# A ball of 0.1 m at the end of a bar of 1 m that turns about z, and a second one beyond.
_SWING = (
    '<link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>'
    '<link name="ball"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry>'
    '</collision></link><link name="end"><collision><geometry><sphere radius="0.1"/></geometry>'
    "</collision></link>"
    '<joint name="swing" type="continuous"><parent link="base"/><child link="ball"/>'
    '<axis xyz="0 0 1"/></joint>'
    '<joint name="reach" type="prismatic"><parent link="ball"/><child link="end"/>'
    '<origin xyz="1 0 0"/><axis xyz="1 0 0"/>'
    '<limit lower="0.1" upper="1" velocity="1" effort="1"/></joint>'
)
_GROUPS = (
    '<group name="arm"><joint name="swing"/><joint name="reach"/></group>'
    '<group name="turn"><joint name="swing"/></group>'
)


def _scene(made: RobotModel, *items: WorldObject) -> PlanningScene:
    scene = PlanningScene.of(made)
    for item in items:
        scene = scene.with_object(item)
    return scene


def _q(swing: float, reach: float = 0.5) -> FloatArray:
    return np.array([swing, reach])


def test_links_collide_where_they_overlap(robot: Make) -> None:
    checker = CollisionChecker(_scene(robot(_SWING, _GROUPS)), "arm")
    assert isinstance(checker, Validity)
    assert checker.is_valid(_q(0.3)) and checker.why(_q(0.3)) == ""
    assert not checker.is_valid(_q(0.3, 0.15))
    assert checker.why(_q(0.3, 0.15)) == "link 'ball' collides with link 'end' (50.0 mm deep)"


def test_disabled_pairs_are_not_looked_at(robot: Make) -> None:
    pair = '<disable_collisions link1="ball" link2="end" reason="Adjacent"/>'
    checker = CollisionChecker(_scene(robot(_SWING, _GROUPS + pair)), "arm")
    assert checker.is_valid(_q(0.3, 0.15))


def test_default_and_enabled_pairs(robot: Make) -> None:
    quiet = '<disable_default_collisions link="end"/>'
    wall = WorldObject.single("wall", Box((0.2, 0.2, 0.2)), Pose((1.5, 0.0, 0.0)))
    made = robot(_SWING, _GROUPS + quiet)
    assert CollisionChecker(_scene(made, wall), "arm").is_valid(_q(0.0, 0.15))
    loud = quiet + '<enable_collisions link1="end" link2="ball"/>'
    checker = CollisionChecker(_scene(robot(_SWING, _GROUPS + loud), wall), "arm")
    assert not checker.is_valid(_q(0.0, 0.15)) and checker.is_valid(_q(0.0, 0.5))


def test_limits_are_part_of_validity(robot: Make) -> None:
    checker = CollisionChecker(_scene(robot(_SWING, _GROUPS)), "arm")
    assert not checker.is_valid(_q(0.0, 1.2))
    assert checker.why(_q(0.0, 1.2)) == "joint 'reach' is at 1.2, outside [0.1, 1]"
    assert checker.is_valid(_q(100.0)), "a continuous joint has no limits"


@pytest.mark.parametrize(
    ("shape", "reach_m"),
    [
        (Sphere(0.2), 0.2),
        (Box((0.4, 1.0, 1.0)), 0.2),
        (Cylinder(0.2, 1.0), 0.2),
        (Cone(0.2, 2.0), 0.1),
        (
            SceneMesh(
                np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-1, 1) for z in (-1.0, 1)]),
                np.zeros((0, 3), np.int32),
            ),
            0.2,
        ),
    ],
)
def test_every_shape_is_met_at_its_surface(robot: Make, shape: SceneShape, reach_m: float) -> None:
    made = robot(_SWING, _GROUPS)
    # The second ball's surface is at 1.1 m + reach.
    item = WorldObject.single("thing", shape, Pose((2.0, 0.0, 0.0)))
    checker = CollisionChecker(_scene(made, item), "arm")
    touching = 2.0 - reach_m - 1.1
    assert checker.is_valid(_q(0.0, touching - 0.003))
    assert not checker.is_valid(_q(0.0, touching + 0.003))
    assert "link 'end' collides with object 'thing'" in checker.why(_q(0.0, touching + 0.02))


def test_a_plane_is_a_half_space(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    item = WorldObject.single("wall", Plane((-1.0, 0.0, 0.0)), Pose((1.8, 0.0, 0.0)))
    checker = CollisionChecker(_scene(made, item), "arm")
    assert checker.is_valid(_q(0.0, 0.69)) and not checker.is_valid(_q(0.0, 0.71))
    assert checker.is_valid(_q(3.0, 0.9))


def test_a_hollow_mesh_is_hollow(robot: Make) -> None:
    """Two bars with a gap between them, in one mesh: the ball passes through."""
    made = robot(_SWING, _GROUPS)
    bars = [_bar(0.4), _bar(-0.4)]
    vertices = np.vstack([bar for bar, _ in bars])
    faces = np.vstack([faces + 8 * index for index, (_, faces) in enumerate(bars)])
    gate = WorldObject.single("gate", SceneMesh(vertices, faces), Pose((1.5, 0.0, 0.0)))
    checker = CollisionChecker(_scene(made, gate), "arm")
    assert checker.is_valid(_q(0.0, 0.5))
    assert not checker.is_valid(_q(0.27, 0.5))


def _bar(y: float) -> tuple[FloatArray, np.ndarray[tuple[int, int], np.dtype[np.int32]]]:
    corners = [(x, y + w, z) for x in (-0.1, 0.1) for w in (-0.1, 0.1) for z in (-0.5, 0.5)]
    faces = [
        (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
        (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
    ]  # fmt: skip
    return np.array(corners), np.array(faces, np.int32)


def test_motions_are_checked_all_the_way(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    post = WorldObject.single("post", Cylinder(0.01, 2.0), Pose((0.0, 1.5, 0.0)))
    checker = CollisionChecker(_scene(made, post), "arm")
    assert not checker.motion_is_valid(_q(0.0), _q(3.0), 0.02)
    assert checker.motion_is_valid(_q(0.0), _q(-3.0), 0.02)
    assert not checker.motion_is_valid(_q(0.0), _q(0.0, 2.0), 0.02), "the end is out of limits"


def test_only_pairs_count_that_the_group_moves(robot: Make) -> None:
    """What is wrong elsewhere does not keep a group from moving."""
    made = robot(_SWING, _GROUPS)
    inside = WorldObject.single("floor", Box((0.5, 0.5, 0.5)), Pose())
    scene = _scene(made, inside)
    assert CollisionChecker(scene, "arm").is_valid(_q(0.0))
    whole = CollisionChecker(scene)
    assert not whole.is_valid(_q(0.0))
    assert "link 'base' collides with object 'floor'" in whole.why(_q(0.0))


def test_joints_outside_the_group_stand_where_the_scene_says(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    post = WorldObject.single("post", Sphere(0.1), Pose((1.9, 0.0, 0.0)))
    scene = _scene(made, post)
    assert CollisionChecker(scene.with_positions({"reach": 0.3}), "turn").is_valid(np.zeros(1))
    far = CollisionChecker(scene.with_positions({"reach": 0.9}), "turn")
    assert not far.is_valid(np.zeros(1)) and far.is_valid(np.ones(1))


def test_attached_things_move_along_and_may_be_touched(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    stick = WorldObject.single("stick", Box((0.6, 0.02, 0.02)), Pose((1.55, 0.0, 0.0)))
    scene = _scene(made, stick).with_positions({"swing": 0.0, "reach": 0.5})
    wall = WorldObject.single("wall", Box((0.1, 1.0, 1.0)), Pose((0.0, 2.25, 0.0)))
    held = scene.with_object(wall).attach("stick", "end")
    checker = CollisionChecker(held, "arm")
    assert checker.is_valid(_q(0.0))
    reason = checker.why(_q(np.pi / 2))
    assert "attached object 'stick' collides with object 'wall'" in reason and "'end'" not in reason
    # Drawn in, the stick reaches the first ball, which it may touch only if that is said.
    assert "link 'ball' collides with attached object 'stick'" in checker.why(_q(0.0, 0.25))
    allowed = CollisionChecker(scene.attach("stick", "end", ["ball"]), "arm")
    assert "stick" not in allowed.why(_q(0.0, 0.25))


def test_things_attached_to_one_link_may_touch(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    scene = _scene(made, WorldObject.single("a", Sphere(0.05), Pose((1.7, 0.0, 0.0))))
    scene = scene.with_object(WorldObject.single("b", Sphere(0.05), Pose((1.72, 0.0, 0.0))))
    scene = scene.with_positions({"reach": 0.5}).attach("a", "end").attach("b", "end")
    assert CollisionChecker(scene, "arm").is_valid(_q(0.0))


def test_moving_a_thing_needs_no_new_model(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    scene = _scene(made, WorldObject.single("post", Sphere(0.1), Pose((1.5, 0.0, 0.0))))
    checker = CollisionChecker(scene, "arm")
    assert not checker.is_valid(_q(0.0)) and checker.why(_q(0.0))
    moved = checker.follow(scene.with_object(scene.objects["post"].at(Pose((0.0, 1.5, 0.0)))))
    assert moved._contacts._built is checker._contacts._built
    assert moved.is_valid(_q(0.0)) and not moved.is_valid(_q(np.pi / 2))
    assert not checker.is_valid(_q(0.0)), "the first checker keeps its scene"
    more = moved.follow(_scene(made, WorldObject("two", (PlacedShape(Sphere(0.1)),))))
    assert more._contacts._built is not checker._contacts._built


def test_copies_are_independent(robot: Make) -> None:
    checker = CollisionChecker(_scene(robot(_SWING, _GROUPS)), "arm")
    other = checker.copy()
    assert other.is_valid(_q(0.0)) and not checker.is_valid(_q(0.0, 0.15))
    assert other.why(_q(0.0, 0.15)) == checker.why(_q(0.0, 0.15)) != ""
    assert other._contacts._data is not checker._contacts._data


def test_the_distance_is_that_of_the_nearest_pair(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    item = WorldObject.single("ball", Sphere(0.1), Pose((2.0, 0.0, 0.0)))
    with pytest.raises(ValueError, match="is a link"):
        _scene(made, item)
    post = WorldObject.single("post", Sphere(0.1), Pose((2.0, 0.0, 0.0)))
    checker = CollisionChecker(_scene(made, post), "arm")
    assert checker.distance_m(_q(0.0, 0.6)) == pytest.approx(0.2, abs=1e-6)
    assert checker.distance_m(_q(0.0, 0.95)) == pytest.approx(-0.15, abs=1e-6)


def test_padding_keeps_links_away(robot: Make) -> None:
    made = robot(_SWING, _GROUPS)
    post = WorldObject.single("post", Sphere(0.1), Pose((2.0, 0.0, 0.0)))
    scene = _scene(made, post)
    near = _q(0.0, 0.75)
    assert CollisionChecker(scene, "arm").is_valid(near)
    assert not CollisionChecker(replace(scene, padding_m={"end": 0.1}), "arm").is_valid(near)


def test_mimicking_links_are_checked(seven: RobotModel) -> None:
    scene = PlanningScene.of(seven).with_positions(seven.group("arm").states["ready"])
    at = scene.with_positions({"finger": 0.04}).pose_of("finger_right") @ Pose((0.0, -0.025, 0.03))
    post = WorldObject.single("post", Sphere(0.01), at)
    checker = CollisionChecker(scene.with_object(post), "hand")
    assert checker.is_valid(np.array([0.0]))
    assert "link 'finger_right' collides with object 'post'" in checker.why(np.array([0.04]))


def test_a_floating_robot_is_checked_where_it_is(robot: Make) -> None:
    made = robot(
        '<link name="a"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/>'
        "</geometry></collision></link>",
        '<virtual_joint name="v" type="floating" parent_frame="world" child_link="a"/>'
        '<group name="g"><joint name="v"/></group>',
    )
    post = WorldObject.single("post", Sphere(0.1), Pose((0.5, 1.0, 0.0)))
    checker = CollisionChecker(_scene(made, post), "g")
    half = np.sqrt(0.5)
    turned = np.array([0.5, 0.0, 0.0, 0.0, 0.0, half, half])
    assert not checker.is_valid(turned), "a quarter turn about z brings the ball to the post"
    assert checker.is_valid(np.array([0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))


def test_luck_is_free_in_its_named_states(luck: RobotModel) -> None:
    checker = CollisionChecker(PlanningScene.of(luck), "test_group")
    group = luck.group("test_group")
    for name in ("home", "ready"):
        q = group.space.array(dict(group.states[name]))
        assert checker.why(q) == "", name
    rng = np.random.default_rng(0)
    reasons = [checker.why(group.space.sample(rng)) for _ in range(200)]
    assert any("link 'link_2' collides with link 'link_4'" in reason for reason in reasons)
