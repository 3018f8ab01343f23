from __future__ import annotations

import numpy as np
import pytest

from gazelle.errors import InterfaceError
from gazelle.interfaces import (
    RosVersion,
    convert,
    fill,
    message_type,
    ros1_message_type,
    strify,
    time_keys,
    to_plain,
)

FORMS = pytest.mark.parametrize("form", [message_type, ros1_message_type])


@FORMS
def test_dict_sets_some_fields_and_list_sets_all(form):
    twist = form("geometry_msgs/Twist")()
    fill(twist, {"linear": {"x": 1}, "angular": [0, 0, 2]})
    assert to_plain(twist) == {
        "linear": {"x": 1.0, "y": 0.0, "z": 0.0},
        "angular": {"x": 0.0, "y": 0.0, "z": 2.0},
    }
    assert type(twist.linear.x) is float
    fill(twist, [[1, 2, 3], [4, 5, 6]])
    assert twist.angular.z == 6.0


@FORMS
def test_list_of_one_dict_is_the_dict_and_none_is_no_fields(form):
    text = form("std_msgs/String")()
    fill(text, [{"data": "hi"}])
    assert text.data == "hi"
    fill(form("std_msgs/Empty")(), None)


@FORMS
def test_every_message_comes_back_from_its_plain_form(form, make_message):
    for name in ("sensor_msgs/msg/JointState", "nav_msgs/msg/Path", "sensor_msgs/msg/CameraInfo"):
        ros_version = form(name).GENERATION
        message = make_message(name, ros_version, 4)
        twin = form(name)()
        fill(twin, to_plain(message))
        assert twin == message


def test_now_and_auto_stand_for_times_and_headers():
    for form in (message_type, ros1_message_type):
        pose = form("geometry_msgs/PoseStamped")()
        keys = time_keys(12_000_000_005, pose.GENERATION)
        fill(pose, {"header": "auto"}, keys=keys)
        other = form("geometry_msgs/PoseStamped")()
        fill(other, {"header": {"stamp": "now", "frame_id": "map"}}, keys=keys)
        assert other.header.stamp == pose.header.stamp
        assert other.header.stamp is not keys["now"]
    assert (other.header.stamp.secs, other.header.stamp.nsecs) == (12, 5)


def test_times_may_be_nanoseconds_parts_or_pairs():
    header = ros1_message_type("std_msgs/Header")()
    for value in (1_500_000_000, {"secs": 1, "nsecs": 500_000_000}, [1, 500_000_000]):
        fill(header, {"stamp": value})
        assert header.stamp.to_nsec() == 1_500_000_000
    other = message_type("std_msgs/Header")()
    fill(other, {"stamp": 1_500_000_000})
    assert (other.stamp.sec, other.stamp.nanosec) == (1, 500_000_000)


@FORMS
def test_lists_of_messages_are_made(form):
    path = form("nav_msgs/Path")()
    fill(path, {"poses": [{"pose": {"position": {"x": 1}}}, {}]})
    assert [pose.pose.position.x for pose in path.poses] == [1.0, 0.0]


@FORMS
@pytest.mark.parametrize(
    ("name", "values", "text"),
    [
        (
            "geometry_msgs/Twist",
            {"linear": {"q": 1}},
            r"has no field 'q'.*No field name \[linear.q\]",
        ),
        ("geometry_msgs/Twist", {"linaer": {}}, "did you mean 'linear'"),
        ("geometry_msgs/Twist", [1], "has 2 fields, 1 values are given .ROS: Not enough arguments"),
        ("geometry_msgs/Twist", [1, 2, 3], "Too many arguments"),
        ("geometry_msgs/Twist", {"linear": {"x": "abc"}}, "'linear.x' must be a number"),
        ("geometry_msgs/Twist", {"linear": 5}, "takes a list or a dictionary of its fields"),
        ("std_msgs/Header", {"stamp": "soon"}, r"No key named \[soon\]"),
        ("std_msgs/UInt8", {"data": -1}, "outside of uint8's range"),
        ("sensor_msgs/JointState", {"name": "a"}, "'name' must be a list"),
        ("sensor_msgs/Imu", {"orientation_covariance": [1]}, "has 9 items, got 1"),
        ("sensor_msgs/LaserScan", {"ranges": [1, "x"]}, r"'ranges\[1\]' must be a number"),
    ],
)
def test_bad_values_are_one_clear_error(form, name, values, text):
    with pytest.raises(InterfaceError, match=text):
        fill(form(name)(), values)


@pytest.mark.parametrize("value", [1.5, {"sec": 1}, [1]])
def test_bad_ros1_times_are_explained(value):
    with pytest.raises(InterfaceError, match="field 'stamp' is a time"):
        fill(ros1_message_type("std_msgs/Header")(), {"stamp": value})


def test_strify_follows_genpy():
    scan = ros1_message_type("sensor_msgs/LaserScan")(ranges=np.array([1.0, 2.0]))
    assert "ranges: [1.0, 2.0]" in strify(scan)
    image = convert(
        message_type("sensor_msgs/Image")(data=[1, 2]), ros1_message_type("sensor_msgs/Image")
    )
    assert strify(image).endswith("data: [1, 2]")
    shown = strify(scan, field_filter=lambda message: ["range_min"], width=3)
    assert shown == "range_min: 0.0"
    flag = ros1_message_type("std_msgs/Bool")(data=True)
    assert strify(flag) == "data: True"
    assert RosVersion.ROS1 is scan.GENERATION
