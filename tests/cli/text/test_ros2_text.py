"""ROS 2 messages as YAML, comma-separated values and Python's repr."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.cli.text.ros2_text import (
    Shortening,
    message_csv,
    message_repr,
    message_yaml,
    value_text,
)
from gazelle.interfaces import FieldType, Message, fill, message_type
from gazelle.interfaces.definition import Array


def _message(kind: str, **values: Any) -> Message:
    made = message_type(kind)()
    fill(made, values)
    return made


def test_yaml_has_the_fields_in_order_and_the_header_of_ros2() -> None:
    joints = _message(
        "sensor_msgs/msg/JointState",
        header={"stamp": {"sec": 3, "nanosec": 5}, "frame_id": "base"},
        name=["a", "b"],
        position=[0.5, 1e-7],
    )
    assert message_yaml(joints) == (
        "header:\n  stamp:\n    sec: 3\n    nanosec: 5\n  frame_id: base\nname:\n- a\n- b\n"
        "position:\n- 0.5\n- 1.0e-07\nvelocity: []\neffort: []\n"
    )


def test_flow_style_is_that_of_lists() -> None:
    joints = _message("sensor_msgs/msg/JointState", name=["a", "b"], position=[0.5, 1.0])
    assert message_yaml(joints, flow_style=True) == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"
        "name: [a, b]\nposition: [0.5, 1.0]\nvelocity: []\neffort: []\n"
    )
    points = _message("geometry_msgs/msg/Polygon", points=[{"x": 1.0}])
    assert message_yaml(points, flow_style=True) == "points: [{x: 1.0, y: 0.0, z: 0.0}]\n"


@pytest.mark.parametrize("text", ["\U0001f98c", "a\x85b", "ü: a", "\0", "a\nb", "x" * 300])
def test_texts_look_as_pyyaml_writes_them(text: str) -> None:
    import sys

    import yaml

    wanted = yaml.dump({"data": text}, allow_unicode=True, width=sys.maxsize)
    assert message_yaml(_message("std_msgs/msg/String", data=text)) == wanted


def test_long_values_are_cut_and_noted() -> None:
    scan = _message("sensor_msgs/msg/LaserScan", ranges=[1.0, 2.0, 3.0])
    scan.header.frame_id = "laser"
    assert "frame_id: la...\n" in message_yaml(scan, Shortening(2))
    assert "ranges:\n- 1.0\n- 2.0\n- '...'\nintens" in message_yaml(scan, Shortening(2))
    noted = message_yaml(scan, Shortening(None, no_arrays=True, no_strings=True))
    assert "frame_id: '<string length: <5>>'\n" in noted
    assert "ranges: '<sequence type: float, length: 3>'\n" in noted
    imu = message_yaml(_message("sensor_msgs/msg/Imu"), Shortening(None, no_arrays=True))
    assert "orientation_covariance: '<array type: double[9]>'\n" in imu


def test_bytes_are_characters_in_yaml_and_bytes_in_csv() -> None:
    status = _message("diagnostic_msgs/msg/DiagnosticStatus", level=2, name="motor")
    assert message_yaml(status).startswith('level: "\\x02"\nname: motor\n')
    assert message_csv(status) == "b'\\x02',motor,,,"


def test_csv_has_no_comma_behind_empty_values_in_front() -> None:
    assert message_csv(_message("diagnostic_msgs/msg/KeyValue", value="5")) == "5"
    path = _message("sensor_msgs/msg/JointState", position=[1.0, 2.0, 3.0])
    assert message_csv(path, Shortening(2)) == "0,0,,,1.0,2.0,...,,"
    assert "<sequence type: double, length: 3>" in message_csv(path, Shortening(None, True))


def test_repr_is_that_of_generated_messages() -> None:
    assert message_repr(_message("geometry_msgs/msg/Twist", linear={"x": 0.5})) == (
        "geometry_msgs.msg.Twist(linear=geometry_msgs.msg.Vector3(x=0.5, y=0.0, z=0.0), "
        "angular=geometry_msgs.msg.Vector3(x=0.0, y=0.0, z=0.0))"
    )
    image = _message("sensor_msgs/msg/CompressedImage", data=[1, 2], format="png")
    assert message_repr(image).endswith("format='png', data=[1, 2])")
    covariance = message_repr(_message("geometry_msgs/msg/PoseWithCovariance"))
    assert "covariance=array([0., 0., 0.," in covariance
    array = _message("diagnostic_msgs/msg/DiagnosticArray", status=[{"level": 1}])
    assert "status=[diagnostic_msgs.msg.DiagnosticStatus(level=b'\\x01', name=''" in (
        message_repr(array)
    )


def test_single_values_look_as_python_prints_them() -> None:
    floats = FieldType("float32", Array.SEQUENCE)
    assert value_text([1.0, 2.0], floats) == "array('f', [1.0, 2.0])"
    assert value_text([], floats) == "array('f')"
    assert value_text([0.0, 0.0], FieldType("float64", Array.FIXED, 2)) == "[0. 0.]"
    assert value_text("hi", FieldType("string")) == "hi"
    assert value_text(["hi"], FieldType("string", Array.SEQUENCE)) == "['hi']"
    assert value_text(5, FieldType("int32")) == "5"
