"""The robot without physics: its odometry is the integral of its commands."""

from __future__ import annotations

import math
import threading

import pytest

from gazelle.errors import LaunchError
from gazelle.interfaces import message_type
from gazelle.node_specs.registry import node_spec
from gazelle.nodes.host import run_node
from gazelle.nodes.turtlebot3.fake import FakeBase

_STEP_NS = 33_333_333


def _drive(base: FakeBase, seconds: float, linear: float, angular: float) -> None:
    start_ns = base.commanded_ns
    for step in range(1, round(seconds * 1e9 / _STEP_NS) + 1):
        now_ns = start_ns + step * _STEP_NS
        base.command(linear, angular, now_ns)
        base.move(now_ns, _STEP_NS)


def test_odometry_is_the_integral_of_the_commands() -> None:
    base = FakeBase(0.287)
    _drive(base, 4.0, 0.2, 0.5)
    radius, angle = 0.2 / 0.5, base.yaw_rad
    assert angle == pytest.approx(2.0, abs=1e-6)
    expected = (radius * math.sin(angle), radius * (1 - math.cos(angle)))
    assert (base.x_m, base.y_m) == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("separation", [0.16, 0.287])
def test_wheels_turn_as_far_as_the_robot_goes(separation: float) -> None:
    base = FakeBase(separation)
    _drive(base, 3.0, 0.2, 0.7)
    assert (base.left_rad + base.right_rad) / 2 * 0.033 == pytest.approx(0.6, rel=1e-6)
    turned = (base.right_rad - base.left_rad) * 0.033 / separation
    assert turned == pytest.approx(base.yaw_rad)


def test_square_of_commands_ends_where_it_began() -> None:
    base = FakeBase(0.16)
    for _side in range(4):
        _drive(base, 5.0, 0.2, 0.0)
        _drive(base, 3.0, 0.0, math.pi / 2 / (90 * _STEP_NS / 1e9))
    assert (base.x_m, base.y_m) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert base.yaw_rad == pytest.approx(2 * math.pi)


def test_command_holds_for_one_second() -> None:
    base = FakeBase(0.16)
    base.command(0.2, 0.0, 0)
    for step in range(1, 100):
        base.move(step * _STEP_NS, _STEP_NS)
    assert base.x_m == pytest.approx(0.2, abs=0.2 * _STEP_NS / 1e9)
    assert base.wheel_speeds_rad_s == (0.0, 0.0)


def test_node_sends_odometry_joints_and_transform_of_the_same_moment(bench) -> None:
    bench.node.parameters.set("/tb3_model", "waffle")
    bench.node.parameters.set("/odom_frame", "world")
    odometry = bench.listen("/odom", "nav_msgs/msg/Odometry")
    joints = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    transforms = bench.listen("/tf", "tf2_msgs/msg/TFMessage")
    bench.start("turtlebot3_fake/turtlebot3_fake_node")
    twist = message_type("geometry_msgs/msg/Twist")
    out = bench.node.create_publisher("/cmd_vel", twist)
    bench.eventually(lambda: out.matched)
    out.publish(_twist(0.1, 1.0))
    bench.eventually(lambda: odometry and odometry[-1].pose.pose.orientation.z > 0.02)
    moving = odometry[-1]
    assert (moving.twist.twist.linear.x, moving.twist.twist.angular.z) == (0.1, 1.0)
    assert (moving.header.frame_id, moving.child_frame_id) == ("world", "base_footprint")
    diagonal = [moving.pose.covariance[7 * place] for place in range(6)]
    assert diagonal == [0.1, 0.1, 1e6, 1e6, 1e6, 0.2]
    state = bench.eventually(lambda: _same(joints, moving))
    assert list(state.name) == ["wheel_left_joint", "wheel_right_joint"]
    assert list(state.velocity) == pytest.approx([(0.1 - 0.1435) / 0.033, (0.1 + 0.1435) / 0.033])
    transform = bench.eventually(lambda: _same([one.transforms[0] for one in transforms], moving))
    assert transform.transform.translation.x == moving.pose.pose.position.x
    assert transform.transform.rotation.z == moving.pose.pose.orientation.z


