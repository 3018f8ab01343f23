"""ackermann_steering_controller of both generations on ideal joints."""

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

from gazelle.control.controllers.ackermann_steering_controller import AckermannSteeringController
from gazelle.control.errors import ControllerError
from gazelle.description.model import (
    Collision,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Sphere,
)
from gazelle.geometry import Pose
from gazelle.interfaces import service_type

BASE, RADIUS, TRACK = 1.0, 0.25, 0.8
NEW = {
    "traction_joints_names": ["rr", "rl"],
    "steering_joints_names": ["fr", "fl"],
    "wheelbase": BASE,
    "traction_wheels_radius": RADIUS,
    "traction_track_width": TRACK,
}
OLD = {
    "rear_wheels_names": ["rr", "rl"],
    "front_wheels_names": ["fr", "fl"],
    "front_steering": True,
    "wheelbase": BASE,
    "rear_wheels_radius": RADIUS,
    "front_wheels_radius": 99.0,
    "rear_wheel_track": TRACK,
    "front_wheel_track": 99.0,
}
JOINTS = [*rolling("rr", "rl"), *steered("fr", "fl")]


def _bench(parameters=None, *, base=NEW):
    return WheeledBench(
        AckermannSteeringController, JOINTS, {**base, **(parameters or {})}, ros_version=2
    )


def _drive(bench, seconds, linear, angular):
    bench.run(seconds, "~/reference", twist(linear, z=angular))


@pytest.mark.parametrize("base", [NEW, OLD])
def test_circle_has_the_radius_of_speed_by_yaw_rate(base):
    bench = _bench(base=base)
    _drive(bench, 4.0, 0.5, 0.25)
    right, left, steer_right, steer_left = bench.commands[-1]
    radius = 0.5 / 0.25
    assert right * RADIUS == pytest.approx(0.25 * (radius + TRACK / 2))
    assert left * RADIUS == pytest.approx(0.25 * (radius - TRACK / 2))
    assert BASE / math.tan(steer_left) == pytest.approx(radius - TRACK / 2)
    assert BASE / math.tan(steer_right) == pytest.approx(radius + TRACK / 2)
    message = bench.last("~/odometry")
    assert message.twist.twist.linear.x == pytest.approx(0.5)
    assert message.twist.twist.angular.z == pytest.approx(0.25)
    place = message.pose.pose.position
    assert math.dist((place.x, place.y), (0.0, radius)) == pytest.approx(radius, abs=2e-3)


def test_rear_steering_drives_the_front_wheels():
    parameters = {**OLD, "front_steering": False, "front_wheels_radius": 0.5}
    joints = [*rolling("fr", "fl"), *steered("rr", "rl")]
    bench = WheeledBench(AckermannSteeringController, joints, parameters, ros_version=2)
    assert bench.controller.commands == ("fr/velocity", "fl/velocity", "rr/position", "rl/position")
    _drive(bench, 0.1, 1.0, 0.0)
    assert bench.commands[-1] == pytest.approx([2.0, 2.0, 0.0, 0.0])


def test_steered_track_may_differ_from_the_driven_one():
    bench = _bench({"steering_track_width": 0.4})
    _drive(bench, 0.1, 0.5, 0.25)
    right, left = bench.commands[-1][2:]
    assert 1 / math.tan(right) - 1 / math.tan(left) == pytest.approx(0.4 / BASE)


def test_timeout_stops_the_wheels_and_leaves_the_steering():
    bench = _bench({"reference_timeout": 0.2})
    _drive(bench, 0.1, 0.5, 0.25)
    angles = bench.commands[-1][2:]
    bench.run(0.25)
    assert bench.commands[-1][:2] == [0.0, 0.0]
    assert bench.commands[-1][2:] == angles


def test_timeout_of_zero_lets_a_reference_act_once():
    bench = _bench({"reference_timeout": 0.0})
    bench.run(0.001, "~/reference", twist(0.5))
    assert bench.commands[-1][0] == pytest.approx(2.0)
    bench.run(0.001)
    assert bench.commands[-1][0] == 0.0


@pytest.mark.parametrize("topic", ["~/reference", "~/reference_unstamped"])
def test_twist_and_twist_stamped_drive_alike(topic):
    plain, other = _bench(), _bench()
    plain.run(0.05, topic, twist(0.3, z=0.1))
    other.run(0.05, topic, stamped(0, 0.3, z=0.1))
    assert plain.commands == other.commands
    assert plain.commands[-1][0] > 0


def test_position_feedback_gives_the_same_odometry_as_velocities():
    benches = [_bench(), _bench({"position_feedback": True})]
    for bench in benches:
        _drive(bench, 1.0, 0.5, 0.25)
    velocity, position = (bench.last("~/odometry").pose.pose.position for bench in benches)
    assert (position.x, position.y) == pytest.approx((velocity.x, velocity.y), abs=1e-9)
    assert len(benches[1].last("~/controller_state").traction_wheels_position) == 2


def test_open_loop_takes_the_reference_for_odometry():
    bench = _bench({"open_loop": True})
    _drive(bench, 1.0, 0.5, 0.25)
    place = bench.last("~/odometry").pose.pose.position
    assert (place.x, place.y) == pytest.approx((2 * math.sin(0.25), 2 * (1 - math.cos(0.25))))


def test_wheels_slow_down_until_the_steering_is_there():
    bench = _bench({"reduce_wheel_speed_until_steering_reached": True})
    bench.run(0.001, "~/reference", twist(0.2, z=0.3))
    target = math.atan(0.3 * BASE / 0.2)
    eager = math.cos(target) / math.cos(math.pi / 6)
    assert bench.commands[-1][:2] == pytest.approx([0.2 / RADIUS * eager] * 2)
    bench.run(0.002, "~/reference", twist(0.2, z=0.3))
    assert sum(bench.commands[-1][:2]) / 2 == pytest.approx(0.2 / RADIUS)


