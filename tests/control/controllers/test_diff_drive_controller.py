"""diff_drive_controller on ideal wheels: laws of its odometry, limits and timeouts."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, stamped, twist
from tests.control.plant import MS, make_controller, make_robot

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.diff_drive_controller import DiffDriveController
from gazelle.control.errors import ControllerError
from gazelle.description.model import (
    Box,
    Collision,
    Cylinder,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
)
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.interfaces import service_type

RADIUS, SEPARATION = 0.1, 0.5
SIDES = {"left_wheel": "left", "right_wheel": "right"}
SIZES = {"wheel_separation": SEPARATION, "wheel_radius": RADIUS}
VARIANCES = {
    "pose_covariance_diagonal": [0.001, 0.002, 0.003, 0.004, 0.005, 0.03],
    "twist_covariance_diagonal": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
}
ROS1 = {**SIDES, **SIZES, **VARIANCES, "publish_rate": 1000.0}
ROS2 = {
    "left_wheel_names": ["left"],
    "right_wheel_names": ["right"],
    **SIZES,
    "publish_rate": 2000.0,
}


def _bench(parameters=None, *, joints=("left", "right"), base=ROS1, **options):
    return WheeledBench(
        DiffDriveController, rolling(*joints), {**base, **(parameters or {})}, **options
    )


def _speeds(bench):
    """Forward speeds and yaw rates that the wheels were told, by update."""
    left, right = np.array(bench.commands)[:, :2].T * RADIUS
    return (left + right) / 2, (right - left) / SEPARATION


def test_straight_line_goes_as_far_as_the_wheels_roll():
    bench = _bench()
    bench.run(2.0, "~/cmd_vel", twist(0.4))
    travelled = 0.4 * (bench.time_ns - MS) * 1e-9
    assert bench.plant.position * RADIUS == pytest.approx([0.8, 0.8])
    assert bench.pose() == pytest.approx((travelled, 0.0, 0.0), abs=1e-9)


def test_turn_on_the_spot_stays_there():
    bench = _bench()
    bench.run(2.001, "~/cmd_vel", twist(z=0.6))
    assert bench.pose() == pytest.approx((0.0, 0.0, math.sin(0.6)), abs=1e-9)


def test_circle_is_integrated_exactly_even_in_coarse_steps():
    bench = _bench(period_ns=100 * MS)
    bench.run(2.1, "~/cmd_vel", twist(0.5, z=0.25))
    angle, radius = 0.25 * 2.0, 0.5 / 0.25
    x, y, half = bench.pose()
    assert (x, y) == pytest.approx((radius * math.sin(angle), radius * (1 - math.cos(angle))))
    assert half == pytest.approx(math.sin(angle / 2))


def test_odometry_has_the_covariances_frames_and_velocities():
    bench = _bench({"odom_frame_id": "o", "base_frame_id": "b"})
    bench.run(0.1, "~/cmd_vel", twist(0.4, z=0.2))
    message = bench.last("~/odom")
    assert (message.header.frame_id, message.child_frame_id) == ("o", "b")
    diagonal = VARIANCES["pose_covariance_diagonal"]
    assert np.array(message.pose.covariance).reshape(6, 6) == pytest.approx(np.diag(diagonal))
    diagonal = VARIANCES["twist_covariance_diagonal"]
    assert np.array(message.twist.covariance).reshape(6, 6) == pytest.approx(np.diag(diagonal))
    assert message.twist.twist.linear.x == pytest.approx(0.4)
    assert message.twist.twist.angular.z == pytest.approx(0.2)


def test_velocity_is_the_mean_over_the_rolling_window():
    bench = _bench({"velocity_rolling_window_size": 4})
    bench.run(0.006, "~/cmd_vel", twist(0.4))
    bench.run(0.002, "~/cmd_vel", twist(0.8))
    # The last two updates measured 0.4 and 0.8: a command shows one update later.
    assert bench.last("~/odom").twist.twist.linear.x == pytest.approx((3 * 0.4 + 0.8) / 4)


def test_tf_is_the_odometry_and_can_be_switched_off():
    bench = _bench()
    bench.run(0.5, "~/cmd_vel", twist(0.4, z=0.3))
    transform = bench.last("/tf").transforms[0]
    pose = bench.last("~/odom").pose.pose
    assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_link")
    assert transform.transform.translation.x == pose.position.x
    assert transform.transform.rotation.z == pose.orientation.z
    silent = _bench({"enable_odom_tf": False})
    silent.run(0.1)
    assert not silent.ports.publishers["/tf"].messages


def test_publish_rate_is_kept_in_the_mean():
    bench = _bench({"publish_rate": 50})
    bench.run(1.0)
    stamps = [m.header.stamp.nanosec // MS for m in bench.ports.publishers["~/odom"].messages]
    assert stamps[:3] == [21, 41, 61]
    assert len(stamps) == 49


def test_nothing_is_built_while_nobody_listens():
    bench = _bench(
        {"publish_cmd": True, "publish_wheel_joint_controller_state": True}, subscribed=False
    )
    bench.run(0.1, "~/cmd_vel", twist(0.4))
    assert all(not publisher.messages for publisher in bench.ports.publishers.values())


LIMITS = {
    "linear/x": {
        "has_velocity_limits": True,
        "max_velocity": 0.2,
        "has_acceleration_limits": True,
        "max_acceleration": 0.6,
        "has_jerk_limits": True,
        "max_jerk": 5.0,
    },
    "angular/z": {
        "has_velocity_limits": True,
        "max_velocity": 2.0,
        "min_velocity": -1.0,
        "has_acceleration_limits": True,
        "max_acceleration": 6.0,
    },
}


def test_ros1_limits_are_reached_and_never_exceeded():
    bench = _bench(LIMITS)
    bench.run(1.0, "~/cmd_vel", twist(1.0, z=5.0))
    bench.run(1.0, "~/cmd_vel", twist(-1.0, z=-5.0))
    linear, angular = _speeds(bench)
    assert (linear.min(), linear.max()) == pytest.approx((-0.2, 0.2))
    assert (angular.min(), angular.max()) == pytest.approx((-1.0, 2.0))
    assert np.abs(np.diff(linear)).max() / 1e-3 == pytest.approx(0.6)
    assert np.abs(np.diff(angular)).max() / 1e-3 == pytest.approx(6.0)
    # The velocity limit cuts off at once, as in the original; the jerk limit acts before it.
    jerk = np.diff(linear[:80], 2) / 1e-6
    assert jerk.max() == pytest.approx(2 * 5.0)


def test_ros1_limits_without_their_flag_do_not_act():
    bench = _bench({"linear/x/max_velocity": 0.2})
    bench.run(0.1, "~/cmd_vel", twist(1.0))
    assert _speeds(bench)[0].max() == pytest.approx(1.0)


def test_flag_without_a_limit_stops_a_ros1_robot_and_is_reported():
    bench = _bench({"linear/x/has_velocity_limits": True})
    bench.run(0.1, "~/cmd_vel", twist(1.0))
    assert _speeds(bench)[0].max() == 0.0
    (found,) = bench.diagnostics
    assert found.code == "control.limit-without-value"
    assert "linear.x.max_velocity: 0 is used and the robot stands still" in found.message


def test_limit_of_nothing_that_nobody_switched_on_is_left_out():
    """Up to Humble it had no effect; from Jazzy on the robot would stand still."""
    limits = {"max_velocity": 0.5, "max_jerk": 0.0, "min_jerk": 0.0}
    bench = _bench({"linear.x": limits}, base=ROS2, ros_version=2)
    bench.run(0.1, "~/cmd_vel", twist(1.0))
    assert _speeds(bench)[0].max() == pytest.approx(0.5)
    (found,) = bench.diagnostics.by_code("control.limit-of-nothing")
    assert "linear.x.max_jerk is 0 without linear.x.has_jerk_limits" in found.message
    bench = _bench({"linear.x": limits | {"has_jerk_limits": True}}, base=ROS2, ros_version=2)
    bench.run(0.1, "~/cmd_vel", twist(1.0))
    assert _speeds(bench)[0].max() == 0.0


def test_ros2_limits_act_when_they_are_given():
    limits = {"max_velocity": 0.5, "max_acceleration": 1.0, "max_deceleration": -2.0}
    bench = _bench({"linear.x": limits}, base=ROS2, ros_version=2)
    bench.run(1.0, "~/cmd_vel", twist(1.0))
    bench.run(1.0, "~/cmd_vel", twist(0.0))
    linear, _ = _speeds(bench)
    assert linear.max() == pytest.approx(0.5)
    assert np.diff(linear).max() / 1e-3 == pytest.approx(1.0)
    assert np.diff(linear).min() / 1e-3 == pytest.approx(-2.0)


@pytest.mark.parametrize("off", [{"max_velocity": math.nan}, {"has_velocity_limits": False}])
def test_ros2_limits_are_off_for_nan_and_for_false(off):
    bench = _bench({"linear.x": {"max_velocity": 0.5, **off}}, base=ROS2, ros_version=2)
    bench.run(0.1, "~/cmd_vel", twist(1.0))
    assert _speeds(bench)[0].max() == pytest.approx(1.0)


def test_limits_that_contradict_each_other_are_an_error():
    with pytest.raises(ControllerError, match=r"linear\.x\.min_velocity 1 is above max_velocity"):
        _bench({"linear.x": {"max_velocity": 0.5, "min_velocity": 1.0}}, base=ROS2, ros_version=2)


def test_command_times_out_and_the_limits_bound_the_braking():
    limits = {"has_acceleration_limits": True, "max_acceleration": 0.6}
    bench = _bench({"linear/x": limits, "cmd_vel_timeout": 0.25})
    bench.run(1.0, "~/cmd_vel", twist(0.2))
    bench.run(0.25)
    assert _speeds(bench)[0][-1] == pytest.approx(0.2)
    bench.run(0.4)
    linear, _ = _speeds(bench)
    assert linear[-1] == pytest.approx(0.0, abs=1e-12)
    assert np.diff(linear).min() / 1e-3 == pytest.approx(-0.6)


def test_ros2_timeout_of_zero_keeps_the_command():
    bench = _bench({"cmd_vel_timeout": 0.0}, base=ROS2, ros_version=2)
    bench.run(0.001, "~/cmd_vel", twist(0.3))
    bench.run(5.0)
    assert _speeds(bench)[0][-1] == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("ros_version", "topic"), [(1, "~/cmd_vel"), (2, "~/cmd_vel"), (2, "~/cmd_vel_unstamped")]
)
def test_twist_and_twist_stamped_drive_alike(ros_version, topic):
    base = ROS1 if ros_version == 1 else ROS2
    plain, other = (_bench(base=base, ros_version=ros_version) for _ in range(2))
    plain.run(0.1, topic, twist(0.3, z=0.1))
    other.run(0.1, topic, stamped(0, 0.3, z=0.1))
    assert plain.commands == other.commands
    assert plain.commands[-1][0] > 0


def test_type_of_the_original_is_announced():
    assert _bench().ports.subscriptions["~/cmd_vel"][0][0] == "geometry_msgs/Twist"
    ros2 = _bench(base=ROS2, ros_version=2)
    assert ros2.ports.subscriptions["~/cmd_vel"][0][0] == "geometry_msgs/TwistStamped"


def test_stamp_tells_the_age_of_a_ros2_command():
    bench = _bench(base=ROS2, ros_version=2)
    bench.run(1.0)
    bench.run(0.001, "~/cmd_vel", stamped(bench.time_ns - 400 * MS, 0.3))
    bench.run(0.099)
    assert _speeds(bench)[0][-1] == pytest.approx(0.3)
    bench.run(0.01)
    assert _speeds(bench)[0][-1] == 0.0


def test_stamps_of_another_clock_are_said_once():
    bench = _bench(base=ROS2, ros_version=2)
    bench.run(1.0)
    bench.run(0.01, "~/cmd_vel", stamped(100 * MS, 0.3))
    assert _speeds(bench)[0][-1] == 0.0
    bench.run(0.01, "~/cmd_vel", stamped(1_700_000_000 * 1000 * MS, 0.3))
    assert _speeds(bench)[0][-1] == pytest.approx(0.3)
    old, ahead = (text for _, text in bench.ports.lines if "stamp" in text or "old" in text)
    assert "Ignoring the received message because it is 0.900 s old" in old
    assert "ahead of simulated time; its arrival counts" in ahead


def test_commands_that_are_not_numbers_are_ignored_with_the_old_phrase():
    bench = _bench()
    bench.run(0.01, "~/cmd_vel", twist(0.3))
    bench.run(0.01, "~/cmd_vel", twist(math.nan))
    assert _speeds(bench)[0][-1] == pytest.approx(0.3)
    assert [text for _, text in bench.ports.lines if "NaN" in text] == [
        "Received NaN in velocity command. Ignoring."
    ]


def test_stopped_controller_brakes_and_takes_no_commands():
    bench = _bench()
    bench.run(0.1, "~/cmd_vel", twist(0.3))
    bench.controller.stop(bench.time_ns)
    assert bench.robot.interface_values.commands.tolist() == [0.0, 0.0]
    bench.ports.send("~/cmd_vel", twist(1.0))
    bench.controller.start(bench.time_ns)
    bench.run(0.01)
    assert _speeds(bench)[0][-1] == 0.0
    text = "Can't accept new commands. Controller is not running."
    assert ("warn", text) in bench.ports.lines


def test_wheels_of_a_side_are_driven_alike_and_averaged():
    joints = ("lf", "lb", "rf", "rb")
    parameters = {"left_wheel": ["lf", "lb"], "right_wheel": ["rf", "rb"]}
    bench = _bench(parameters, joints=joints)
    bench.run(0.1, "~/cmd_vel", twist(0.5, z=0.4))
    commands = bench.commands[-1]
    assert commands[0] == commands[1] == pytest.approx((0.5 - 0.1) / RADIUS)
    assert commands[2] == commands[3] == pytest.approx((0.5 + 0.1) / RADIUS)
    bench.run(0.6)
    before = bench.pose()[0]
    bench.plant.position[:] += [0.3, 0.1, 0.2, 0.2]
    bench.run(0.01)
    assert bench.pose()[0] - before == pytest.approx(0.2 * RADIUS, abs=1e-3)


def test_multipliers_correct_the_measures():
    parameters = {
        "wheel_separation_multiplier": 2.0,
        "left_wheel_radius_multiplier": 0.5,
        "right_wheel_radius_multiplier": 2.0,
    }
    bench = _bench(parameters)
    bench.run(0.01, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1] == pytest.approx([(0.5 - 0.2) / 0.05, (0.5 + 0.2) / 0.2])
    assert _bench({**parameters, "wheel_radius_multiplier": 3.0}).controller is not None
    both = _bench({**parameters, "wheel_radius_multiplier": 4.0})
    both.run(0.01, "~/cmd_vel", twist(0.4))
    assert both.commands[-1] == pytest.approx([1.0, 1.0])


def test_multipliers_rate_and_tf_change_live_in_ros1():
    bench = _bench()
    bench.ports.set_live(
        "", wheel_separation_multiplier=1.5, enable_odom_tf=False, publish_rate=10.0
    )
    bench.run(1.0, "~/cmd_vel", twist(z=1.0))
    assert bench.commands[-1] == pytest.approx([-1.0 * 0.375 / RADIUS, 0.375 / RADIUS])
    assert len(bench.ports.publishers["~/odom"].messages) == 9
    assert not bench.ports.publishers["/tf"].messages
    rows = {row.name: row for row in bench.ports.live[""].rows}
    assert (rows["publish_rate"].highest, rows["wheel_separation_multiplier"].lowest) == (2000, 0.5)


def test_ros2_parameters_change_live_and_bad_ones_are_refused():
    bench = _bench(base=ROS2, ros_version=2)
    assert bench.controller.changed({"left_wheel_radius_multiplier": 0.0}) == (
        "left_wheel_radius_multiplier must be above 0"
    )
    assert bench.controller.changed({"cmd_vel_timeout": 0.1, "publish_rate": 0.0}) == ""
    bench.run(0.001, "~/cmd_vel", twist(0.3))
    bench.run(0.12)
    assert _speeds(bench)[0][-1] == 0.0
    assert not bench.ports.publishers["~/odom"].messages


def test_open_loop_odometry_follows_the_limited_command():
    bench = _bench({**LIMITS, "open_loop": True})
    bench.run(1.0, "~/cmd_vel", twist(1.0))
    linear, _ = _speeds(bench)
    assert bench.pose()[0] == pytest.approx(linear[:-1].sum() * 1e-3)
    assert bench.last("~/odom").twist.twist.linear.x == pytest.approx(0.2)


def test_velocity_feedback_gives_the_same_odometry_as_positions():
    positions = _bench(base=ROS2, ros_version=2)
    velocities = _bench({"position_feedback": False}, base=ROS2, ros_version=2)
    for bench in (positions, velocities):
        bench.run(1.0, "~/cmd_vel", twist(0.5, z=0.4))
    assert velocities.controller.states == ("left/velocity", "right/velocity")
    assert velocities.pose() == pytest.approx(positions.pose(), abs=1e-9)


def test_limited_command_is_published_on_request():
    bench = _bench({**LIMITS, "publish_cmd": True})
    bench.run(1.0, "~/cmd_vel", twist(1.0, z=1.0))
    message = bench.last("~/cmd_vel_out")
    assert bench.ports.publishers["~/cmd_vel_out"].type_name == "geometry_msgs/TwistStamped"
    assert (message.twist.linear.x, message.twist.angular.z) == pytest.approx((0.2, 1.0))
    assert "~/cmd_vel_out" not in _bench().ports.publishers


def test_wheel_state_has_the_desired_and_the_true_motion():
    bench = _bench({"publish_wheel_joint_controller_state": True})
    bench.run(0.5, "~/cmd_vel", twist(0.4))
    message = bench.last("~/wheel_joint_controller_state")
    assert message.joint_names == ["left", "right"]
    assert list(message.reference.positions) == pytest.approx([2.0, 2.0])
    assert list(message.feedback.velocities) == pytest.approx([4.0, 4.0])
    assert list(message.error.positions) == pytest.approx([4.0e-3, 4.0e-3])


def test_set_odometry_moves_the_pose_while_active():
    bench = _bench(base=ROS2, ros_version=2)
    service = service_type("control_msgs/SetOdometry")
    request = service.Request(x=1.0, y=2.0, yaw=0.0)
    assert bench.ports.call("~/set_odometry", request, service.Response()).success
    bench.run(0.01)
    assert bench.pose() == pytest.approx((1.0, 2.0, 0.0))
    bench.controller.stop(bench.time_ns)
    refused = bench.ports.call("~/set_odometry", request, service.Response())
    assert (refused.success, refused.message) == (False, "Controller is not active")


def test_odometry_starts_at_zero_wherever_the_wheels_stand():
    bench = _bench()
    bench.plant.position[:] = (10.0, -3.0)
    bench.run(0.01)
    assert bench.pose() == (0.0, 0.0, 0.0)


def test_odometry_begins_anew_after_a_reset_and_goes_on_after_a_stop():
    bench = _bench()
    bench.run(1.0, "~/cmd_vel", twist(0.4))
    there = bench.pose()
    bench.controller.stop(bench.time_ns)
    bench.plant.position[:] += 5.0
    bench.controller.start(bench.time_ns)
    bench.run(0.01)
    assert bench.pose() == pytest.approx(there, abs=1e-3)
    bench.controller.stop(bench.time_ns)
    bench.plant.reset()
    bench.time_ns = 0
    bench.controller.start(0)
    bench.run(0.01)
    assert bench.pose() == (0.0, 0.0, 0.0)


def _model(left_y=0.3, shape=None):
    def wheel(name, y):
        joint = Joint(
            name,
            JointType.CONTINUOUS,
            "base",
            f"{name}_link",
            Pose((0.1, y, 0.0)),
            JointAxis((0.0, 1.0, 0.0)),
        )
        found = Cylinder(0.12, 0.05) if shape is None else shape
        return joint, Link(f"{name}_link", collisions=(Collision("c", found),))

    joints, links = zip(wheel("left", left_y), wheel("right", -left_y), strict=True)
    return Model("robot", links=(Link("base"), *links), joints=joints)


def test_missing_measures_come_from_the_description():
    parameters = {**SIDES, **VARIANCES, "publish_rate": 1000}
    bench = _bench(base=parameters, model=_model())
    bench.run(0.01, "~/cmd_vel", twist(0.5, z=0.4))
    assert bench.commands[-1] == pytest.approx([(0.5 - 0.12) / 0.12, (0.5 + 0.12) / 0.12])
    assert (
        "info",
        "wheel_radius 0.12 m is taken from the robot's description",
    ) in bench.ports.lines
    assert not list(bench.diagnostics)


def test_ros2_without_measures_is_told_that_ros_would_refuse():
    base = {key: value for key, value in ROS2.items() if key not in SIZES}
    bench = _bench(base=base, ros_version=2, model=_model())
    assert [item.code for item in bench.diagnostics] == ["control.wheel-measure"] * 2
    assert "Real ROS 2 would refuse" in next(iter(bench.diagnostics)).message


def test_wheel_of_another_shape_has_no_radius():
    parameters = {**SIDES, **VARIANCES}
    match = "NOT modeled as a cylinder or sphere"
    with pytest.raises(ControllerError, match=match):
        _bench(base=parameters, model=_model(shape=Box((0.1, 0.1, 0.1))))


def test_exchanged_sides_are_reported():
    bench = _bench(model=_model(left_y=-0.3))
    (found,) = bench.diagnostics.by_code("control.wheels-exchanged")
    assert found.code == "control.wheels-exchanged"
    assert (
        "'left' is named as a left wheel and stands 0.6 m to the right of 'right'" in found.message
    )


def test_missing_covariances_are_zeros_and_said_in_ros1():
    bench = _bench(base={**SIDES, **SIZES})
    assert [item.code for item in bench.diagnostics] == ["control.no-covariance"] * 2
    assert not list(_bench(base=ROS2, ros_version=2).diagnostics)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"left_wheel": ["left", "right"]}, r"#left wheels \(2\) != #right wheels \(1\)"),
        ({"left_wheel": []}, "Wheel names parameters are empty"),
        ({"left_wheel": "lft"}, "Could not find resource 'lft'"),
        ({"wheel_radius": 0.0}, "wheel_radius is 0, it must be above 0"),
        ({"pose_covariance_diagonal": [1.0]}, "has 1 values, not 6"),
    ],
)
def test_bad_parameters_say_what_is_wrong(change, message):
    with pytest.raises(ControllerError, match=message):
        _bench(change)


def test_missing_wheels_say_which_key_is_near():
    with pytest.raises(ControllerError, match="no 'left_wheel_names' or 'left_wheel' given"):
        _bench(base={"left_wheel_joint": "left", "right_wheel": "right", **SIZES})


@pytest.mark.parametrize(
    ("parameters", "expected"),
    [
        ({}, ("alice/odom", "alice/base_link")),
        ({"tf_frame_prefix": "~x"}, ("alicex/odom", "alicex/base_link")),
        ({"tf_frame_prefix": "/bob/"}, ("bob/odom", "bob/base_link")),
        ({"tf_frame_prefix_enable": False}, ("odom", "base_link")),
    ],
)
def test_frames_are_prefixed_as_ros2_does(parameters, expected):
    robot, _ = make_robot(rolling("left", "right"), ros_version=2)
    tree = {**ROS2, **parameters}
    table = DiffDriveController.TABLE.parameters
    _, ports = make_controller(DiffDriveController, robot, tree)
    reader = controller_parameters("c", tree, table, Diagnostics())
    context = ControllerContext("c", table.types[0], robot, reader, ports, 100.0, "alice")
    controller = DiffDriveController(context)
    controller.start(0)
    controller.update(MS, MS)
    message = ports.publishers["~/odom"].last
    assert (message.header.frame_id, message.child_frame_id) == expected
