"""Planner.load: plans, inverse kinematics and collisions without a graph."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.model import Box
from gazelle.errors import NotFoundError, UserFileError
from gazelle.geometry import Pose
from gazelle.motion import Planner
from gazelle.motion.planning import ErrorCode, PlanningError, Search, first_fault
from gazelle.motion.scene import WorldObject

_ARMS = Path(__file__).parent / "arms"
_LIMITS = "joint_limits:\n" + "".join(
    f"  joint{i}:\n    has_acceleration_limits: true\n    max_acceleration: 2.5\n"
    for i in range(1, 8)
)
_READY = {f"joint{i}": v for i, v in enumerate((0, -0.785, 0, -2.356, 0, 1.571, 0.785), start=1)}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A MoveIt config package of the seven-jointed arm."""
    folder = tmp_path / "src" / "seven_moveit_config"
    (folder / "config").mkdir(parents=True)
    package = "<package format='3'><name>seven_moveit_config</name><version>1.0.0</version>"
    package += "<description>x</description><maintainer email='a@b.example'>a</maintainer>"
    (folder / "package.xml").write_text(f"{package}<license>x</license></package>")
    for ending in ("urdf", "srdf"):
        text = (_ARMS / f"seven.{ending}").read_text(encoding="utf-8")
        (folder / "config" / f"seven.{ending}").write_text(text, encoding="utf-8")
    (folder / "config" / "joint_limits.yaml").write_text(_LIMITS, encoding="utf-8")
    kinematics = "arm:\n  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin\n"
    (folder / "config" / "kinematics.yaml").write_text(kinematics, encoding="utf-8")
    return folder


@pytest.fixture
def planner(package: Path) -> Planner:
    """A planner with the arm in its state ready."""
    made = Planner.load(package)
    assert list(made.diagnostics) == [], [str(item) for item in made.diagnostics]
    made.scene = made.scene.with_positions(_READY)
    return made


def test_a_plan_to_a_named_state_ends_there(package: Path) -> None:
    planner = Planner.load(package)
    motion = planner.plan("ready", group="arm", start={"joint4": -1.0})
    trajectory = motion.trajectory
    assert trajectory.names == tuple(_READY) and motion.group == "arm"
    np.testing.assert_allclose(trajectory.positions[-1], list(_READY.values()), atol=1e-9)
    assert trajectory.positions[0][3] == -1.0
    limits = planner.robot.group("arm").space
    assert (np.abs(trajectory.velocities) <= 0.1 * limits.velocity + 1e-9).all()
    assert (np.abs(trajectory.accelerations) <= 0.1 * 2.5 + 1e-9).all()


def test_scaling_makes_it_faster(planner: Planner) -> None:
    slow = planner.plan({"joint1": 1.0}, group="arm")
    fast = planner.plan({"joint1": 1.0}, group="arm", velocity_scaling=1, acceleration_scaling=1)
    assert fast.trajectory.duration_s < 0.5 * slow.trajectory.duration_s


def test_obstacles_are_gone_around(planner: Planner) -> None:
    tip = planner.fk({**_READY, "joint1": 0.7}, "tcp")
    x, y, _ = tip.position_m
    post = WorldObject.single("post", Box((0.08, 0.08, 1.6)), Pose((x, y, 0.8)))
    planner.scene = planner.scene.with_object(post)
    assert "post" in str(planner.collisions({**_READY, "joint1": 0.7}, group="arm")[0])
    motion = planner.plan({"joint1": 1.4}, group="arm", search=Search(seed=1))
    assert len(motion.path.waypoints) > 2
    group = planner.robot.group("arm")
    checker = planner._checker(group)
    assert first_fault(group.space, checker, motion.trajectory.positions) == ""


def test_a_pose_is_planned_to(planner: Planner) -> None:
    goal = planner.fk({**_READY, "joint1": 0.9, "joint4": -1.8}, "tcp")
    motion = planner.plan(goal, group="arm")
    end = dict(zip(motion.trajectory.names, motion.trajectory.positions[-1], strict=True))
    reached = planner.fk(end, "tcp")
    np.testing.assert_allclose(reached.matrix(), goal.matrix(), atol=1e-4)
    same = planner.plan(goal.matrix(), group="arm")
    np.testing.assert_array_equal(same.path.waypoints, motion.path.waypoints)


