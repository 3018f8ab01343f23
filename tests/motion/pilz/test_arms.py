"""Pilz' commands with the kinematics and collisions of real arms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gazelle.description.model import Sphere
from gazelle.description.moveit import CartesianLimits
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Solver
from gazelle.motion.model import RobotModel
from gazelle.motion.pilz import (
    Auxiliary,
    AuxiliaryKind,
    Command,
    CommandKind,
    PilzPlanner,
    plan_sequence,
)
from gazelle.motion.planning import ErrorCode, PlanningError
from gazelle.motion.scene import PlanningScene, WorldObject

_START = np.array([0.0, -1.2, 1.8, -0.6, 1.5, 0.0])


def _planner(robot: RobotModel, scene: PlanningScene | None = None) -> PilzPlanner:
    space = replace(robot.group("arm").space, acceleration=np.full(6, 12.0))
    checker = CollisionChecker(scene or PlanningScene.of(robot), "arm")
    limits = CartesianLimits(max_trans_vel=0.5, max_trans_acc=1.0, max_rot_vel=1.5)
    return PilzPlanner(space, Solver(robot, "arm"), cartesian=limits, validity=checker)


def _moved(planner: PilzPlanner, x: float, y: float, z: float) -> FloatArray:
    pose = planner.kinematics.fk(_START)
    pose[:3, 3] += x, y, z
    return pose


def _tips(planner: PilzPlanner, positions: FloatArray) -> FloatArray:
    return np.array([planner.kinematics.fk(q)[:3, 3] for q in positions])


def test_lin_and_circ_keep_the_tip_on_their_way(ur_like: RobotModel) -> None:
    planner = _planner(ur_like)
    begin = planner.kinematics.fk(_START)
    line = planner.plan(_START, Command(CommandKind.LIN, _moved(planner, 0.0, 0.15, -0.1)))
    way = _tips(planner, line.positions) - begin[:3, 3]
    goal = np.array([0.0, 0.15, -0.1])
    off = way - np.outer(way @ goal, goal) / (goal @ goal)
    assert np.abs(off).max() < 1e-6
    assert way[-1] == pytest.approx(goal, abs=1e-6)

    center = begin[:3, 3] + np.array([0.0, 0.0, -0.1])
    command = Command(
        CommandKind.CIRC,
        _moved(planner, 0.0, 0.1, -0.1),
        Auxiliary(AuxiliaryKind.CENTER, center),
        velocity_scaling=0.5,
    )
    arc = planner.plan(_START, command)
    radii = np.linalg.norm(_tips(planner, arc.positions) - center, axis=1)
    assert radii == pytest.approx(0.1, abs=1e-6)


def test_a_blended_sequence_passes_the_corner(ur_like: RobotModel) -> None:
    planner = _planner(ur_like)
    first = Command(CommandKind.LIN, _moved(planner, 0.0, 0.15, 0.0), blend_radius_m=0.04)
    commands = [
        replace(item, velocity_scaling=0.4, acceleration_scaling=0.4)
        for item in (first, Command(CommandKind.LIN, _moved(planner, 0.0, 0.15, -0.15)))
    ]
    found = plan_sequence(planner, _START, commands)
    corner = _moved(planner, 0.0, 0.15, 0.0)[:3, 3]
    nearest = np.linalg.norm(_tips(planner, found.positions) - corner, axis=1).min()
    assert 0.002 < nearest < 0.04
    assert _tips(planner, found.positions[-1:])[0] == pytest.approx(
        _moved(planner, 0.0, 0.15, -0.15)[:3, 3], abs=1e-6
    )


def test_a_line_that_hits_something_names_both(ur_like: RobotModel) -> None:
    free = _planner(ur_like)
    where = tuple(float(value) for value in _moved(free, 0.0, 0.15, 0.0)[:3, 3])
    ball = WorldObject.single("ball", Sphere(0.05), Pose(position_m=where))  # type: ignore[arg-type]
    planner = _planner(ur_like, PlanningScene.of(ur_like).with_object(ball))
    with pytest.raises(PlanningError, match="collides with object 'ball'") as caught:
        planner.plan(_START, Command(CommandKind.LIN, _moved(planner, 0.0, 0.15, 0.0)))
    assert caught.value.code is ErrorCode.INVALID_MOTION_PLAN


def test_a_pose_out_of_reach_is_no_ik_solution(ur_like: RobotModel) -> None:
    planner = _planner(ur_like)
    for kind in (CommandKind.PTP, CommandKind.LIN):
        with pytest.raises(PlanningError, match="inverse kinematics of the goal pose") as caught:
            planner.plan(_START, Command(kind, _moved(planner, 3.0, 0.0, 0.0)))
        assert caught.value.code is ErrorCode.NO_IK_SOLUTION
