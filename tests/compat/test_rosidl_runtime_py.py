"""rosidl_runtime_py: messages as text, and types by name."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.compat import rosidl_runtime_py
from gazelle.interfaces import message_type


def _pose() -> Any:
    message: Any = message_type("geometry_msgs/PoseStamped")()
    message.header.frame_id = "map"
    message.pose.position.x = 1.5
    return message


def test_message_becomes_yaml_that_sets_another() -> None:
    text = rosidl_runtime_py.message_to_yaml(_pose())
    assert text.startswith(
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: map\npose:\n"
    )
    import yaml

    other = type(_pose())()
    assert rosidl_runtime_py.set_message_fields(other, yaml.safe_load(text)) == []
    assert other == _pose()
    assert rosidl_runtime_py.message_to_csv(_pose().pose.position) == "1.5,0.0,0.0"
    point = _pose().pose.position
    assert rosidl_runtime_py.message_to_yaml(point, flow_style=True) == "{x: 1.5, y: 0.0, z: 0.0}\n"
    with pytest.raises(Exception, match="framed_id"):
        rosidl_runtime_py.set_message_fields(other, {"header": {"framed_id": "x"}})


def test_long_values_are_cut_or_left_out() -> None:
    state: Any = message_type("sensor_msgs/JointState")(name=["elbow", "b"], position=[1.0] * 9)
    found = rosidl_runtime_py.message_to_ordereddict(state, truncate_length=2)
    assert found["name"] == ["el...", "b"] and found["position"] == [1.0, 1.0, "..."]
    assert found["velocity"] == []
    short = rosidl_runtime_py.message_to_ordereddict(state, no_arr=True, no_str=True)
    assert short["position"] == "<sequence<double>, length: 9>"
    covariance: Any = message_type("geometry_msgs/PoseWithCovariance")()
    shown = rosidl_runtime_py.message_to_ordereddict(covariance, no_arr=True)
    assert shown["covariance"] == "<double[36], length: 36>"
    assert short["header"]["frame_id"] == "<string length: <0>>"


def test_types_are_found_by_name() -> None:
    assert rosidl_runtime_py.get_message("std_msgs/msg/String") is message_type("std_msgs/String")
    assert rosidl_runtime_py.is_service(rosidl_runtime_py.get_service("std_srvs/srv/Trigger"))
    assert rosidl_runtime_py.is_action(
        rosidl_runtime_py.get_action("example_interfaces/action/Fibonacci")
    )
    assert rosidl_runtime_py.is_message(rosidl_runtime_py.get_interface("std_msgs/msg/Header"))
    assert "msg/String" in rosidl_runtime_py.get_interfaces(["std_msgs"])["std_msgs"]
    assert rosidl_runtime_py.get_service_interfaces(["std_srvs"])["std_srvs"][0].startswith("srv/")
    assert "std_msgs" in rosidl_runtime_py.get_interface_packages()
    with pytest.raises(ValueError, match=r"got 'String'; write it as package/msg/Name"):
        rosidl_runtime_py.get_message("String")
    with pytest.raises(ValueError, match="'std_msgs/msg/String': no srv"):
        rosidl_runtime_py.get_service("std_msgs/msg/String")
    with pytest.raises(Exception, match="Strng"):
        rosidl_runtime_py.get_message("std_msgs/msg/Strng")
