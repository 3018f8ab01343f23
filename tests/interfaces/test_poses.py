from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type, ros1_message_type
from gazelle.interfaces.poses import (
    pose_message,
    pose_of,
    pose_of_transform,
    set_plane_pose,
    set_pose,
    set_transform,
    set_xyz,
    transform_stamped,
    twist_message,
    unit_pose_of,
    xyz_of,
)

POSE = Pose((1.0, 2.0, 3.0), (0.5, -0.5, 0.5, -0.5))


@pytest.mark.parametrize("make", [message_type, ros1_message_type])
def test_poses_and_transforms_of_either_generation_come_back(make):
    pose, transform = make("geometry_msgs/Pose")(), make("geometry_msgs/Transform")()
    set_pose(pose, POSE)
    set_transform(transform, POSE)
    assert pose_of(pose) == pose_of_transform(transform) == POSE


def test_a_message_gets_plain_numbers():
    point = message_type("geometry_msgs/Point")()
    set_xyz(point, np.array([1, 2, 3]))
    assert [type(value) for value in xyz_of(point)] == [float] * 3
    assert type(point.x) is float


def test_a_pose_of_the_ground_plane_is_turned_about_z():
    message = message_type("geometry_msgs/Pose")()
    set_plane_pose(message, (1.0, -2.0, math.pi))
    assert pose_of(message).xy_yaw == pytest.approx((1.0, -2.0, math.pi))
    assert message.position.z == 0.0


@pytest.mark.parametrize(
    "quat", [(0.0, 0.0, 0.0, 0.0), (math.nan, 0.0, 0.0, 1.0), (0, 0, math.inf, 1)]
)
def test_a_quaternion_of_zeros_or_no_numbers_is_no_rotation(quat):
    message = message_type("geometry_msgs/Pose")()
    set_pose(message, Pose((1.0, 2.0, 3.0), quat))
    assert unit_pose_of(message) == Pose((1.0, 2.0, 3.0))


def test_a_quaternion_keeps_its_length_where_nobody_asks_for_a_unit():
    message = message_type("geometry_msgs/Pose")()
    set_pose(message, Pose(quat_xyzw=(0.0, 0.0, 3.0, 4.0)))
    assert pose_of(message).quat_xyzw == (0.0, 0.0, 3.0, 4.0)
    assert unit_pose_of(message).quat_xyzw == (0.0, 0.0, 0.6, 0.8)


def test_stamps_do_without_geometry():
    code = "import sys, gazelle.interfaces.stamps; print('gazelle.geometry' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_messages_are_made_of_poses_and_numbers():
    assert pose_of(pose_message(POSE)) == POSE
    twist = twist_message(np.array([1, 2, 3]), (0.0, 0.0, 4.0))
    assert (xyz_of(twist.linear), xyz_of(twist.angular)) == ((1.0, 2.0, 3.0), (0.0, 0.0, 4.0))
    transform = transform_stamped(5, "map", "odom", POSE)
    assert pose_of_transform(transform.transform) == POSE
    names = (transform.header.stamp.nanosec, transform.header.frame_id, transform.child_frame_id)
    assert names == (5, "map", "odom")
