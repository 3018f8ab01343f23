"""omni_wheel_drive_controller on ideal joints."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, stamped, twist

from gazelle.control.controllers.omni_wheel_drive_controller import OmniWheelDriveController
from gazelle.control.errors import ControllerError
from gazelle.interfaces import service_type

NAMES = ("a", "b", "c")
PARAMETERS = {
    "wheel_names": list(NAMES),
    "wheel_offset": 0.3,
    "robot_radius": 0.2,
    "wheel_radius": 0.04,
}


def _bench(parameters=None):
    values = {**PARAMETERS, **(parameters or {})}
    return WheeledBench(OmniWheelDriveController, rolling(*NAMES), values, ros_version=2)


@pytest.mark.parametrize("feedback", [True, False])
def test_sideways_and_turning_path_is_integrated_exactly(feedback):
    bench = _bench({"position_feedback": feedback})
    bench.run(2.001, "~/cmd_vel", twist(0.3, -0.2, 0.5))
    sine, cosine = math.sin(1.0) / 0.5, (1 - math.cos(1.0)) / 0.5
    assert bench.pose()[:2] == pytest.approx(
        (0.3 * sine + 0.2 * cosine, 0.3 * cosine - 0.2 * sine), abs=1e-9
    )
    velocity = bench.last("~/odom").twist.twist
    assert (velocity.linear.x, velocity.linear.y, velocity.angular.z) == pytest.approx(
        (0.3, -0.2, 0.5)
    )


def test_turn_on_the_spot_drives_all_wheels_alike():
    bench = _bench()
    bench.run(0.1, "~/cmd_vel", twist(z=1.0))
    assert bench.commands[-1] == pytest.approx([-0.2 / 0.04] * 3)


def test_stamped_and_plain_twist_hold_until_the_timeout():
    plain, other = _bench(), _bench()
    plain.run(0.05, "~/cmd_vel", twist(0.3, 0.1))
    other.run(0.05, "~/cmd_vel", stamped(0, 0.3, 0.1))
    assert plain.commands == other.commands
    plain.run(0.52)
    assert plain.commands[-1] == pytest.approx([0.0] * 3)


def test_open_loop_covariances_tf_and_service():
    bench = _bench(
        {
            "open_loop": True,
            "diagonal_covariance.pose": [1, 2, 3, 4, 5, 6],
            "diagonal_covariance.twist": [6, 5, 4, 3, 2, 1],
        }
    )
    bench.run(0.5, "~/cmd_vel", twist(0.3))
    assert bench.pose()[0] == pytest.approx(0.15)
    message = bench.last("~/odom")
    assert np.diag(np.reshape(message.pose.covariance, (6, 6))).tolist() == [1, 2, 3, 4, 5, 6]
    assert np.diag(np.reshape(message.twist.covariance, (6, 6))).tolist() == [6, 5, 4, 3, 2, 1]
    assert bench.last("/tf").transforms[0].transform.translation.x == pytest.approx(0.15)
    service = service_type("control_msgs/SetOdometry")
    request = service.Request(x=3.0, y=4.0, yaw=0.5)
    assert bench.ports.call("~/set_odometry", request, service.Response()).success
    assert bench.controller.changed({"enable_odom_tf": False}) == ""
    sent = len(bench.ports.publishers["/tf"].messages)
    bench.run(0.01)
    assert len(bench.ports.publishers["/tf"].messages) == sent


def test_fewer_than_three_wheels_are_an_error():
    with pytest.raises(ControllerError, match="The number of wheels is less than 3"):
        _bench({"wheel_names": ["a", "b"]})
