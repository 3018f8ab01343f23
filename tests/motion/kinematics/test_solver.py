"""Forward kinematics against the description's own, inverse kinematics against forward."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gazelle.description.forward_kinematics import posed_model
from gazelle.description.moveit import KinematicsSettings
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Patience, Solver, link_poses
from gazelle.motion.model import RobotModel

Make = Callable[..., RobotModel]

_POSES = 500
_PLANAR_ARM = (
    '<link name="a"/><link name="b"/>'
    '<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>'
    '<origin xyz="0.3 0 0.2"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>'
)


def _numerical(solver: Solver, q: FloatArray) -> FloatArray:
    """Difference quotients of the tip's pose."""
    pose, step = solver.fk(q), 1e-6
    found = np.zeros((6, len(q)))
    for index in range(len(q)):
        shift = np.zeros(len(q))
        shift[index] = step
        change = (solver.fk(q + shift) - solver.fk(q - shift)) / (2 * step)
        spin = change[:3, :3] @ pose[:3, :3].T
        found[:3, index] = change[:3, 3]
        found[3:, index] = spin[2, 1], spin[0, 2], spin[1, 0]
    return found


def _solved(robot: RobotModel, group: str, seed: int) -> int:
    """Count the random reachable poses that are solved within the limits."""
    solver, rng = Solver(robot, group), np.random.default_rng(seed)
    space = solver.group.space
    count = 0
    for _ in range(_POSES):
        pose = solver.fk(space.sample(rng))
        q = solver.ik(pose, seed_q=space.sample(rng), rng=rng)
        if q is not None:
            np.testing.assert_allclose(solver.fk(q), pose, atol=3e-5)
            assert not space.outside(q, 1e-9)
            count += 1
    return count


def test_poses_are_those_of_the_description(seven: RobotModel) -> None:
    rng = np.random.default_rng(0)
    values = dict(zip(seven.variables, rng.uniform(-1, 1, len(seven.variables)), strict=True))
    positions = seven.positions(values)
    own = posed_model(seven.description, seven.named(positions))
    poses = link_poses(seven, positions)
    assert set(poses) == {link.name for link in own.links}
    for link in own.links:
        np.testing.assert_allclose(poses[link.name], link.T_model_link.matrix(), atol=1e-12)


@pytest.mark.parametrize("name", ["ur_like", "seven"])
def test_solver_and_robot_agree_on_every_link(name: str, request: pytest.FixtureRequest) -> None:
    robot: RobotModel = request.getfixturevalue(name)
    solver = Solver(robot, "arm")
    q = solver.group.space.sample(np.random.default_rng(3))
    poses = link_poses(robot, robot.with_group(solver.group, q, robot.default_positions()))
    for link, pose in poses.items():
        np.testing.assert_allclose(solver.fk(q, link), pose, atol=1e-12)


@pytest.mark.parametrize("name", ["ur_like", "seven"])
def test_jacobian_is_the_derivative(name: str, request: pytest.FixtureRequest) -> None:
    solver = Solver(request.getfixturevalue(name), "arm")
    q = solver.group.space.sample(np.random.default_rng(4))
    np.testing.assert_allclose(solver.jacobian(q), _numerical(solver, q), atol=1e-8)


def test_jacobian_of_a_tool_is_that_of_a_link_there(seven: RobotModel) -> None:
    solver = Solver(seven, "arm")
    q = solver.group.space.sample(np.random.default_rng(5))
    tool = np.linalg.inv(solver.fk(q, "hand")) @ solver.fk(q, "tcp")
    found = solver.jacobian(q, "hand", T_link_tool=tool)
    np.testing.assert_allclose(found, solver.jacobian(q, "tcp"), atol=1e-12)


@pytest.mark.parametrize("name", ["ur_like", "seven"])
def test_random_reachable_poses_are_solved(name: str, request: pytest.FixtureRequest) -> None:
    assert _solved(request.getfixturevalue(name), "arm", 1) >= 0.99 * _POSES


