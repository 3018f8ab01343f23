"""teleop_twist_joy: what buttons and axes come to."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type
from gazelle.nodes.teleop.twist_joy import JoyDriving, read_driving

_JOY: Any = message_type("sensor_msgs/msg/Joy")


def _read(tree: dict[str, Any], *, is_ros2: bool) -> JoyDriving:
    found = Diagnostics()
    driving = read_driving(tree, "/teleop", found, is_ros2=is_ros2)
    assert not len(found), [item.message for item in found]
    return driving


def _joy(axes: list[float], *held: int) -> Any:
    return SimpleNamespace(axes=axes, buttons=[int(place in held) for place in range(6)])


def test_single_numbers_of_ros1_stand_for_x_and_yaw() -> None:
    tree = {"axis_linear": 1, "scale_linear": 0.7, "scale_linear_turbo": 1.5, "axis_angular": 0,
            "scale_angular": 0.4, "enable_button": 2, "enable_turbo_button": 3}  # fmt: skip
    driving = _read(tree, is_ros2=False)
    slow, fast = driving.velocities(_joy([1.0, 1.0], 2)), driving.velocities(_joy([1.0, 1.0], 3))
    assert slow is not None and fast is not None
    assert (slow["x"], slow["yaw"]) == (0.7, 0.4)
    assert (fast["x"], fast["yaw"]) == (1.5, 0.4)
    assert driving.velocities(_joy([1.0, 1.0])) is None


def test_axes_by_name_have_no_scale_unless_given() -> None:
    tree = {"axis_linear": {"x": 1, "y": 0}, "scale_linear": {"x": 0.4}, "axis_angular": {"yaw": 2}}
    speeds = _read(tree, is_ros2=False).velocities(_joy([1.0, 1.0, 1.0], 0))
    assert speeds == {"x": 0.4, "y": 0.0, "z": 0.0, "yaw": 0.0, "pitch": 0.0, "roll": 0.0}


def test_ros2_has_defaults_of_its_own() -> None:
    driving = _read({"require_enable_button": False, "inverted_reverse": True}, is_ros2=True)
    speeds = driving.velocities(_joy([0.0, 0.0, 1.0, 0.0, 0.0, -1.0]))
    assert speeds is not None
    assert (speeds["x"], speeds["yaw"]) == (-0.5, -0.5)


def test_axes_and_buttons_that_a_joystick_lacks_count_as_none() -> None:
    driving = _read({"axis_linear": 9, "enable_turbo_button": 40}, is_ros2=False)
    speeds = driving.velocities(_joy([1.0], 0))
    assert speeds is not None and speeds["x"] == 0.0
    assert speeds["yaw"] == 0.5


def test_unknown_parameters_are_told() -> None:
    found = Diagnostics()
    read_driving({"enable_buton": 3}, "/teleop", found, is_ros2=True)
    (told,) = found
    assert told.code == "parameter.unknown"
    assert told.fix.startswith("did you mean 'enable_button'")


def test_node_stops_once_when_the_button_is_let_go(bench: Any) -> None:
    got = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.start("teleop_twist_joy/teleop_node", "_scale_linear:=2.0")
    out = bench.node.create_publisher("/joy", _JOY)
    bench.eventually(lambda: out.matched)
    held = _JOY(axes=[0.0, 0.5], buttons=[1])
    for joy in (held, _JOY(axes=[0.0, 0.5], buttons=[0]), _JOY(axes=[0.0, 0.5], buttons=[0]), held):
        out.publish(joy)
    bench.eventually(lambda: len(got) >= 3)
    assert [one.linear.x for one in got] == [1.0, 0.0, 1.0]


def test_ros2_sends_stamps_and_takes_new_scales(bench: Any) -> None:
    got = bench.listen("/cmd_vel", "geometry_msgs/msg/TwistStamped")
    words = ("publish_stamped_twist:=true", "axis_linear.x:=0", "require_enable_button:=false")
    given = [word for one in words for word in ("-p", one)]
    bench.start("teleop_twist_joy/teleop_node", "--ros-args", *given)
    out = bench.node.create_publisher("/joy", _JOY)
    bench.eventually(lambda: out.matched)
    out.publish(_JOY(axes=[1.0]))
    first = bench.eventually(lambda: got)[0]
    assert (first.header.frame_id, first.twist.linear.x) == ("teleop_twist_joy", 0.5)
    parameter = message_type("rcl_interfaces/msg/Parameter")()
    parameter.name = "scale_linear.x"
    parameter.value.type, parameter.value.double_value = 3, 0.25
    name = "/teleop_twist_joy_node/set_parameters"
    results = bench.call(name, "rcl_interfaces/srv/SetParameters", parameters=[parameter]).results
    assert results[0].successful
    out.publish(_JOY(axes=[1.0]))
    bench.eventually(lambda: len(got) > 1)
    assert got[1].twist.linear.x == 0.25
