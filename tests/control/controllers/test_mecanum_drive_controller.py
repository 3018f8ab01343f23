"""mecanum_drive_controller on ideal joints."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, stamped, twist

from gazelle.control.controllers.mecanum_drive_controller import MecanumDriveController
from gazelle.control.errors import ControllerError
from gazelle.interfaces import service_type

NAMES = ("fl", "fr", "rr", "rl")
PARAMETERS = {
    "front_left_wheel_command_joint_name": "fl",
    "front_right_wheel_command_joint_name": "fr",
    "rear_right_wheel_command_joint_name": "rr",
    "rear_left_wheel_command_joint_name": "rl",
    "kinematics": {
        "wheels_radius": 0.05,
        "sum_of_robot_center_projection_on_X_Y_axis": 0.4,
        "base_frame_offset": {"x": 0.0, "y": 0.0, "theta": 0.0},
    },
    "reference_timeout": 0.5,
}


def _bench(parameters=None):
    values = {**PARAMETERS, **(parameters or {})}
    return WheeledBench(MecanumDriveController, rolling(*NAMES), values, ros_version=2)


def test_sideways_and_turning_path_is_integrated_exactly():
    bench = _bench()
    bench.run(2.001, "~/reference", twist(0.3, -0.2, 0.5))
    sine, cosine = math.sin(1.0) / 0.5, (1 - math.cos(1.0)) / 0.5
    # Ideal wheels stand at the first update, so 2 s of motion are measured.
    assert bench.pose("~/odometry")[:2] == pytest.approx(
        (0.3 * sine + 0.2 * cosine, 0.3 * cosine - 0.2 * sine), abs=1e-9
    )
    velocity = bench.last("~/odometry").twist.twist
    assert (velocity.linear.x, velocity.linear.y, velocity.angular.z) == pytest.approx(
        (0.3, -0.2, 0.5)
    )


def test_limits_of_all_three_axes_are_reached_and_never_exceeded():
    limits = {"max_velocity": 0.2, "max_acceleration": 1.0}
    bench = _bench({"linear.x": limits, "linear.y": limits, "angular.z": limits})
    bench.run(0.5, "~/reference", twist(1.0, 1.0, 1.0))
    fl, fr, rr, rl = np.array(bench.commands).T * 0.05 / 4
    for speeds in (fl + fr + rr + rl, -fl + fr - rr + rl, (-fl + fr + rr - rl) / 0.4):
        assert speeds.max() == pytest.approx(0.2)
        assert np.diff(speeds).max() / 1e-3 == pytest.approx(1.0)


@pytest.mark.parametrize("topic", ["~/reference", "~/reference_unstamped"])
def test_twist_and_twist_stamped_drive_alike_until_the_timeout(topic):
    plain, other = _bench(), _bench()
    plain.run(0.05, topic, twist(0.3, 0.1))
    other.run(0.05, topic, stamped(0, 0.3, 0.1))
    assert plain.commands == other.commands
    plain.run(0.52)
    assert plain.commands[-1] == [0.0] * 4


def test_reference_acts_for_one_update_by_default():
    bench = _bench({"reference_timeout": 0.0})
    bench.run(0.001, "~/reference", twist(0.3))
    assert bench.commands[-1] == pytest.approx([6.0] * 4)
    bench.run(0.001)
    assert bench.commands[-1] == [0.0] * 4
    assert bench.controller.changed({"reference_timeout": 1.0, "enable_odom_tf": False}) == ""
    bench.run(0.001, "~/reference", twist(0.3))
    bench.run(0.5)
    assert bench.commands[-1] == pytest.approx([6.0] * 4)


def test_state_odometry_frames_and_service():
    bench = _bench({"enable_odom_tf": True})
    bench.run(0.1, "~/reference", twist(0.3, 0.1))
    state = bench.last("~/controller_state")
    assert state.front_left_wheel_velocity == pytest.approx(4.0)
    assert state.back_left_wheel_velocity == pytest.approx(8.0)
    assert state.reference_velocity.linear.y == pytest.approx(0.1)
    covariance = np.diag(np.reshape(bench.last("~/odometry").pose.covariance, (6, 6)))
    assert covariance == pytest.approx([0.1] * 6)
    assert bench.last("~/tf_odometry").transforms[0].transform.translation.y > 0
    service = service_type("control_msgs/SetOdometry")
    request = service.Request(x=3.0, y=4.0, yaw=0.5)
    assert bench.ports.call("~/set_odometry", request, service.Response()).success


def test_stop_stops_the_wheels_and_a_missing_joint_is_named():
    bench = _bench()
    bench.run(0.1, "~/reference", twist(0.3))
    bench.controller.stop(bench.time_ns)
    assert bench.robot.interface_values.commands.tolist() == [0.0] * 4
    with pytest.raises(ControllerError, match="no 'front_left_wheel_command_joint_name' given"):
        WheeledBench(MecanumDriveController, rolling(*NAMES), {}, ros_version=2)


def test_the_controller_of_ros1_is_another_one():
    with pytest.raises(ControllerError, match="ROS 1's mecanum_drive_controller is compiled code"):
        WheeledBench(MecanumDriveController, rolling(*NAMES), {}, ros_version=1)
    WheeledBench(MecanumDriveController, rolling(*NAMES), PARAMETERS, ros_version=1)
