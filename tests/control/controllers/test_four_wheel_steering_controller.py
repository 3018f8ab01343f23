"""four_wheel_steering_controller on ideal joints."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling, steered, twist

from gazelle.control.controllers.four_wheel_steering_controller import FourWheelSteeringController
from gazelle.control.errors import ControllerError
from gazelle.description.model import Collision, Cylinder, Joint, JointAxis, JointType, Link, Model
from gazelle.geometry import Pose
from gazelle.interfaces import message_type

CORNERS = {"fl": (0.5, 0.35), "fr": (0.5, -0.35), "rl": (-0.5, 0.35), "rr": (-0.5, -0.35)}
RADIUS, OFFSET = 0.2, 0.05
PARAMETERS = {
    "front_wheel": ["fl", "fr"],
    "rear_wheel": ["rl", "rr"],
    "front_steering": ["sfl", "sfr"],
    "rear_steering": ["srl", "srr"],
    "publish_rate": 1000,
    "pose_covariance_diagonal": [0.001] * 6,
    "twist_covariance_diagonal": [0.002] * 6,
}


def _model():
    links, joints = [Link("base")], []
    for name, (x, y) in CORNERS.items():
        inside = y - math.copysign(OFFSET, y)
        links += [
            Link(f"{name}_knuckle"),
            Link(f"{name}_wheel", collisions=(Collision("c", Cylinder(RADIUS, 0.1)),)),
        ]
        kind, axis = JointType.CONTINUOUS, JointAxis()
        at = Pose((x, inside, 0.0))
        joints += [
            Joint(f"s{name}", kind, "base", f"{name}_knuckle", at, axis),
            Joint(name, kind, f"{name}_knuckle", f"{name}_wheel", Pose((x, y, 0.0)), axis),
        ]
    return Model("robot", links=tuple(links), joints=tuple(joints))


def _bench(parameters=None):
    joints = [*rolling(*CORNERS), *steered(*(f"s{name}" for name in CORNERS))]
    values = {**PARAMETERS, **(parameters or {})}
    return WheeledBench(FourWheelSteeringController, joints, values, model=_model())


def _order(speed, front, rear):
    return message_type("four_wheel_steering_msgs/FourWheelSteering")(
        speed=speed, front_steering_angle=front, rear_steering_angle=rear
    )


def test_twist_drives_a_circle_about_the_middle():
    bench = _bench()
    bench.run(2.0, "~/cmd_vel", twist(0.6, z=0.4))
    speeds, angles = bench.commands[-1][:4], bench.commands[-1][4:]
    assert angles[2:] == [-angles[0], -angles[1]]
    assert math.tan(angles[0]) == pytest.approx(0.5 / (1.5 - 0.3))
    assert speeds[0] * RADIUS == pytest.approx(0.4 * math.hypot(1.2, 0.5) - 0.4 * OFFSET)
    message = bench.last("~/odom")
    assert message.twist.twist.linear.x == pytest.approx(0.6)
    assert message.twist.twist.angular.z == pytest.approx(0.4)
    x, y, _ = bench.pose()
    assert math.dist((x, y), (0.0, 1.5)) == pytest.approx(1.5, abs=2e-3)


def test_equal_angles_make_the_base_walk_like_a_crab():
    bench = _bench()
    bench.run(2.0, "~/cmd_four_wheel_steering", _order(0.5, 0.6, 0.6))
    x, y, half = bench.pose()
    assert y / x == pytest.approx(math.tan(0.6), rel=5e-3)
    assert half == 0.0
    assert bench.last("~/odom").twist.twist.linear.y == pytest.approx(0.5 * math.tan(0.6))


def test_newer_of_the_two_commands_counts():
    bench = _bench()
    bench.run(0.01, "~/cmd_vel", twist(0.6))
    bench.run(0.01, "~/cmd_four_wheel_steering", _order(0.3, 0.0, 0.0))
    assert bench.commands[-1][:4] == pytest.approx([0.3 / RADIUS] * 4)
    bench.run(0.01, "~/cmd_vel", twist(0.6))
    assert bench.commands[-1][:4] == pytest.approx([0.6 / RADIUS] * 4)


@pytest.mark.parametrize(
    ("topic", "message"),
    [("~/cmd_vel", twist(0.6, z=0.4)), ("~/cmd_four_wheel_steering", _order(0.6, 0.3, 0.1))],
)
def test_timeout_stops_and_straightens(topic, message):
    bench = _bench()
    bench.run(0.1, topic, message)
    bench.run(0.45)
    assert bench.commands[-1][0] > 0
    bench.run(0.06)
    assert bench.commands[-1] == [0.0] * 8


def test_limits_act_on_both_commands():
    limits = {
        "has_velocity_limits": True,
        "max_velocity": 0.4,
        "has_acceleration_limits": True,
        "max_acceleration": 1.0,
    }
    for topic, message in (
        ("~/cmd_vel", twist(2.0)),
        ("~/cmd_four_wheel_steering", _order(2.0, 0.0, 0.0)),
    ):
        bench = _bench({"linear/x": limits})
        bench.run(1.0, topic, message)
        speeds = np.array(bench.commands)[:, 0] * RADIUS
        assert speeds.max() == pytest.approx(0.4)
        # Below 1 mm/s the wheels are not driven, so the second update makes up for the first.
        assert np.diff(speeds)[2:].max() / 1e-3 == pytest.approx(1.0)


def test_state_message_tells_angles_and_speed():
    bench = _bench()
    bench.run(1.0, "~/cmd_four_wheel_steering", _order(0.5, 0.3, -0.2))
    state = bench.last("~/odom_steer").data
    assert (state.front_steering_angle, state.rear_steering_angle) == pytest.approx((0.3, -0.2))
    along, across = 0.5, 0.5 * (math.tan(0.3) + math.tan(-0.2)) / 2
    assert state.speed == pytest.approx(math.hypot(along, across))


def test_acceleration_is_positive_while_the_speed_grows():
    limits = {"has_acceleration_limits": True, "max_acceleration": 1.0}
    bench = _bench({"linear/x": limits})
    bench.run(0.3, "~/cmd_vel", twist(2.0))
    assert bench.last("~/odom_steer").data.acceleration == pytest.approx(1.0)


def test_bad_orders_and_stopped_controllers_say_so():
    bench = _bench()
    bench.run(0.01, "~/cmd_four_wheel_steering", _order(math.nan, 0.0, 0.0))
    assert bench.commands[-1] == [0.0] * 8
    bench.controller.stop(bench.time_ns)
    bench.ports.send("~/cmd_four_wheel_steering", _order(1.0, 0.0, 0.0))
    texts = [text for _, text in bench.ports.lines]
    assert any("Received NaN in four_wheel_steering_msgs" in text for text in texts)
    assert "Can't accept new commands. Controller is not running." in texts


def test_two_joints_an_axle_are_needed():
    with pytest.raises(ControllerError, match="front_wheel needs two joints, left and right"):
        _bench({"front_wheel": ["fl"]})