def test_ros2_wheels_come_from_a_parameter_file(bench, tmp_path, capfd) -> None:
    path = tmp_path / "burger.yaml"
    path.write_text(
        "turtlebot3_fake_node:\n  ros__parameters:\n    wheels:\n      separation: 0.16\n"
        "      radius: 0.05\n    odom_frame: world\n"
    )
    odometry = bench.listen("/odom", "nav_msgs/msg/Odometry")
    joints = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    words = ("--ros-args", "--params-file", str(path))
    bench.start("turtlebot3_fake_node/turtlebot3_fake_node", *words)
    out = bench.node.create_publisher("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.eventually(lambda: out.matched)
    out.publish(_twist(0.1, 0.0))
    bench.eventually(lambda: joints and joints[-1].velocity[0] == pytest.approx(0.1 / 0.05))
    assert bench.eventually(lambda: odometry)[-1].header.frame_id == "world"
    assert set(odometry[-1].pose.covariance) == {0.0}
    spec = node_spec("turtlebot3_fake_node", "turtlebot3_fake_node")
    assert spec is not None
    assert tuple(joints[-1].name) == spec.joints
    found = bench.call("/turtlebot3_fake_node/list_parameters", "rcl_interfaces/ListParameters")
    assert "wheels.radius" in found.result.names
    assert "Turtlebot3 fake node has been initialised" in capfd.readouterr().err


def test_ros2_without_wheels_says_how_to_give_them(bench) -> None:
    request = {"node": "turtlebot3_fake_node/turtlebot3_fake_node", "argv": []}
    with pytest.raises(
        LaunchError, match=r"-p wheels\.separation:=0\.16 -p wheels\.radius:=0\.033"
    ):
        run_node(request, bench.graph, threading.Event())


def test_missing_model_is_told_with_what_the_original_does(bench, capfd) -> None:
    bench.node.parameters.set("/tb3_model", "wafle")
    bench.start("turtlebot3_fake/turtlebot3_fake_node")
    bench.eventually(lambda: "/odom" in dict(bench.graph.topic_names_and_types()))
    bench.stop()
    text = "".join(capfd.readouterr())
    assert "'wafle' is no TurtleBot3; there are burger, waffle, waffle_pi. did you mean" in text
    assert "the original computes with an arbitrary distance" in text


def _twist(linear: float, angular: float):
    message = message_type("geometry_msgs/msg/Twist")()
    message.linear.x, message.angular.z = linear, angular
    return message


def _same(messages, other):
    stamp = other.header.stamp
    return next((one for one in messages if one.header.stamp == stamp), None)


def test_model_below_the_node_has_no_effect_and_that_is_told(bench, capfd) -> None:
    bench.start("turtlebot3_fake/turtlebot3_fake_node", "_tb3_model:=waffle")
    bench.eventually(lambda: "/odom" in dict(bench.graph.topic_names_and_types()))
    bench.stop()
    text = "parameter 'tb3_model' ('waffle') has no effect here: the node reads /tb3_model"
    assert text in "".join(capfd.readouterr())


def test_ros2_unknown_parameters_are_told(bench, capfd) -> None:
    words = ("wheels.separation:=0.16", "wheels.radius:=0.05", "odm_frame:=world")
    rules = [word for rule in words for word in ("-p", rule)]
    bench.start("turtlebot3_fake_node/turtlebot3_fake_node", "--ros-args", *rules)
    bench.eventually(lambda: "/odom" in dict(bench.graph.topic_names_and_types()))
    bench.stop()
    text = "parameter 'odm_frame' is not one of turtlebot3_fake_node (ROS 2); it has no effect"
    assert text in "".join(capfd.readouterr())
