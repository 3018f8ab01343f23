"""joystick_relay.py and twist_marker."""

from __future__ import annotations

from typing import Any

import pytest
from tests.patience import stretched

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import message_type
from gazelle.nodes.parameters import node_reader
from gazelle.nodes.twist_mux.joystick_relay import PARAMETERS, Steps

_TWIST: Any = message_type("geometry_msgs/msg/Twist")


def _steps(turbo: dict[str, Any], found: Diagnostics) -> Steps:
    return Steps(node_reader(PARAMETERS, {"turbo": turbo}, "/relay", found))


def test_steps_lie_evenly_between_least_and_most() -> None:
    turbo = {"steps": 3, "linear_forward_min": 0.5, "linear_forward_max": 1.5, "init_step": 1}
    steps = _steps(turbo, Diagnostics())
    speeds = []
    for _ in range(4):
        speeds.append(steps.speed("forward", 1.0))
        steps.move(1)
    assert speeds == [0.5, 1.0, 1.5, 1.5]
    assert steps.speed("backward", -1.0) == -1.5
    steps.reset()
    steps.move(1, angular_only=True)
    assert (steps.step, steps.angular_step) == (1, 2)


def test_a_speed_that_is_not_positive_is_refused() -> None:
    with pytest.raises(
        LaunchError, match=r"'turbo\.angular_min' is 0, not a number greater than 0"
    ):
        _steps({"angular_min": 0}, Diagnostics())


def test_a_first_step_that_is_no_number_is_told_and_the_middle_one_is_taken() -> None:
    found = Diagnostics()
    assert _steps({"steps": 5, "init_step": "slow"}, found).step == 3
    assert [item.message for item in found] == [
        "/relay: parameter 'turbo.init_step' is 'slow', not a number; 3.0 is used"
    ]


@pytest.mark.parametrize("ros_version", [1, 2])
def test_relay_scales_and_gives_up_its_priority(bench: Any, ros_version: Any) -> None:
    words = ("--ros-args",) if ros_version == 2 else ()
    got = bench.listen("/joy_vel_out", "geometry_msgs/msg/Twist")
    told = bench.listen("/joy_priority", "std_msgs/msg/Bool")
    bench.node.parameters.set("/joystick_relay/turbo/linear_forward_min", 2.0)
    flags = ("-p", "turbo.linear_forward_min:=2.0") if words else ()
    bench.start("twist_mux/joystick_relay.py", *words, *flags)
    out = bench.node.create_publisher("/joy_vel_in", _TWIST)
    bench.eventually(lambda: out.matched)
    twist = _TWIST()
    twist.linear.x = 0.5
    out.publish(twist)
    assert bench.eventually(lambda: got)[0].linear.x == 1.0
    client = ActionClient(
        bench.node, "/joy_priority_action", "twist_mux_msgs/JoyPriority", ros_version=ros_version
    )
    assert client.wait_for_server(stretched(30.0))
    client.send_goal({})
    bench.eventually(lambda: [one.data for one in told] == [True, False])


def test_marker_points_along_the_velocity(bench: Any) -> None:
    got = bench.listen("/marker", "visualization_msgs/msg/Marker")
    bench.start("twist_mux/twist_marker", "_scale:=2.0")
    out = bench.node.create_publisher("/twist", _TWIST)
    bench.eventually(lambda: out.matched)
    twist = _TWIST()
    twist.linear.x, twist.linear.y, twist.angular.z = 0.5, 0.1, -0.4
    out.publish(twist)
    marker = bench.eventually(lambda: got)[0]
    tip = marker.points[1]
    assert (tip.x, tip.y, tip.z) == (0.5, -0.4, 0.01)
    assert (marker.header.frame_id, marker.pose.position.z) == ("base_footprint", 2.0)
    assert marker.scale.x == 0.1
