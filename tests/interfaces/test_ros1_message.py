from __future__ import annotations

import copy
import io
import pickle

import numpy as np
import pytest

from gazelle.interfaces import AnyMsg, Time, ros1_message_type, to_ros1


def test_genpy_attributes_are_there():
    joint_state = ros1_message_type("sensor_msgs/JointState")
    assert joint_state._type == "sensor_msgs/JointState"
    assert joint_state._md5sum == "3066dcd76a6cfaef579bd0f34173e9fd"
    assert joint_state.__slots__ == ["header", "name", "position", "velocity", "effort"]
    assert joint_state._slot_types[:3] == ["std_msgs/Header", "string[]", "float64[]"]
    assert joint_state._has_header
    assert not ros1_message_type("std_msgs/String")._has_header
    rule = "=" * 80
    # A ROS that is installed adds its comments.
    own, header = joint_state._full_text.split(f"\n{rule}\nMSG: std_msgs/Header\n")
    assert "Header header" in own and "\nstring[] name\n" in own
    assert "\ntime stamp\n" in f"\n{header}"


def test_header_may_be_named_alone():
    assert ros1_message_type("Header") is ros1_message_type("std_msgs/Header")


def test_constructor_takes_all_by_place_or_some_by_name():
    vector = ros1_message_type("geometry_msgs/Vector3")
    assert vector(1.0, 2.0, 3.0).z == 3.0
    assert vector(y=2.0).x == 0.0
    assert ros1_message_type("geometry_msgs/Twist")(linear=None).linear == vector()
    with pytest.raises(TypeError, match=r"args should be \['x', 'y', 'z'\] args are\(1,\)"):
        vector(1)
    with pytest.raises(TypeError, match="may only use args OR keywords, not both"):
        vector(1, y=2)
    with pytest.raises(AttributeError, match="q is not an attribute of Vector3"):
        vector(q=1)


def test_defaults_follow_genpy():
    image = ros1_message_type("sensor_msgs/Image")()
    assert image.data == b""
    info = ros1_message_type("sensor_msgs/CameraInfo")()
    assert (info.D, info.K) == ([], [0.0] * 9)
    assert isinstance(info.header.stamp, Time)
    assert ros1_message_type("geometry_msgs/Quaternion")().w == 0.0


def test_serialize_and_deserialize_as_rospy_calls_them():
    cls = ros1_message_type("sensor_msgs/LaserScan")
    scan = cls(ranges=[1.0, 2.0])
    scan.header.stamp = Time(3, 4)
    buffer = io.BytesIO()
    scan.serialize(buffer)
    back = cls()
    assert back.deserialize(buffer.getvalue()) is back
    assert back == scan
    assert back.ranges == (1.0, 2.0)
    back.deserialize_numpy(buffer.getvalue(), np)
    assert back.ranges.dtype == np.float32


def test_any_message_keeps_bytes():
    message = AnyMsg().deserialize(b"abc")
    buffer = io.BytesIO()
    message.serialize(buffer)
    assert buffer.getvalue() == to_ros1(message) == b"abc"
    assert ros1_message_type("*")._md5sum == "*"
    with pytest.raises(ValueError, match="no bytes yet"):
        AnyMsg().serialize(buffer)
    with pytest.raises(TypeError, match="does not accept arguments"):
        AnyMsg(1)


def test_print_shows_the_yaml_like_text():
    goal = ros1_message_type("actionlib_msgs/GoalStatusArray")()
    status = ros1_message_type("actionlib_msgs/GoalStatus")(status=1, text="on")
    goal.status_list.append(status)
    assert str(goal) == (
        "header: \n  seq: 0\n  stamp: \n    secs: 0\n    nsecs:         0\n  frame_id: ''\n"
        "status_list: \n  - \n    goal_id: \n      stamp: \n        secs: 0\n"
        "        nsecs:         0\n      id: ''\n    status: 1\n    text: \"on\""
    )


def test_actions_become_seven_messages():
    names = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")
    for name in names:
        cls = ros1_message_type(f"actionlib_tutorials/Fibonacci{name}")
        assert cls._type == f"actionlib_tutorials/Fibonacci{name}"
    goal = ros1_message_type("actionlib_tutorials/FibonacciActionGoal")()
    assert goal.goal.order == 0
    assert goal._slot_types[1] == "actionlib_msgs/GoalID"
    assert ros1_message_type("actionlib_tutorials/FibonacciAction")._md5sum == (
        "f59df5767bf7634684781c92598b2406"
    )


def test_ros2_types_have_a_ros1_form():
    log = ros1_message_type("action_msgs/GoalInfo")()
    assert log._slot_types == ["unique_identifier_msgs/UUID", "time"]
    assert log.goal_id.uuid == bytes(16)


def test_copies_and_pickles_are_equal():
    path = ros1_message_type("nav_msgs/Path")()
    path.poses.append(ros1_message_type("geometry_msgs/PoseStamped")())
    for twin in (copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
        assert twin == path
        twin.poses[0].pose.position.x = 1.0
        assert twin != path
