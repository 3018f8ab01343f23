"""Bounds of whole motions against MuJoCo's contacts, state by state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import Box, Capsule, Cone, Cylinder, Ellipsoid, Plane, Sphere
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.collision.continuous import Verdict
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import PlacedShape, PlanningScene, SceneShape, WorldObject

Make = Callable[..., RobotModel]

_SHAPES: tuple[SceneShape, ...] = (
    Box((0.2, 0.3, 0.1)),
    Sphere(0.12),
    Cylinder(0.08, 0.4),
    Capsule(0.07, 0.3),
    Ellipsoid((0.1, 0.2, 0.15)),
    Cone(0.15, 0.3),
)
_SHALLOW_M = 1e-5


def _crowded(robot: RobotModel, seed: int) -> PlanningScene:
    """Return a robot among two of each shape, one of them part of a thing of several, a floor."""
    rng = np.random.default_rng(seed)
    scene = PlanningScene.of(robot)
    for number in range(2):
        placed = []
        for place, shape in enumerate(_SHAPES):
            quat = rng.normal(size=4)
            at = Pose(tuple(rng.uniform(-1.2, 1.2, 3)), tuple(quat / np.linalg.norm(quat)))
            if number:
                placed.append(PlacedShape(shape, at))
            else:
                scene = scene.with_object(WorldObject.single(f"thing {place}", shape, at))
        if placed:
            scene = scene.with_object(WorldObject("heap", tuple(placed)))
    return scene.with_object(
        WorldObject.single("floor", Plane((0.0, 0.1, 1.0)), Pose((0.0, 0.0, -0.5)))
    )


@pytest.fixture(params=["ur_like", "seven"])
def crowded(request: pytest.FixtureRequest) -> CollisionChecker:
    """The arm among the shapes, and it carries a stick."""
    robot: RobotModel = request.getfixturevalue(request.param)
    scene = _crowded(robot, 4)
    tip = robot.group("arm").links[-1]
    at = scene.pose_of(tip)
    scene = scene.with_object(WorldObject.single("stick", Box((0.02, 0.02, 0.2)), at))
    return CollisionChecker(scene.attach("stick", tip, robot.links), "arm")


def test_what_is_said_of_a_state_is_so(crowded: CollisionChecker) -> None:
    rng = np.random.default_rng(5)
    assert crowded.group is not None
    said = dict.fromkeys(Verdict, 0)
    for _ in range(600):
        q = crowded.group.space.sample(rng)
        verdict = crowded._sweeper.state(q)
        said[verdict] += 1
        if verdict is not Verdict.DOUBTFUL:
            assert crowded._contacts.touches(q) == (verdict is Verdict.COLLIDES), crowded.why(q)
    assert said[Verdict.FREE] > 30
    assert said[Verdict.COLLIDES] > 30
    assert said[Verdict.DOUBTFUL] <= 6, "only what is about to touch is in doubt"


def test_a_motion_that_is_said_to_be_free_is_free_all_along(crowded: CollisionChecker) -> None:
    rng = np.random.default_rng(6)
    assert crowded.group is not None
    space, free = crowded.group.space, 0
    for _ in range(150):
        start, way = space.sample(rng), rng.normal(size=space.size)
        end = space.clamped(start + way * (rng.uniform(0.0, 1.5) / np.linalg.norm(way)))
        verdict, _ = crowded._sweeper.motion(start, end, 0.005)
        states = np.linspace(start, end, 30)[1:]
        depths = [max((c.depth_m for c in crowded.contacts(q)), default=0.0) for q in states]
        if verdict is Verdict.FREE:
            free += 1
            assert max(depths) < _SHALLOW_M, crowded.why(states[int(np.argmax(depths))])
        elif verdict is Verdict.COLLIDES:
            found = [crowded._contacts.touches(q) for q in np.linspace(start, end, 1000)]
            assert any(found)
    assert free > 10


def test_a_verdict_does_not_depend_on_what_was_asked_before(crowded: CollisionChecker) -> None:
    rng = np.random.default_rng(7)
    assert crowded.group is not None
    space = crowded.group.space
    ends = [(space.sample(rng), space.sample(rng)) for _ in range(60)]
    first = [crowded._sweeper.motion(a, b, 0.1)[0] for a, b in ends]
    again = [crowded._sweeper.motion(a, b, 0.1)[0] for a, b in reversed(ends)]
    fresh = CollisionChecker(crowded.scene, crowded.group)
    assert first == again[::-1] == [fresh._sweeper.motion(a, b, 0.1)[0] for a, b in ends]


_SLIDING = (
    '<link name="base"/>'
    '<link name="cart"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>'
    '<link name="twin"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
    '<joint name="slide" type="prismatic"><parent link="base"/><child link="cart"/>'
    '<axis xyz="1 0 0"/><limit lower="-2" upper="2" velocity="1" effort="1"/></joint>'
    '<joint name="follow" type="revolute"><parent link="base"/><child link="twin"/>'
    '<origin xyz="0 1 0"/><axis xyz="0 0 1"/><mimic joint="slide" multiplier="-2"/>'
    '<limit lower="-9" upper="9" velocity="1" effort="1"/></joint>'
)


@pytest.mark.parametrize(
    ("at", "is_free"),
    [((1.0, 0.0, 0.0), False), ((1.0, 0.0, 0.35), True), ((0.0, 1.5, 0.0), True)],
)
def test_a_slide_is_followed_all_the_way(
    robot: Make, at: tuple[float, float, float], is_free: bool
) -> None:
    made = robot(_SLIDING, '<group name="g"><joint name="slide"/></group>')
    post = WorldObject.single("post", Sphere(0.1), Pose(at))
    checker = CollisionChecker(PlanningScene.of(made).with_object(post), "g")
    # A third of the way is as long as a step here: what is found is between the steps.
    assert checker.motion_is_valid(np.array([-2.0]), np.array([2.0]), 0.05) is is_free


def test_what_follows_a_joint_is_followed(robot: Make) -> None:
    """The twin turns twice as far as the cart slides, on an arm of half a metre."""
    arm = _SLIDING.replace(
        '<link name="twin"><collision>', '<link name="twin"><collision><origin xyz="0.5 0 0"/>'
    )
    made = robot(arm, '<group name="g"><joint name="slide"/></group>')
    post = WorldObject.single("post", Sphere(0.02), Pose((-0.5, 1.0, 0.0)))
    checker = CollisionChecker(PlanningScene.of(made).with_object(post), "g")
    assert not checker.motion_is_valid(np.array([0.0]), np.array([2.0]), 0.05)
    assert checker.motion_is_valid(np.array([0.0]), np.array([1.3]), 0.05)


def test_two_that_lie_in_each_other_evenly_touch(robot: Make) -> None:
    """The origin of their difference lies on edges of all that the search looks at."""
    made = robot(_SLIDING, '<group name="g"><joint name="slide"/></group>')
    for size in ((0.2, 0.2, 0.2), (0.4, 0.1, 0.1), (1.0, 1.0, 0.001)):
        box = WorldObject.single("box", Box(size), Pose())
        checker = CollisionChecker(PlanningScene.of(made).with_object(box), "g")
        assert not checker.is_valid(np.zeros(1)), size
        assert not checker.is_valid(np.array([0.001])), size


def test_what_is_padded_is_left_to_the_exact_check(robot: Make) -> None:
    made = robot(_SLIDING, '<group name="g"><joint name="slide"/></group>')
    post = WorldObject.single("post", Sphere(0.1), Pose((0.25, 0.0, 0.0)))
    scene = PlanningScene.of(made).with_object(post)
    assert CollisionChecker(scene, "g").is_valid(np.zeros(1))
    padded = CollisionChecker(replace(scene, padding_m={"cart": 0.1}), "g")
    assert padded._sweeper.state(np.zeros(1)) is Verdict.DOUBTFUL
    assert not padded.is_valid(np.zeros(1))
    assert padded.is_valid(np.array([-0.2]))


def test_nothing_is_compiled_for_mujoco_before_something_is_in_doubt(robot: Make) -> None:
    made = robot(_SLIDING, '<group name="g"><joint name="slide"/></group>')
    checker = CollisionChecker(PlanningScene.of(made), "g")
    assert checker.is_valid(np.zeros(1))
    assert "_built" not in vars(checker._contacts)
    assert checker.why(np.zeros(1)) == ""
    assert "_built" in vars(checker._contacts)


def test_what_is_no_number_is_not_free(robot: Make) -> None:
    turning = _SLIDING.replace('type="prismatic"', 'type="continuous"')
    made = robot(turning, '<group name="g"><joint name="slide"/></group>')
    checker = CollisionChecker(PlanningScene.of(made), "g")
    for value in (np.nan, np.inf, -np.inf):
        assert not checker.is_valid(np.array([value]))
        assert not checker.motion_is_valid(np.zeros(1), np.array([value]), 0.005)


def test_a_motion_of_many_turns_is_looked_at_piece_by_piece(robot: Make) -> None:
    """No more memory is taken than for a motion that an arm makes."""
    turning = _SLIDING.replace('type="prismatic"', 'type="continuous"')
    arm = turning.replace(
        '<link name="cart"><collision>', '<link name="cart"><collision><origin xyz="0 -0.5 0"/>'
    )
    made = robot(arm, '<group name="g"><joint name="slide"/></group>')
    free = CollisionChecker(PlanningScene.of(made), "g")
    assert free.motion_is_valid(np.zeros(1), np.array([600.0]), 0.05)
    post = WorldObject.single("post", Sphere(0.1), Pose((0.0, 0.0, 0.5)))
    barred = CollisionChecker(PlanningScene.of(made).with_object(post), "g")
    assert not barred.motion_is_valid(np.zeros(1), np.array([600.0]), 0.05)


def test_a_slide_beyond_its_limits_carries_what_is_behind_it_as_far(robot: Make) -> None:
    """Nobody plans for the slide, and it stands 3 m out where 0.1 m is its limit."""
    links = '<link name="base"/><link name="mast"/><link name="end"><collision><geometry>'
    made = robot(
        links + '<sphere radius="0.05"/></geometry></collision></link>'
        '<joint name="turn" type="revolute"><parent link="base"/><child link="mast"/>'
        '<axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>'
        '<joint name="out" type="prismatic"><parent link="mast"/><child link="end"/>'
        '<axis xyz="1 0 0"/><limit lower="0" upper="0.1" velocity="1" effort="1"/></joint>',
        '<group name="g"><joint name="turn"/></group>',
    )
    # In the way after a quarter of the turn; the ends and the middle are far from it.
    at = (3.0 * np.cos(0.75), 3.0 * np.sin(0.75), 0.0)
    post = WorldObject.single("post", Sphere(0.05), Pose(at))
    near = CollisionChecker(PlanningScene.of(made).with_object(post), "g")
    assert near.motion_is_valid(np.zeros(1), np.array([3.0]), 0.01)
    far = near.scene.with_positions({"out": 3.0})
    for checker in (CollisionChecker(far, "g"), near.follow(far)):
        assert not checker.motion_is_valid(np.zeros(1), np.array([3.0]), 0.01)
