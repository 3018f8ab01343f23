"""tricycle_steering_controller on ideal joints."""

from __future__ import annotations

import math

import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, steered, twist

from gazelle.control.controllers.tricycle_steering_controller import TricycleSteeringController

NEW = {
    "traction_joints_names": ["right", "left"],
    "steering_joints_names": ["front"],
    "wheelbase": 1.5,
    "traction_wheels_radius": 0.3,
    "traction_track_width": 1.0,
}
OLD = {
    "rear_wheels_names": ["right", "left"],
    "front_wheels_names": ["front"],
    "wheelbase": 1.5,
    "rear_wheels_radius": 0.3,
    "front_wheels_radius": 99.0,
    "wheel_track": 1.0,
}


@pytest.mark.parametrize("parameters", [NEW, OLD])
def test_driven_wheels_of_a_curve_fit_the_steered_one(parameters):
    joints = [*rolling("right", "left"), *steered("front")]
    bench = WheeledBench(TricycleSteeringController, joints, parameters, ros_version=2)
    bench.run(2.0, "~/reference", twist(0.6, z=0.2))
    right, left, angle = bench.commands[-1]
    assert angle == pytest.approx(math.atan(0.2 * 1.5 / 0.6))
    assert (right * 0.3, left * 0.3) == pytest.approx((0.2 * 3.5, 0.2 * 2.5))
    message = bench.last("~/odometry")
    assert (message.twist.twist.linear.x, message.twist.twist.angular.z) == pytest.approx(
        (0.6, 0.2)
    )
    place = message.pose.pose.position
    assert math.dist((place.x, place.y), (0.0, 3.0)) == pytest.approx(3.0, abs=2e-3)
