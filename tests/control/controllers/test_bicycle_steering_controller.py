"""bicycle_steering_controller on ideal joints."""

from __future__ import annotations

import math

import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, steered, twist

from gazelle.control.controllers.bicycle_steering_controller import BicycleSteeringController
from gazelle.control.errors import ControllerError

NEW = {
    "traction_joints_names": ["rear"],
    "steering_joints_names": ["front"],
    "wheelbase": 1.5,
    "traction_wheel_radius": 0.3,
}
OLD = {
    "rear_wheels_names": ["rear"],
    "front_wheels_names": ["front"],
    "wheelbase": 1.5,
    "rear_wheel_radius": 0.3,
    "front_wheel_radius": 99.0,
}


@pytest.mark.parametrize("parameters", [NEW, OLD])
def test_twist_becomes_wheel_speed_and_steering_angle(parameters):
    joints = [*rolling("rear"), *steered("front")]
    bench = WheeledBench(BicycleSteeringController, joints, parameters, ros_version=2)
    bench.run(2.0, "~/reference", twist(0.6, z=0.2))
    assert bench.commands[-1] == pytest.approx([2.0, math.atan(0.2 * 1.5 / 0.6)])
    message = bench.last("~/odometry")
    assert message.twist.twist.angular.z == pytest.approx(0.2)
    place = message.pose.pose.position
    assert math.dist((place.x, place.y), (0.0, 3.0)) == pytest.approx(3.0, abs=2e-3)


def test_state_joints_may_be_others_than_the_driven_ones():
    joints = [*rolling("rear", "encoder"), *steered("front")]
    parameters = {**NEW, "traction_joints_state_names": ["encoder"]}
    bench = WheeledBench(BicycleSteeringController, joints, parameters, ros_version=2)
    bench.run(0.1, "~/reference", twist(0.6))
    assert bench.controller.states == ("encoder/velocity", "front/position")
    assert bench.last("~/odometry").twist.twist.linear.x == 0.0


def test_two_driven_joints_are_too_many():
    joints = [*rolling("rear", "other"), *steered("front")]
    parameters = {**NEW, "traction_joints_names": ["rear", "other"]}
    with pytest.raises(ControllerError, match="Bicycle configuration requires exactly 1"):
        WheeledBench(BicycleSteeringController, joints, parameters, ros_version=2)
