from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

from gazelle.errors import NotFoundError
from gazelle.interfaces import known_types, message_type
from gazelle.interfaces.definition import Array, FieldType


def test_both_spellings_give_one_class():
    assert message_type("sensor_msgs/LaserScan") is message_type("sensor_msgs/msg/LaserScan")
    assert message_type("sensor_msgs/LaserScan").TYPE_NAME == "sensor_msgs/msg/LaserScan"


def test_defaults_are_zero_empty_and_nested_and_never_shared():
    joint_state = message_type("sensor_msgs/JointState")
    one, two = joint_state(), joint_state()
    assert one == two
    one.name.append("wheel")
    one.header.frame_id = "base"
    assert (two.name, two.header.frame_id) == ([], "")
    assert one.position.dtype == np.float64
    imu = message_type("sensor_msgs/Imu")
    imu().orientation_covariance[0] = 1.0
    assert imu().orientation_covariance[0] == 0.0


def test_defaults_of_ros2_definitions_hold():
    assert message_type("geometry_msgs/Quaternion")().w == 1.0


def test_constants_are_class_attributes():
    assert message_type("sensor_msgs/PointField").FLOAT32 == 7
    assert message_type("rcl_interfaces/Log").INFO == 20


def test_unknown_fields_are_refused():
    twist = message_type("geometry_msgs/Twist")
    with pytest.raises(TypeError, match="linaer"):
        twist(linaer=None)
    with pytest.raises(AttributeError, match="linaer"):
        twist().linaer = 1


def test_equality_knows_arrays_lists_and_bytes():
    image = message_type("sensor_msgs/Image")
    assert image(data=b"\1\2") == image(data=np.array([1, 2], np.uint8))
    assert image(data=b"\1\2") != image(data=np.array([1, 3], np.uint8))
    scan = message_type("sensor_msgs/LaserScan")
    assert scan(ranges=[1.0]) == scan(ranges=np.array([1.0], np.float32))
    assert scan() != image()


def test_repr_names_type_and_values():
    vector = message_type("geometry_msgs/Vector3")(1.0, 2.0)
    assert repr(vector) == "geometry_msgs.msg.Vector3(x=1.0, y=2.0, z=0.0)"
    cloud = message_type("sensor_msgs/PointCloud2")(data=np.zeros(99, np.uint8))
    assert "data=<99 × uint8>" in repr(cloud)


def test_copies_and_pickles_are_equal_and_separate():
    scan = message_type("sensor_msgs/LaserScan")(ranges=np.ones(3, np.float32))
    for twin in (copy.deepcopy(scan), pickle.loads(pickle.dumps(scan))):
        assert twin == scan
        twin.ranges[0] = 5.0
        assert twin != scan


def test_field_types_are_listed_as_rclpy_does():
    found = message_type("sensor_msgs/Imu").get_fields_and_field_types()
    assert found["header"] == "std_msgs/Header"
    assert found["orientation_covariance"] == "double[9]"
    found = message_type("rcl_interfaces/ParameterDescriptor").get_fields_and_field_types()
    assert found["read_only"] == "boolean"
    assert found["integer_range"] == "sequence<rcl_interfaces/IntegerRange, 1>"
    found = message_type("rcl_interfaces/ParameterValue").get_fields_and_field_types()
    assert found["byte_array_value"] == "sequence<octet>"
    assert FieldType("string", Array.SEQUENCE, 5, 10).idl == "sequence<string<10>, 5>"


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("sensor_msgs/LaserScam", "message type 'sensor_msgs/LaserScam' not found; did you mean"),
        ("my_msgs/LaserScan", "did you mean 'sensor_msgs/msg/LaserScan'"),
        ("LaserScan", "a type is written package/Name"),
        ("a/b/c", "a type is written package/Name"),
        ("../etc/passwd", "not found"),
    ],
)
def test_unknown_types_say_what_is_near(name, text):
    with pytest.raises(NotFoundError, match=text):
        message_type(name)


def test_every_shipped_message_can_be_made(every_message):
    for name in every_message:
        assert message_type(name)() == message_type(name)()
    assert len(known_types()) > 350