def test_odometry_is_published_at_every_update_with_frames_and_covariances():
    bench = _bench({"twist_covariance_diagonal": [1, 2, 3, 4, 5, 6], "tf_frame_prefix": "car"})
    bench.run(0.01)
    assert len(bench.ports.publishers["~/odometry"].messages) == 10
    message = bench.last("~/odometry")
    assert (message.header.frame_id, message.child_frame_id) == ("car/odom", "car/base_link")
    assert np.diag(np.reshape(message.twist.covariance, (6, 6))).tolist() == [1, 2, 3, 4, 5, 6]
    assert np.diag(np.reshape(message.pose.covariance, (6, 6))).tolist() == [0, 7, 14, 21, 28, 35]
    transform = bench.last("~/tf_odometry").transforms[0]
    assert (transform.header.frame_id, transform.child_frame_id) == ("car/odom", "car/base_link")


def test_state_tells_commands_and_angles():
    bench = _bench()
    _drive(bench, 0.1, 0.5, 0.25)
    state = bench.last("~/controller_state")
    assert list(state.linear_velocity_command) == bench.commands[-1][:2]
    assert list(state.steering_angle_command) == bench.commands[-1][2:]
    assert list(state.steer_positions) == pytest.approx(bench.commands[-1][2:])


def test_stopped_wheels_stand_and_parameters_change_live():
    bench = _bench()
    _drive(bench, 0.1, 0.5, 0.25)
    bench.controller.stop(bench.time_ns)
    assert bench.command("rr/velocity") == bench.command("rl/velocity") == 0.0
    assert bench.controller.changed({"reference_timeout": 0.05, "enable_odom_tf": False}) == ""
    bench.controller.start(bench.time_ns)
    sent = len(bench.ports.publishers["~/tf_odometry"].messages)
    bench.run(0.001, "~/reference", twist(0.5))
    bench.run(0.06)
    assert bench.command("rr/velocity") == 0.0
    assert len(bench.ports.publishers["~/tf_odometry"].messages) == sent


def test_odometry_can_be_set():
    bench = _bench()
    service = service_type("control_msgs/SetOdometry")
    request = service.Request(x=3.0, y=4.0, yaw=0.5)
    assert bench.ports.call("~/set_odometry", request, service.Response()).success
    bench.run(0.001)
    place = bench.last("~/odometry").pose.pose.position
    assert (place.x, place.y) == (3.0, 4.0)


def test_wrong_number_of_joints_is_an_error():
    match = "Ackermann configuration requires exactly 2, but 1 were provided"
    with pytest.raises(ControllerError, match=match):
        _bench({"steering_joints_names": ["fr"]})
    with pytest.raises(ControllerError, match="no 'wheelbase' given"):
        _bench(base={key: value for key, value in NEW.items() if key != "wheelbase"})


ROS1 = {
    "rear_wheel": "rear",
    "front_steer": "steer",
    "wheel_separation_h": BASE,
    "wheel_radius": RADIUS,
    "publish_rate": 1000,
    "pose_covariance_diagonal": [0.001] * 6,
    "twist_covariance_diagonal": [0.001] * 6,
}


def _ros1(parameters=None, *, base=ROS1, model=None):
    joints = [*rolling("rear"), *steered("steer")]
    values = {**base, **(parameters or {})}
    return WheeledBench(AckermannSteeringController, joints, values, model=model)


def test_ros1_takes_angular_z_for_the_steering_angle():
    bench = _ros1()
    bench.run(2.0, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1] == pytest.approx([0.5 / RADIUS, 0.4])
    radius = BASE / math.tan(0.4)
    x, y, _ = bench.pose()
    assert math.dist((x, y), (0.0, radius)) == pytest.approx(radius, abs=1e-3)
    assert bench.last("~/odom").twist.twist.angular.z == pytest.approx(0.5 / radius)


def test_ros1_limits_act_on_speed_and_angle_and_a_timeout_straightens():
    limit = {"has_velocity_limits": True, "max_velocity": 0.3}
    bench = _ros1({"linear/x": limit, "angular/z": limit})
    bench.run(0.1, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1] == pytest.approx([0.3 / RADIUS, 0.3])
    bench.run(0.6)
    assert bench.commands[-1] == [0.0, 0.0]


def test_ros1_multipliers_act_on_odometry_only():
    bench = _ros1({"wheel_radius_multiplier": 2.0, "steer_pos_multiplier": 0.5})
    bench.run(1.0, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1] == pytest.approx([0.5 / RADIUS, 0.4])
    velocity = bench.last("~/odom").twist.twist
    assert velocity.linear.x == pytest.approx(1.0)
    assert velocity.angular.z == pytest.approx(math.tan(0.2) / BASE)


def test_ros1_measures_come_from_the_description():
    joints = tuple(
        Joint(name, JointType.CONTINUOUS, "base", f"{name}_link", Pose((x, 0.0, 0.0)), JointAxis())
        for name, x in (("rear", -0.4), ("steer", 0.5))
    )
    wheel = Link("rear_link", collisions=(Collision("c", Sphere(0.2)),))
    model = Model("robot", links=(Link("base"), wheel, Link("steer_link")), joints=joints)
    base = {key: value for key, value in ROS1.items() if not key.startswith("wheel_")}
    bench = _ros1(base=base, model=model)
    bench.run(0.5, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1][0] == pytest.approx(0.5 / 0.2)
    assert bench.last("~/odom").twist.twist.angular.z == pytest.approx(0.5 * math.tan(0.4) / 0.9)
