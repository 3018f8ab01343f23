"""tricycle_controller on ideal joints."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.controllers.wheeled_bench import (
    WheeledBench,
    rolling,
    stamped,
    steered,
    twist,
)

from gazelle.control.controllers.tricycle_controller import TricycleController
from gazelle.control.errors import ControllerError
from gazelle.interfaces import service_type

PARAMETERS = {
    "traction_joint_name": "wheel",
    "steering_joint_name": "steer",
    "wheelbase": 1.25,
    "wheel_radius": 0.2,
}


def _bench(parameters=None, **options):
    joints = [*rolling("wheel"), *steered("steer")]
    values = {**PARAMETERS, **(parameters or {})}
    return WheeledBench(TricycleController, joints, values, ros_version=2, **options)


def test_circle_has_the_radius_of_speed_by_yaw_rate():
    bench = _bench()
    bench.run(2.0, "~/cmd_vel", twist(0.5, z=0.25))
    speed, angle = bench.commands[-1]
    assert angle == pytest.approx(math.atan(0.25 * 1.25 / 0.5))
    assert speed * 0.2 * math.cos(angle) == pytest.approx(0.5)
    message = bench.last("~/odom")
    assert (message.twist.twist.linear.x, message.twist.twist.angular.z) == pytest.approx(
        (0.5, 0.25)
    )
    x, y, _ = bench.pose()
    assert math.dist((x, y), (0.0, 2.0)) == pytest.approx(2.0, abs=2e-3)


def test_turn_on_the_spot_steers_a_quarter_turn_first():
    bench = _bench()
    bench.run(0.001, "~/cmd_vel", twist(z=-0.8))
    assert bench.commands[-1] == pytest.approx(
        [5.0 * math.cos(math.pi / 2), -math.pi / 2], abs=1e-9
    )
    bench.run(0.002, "~/cmd_vel", twist(z=-0.8))
    assert bench.commands[-1] == pytest.approx([0.8 * 1.25 / 0.2, -math.pi / 2])
    bench.run(1.0, "~/cmd_vel", twist(z=-0.8))
    x, y, half = bench.pose()
    assert (x, y) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert half < -0.38


def test_wheel_waits_for_the_steering():
    bench = _bench({"steering.max_velocity": 1.0})
    bench.run(0.001, "~/cmd_vel", twist(0.2, z=0.16))
    target = math.atan(0.16 * 1.25 / 0.2)
    full = 0.2 / (0.2 * math.cos(target))
    assert bench.commands[-1] == pytest.approx([full * math.cos(target), 0.001])
    bench.run(0.5, "~/cmd_vel", twist(0.2, z=0.16))
    assert bench.commands[-1][0] == pytest.approx(full)


def test_limits_are_reached_and_never_exceeded():
    limits = {
        "traction": {"max_velocity": 2.0, "max_acceleration": 4.0, "max_deceleration": 8.0},
        "steering": {"max_position": 0.3, "max_velocity": 1.5},
    }
    bench = _bench(limits)
    bench.run(1.0, "~/cmd_vel", twist(1.0, z=1.0))
    bench.run(0.7, "~/cmd_vel", twist(0.0))
    speeds, angles = np.array(bench.commands).T
    assert speeds.max() == pytest.approx(2.0)
    assert np.diff(speeds).max() / 1e-3 == pytest.approx(4.0)
    assert np.diff(speeds).min() / 1e-3 == pytest.approx(-8.0)
    assert angles.max() == pytest.approx(0.3)
    assert np.diff(angles).max() / 1e-3 == pytest.approx(1.5)


def test_timeout_is_in_milliseconds_and_straightens_the_wheel():
    bench = _bench({"cmd_vel_timeout": 200})
    bench.run(0.1, "~/cmd_vel", stamped(1, 0.3, z=0.1))
    assert bench.commands[-1][0] > 0
    bench.run(0.099)
    assert bench.commands[-1][0] > 0
    bench.run(0.01)
    assert bench.commands[-1] == [0.0, 0.0]


@pytest.mark.parametrize(("flag", "name"), [(True, "TwistStamped"), (False, "Twist")])
def test_type_of_the_command_is_announced_as_use_stamped_vel_says(flag, name):
    bench = _bench({"use_stamped_vel": flag})
    types, _ = bench.ports.subscriptions["~/cmd_vel"]
    assert types[0] == f"geometry_msgs/{name}"
    bench.run(0.1, "~/cmd_vel", twist(0.3))
    assert bench.commands[-1][0] > 0
    bench.run(0.1, "~/cmd_vel", stamped(0, 0.6))
    assert bench.commands[-1][0] == pytest.approx(3.0)


def test_ackermann_command_and_tf_are_published_on_request():
    bench = _bench({"publish_ackermann_command": True, "enable_odom_tf": True})
    bench.run(0.1, "~/cmd_vel", twist(0.4))
    command = bench.last("~/cmd_ackermann")
    assert (command.speed, command.steering_angle) == pytest.approx((2.0, 0.0))
    assert bench.last("/tf").transforms[0].transform.translation.x > 0
    assert not _tf_of_default().messages


def _tf_of_default():
    bench = _bench()
    bench.run(0.1, "~/cmd_vel", twist(0.4))
    return bench.ports.publishers["/tf"]


def test_odometry_may_have_only_a_twist():
    bench = _bench({"odom_only_twist": True})
    bench.run(0.1, "~/cmd_vel", twist(0.4))
    assert bench.pose() == (0.0, 0.0, 0.0)
    assert bench.last("~/odom").twist.twist.linear.x == pytest.approx(0.4)


def test_open_loop_takes_the_command_for_odometry():
    bench = _bench({"open_loop": True})
    bench.run(1.0, "~/cmd_vel", twist(0.5, z=0.25))
    x, y, _ = bench.pose()
    assert (x, y) == pytest.approx((2 * math.sin(0.25), 2 * (1 - math.cos(0.25))))


def test_odometry_can_be_reset():
    bench = _bench()
    bench.run(0.5, "~/cmd_vel", twist(0.4))
    service = service_type("std_srvs/Empty")
    bench.ports.call("~/reset_odometry", service.Request(), service.Response())
    bench.run(0.001)
    assert bench.pose()[0] == pytest.approx(0.4e-3)


def test_limits_that_are_no_magnitudes_are_an_error():
    with pytest.raises(ControllerError, match=r"limits of traction\.velocity are -1 and 1000"):
        _bench({"traction.min_velocity": -1.0})
