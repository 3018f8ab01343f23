"""Names, sums, definitions and texts of messages in C++ are those that Python and ROS have."""

from __future__ import annotations

import pytest
from tests.cpp.interfaces.message_probe import MessageProbe, own_types

from gazelle.errors import GazelleError
from gazelle.interfaces import RosVersion, Time, full_definition_text, to_cdr, wire_type

TYPES = own_types()


@pytest.fixture
def nothing_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Definitions with comments that this machine has by chance are not looked at."""
    monkeypatch.setattr(full_definition_text, "installed_texts", lambda *_: iter(()))


@pytest.mark.usefixtures("nothing_installed")
def test_definitions_are_pythons(ros1_probe: MessageProbe, ros2_probe: MessageProbe) -> None:
    types = own_types()
    for name in ros1_probe.names:
        if "/msg/" in name:
            assert ros1_probe.definition(name) == types.ros1_definition(name), name
    for name in ros2_probe.names:
        if "/msg/" in name:
            assert ros2_probe.definition(name) == types.ros2_definition(name), name


def test_names_and_sums_are_pythons(ros1_probe: MessageProbe, ros2_probe: MessageProbe) -> None:
    for name in ros2_probe.names:
        full, _, md5, type_hash = ros2_probe.sums(name)
        assert (full, type_hash) == (name, TYPES.type_hash(name)), name
        try:
            assert md5 == TYPES.md5sum(name)
        except GazelleError:
            assert md5 == ""
    for name in ros1_probe.names:
        full, _, md5, _ = ros1_probe.sums(name)
        assert (full, md5) == (wire_type(name), TYPES.md5sum(name)), name


def test_ros1_has_its_own_names(ros1_probe: MessageProbe) -> None:
    assert ros1_probe.sums("rosgraph_msgs/msg/Log")[:2] == (
        "rcl_interfaces/msg/Log",
        "rosgraph_msgs/Log",
    )
    assert ros1_probe.sums("std_srvs/srv/SetBool_Request")[1] == "std_srvs/SetBoolRequest"
    assert ros1_probe.sums("std_msgs/msg/String")[2] == "992ce8a1687cec8c8bd883ec73ca41d1"


def test_ros1_prints_fields_as_roscpp_does(ros1_probe: MessageProbe) -> None:
    scan = TYPES.ros1_message_type("sensor_msgs/LaserScan")()
    scan.header.frame_id = "laser"
    scan.header.stamp = Time(5, 7)
    scan.ranges = [0.5, 1.0]
    text = ros1_probe.printed("sensor_msgs/msg/LaserScan", to_cdr(scan))
    assert text.startswith(
        "header: \n  seq: 0\n  stamp: 5.000000007\n  frame_id: laser\nangle_min: 0\n"
    )
    assert text.endswith("ranges[]\n  ranges[0]: 0.5\n  ranges[1]: 1\nintensities[]\n")


def test_ros1_prints_messages_in_messages(ros1_probe: MessageProbe) -> None:
    shapes = TYPES.ros1_message_type("probe_msgs/Shapes")()
    shapes.vectors = [TYPES.ros1_message_type("geometry_msgs/Vector3")(1.0, 2.0, 3.0)]
    shapes.data = b"\x01\xff"
    text = ros1_probe.printed("probe_msgs/msg/Shapes", to_cdr(shapes))
    assert "vectors[]\n  vectors[0]: \n    x: 1\n    y: 2\n    z: 3\n" in text
    assert text.endswith("data[]\n  data[0]: 1\n  data[1]: 255\n")


def test_ros2_prints_yaml_as_rosidl_does(ros2_probe: MessageProbe) -> None:
    message = TYPES.message_type("probe_msgs/Everything")()
    message.text = 'say "hi"\\'
    message.wide = "a\u00e9\u4e00"
    message.flags = [True, False]
    message.nothings = [TYPES.message_type("probe_msgs/Nothing")()]
    text = ros2_probe.yaml("probe_msgs/msg/Everything", to_cdr(message))
    for line in (
        "flag: true",
        "raw: 0xc8",
        "letter: 66",
        "f32: 0.250000",
        'text: "say \\"hi\\"\\\\"',
        'wide: "a\\xe9\\u4e00"',
        "flags:\n- true\n- false",
        "texts: []",
        "nothing:\nnull",
        "two_poses:\n-\n  position:\n    x: 0.00000",
        "stamp:\n  sec: 0\n  nanosec: 0",
    ):
        assert f"{line}\n" in text, line


def test_ros2_prints_in_one_line(ros2_probe: MessageProbe) -> None:
    message = TYPES.message_type("std_msgs/Header")(frame_id="map")
    text = ros2_probe.yaml("std_msgs/msg/Header", to_cdr(message), flow=True)
    assert text == '{stamp: {sec: 0, nanosec: 0}, frame_id: "map"}'
    empty = ros2_probe.yaml("std_msgs/msg/Empty", to_cdr(TYPES.message_type("std_msgs/Empty")()))
    assert empty == "null\n"


def test_an_action_of_ros1_has_its_messages(ros1_probe: MessageProbe) -> None:
    goal = TYPES.class_of("probe_msgs/msg/WalkActionGoal", RosVersion.ROS1)()
    goal.goal.metres = 2.5
    text = ros1_probe.printed("probe_msgs/msg/WalkActionGoal", to_cdr(goal))
    assert text.endswith("goal: \n  metres: 2.5\n")
