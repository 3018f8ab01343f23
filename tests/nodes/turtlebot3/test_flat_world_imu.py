"""An IMU as on flat ground."""

from __future__ import annotations

from gazelle.interfaces import message_type
from gazelle.nodes.turtlebot3.flat_world_imu import Flattener


def _imu(sec: int, nanosec: int = 0):
    message = message_type("sensor_msgs/msg/Imu")()
    message.header.stamp.sec, message.header.stamp.nanosec = sec, nanosec
    message.linear_acceleration.x = 3.0
    message.angular_velocity.z = 0.7
    return message


def test_accelerations_become_gravity_and_the_rest_stays() -> None:
    source = _imu(1)
    flat = Flattener().flat(source)
    acceleration = flat.linear_acceleration
    assert (acceleration.x, acceleration.y, acceleration.z) == (0.0, 0.0, 9.8)
    assert flat.angular_velocity.z == 0.7
    assert source.linear_acceleration.x == 3.0


def test_messages_that_are_not_newer_are_left_out() -> None:
    flattener = Flattener()
    stamps = [(5, 0), (5, 0), (4, 9), (5, 1)]
    assert [flattener.flat(_imu(*stamp)) is not None for stamp in stamps] == [
        True, False, False, True,
    ]  # fmt: skip


def test_node_passes_measurements_on(bench) -> None:
    got = bench.listen("/imu_out", "sensor_msgs/msg/Imu")
    bench.start("turtlebot3_slam/flat_world_imu_node")
    out = bench.node.create_publisher("/imu_in", "sensor_msgs/msg/Imu")
    bench.eventually(lambda: out.matched)
    out.publish(_imu(1))
    assert bench.eventually(lambda: got)[0].linear_acceleration.z == 9.8
