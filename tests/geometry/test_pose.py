from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.geometry import (
    IDENTITY_POSE,
    Pose,
    quat_xyzw_about_axis,
    quat_xyzw_from_rpy,
    quat_xyzw_from_yaw,
    rpy_from_quat_xyzw,
    unit_quat_xyzw,
    yaw_from_quat_xyzw,
)

ANGLE = st.floats(-3.1, 3.1)
PITCH = st.floats(-1.5, 1.5)
LENGTH = st.floats(-10, 10)
POSES = st.builds(
    Pose.from_xyz_rpy, st.tuples(LENGTH, LENGTH, LENGTH), st.tuples(ANGLE, PITCH, ANGLE)
)


def near(a: Pose, b: Pose, tolerance: float = 1e-9) -> bool:
    return bool(np.allclose(a.matrix(), b.matrix(), atol=tolerance))


def test_yaw_turns_x_to_y():
    turned = Pose.from_xyz_rpy((1, 2, 3), (0, 0, math.pi / 2)).rotate((1, 0, 0))
    assert turned == pytest.approx((0, 1, 0))


def test_roll_acts_before_pitch_and_yaw():
    turned = Pose.from_xyz_rpy((0, 0, 0), (math.pi / 2, 0, math.pi / 2)).rotate((0, 1, 0))
    assert turned == pytest.approx((0, 0, 1))


def test_the_scalar_comes_last_and_first_for_mujoco():
    pose = Pose((0, 0, 0), (0.1, 0.2, 0.3, 0.4))
    assert pose.quat_wxyz == (0.4, 0.1, 0.2, 0.3)


def test_a_zero_quaternion_is_no_rotation():
    assert rpy_from_quat_xyzw((0, 0, 0, 0)) == (0, 0, 0)


def test_pitch_is_clamped_at_the_pole():
    quat = quat_xyzw_from_rpy((0, math.pi / 2, 0))
    assert rpy_from_quat_xyzw(quat)[1] == pytest.approx(math.pi / 2)


@given(POSES)
def test_a_pose_times_its_inverse_is_identity(pose):
    assert near(pose @ pose.inverse(), IDENTITY_POSE)


@given(POSES, POSES)
def test_composition_is_matrix_multiplication(a, b):
    np.testing.assert_allclose((a @ b).matrix(), a.matrix() @ b.matrix(), atol=1e-9)


@given(POSES)
def test_matrix_and_pose_go_round(pose):
    assert near(Pose.from_matrix(pose.matrix()), pose)


@given(st.tuples(ANGLE, PITCH, ANGLE))
def test_roll_pitch_yaw_go_round(rpy):
    assert rpy_from_quat_xyzw(quat_xyzw_from_rpy(rpy)) == pytest.approx(rpy, abs=1e-7)


@given(POSES, st.tuples(LENGTH, LENGTH, LENGTH))
def test_transforming_points_is_rotating_and_shifting(pose, point):
    moved = pose.transform(np.array([point, point]))
    expected = np.add(pose.rotate(point), pose.position_m)
    np.testing.assert_allclose(moved, [expected, expected], atol=1e-9)


@pytest.mark.parametrize("axis", range(3))
def test_quarter_turns_survive_the_matrix(axis):
    rpy = tuple(math.pi if i == axis else 0.0 for i in range(3))
    pose = Pose.from_xyz_rpy((0, 0, 0), rpy)
    assert near(Pose.from_matrix(pose.matrix()), pose)


@given(ANGLE)
def test_a_yaw_is_the_turn_about_z(yaw: float):
    quat = quat_xyzw_from_yaw(yaw)
    assert quat == pytest.approx(quat_xyzw_from_rpy((0.0, 0.0, yaw)))
    assert quat == pytest.approx(quat_xyzw_about_axis((0.0, 0.0, 1.0), yaw))
    assert yaw_from_quat_xyzw(quat) == pytest.approx(yaw)


@given(ANGLE, PITCH, ANGLE)
def test_the_yaw_of_a_quaternion_is_that_of_its_three_angles(roll: float, pitch: float, yaw: float):
    quat = quat_xyzw_from_rpy((roll, pitch, yaw))
    assert yaw_from_quat_xyzw(quat) == pytest.approx(rpy_from_quat_xyzw(quat)[2])


@given(LENGTH, LENGTH, ANGLE)
def test_a_pose_of_the_ground_plane_is_seen_from_above_as_it_was_made(
    x: float, y: float, yaw: float
):
    assert Pose.from_xy_yaw(x, y, yaw).xy_yaw == pytest.approx((x, y, yaw))


def test_a_quaternion_is_brought_to_length_one_and_zeros_to_no_turn():
    assert unit_quat_xyzw((0.0, 0.0, 3.0, 4.0)) == (0.0, 0.0, 0.6, 0.8)
    assert Pose((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 0.0)).normalised() == Pose((1.0, 2.0, 3.0))
