"""Laws of every trajectory that leaves move_group."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
from tests.nodes.move_group.conftest import (
    JOINTS,
    READY,
    ArmBench,
    joint_goal,
    parameters,
    pose_goal,
)

from gazelle.description.model import Box
from gazelle.description.moveit import config_from_parameters
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.motion import Planner
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.planning import FINE_STEP
from gazelle.motion.scene import WorldObject
from gazelle.parameters.trees import nested

_WALL = ("wall", (0.3, 0.02, 0.4), (0.4, 0.0, 0.2))
_POST = ("post", (0.05, 0.05, 0.8), (0.0, 0.45, 0.4))


@pytest.fixture(scope="module")
def planner() -> Planner:
    """The same arm, with a collision checker of its own."""
    tree = nested(parameters())
    config = config_from_parameters(tree, workspace=None, diagnostics=Diagnostics())
    assert config is not None
    made = Planner(config)
    made.scene = made.scene.with_positions({"finger_joint": 0.04})
    return made


def _columns(result: Any) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Times, positions, velocities and accelerations of an answer."""
    assert result.error_code.val == 1, result.error_code
    trajectory = result.planned_trajectory.joint_trajectory
    assert list(trajectory.joint_names) == JOINTS
    times = [p.time_from_start.sec + p.time_from_start.nanosec * 1e-9 for p in trajectory.points]
    rows = [(p.positions, p.velocities, p.accelerations) for p in trajectory.points]
    positions, velocities, accelerations = (np.array(column) for column in zip(*rows, strict=True))
    return np.array(times), positions, velocities, accelerations


def _between(positions: FloatArray) -> FloatArray:
    """All configurations on the way, `FINE_STEP` apart."""
    rows = [positions[:1]]
    for q0, q1 in itertools.pairwise(positions):
        count = max(1, math.ceil(float(np.linalg.norm(q1 - q0)) / FINE_STEP))
        rows.append(q0 + np.arange(1, count + 1)[:, None] / count * (q1 - q0))
    return np.concatenate(rows)


def _assert_lawful(result: Any, space: JointSpace, scaling: tuple[float, float]) -> None:
    times, positions, velocities, accelerations = _columns(result)
    assert times[0] == 0.0 and (np.diff(times) > 0.0).all()
    assert (positions >= space.lower - 1e-9).all() and (positions <= space.upper + 1e-9).all()
    assert (np.abs(velocities) <= space.velocity * scaling[0] * 1.0005).all()
    assert (np.abs(accelerations) <= space.acceleration * scaling[1] * 1.0005).all()
    assert not velocities[[0, -1]].any()


def _least(space: JointSpace, way: FloatArray, scaling: tuple[float, float]) -> float:
    """The least time along a straight line, from rest to rest."""
    share = np.maximum(np.abs(way), 1e-12)
    v = float((space.velocity * scaling[0] / share).min())
    a = float((space.acceleration * scaling[1] / share).min())
    return 1.0 / v + v / a if v * v <= a else 2.0 / math.sqrt(a)


def test_trajectories_touch_nothing_and_keep_to_all_limits(arm: ArmBench, planner: Planner) -> None:
    scene = planner.scene
    for name, size, at in (_WALL, _POST):
        arm.add_box(name, list(size), list(at))
        scene = scene.with_object(WorldObject.single(name, Box(size), Pose(at)))
    checker = CollisionChecker(scene, planner.robot.groups["arm"])
    space = planner.robot.groups["arm"].space
    rng = np.random.default_rng(4)
    goals = [pose_goal(0.36, 0.18, 0.3), pose_goal(0.36, -0.18, 0.3)]
    while len(goals) < 6:
        q = space.sample(rng)
        if checker.is_valid(q):
            goals.append(joint_goal(q.tolist()))
    for number, goal in enumerate(goals):
        scaling = (1.0, 1.0) if number % 2 else (0.5, 0.25)
        factors = dict(zip(("velocity", "acceleration"), scaling, strict=True))
        names = {f"max_{kind}_scaling_factor": value for kind, value in factors.items()}
        result = arm.move(goal_constraints=goal, **names)
        _assert_lawful(result, space, scaling)
        for q in _between(_columns(result)[1]):
            assert checker.is_valid(q), checker.why(q)


@pytest.mark.parametrize("scaling", [(1.0, 1.0), (0.3, 0.2)])
def test_straight_motions_take_the_least_time(
    arm: ArmBench, planner: Planner, scaling: tuple[float, float]
) -> None:
    space = planner.robot.groups["arm"].space
    rng = np.random.default_rng(7)
    for _ in range(4):
        goal = np.array(READY) + rng.uniform(-0.4, 0.4, 6)
        result = arm.move(
            plan_only=True,
            goal_constraints=joint_goal(goal.tolist(), 1e-6),
            max_velocity_scaling_factor=scaling[0],
            max_acceleration_scaling_factor=scaling[1],
        )
        _assert_lawful(result, space, scaling)
        times, positions, *_ = _columns(result)
        way = positions[-1] - positions[0]
        on_line = positions[0] + np.outer((positions - positions[0]) @ way / (way @ way), way)
        assert np.abs(positions - on_line).max() < 1e-6
        assert times[-1] == pytest.approx(_least(space, way, scaling), rel=0.05)


def test_path_constraints_hold_around_every_corner(arm: ArmBench, planner: Planner) -> None:
    arm.add_box("wall", [0.3, 0.02, 0.2], [0.4, 0.0, 0.2])
    assert arm.move(goal_constraints=pose_goal(0.36, 0.18, 0.3)).error_code.val == 1
    upright = {
        "header": {"frame_id": "world"}, "link_name": "tool_link",
        "orientation": {"y": 1.0, "w": 0.0}, "weight": 1.0,
        "absolute_x_axis_tolerance": 0.3, "absolute_y_axis_tolerance": 0.3,
        "absolute_z_axis_tolerance": 4.0,
    }  # fmt: skip
    result = arm.move(
        plan_only=True,
        allowed_planning_time=20.0,
        goal_constraints=pose_goal(0.36, -0.18, 0.3),
        path_constraints={"orientation_constraints": [upright]},
    )
    rows = _between(_columns(result)[1])
    assert len(rows) > 100
    for q in rows:
        down = planner.fk(dict(zip(JOINTS, q.tolist(), strict=True)), "tool_link").matrix()[:3, 2]
        # Two turns of 0.3 rad, one after the other.
        assert down[2] <= -(math.cos(0.3) ** 2) + 1e-3


def test_ptp_brakes_as_the_package_says(make_arm: Any) -> None:
    limits = {name: dict(values) for name, values in _limits().items()}
    for values in limits.values():
        values |= {"has_deceleration_limits": True, "max_deceleration": -0.5}
    planning = {**parameters()["robot_description_planning"], "joint_limits": limits}
    arm = make_arm(robot_description_planning=planning)
    result = arm.move(
        plan_only=True,
        pipeline_id="pilz_industrial_motion_planner",
        planner_id="PTP",
        goal_constraints=joint_goal([0.3, *READY[1:]]),
    )
    change = _columns(result)[3][:, 0]
    strictest = min(values["max_acceleration"] for values in limits.values())
    assert change.max() == pytest.approx(strictest, rel=1e-3)
    assert change.min() == pytest.approx(-0.5, rel=1e-3)


def _limits() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = parameters()["robot_description_planning"]["joint_limits"]
    return {name: values for name, values in found.items() if name in JOINTS}
