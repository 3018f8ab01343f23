"""A simulator's true pose in the place of amcl's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_pose, unit_pose_of
from gazelle.nodes.navigation.robot_pose import Frames

_ODOMETRY = "nav_msgs/msg/Odometry"
_POSE = "geometry_msgs/msg/PoseWithCovarianceStamped"
_SECOND_NS = 1_000_000_000


def _plane(x: float, y: float, yaw: float = 0.0) -> Pose:
    return Pose.from_xyz_rpy((x, y, 0.0), (0.0, 0.0, yaw))


def _truth(pose: Pose, second: int) -> Any:
    message = message_type(_ODOMETRY)()
    message.header.stamp.sec = second
    set_pose(message.pose.pose, pose)
    return message


def test_the_true_pose_is_amcls_and_map_to_odometry_follows(bench: Any) -> None:
    words = ["_delta_x:=1.0", "_delta_yaw:=0.5", "_transform_tolerance:=0.25"]
    bench.start("fake_localization/fake_localization", *words)
    poses, clouds = (
        bench.listen("/amcl_pose", _POSE),
        bench.listen("/particlecloud", "geometry_msgs/msg/PoseArray"),
    )
    frames, tf = Frames(bench.node), TransformBroadcaster(bench.node)
    out = bench.node.create_publisher("/base_pose_ground_truth", message_type(_ODOMETRY))
    bench.eventually(lambda: out.matched)
    true, drifted = _plane(3.0, 2.0, math.pi / 2), _plane(2.5, 0.1, 1.2)

    def arrived() -> bool:
        for second in (9, 11):
            tf.send(StampedPose("odom", "base_link", second * _SECOND_NS, drifted))
        out.publish(_truth(true, 10))
        return bool(poses and clouds)

    bench.eventually(arrived)
    expected = _plane(-1.0, 0.0, -0.5) @ true
    np.testing.assert_allclose(
        unit_pose_of(poses[0].pose.pose).matrix(), expected.matrix(), atol=1e-9
    )
    assert (poses[0].header.frame_id, poses[0].header.stamp.sec) == ("/map", 10)
    assert len(clouds[0].poses) == 1
    bench.eventually(lambda: isinstance(frames.between("map", "base_link"), Pose))
    found = frames.buffer.lookup_transform("map", "odom")
    assert found.stamp_ns == 10 * _SECOND_NS + 250_000_000
    np.testing.assert_allclose((found.pose @ drifted).matrix(), expected.matrix(), atol=1e-9)
    assert bench.stop() == [0]


def test_an_initial_pose_moves_the_map_under_the_robot(bench: Any) -> None:
    bench.start("fake_localization/fake_localization", "_base_frame_id:=base")
    poses = bench.listen("/amcl_pose", _POSE)
    frames, tf = Frames(bench.node), TransformBroadcaster(bench.node)
    out = bench.node.create_publisher("/base_pose_ground_truth", message_type(_ODOMETRY))
    given = bench.node.create_publisher("/initialpose", message_type(_POSE))
    bench.eventually(lambda: out.matched and given.matched)

    def located() -> bool:
        for second in (19, 21):
            tf.send(StampedPose("odom", "base", second * _SECOND_NS, _plane(0.0, 0.0)))
        out.publish(_truth(_plane(1.0, 0.0), 20))
        return isinstance(frames.between("map", "base"), Pose)

    bench.eventually(located)
    wanted = message_type(_POSE)()
    wanted.header.frame_id = "map"
    set_pose(wanted.pose.pose, _plane(5.0, 6.0))

    def moved() -> bool:
        # The node has a buffer of its own, which may not know the map's frame yet.
        given.publish(wanted)
        out.publish(_truth(_plane(1.0, 0.0), 20))
        return bool(poses) and poses[-1].pose.pose.position.x > 4.0

    bench.eventually(moved)
    # Each one that came before tf told of the last moves it once more, as the original does.
    now = poses[-1].pose.pose.position
    times = round((now.x - 1.0) / 4.0)
    assert (now.x, now.y) == pytest.approx((1.0 + 4.0 * times, 6.0 * times))
    assert bench.stop() == [0]


def test_a_pose_waits_for_odometry_at_its_time(bench: Any) -> None:
    bench.start("fake_localization/fake_localization")
    poses = bench.listen("/amcl_pose", _POSE)
    tf = TransformBroadcaster(bench.node)
    out = bench.node.create_publisher("/base_pose_ground_truth", message_type(_ODOMETRY))
    bench.eventually(lambda: out.matched)
    out.publish(_truth(_plane(1.0, 0.0), 10))

    def arrived() -> bool:
        for second in (9, 11):
            tf.send(StampedPose("odom", "base_link", second * _SECOND_NS, _plane(0.0, 0.0)))
        # Odometry at this time never comes; the one that waits is looked at again.
        out.publish(_truth(_plane(7.0, 0.0), 500))
        return bool(poses)

    bench.eventually(arrived)
    assert {pose.header.stamp.sec for pose in poses} == {10}
    assert poses[0].pose.pose.position.x == pytest.approx(1.0)
    assert bench.stop() == [0]
