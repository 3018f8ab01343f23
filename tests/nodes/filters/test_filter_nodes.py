"""The nodes of filters on a graph."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.nodes.filters.to_laserscan import depth_of_image
from gazelle.nodes.robot_localization.ekf_node import config_of, matrix_of
from gazelle.nodes.robot_localization.fusion import differential, measure_imu, measure_pose

_SCAN = "sensor_msgs/msg/LaserScan"


def test_scans_pass_through_a_chain(bench: Any) -> None:
    bench.start(
        "laser_filters/scan_to_scan_filter_chain",
        "_scan_filter_chain:=[{name: r, type: LaserScanRangeFilter, params: {lower_threshold: 1}}]",
    )
    got = bench.listen("/scan_filtered", _SCAN)
    out = bench.node.create_publisher("/scan", message_type(_SCAN))
    bench.eventually(lambda: out.matched)
    scan = message_type(_SCAN)()
    scan.header.frame_id, scan.angle_increment = "laser", 0.1
    scan.ranges, scan.range_max = [0.5, 2.0], 10.0
    out.publish(scan)
    bench.eventually(lambda: got)
    np.testing.assert_array_equal(np.asarray(got[0].ranges), [math.nan, 2.0])
    assert got[0].header.frame_id == "laser"
    assert bench.stop() == [0]


def test_ekf_follows_odometry(bench: Any) -> None:
    config = "[" + ", ".join(["false"] * 6 + ["true"] * 6 + ["false"] * 3) + "]"
    words = ["_odom0:=/wheels", f"_odom0_config:={config}", "_two_d_mode:=true", "_frequency:=50"]
    bench.start("robot_localization/ekf_localization_node", *words)
    got = bench.listen("/odometry/filtered", "nav_msgs/msg/Odometry")
    kind = message_type("nav_msgs/msg/Odometry")
    out = bench.node.create_publisher("/wheels", kind)
    bench.eventually(lambda: out.matched)
    # No more than what waits in the queue: 2 s at 0.5 m/s, the first one from rest.
    for k in range(1, 10):
        message = kind()
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(k * 250_000_000, 10**9)
        message.twist.twist.linear.x = 0.5
        message.twist.covariance = np.diag([1e-4] * 6).ravel().tolist()
        out.publish(message)
    bench.eventually(lambda: got and got[-1].pose.pose.position.x > 0.8)
    assert got[-1].pose.pose.position.x == pytest.approx(0.9, abs=0.15)
    assert got[-1].child_frame_id == "base_link"
    assert bench.stop() == [0]


def test_an_ekf_tells_of_values_of_the_wrong_kind_and_goes_on(bench: Any) -> None:
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    words = ["_frequency:=often", "_odom0_pose_rejection_threshold:=far",
             "_transform_time_offset:=soon", "_initial_state:=[1, 2]"]  # fmt: skip
    bench.start("robot_localization/ekf_localization_node", "_odom0:=/wheels", *words)
    expected = [
        "parameter 'frequency' is 'often', not a number; 30.0 is used",
        "parameter 'odom0_pose_rejection_threshold' is 'far', not a number; inf is used",
        "parameter 'transform_time_offset' is 'soon', not a number; 0.0 is used",
        "parameter 'initial_state' has 2 numbers, not 15; it is left out",
    ]
    bench.eventually(lambda: all(any(t in one.msg for one in said) for t in expected))
    assert bench.stop() == [0]


def test_a_text_that_says_false_is_false_to_an_ekf(bench: Any) -> None:
    config = "[" + ", ".join(["false"] * 6 + ["true"] * 6 + ["false"] * 3) + "]"
    words = ["_odom0:=/wheels", f"_odom0_config:={config}", "_frequency:=50"]
    bench.start("robot_localization/ekf_localization_node", *words, "_publish_tf:='False'")
    got = bench.listen("/odometry/filtered", "nav_msgs/msg/Odometry")
    tf = bench.listen("/tf", "tf2_msgs/msg/TFMessage")
    kind = message_type("nav_msgs/msg/Odometry")
    out = bench.node.create_publisher("/wheels", kind)
    bench.eventually(lambda: out.matched)
    message = kind()
    message.header.stamp.sec, message.twist.twist.linear.x = 1, 0.5
    message.twist.covariance = np.diag([1e-4] * 6).ravel().tolist()
    out.publish(message)
    bench.eventually(lambda: len(got) > 3)
    assert bench.stop() == [0]
    assert not tf


def test_depth_images_of_both_encodings() -> None:
    image = message_type("sensor_msgs/msg/Image")()
    image.height, image.width, image.step, image.encoding = 1, 2, 4, "16UC1"
    image.data = np.array([1500, 0], "<u2").tobytes()
    np.testing.assert_allclose(depth_of_image(image), [[1.5, 0.0]])
    image.step, image.encoding = 8, "32FC1"
    image.data = np.array([1.5, 2.5], "<f4").tobytes()
    np.testing.assert_allclose(depth_of_image(image), [[1.5, 2.5]])
    image.encoding = "rgb8"
    with pytest.raises(ValueError, match="unsupported encoding: rgb8"):
        depth_of_image(image)
    image.encoding, image.height = "32FC1", 5
    with pytest.raises(ValueError, match="says 2 × 5 and has 8 bytes"):
        depth_of_image(image)


def test_configurations_of_inputs_are_checked() -> None:
    assert config_of("odom0_config", [True] * 15).all()
    with pytest.raises(LaunchError, match=r"odom0_config is a list of 15 truth values.* not 3"):
        config_of("odom0_config", [True] * 3)
    assert matrix_of("n", None) is None
    diagonal = matrix_of("n", [1.0] * 15)
    assert diagonal is not None
    assert np.trace(diagonal) == 15
    with pytest.raises(LaunchError, match="n has 2 numbers, not 225"):
        matrix_of("n", [1.0, 2.0])


def test_an_imu_that_is_turned_is_read_in_the_robots_frame() -> None:
    imu = message_type("sensor_msgs/msg/Imu")()
    imu.angular_velocity.x, imu.linear_acceleration.z = 0.7, 9.80665
    imu.orientation.w = 1.0
    imu.angular_velocity_covariance = np.eye(3).ravel().tolist()
    imu.linear_acceleration_covariance = [-1.0] + [0.0] * 8
    level = measure_imu(imu, 5, Pose(), without_gravity=True)
    np.testing.assert_allclose(level.values[12:15], 0.0, atol=1e-9)
    assert list(level.measured[[3, 9, 12]]) == [True, True, False]
    turned = Pose.from_xyz_rpy((0, 0, 0), (0.0, 0.0, math.pi / 2))
    np.testing.assert_allclose(measure_imu(imu, 5, turned).values[9:12], [0, 0.7, 0], atol=1e-9)


def test_poses_count_as_velocities_between_them() -> None:
    kind = message_type("geometry_msgs/msg/PoseWithCovariance")
    before, after = kind(), kind()
    before.pose.orientation.w = math.cos(math.pi / 4)
    before.pose.orientation.z = math.sin(math.pi / 4)
    after.pose.orientation = before.pose.orientation
    after.pose.position.y = 0.2
    found = differential(measure_pose(before, 0), measure_pose(after, 500_000_000))
    assert found is not None
    np.testing.assert_allclose(found.values[6:9], [0.4, 0, 0], atol=1e-9)
    assert differential(measure_pose(before, 5), measure_pose(after, 5)) is None
