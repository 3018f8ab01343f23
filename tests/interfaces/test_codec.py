from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.sets import few, part

from gazelle.errors import InterfaceError
from gazelle.interfaces import (
    RosVersion,
    convert,
    from_cdr,
    from_ros1,
    message_type,
    ros1_message_type,
    to_cdr,
    to_ros1,
)

NOT_CONVERTIBLE = "controller_manager_msgs/srv/SwitchController_Request"
RELAXED = settings(
    max_examples=few(100, 300),
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@RELAXED
@given(data=st.data())
def test_any_message_survives_both_wires(data, every_message, make_message):
    name = data.draw(st.sampled_from(every_message))
    ros_version = data.draw(st.sampled_from(RosVersion))
    message = make_message(name, ros_version, data.draw(st.integers(0, 10**6)))
    _round_trip(message)


@pytest.mark.parametrize("ros_version", RosVersion)
def test_every_shipped_message_survives_both_wires(ros_version, every_message, make_message):
    for name in part(every_message, 250):
        _round_trip(make_message(name, ros_version, 7))


def _round_trip(message):
    cls, name = type(message), message.TYPE_NAME
    data = to_cdr(message)
    back = from_cdr(cls, data)
    assert to_cdr(back) == data, name
    if cls.GENERATION is RosVersion.ROS2:
        assert back == message, name
    if name != NOT_CONVERTIBLE:
        data = to_ros1(message)
        back = from_ros1(cls, data)
        assert to_ros1(back) == data, name
        assert cls.GENERATION is RosVersion.ROS2 or back == message, name


def test_ros1_view_writes_the_bytes_of_the_canonical_type(make_message):
    for name in ("LaserScan", "CameraInfo", "JointState", "PointCloud2", "Imu", "Image"):
        message = make_message(f"sensor_msgs/msg/{name}", RosVersion.ROS2, 3)
        view = convert(message, ros1_message_type(f"sensor_msgs/{name}"))
        assert to_cdr(view) == to_cdr(message)
        assert convert(view, type(message)) == message


def test_camera_info_letters_and_time_words_map():
    view = ros1_message_type("sensor_msgs/CameraInfo")(D=[1.0, 2.0], K=list(range(9)))
    view.header.stamp.secs, view.header.stamp.nsecs = 5, 6
    info = convert(view, message_type("sensor_msgs/CameraInfo"))
    assert info.d.tolist() == [1.0, 2.0]
    assert info.k.tolist() == list(range(9))
    assert (info.header.stamp.sec, info.header.stamp.nanosec) == (5, 6)


def test_joint_properties_map_over_case_and_underscore():
    view = ros1_message_type("gazebo_msgs/ODEJointProperties")(hiStop=[1.0], loStop=[2.0])
    other = convert(view, message_type("gazebo_msgs/ODEJointProperties"))
    assert (other.hi_stop.tolist(), other.lo_stop.tolist()) == ([1.0], [2.0])


def test_controller_state_maps_desired_and_actual():
    view = ros1_message_type("control_msgs/JointTrajectoryControllerState")()
    view.desired.positions, view.actual.positions = [1.0], [2.0]
    other = convert(view, message_type("control_msgs/JointTrajectoryControllerState"))
    assert other.reference.positions.tolist() == [1.0]
    assert other.feedback.positions.tolist() == [2.0]


def test_ros1_log_travels_as_rcl_interfaces_log():
    view = ros1_message_type("rosgraph_msgs/Log")(level=4, name="/n", msg="hi", topics=["/t"])
    view.header.stamp.secs = 9
    log = from_cdr(message_type("rcl_interfaces/Log"), to_cdr(view))
    assert (log.level, log.stamp.sec, log.name, log.msg) == (30, 9, "/n", "hi")
    back = from_cdr(type(view), to_cdr(log))
    assert (back.level, back.header.stamp.secs, back.topics) == (4, 9, [])


def test_header_seq_is_zero_after_the_wire():
    view = ros1_message_type("std_msgs/Header")(seq=7, frame_id="map")
    assert from_cdr(type(view), to_cdr(view)).seq == 0
    assert from_ros1(type(view), to_ros1(view)).seq == 7


def test_numeric_arrays_are_read_only_views_of_the_bytes():
    image = message_type("sensor_msgs/Image")(data=np.arange(200, dtype=np.uint8))
    data = bytearray(to_cdr(image))
    read = from_cdr(type(image), data)
    assert not read.data.flags.writeable
    assert np.shares_memory(read.data, np.frombuffer(data, np.uint8))
    with pytest.raises(ValueError, match="read-only"):
        read.data[0] = 1


def test_lists_tuples_bytes_and_other_arrays_may_be_assigned():
    scan_type = message_type("sensor_msgs/LaserScan")
    expected = to_cdr(scan_type(ranges=np.array([1, 2], np.float32)))
    for ranges in ([1.0, 2], (1, 2), np.array([1, 2]), np.array([1.0, 9, 2])[::2], range(1, 3)):
        assert to_cdr(scan_type(ranges=ranges)) == expected
    image_type = message_type("sensor_msgs/Image")
    for data in (b"\1\2", bytearray(b"\1\2"), [1, 2], np.array([1, 2]), np.array([[1], [2]], "u1")):
        assert to_cdr(image_type(data=data)) == to_cdr(image_type(data=np.array([1, 2], "u1")))


def test_big_arrays_that_are_not_in_one_piece_are_written_right():
    wide = np.arange(8000, dtype=np.uint8).reshape(80, 100)
    image_type = message_type("sensor_msgs/Image")
    read = from_cdr(image_type, to_cdr(image_type(data=wide[:, ::2])))
    assert read.data.tolist() == wide[:, ::2].ravel().tolist()


def test_byte_takes_one_byte_of_bytes():
    status = message_type("diagnostic_msgs/DiagnosticStatus")
    assert to_cdr(status(level=b"\2")) == to_cdr(status(level=2))


def test_empty_message_is_one_byte_of_cdr_and_none_of_ros1():
    empty = message_type("std_msgs/Empty")()
    assert to_cdr(empty) == b"\0\1\0\0\0"
    assert to_ros1(empty) == b""


def test_big_endian_cdr_is_read():
    data = b"\0\0\0\0" + b"\0\0\0\3" + b"ab\0"
    assert from_cdr(message_type("std_msgs/String"), data).data == "ab"


@pytest.mark.parametrize(
    ("name", "values", "text"),
    [
        (
            "geometry_msgs/Twist",
            {"linear": 3},
            "'linear' must be a geometry_msgs/msg/Vector3, is int 3",
        ),
        ("geometry_msgs/Vector3", {"x": "1"}, "field 'x' must be a number (float64), is str '1'"),
        ("std_msgs/UInt8", {"data": 300}, "field 'data' is 300, outside of uint8's range 0…255"),
        (
            "std_msgs/Int32",
            {"data": 1.5},
            "field 'data' must be a whole number (int32), is float 1.5",
        ),
        ("std_msgs/String", {"data": 5}, "field 'data' must be a string (str), is int 5"),
        ("sensor_msgs/LaserScan", {"ranges": [1.0, "x"]}, "field 'ranges[1]' must be a number"),
        (
            "sensor_msgs/LaserScan",
            {"ranges": None},
            "'ranges' must be a sequence of numbers, is None",
        ),
        (
            "sensor_msgs/Imu",
            {"orientation_covariance": [0.0]},
            "'orientation_covariance' has 9 items, got 1",
        ),
        ("std_msgs/Float32", {"data": 1e300}, "too large for float32"),
    ],
)
@pytest.mark.parametrize("write", [to_cdr, to_ros1])
@pytest.mark.parametrize("form", [message_type, ros1_message_type])
def test_a_wrong_value_is_named_with_its_field(form, write, name, values, text):
    message = form(name)()
    for field, value in values.items():
        setattr(message, field, value)
    with pytest.raises(InterfaceError) as error:
        write(message)
    assert text in str(error.value)


def test_bounds_of_sequences_hold():
    box = message_type("shape_msgs/SolidPrimitive")(dimensions=[1.0] * 4)
    with pytest.raises(InterfaceError, match="'dimensions' takes at most 3 items, has 4"):
        to_cdr(box)


@pytest.mark.parametrize("form", [message_type, ros1_message_type])
def test_bytes_cut_short_are_an_error_everywhere(form, make_message):
    for name in ("sensor_msgs/msg/JointState", "tf2_msgs/msg/TFMessage", "std_msgs/msg/String"):
        cls = form(name)
        message = make_message(name, cls.GENERATION, 5)
        data = to_cdr(message)
        for length in range(len(data)):
            with pytest.raises(InterfaceError, match="bytes are not a"):
                from_cdr(cls, data[:length])


def test_a_count_beyond_the_bytes_is_an_error_not_a_hang():
    with pytest.raises(InterfaceError, match="bytes are not a tf2_msgs/msg/TFMessage"):
        from_cdr(message_type("tf2_msgs/TFMessage"), b"\0\1\0\0\xff\xff\xff\xff" + bytes(64))


def test_other_encapsulations_are_refused():
    with pytest.raises(InterfaceError, match="encapsulation 00 03 is not plain CDR"):
        from_cdr(message_type("std_msgs/String"), b"\0\3\0\0" + bytes(8))


def test_what_is_no_message_is_refused():
    with pytest.raises(InterfaceError, match="str is not a message class"):
        to_cdr("hello")
