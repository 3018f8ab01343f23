from __future__ import annotations

import pytest

from gazelle.interfaces import (
    md5sum,
    ros1_definition,
    ros1_service_type,
    show_message,
    show_service,
)

MESSAGES = {
    "std_msgs/Header": "2176decaecbce78abc3b96ef049fabed",
    "geometry_msgs/Twist": "9f195f881246fdfa2798d1d3eebca84a",
    "sensor_msgs/Image": "060021388200f6f0f447d0fcd9c64743",
    "nav_msgs/Odometry": "cd5e73d190d741a2f92e81eda573aca7",
    "tf2_msgs/TFMessage": "94810edda583a504dfda3829e70d7eec",
    "tf/tfMessage": "94810edda583a504dfda3829e70d7eec",
    "rosgraph_msgs/Log": "acffd30cd6b6de30f120938c17c593fb",
    "rosgraph_msgs/Clock": "a9c97c1d230cfc112e270351a944ee47",
    "move_base_msgs/MoveBaseAction": "70b6aca7c7f7746d8d1609ad94c80bb8",
    "gazebo_msgs/ModelStates": "48c080191eb15c41858319b4d8a609c2",
    "theora_image_transport/Packet": "33ac4e14a7cff32e7e0d65f18bb410f3",
    "dynamic_reconfigure/Config": "958f16a05573709014982821e6822580",
}
SERVICES = {
    "std_srvs/SetBool": "09fb03525b03e7ea1fd3992bafd87e16",
    "std_srvs/Empty": "d41d8cd98f00b204e9800998ecf8427e",
    "rospy_tutorials/AddTwoInts": "6a2e34150c00229791cc89ff309fff21",
    "nav_msgs/GetMap": "6cdd0a18e0aff5b0a3ca2326a89b54ff",
    "roscpp/SetLoggerLevel": "51da076440d78ca1684d36c868df61ea",
    "turtlesim/Spawn": "0b2d2e872a8e2887d5ed626f2bf2c561",
}


@pytest.mark.parametrize(("name", "digest"), MESSAGES.items())
def test_message_sums_are_those_of_ros(name, digest):
    assert md5sum(name) == digest


@pytest.mark.parametrize(("name", "digest"), SERVICES.items())
def test_service_sums_are_those_of_ros(name, digest):
    assert ros1_service_type(name)._md5sum == digest


def test_parts_of_services_have_sums_of_their_own():
    assert ros1_service_type("gazebo_msgs/SpawnModel")._request_class._md5sum == (
        "6d0eba5753761cd57e6263a056b79930"
    )
    assert ros1_service_type("gazebo_msgs/GetModelState")._response_class._md5sum == (
        "ccd51739bb00f0141629e87b792e92b9"
    )


def test_full_text_lists_each_contained_message_once():
    text = ros1_definition("geometry_msgs/TwistStamped")
    assert text.count("MSG: geometry_msgs/Vector3\n") == 1
    order = [line for line in text.splitlines() if line.startswith("MSG:")]
    assert order == [
        "MSG: std_msgs/Header",
        "MSG: geometry_msgs/Twist",
        "MSG: geometry_msgs/Vector3",
    ]


def test_show_puts_constants_first_and_indents():
    assert show_message("sensor_msgs/NavSatStatus").splitlines()[0] == "int8 STATUS_NO_FIX=-1"
    assert "  float64 x\n" in show_message("geometry_msgs/Twist")
    assert show_service("std_srvs/Trigger") == "---\nbool success\nstring message\n"