def test_random_reachable_poses_of_luck_are_solved(luck: RobotModel) -> None:
    assert _solved(luck, "test_group", 1) >= 0.99 * _POSES


def test_the_answer_is_near_the_seed(seven: RobotModel) -> None:
    solver = Solver(seven, "arm")
    q = solver.group.space.array(solver.group.states["ready"])
    pose = solver.fk(q)
    pose[0, 3] += 0.01
    found = solver.ik(pose, seed_q=q)
    assert found is not None and np.abs(found - q).max() < 0.1


def test_whole_turns_are_taken_towards_the_seed(ur_like: RobotModel) -> None:
    solver = Solver(ur_like, "arm")
    q = np.array([4.0, -1.0, 1.0, -5.0, 0.7, 5.5])
    found = solver.ik(solver.fk(q), seed_q=q)
    assert found is not None
    np.testing.assert_allclose(found, q, atol=1e-4)
    elsewhere = solver.ik(solver.fk(q), seed_q=np.array([-2.0, -1.0, 1.0, 1.0, 0.7, -1.0]))
    assert elsewhere is not None and not solver.group.space.outside(elsewhere)
    assert abs(elsewhere[0] + 2.0) < np.pi and abs(elsewhere[5] + 1.0) < np.pi


def test_what_is_out_of_reach_has_no_answer(ur_like: RobotModel) -> None:
    pose = np.eye(4)
    pose[:3, 3] = 5.0, 0.0, 0.0
    assert Solver(ur_like, "arm").ik(pose, patience=Patience(attempts=20)) is None


def test_position_only_leaves_the_orientation(ur_like: RobotModel) -> None:
    solver = Solver(ur_like, "arm", settings=KinematicsSettings(position_only=True))
    pose = np.eye(4)
    pose[:3, 3] = 0.4, 0.2, 0.3
    found = solver.ik(pose)
    assert found is not None
    np.testing.assert_allclose(solver.fk(found)[:3, 3], pose[:3, 3], atol=1e-5)
    assert np.abs(solver.fk(found)[:3, :3] - pose[:3, :3]).max() > 0.1


def test_a_tool_is_brought_to_the_pose(seven: RobotModel) -> None:
    solver = Solver(seven, "arm")
    tool = Pose.from_xyz_rpy((0.0, 0.05, 0.2), (0.3, 0.0, 0.5)).matrix()
    q = solver.group.space.array(solver.group.states["ready"])
    pose = solver.fk(q) @ tool
    found = solver.ik(pose, T_link_tool=tool)
    assert found is not None
    np.testing.assert_allclose(solver.fk(found) @ tool, pose, atol=3e-5)


def test_other_links_can_be_brought_to_poses(seven: RobotModel) -> None:
    solver = Solver(seven, "arm")
    q = solver.group.space.array(solver.group.states["ready"])
    found = solver.ik(solver.fk(q, "link5"), link="link5", seed_q=q + 0.1)
    assert found is not None
    np.testing.assert_allclose(solver.fk(found, "link5"), solver.fk(q, "link5"), atol=3e-5)
    assert found[5:] == pytest.approx(q[5:] + 0.1), "joints beyond the link stay"


def test_answers_that_are_refused_are_not_given(ur_like: RobotModel) -> None:
    class ElbowUp:
        def is_valid(self, q: FloatArray) -> bool:
            return bool(q[2] > 0)

        def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
            raise AssertionError("inverse kinematics ask for states only")

        def why(self, q: FloatArray) -> str:
            return "" if self.is_valid(q) else "the elbow is down"

    solver = Solver(ur_like, "arm")
    pose = solver.fk(np.array([0.5, -1.0, 1.2, -0.5, 0.7, 0.1]))
    seed = np.array([0.5, -0.2, -1.2, -0.5, 0.7, 0.1])
    free, up = solver.ik(pose, seed_q=seed), solver.ik(pose, seed_q=seed, validity=ElbowUp())
    assert free is not None and free[2] < 0
    assert up is not None and up[2] > 0
    np.testing.assert_allclose(solver.fk(up), pose, atol=3e-5)