def test_inverse_kinematics_avoid_collisions(planner: Planner) -> None:
    goal = planner.fk(_READY, "tcp")
    found = planner.ik(goal, group="arm")
    assert found is not None and planner.collisions(found, group="arm") == ()
    blocked = planner.scene.with_object(
        WorldObject.single("block", Box((0.2, 0.2, 0.2)), Pose(goal.position_m))
    )
    planner.scene = blocked
    assert planner.ik(goal, group="arm") is None
    assert planner.ik(goal, group="arm", avoid_collisions=False) is not None


@pytest.mark.parametrize(
    ("pose", "code", "words"),
    [
        ((3.0, 0.0, 0.0), ErrorCode.NO_IK_SOLUTION, "brings 'tcp' to (3.000, 0.000, 0.000) m"),
        ((0.5, 0.0, 0.5), ErrorCode.GOAL_IN_COLLISION, "collides with object 'block'"),
    ],
)
def test_impossible_goals_say_why(
    planner: Planner, pose: tuple[float, float, float], code: ErrorCode, words: str
) -> None:
    block = WorldObject.single("block", Box((0.3, 0.3, 0.3)), Pose((0.5, 0.0, 0.5)))
    planner.scene = planner.scene.with_object(block)
    with pytest.raises(PlanningError) as caught:
        planner.plan(Pose(pose, (1.0, 0.0, 0.0, 0.0)), group="arm")
    assert caught.value.code is code and words in caught.value.reason


def test_a_goal_that_collides_names_the_pair(planner: Planner) -> None:
    tip = planner.fk({**_READY, "joint1": 1.0}, "tcp")
    block = WorldObject.single("block", Box((0.1, 0.1, 0.1)), tip)
    planner.scene = planner.scene.with_object(block)
    with pytest.raises(PlanningError) as caught:
        planner.plan({"joint1": 1.0}, group="arm")
    assert caught.value.code is ErrorCode.GOAL_IN_COLLISION
    assert "collides with object 'block'" in caught.value.reason


def test_unknown_names_say_what_there_is(planner: Planner) -> None:
    with pytest.raises(NotFoundError, match="'raedy' not found; did you mean 'ready'"):
        planner.plan("raedy", group="arm")
    with pytest.raises(NotFoundError, match="planning groups of 'seven': arm, hand, all"):
        planner.plan("ready")
    with pytest.raises(NotFoundError, match="did you mean 'tcp'"):
        planner.fk(link="tpc")
    assert planner.groups == ("arm", "hand", "all")
    assert planner.states("hand") == {"open": {"finger": 0.035}}
    with pytest.raises(ValueError, match="4×4"):
        planner.plan(np.zeros(7), group="arm")


def test_a_hand_is_planned_for_without_inverse_kinematics(planner: Planner) -> None:
    motion = planner.plan("open", group="hand")
    assert motion.trajectory.positions[-1].tolist() == pytest.approx([0.035])


def test_all_pairs_are_asked_when_no_group_is_named(planner: Planner) -> None:
    floor = WorldObject.single("floor", Box((1.0, 1.0, 0.1)), Pose())
    planner.scene = planner.scene.with_object(floor)
    assert planner.collisions(group="arm") == ()
    (found,) = planner.collisions()
    assert str(found).startswith("link 'base' collides with object 'floor'")


def test_a_folder_without_a_robot_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(UserFileError, match="does not say which robot it is for"):
        Planner.load(tmp_path)


# Largest way over its speed, and the time that speeding up takes.
_ARMS_OF_PACKAGES = [
    (
        Path(__file__).parents[2] / "examples/arm_ws/src/heron_moveit_config",
        "arm",
        [0.0, -0.3, 1.9, 0.0, 1.5416, 0.0],
        1.9 / 1.0 + 0.5,
    ),
    *shared_cases(
        (
            SHARED / "workspaces/ros2_ws/src/luck_robot",
            "",
            [0.0, 0.5, -0.6, 0.0, 0.4, 0.0],
            0.6 / 0.1 + 1.0,
        )
    ),
]


@pytest.mark.parametrize(("folder", "group", "expected", "duration_s"), _ARMS_OF_PACKAGES)
def test_arm_of_a_package_plans_to_ready(
    folder: Path, group: str, expected: list[float], duration_s: float
) -> None:
    motion = Planner.load(folder).plan("ready", group=group)
    np.testing.assert_allclose(motion.trajectory.positions[-1], expected, atol=1e-9)
    assert motion.trajectory.duration_s == pytest.approx(duration_s, rel=0.05)
