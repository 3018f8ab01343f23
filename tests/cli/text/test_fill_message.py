"""Messages from the YAML of ROS 2's command line."""

from __future__ import annotations

import pytest

from gazelle.cli.ros_tool import ToolError
from gazelle.cli.text.fill_message import filled, yaml_values
from gazelle.interfaces import message_type


def test_values_become_what_the_field_is() -> None:
    assert filled(message_type("std_msgs/msg/String"), {"data": 5}, 0).data == "5"
    assert filled(message_type("std_msgs/msg/Float64"), {"data": "1e-3"}, 0).data == 0.001
    assert filled(message_type("std_msgs/msg/Int32"), {"data": 2.7}, 0).data == 2
    assert filled(message_type("std_msgs/msg/Bool"), {"data": 1}, 0).data is True
    joints = filled(message_type("sensor_msgs/msg/JointState"), yaml_values("position: [1]"), 0)
    assert list(joints.position) == [1.0]


def test_auto_is_a_header_of_now_and_now_a_time() -> None:
    kind = message_type("sensor_msgs/msg/JointState")
    assert filled(kind, {"header": "auto"}, 3_000_000_005).header.stamp.nanosec == 5
    header = filled(kind, {"header": {"stamp": "now", "frame_id": "a"}}, 7_000_000_000).header
    assert (header.stamp.sec, header.frame_id) == (7, "a")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("data:5", "needs to be a dictionary in YAML format"),
        ("[1, 2]", "needs to be a dictionary in YAML format"),
        ("{linear: {x: 1}", "are not YAML"),
    ],
)
def test_what_is_no_dictionary_is_told(text: str, words: str) -> None:
    with pytest.raises(ToolError, match=words):
        yaml_values(text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{linera: {x: 1}}", "no field 'linera'; did you mean 'linear'"),
        ("{linear: {x: fast}}", "field 'linear.x' is a float64: could not convert string"),
        ("{linear: 5}", "Failed to populate field: "),
        ("{linear: {x: [1]}}", "Failed to populate field: "),
    ],
)
def test_wrong_values_are_told(text: str, words: str) -> None:
    with pytest.raises(ToolError, match=words):
        filled(message_type("geometry_msgs/msg/Twist"), yaml_values(text), 0)


def test_item_at_fault_is_named_and_words_are_no_truth() -> None:
    polygon = message_type("geometry_msgs/msg/Polygon")
    with pytest.raises(ToolError, match=r"field 'points\[1\]\.z' is a float32: could not"):
        filled(polygon, yaml_values("points: [{x: 1}, {z: b}]"), 0)
    words = "'maybe' is not true or false .ROS 2 would take it for True"
    with pytest.raises(ToolError, match=words):
        filled(message_type("std_msgs/msg/Bool"), {"data": "maybe"}, 0)