def test_the_same_seed_gives_the_same_answer(ur_like: RobotModel) -> None:
    solver = Solver(ur_like, "arm")
    pose = solver.fk(np.array([2.0, -1.0, 1.2, -0.5, 0.7, 3.0]))
    first, second = (solver.ik(pose, rng=np.random.default_rng(7)) for _ in range(2))
    assert first is not None and second is not None and np.array_equal(first, second)


def test_sliding_joints_and_a_planar_base_are_solved(robot: Make) -> None:
    made = robot(
        _PLANAR_ARM,
        '<virtual_joint name="base" type="planar" parent_frame="odom" child_link="a"/>'
        '<group name="g"><joint name="base"/><joint name="j"/></group>',
    )
    solver = Solver(made, "g")
    q = np.array([1.0, -2.0, 0.8, 0.4])
    np.testing.assert_allclose(solver.jacobian(q), _numerical(solver, q), atol=1e-8)
    found = solver.ik(solver.fk(q))
    assert found is not None
    np.testing.assert_allclose(found, q, atol=1e-4)


def test_a_floating_base_is_solved(robot: Make) -> None:
    made = robot(
        _PLANAR_ARM,
        '<virtual_joint name="base" type="floating" parent_frame="world" child_link="a"/>'
        '<group name="g"><joint name="base"/></group>',
    )
    solver = Solver(made, "g", tip_link="b")
    goal = Pose.from_xyz_rpy((1.0, 2.0, 3.0), (0.4, -0.5, 2.0)).matrix()
    found = solver.ik(goal)
    assert found is not None and found.shape == (7,)
    np.testing.assert_allclose(solver.fk(found), goal, atol=3e-5)
    assert np.linalg.norm(found[3:]) == pytest.approx(1.0)


def test_mimicking_joints_within_a_chain_are_solved(robot: Make) -> None:
    links = "".join(f'<link name="{name}"/>' for name in "abcd")
    joints = "".join(
        f'<joint name="{name}" type="revolute"><parent link="{above}"/><child link="{below}"/>'
        f'<origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>'
        f'<limit lower="-2" upper="2" velocity="1" effort="1"/>{mimic}</joint>'
        for name, above, below, mimic in (
            ("j", "a", "b", ""),
            ("k", "b", "c", '<mimic joint="j" multiplier="0.5" offset="0.2"/>'),
            ("l", "c", "d", ""),
        )
    )
    made = robot(links + joints, '<group name="g"><chain base_link="a" tip_link="d"/></group>')
    solver = Solver(made, "g")
    assert solver.group.variables == ("j", "l")
    q = np.array([0.7, -0.9])
    np.testing.assert_allclose(solver.jacobian(q), _numerical(solver, q), atol=1e-8)
    found = solver.ik(solver.fk(q))
    assert found is not None
    np.testing.assert_allclose(found, q, atol=1e-4)


def test_joints_outside_the_group_stand_where_they_are_said_to(seven: RobotModel) -> None:
    bent = seven.positions({"joint1": 1.0})
    at_rest = Solver(seven, "hand", tip_link="finger_left")
    moved = at_rest.at(bent)
    q = np.array([0.02])
    expected = link_poses(seven, seven.positions({"joint1": 1.0, "finger": 0.02}))["finger_left"]
    np.testing.assert_allclose(moved.fk(q), expected, atol=1e-12)
    assert np.abs(at_rest.fk(q) - expected).max() > 0.1


def test_groups_with_several_tips_ask_for_one(seven: RobotModel) -> None:
    with pytest.raises(NotFoundError, match="name one of them: finger_left, finger_right"):
        Solver(seven, "hand").ik(np.eye(4))
    with pytest.raises(NotFoundError, match=r"link 'tpc' not found; did you mean 'tcp'"):
        Solver(seven, "arm").fk(np.zeros(7), "tpc")


def test_poses_with_nan_are_refused(seven: RobotModel) -> None:
    with pytest.raises(ValueError, match="not finite"):
        Solver(seven, "arm").ik(np.full((4, 4), np.nan))
