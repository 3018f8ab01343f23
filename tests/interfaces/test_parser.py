from __future__ import annotations

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import InterfaceError
from gazelle.interfaces.definition import Array, FieldType, RosVersion
from gazelle.interfaces.parser import parse_message, split_parts

ROS1, ROS2 = RosVersion.ROS1, RosVersion.ROS2


def _parse(text, ros_version=ROS2, *, package="my_pkg"):
    diagnostics = Diagnostics()
    found = parse_message(
        text, f"{package}/msg/Thing", ros_version, diagnostics=diagnostics, file="Thing.msg"
    )
    return found, [str(item).split("\n")[0] for item in diagnostics]


def test_types_of_both_generations_are_read():
    found, problems = _parse(
        "float64[36] a\nstring<=5[<=3] b\nuint8[] c\nwstring d\nPose e\nstd_msgs/Header f\n"
        "geometry_msgs/msg/Point[2] g\nstring<=7 h"
    )
    assert not problems
    assert [item.type for item in found.fields] == [
        FieldType("float64", Array.FIXED, 36),
        FieldType("string", Array.SEQUENCE, 3, 5),
        FieldType("uint8", Array.SEQUENCE),
        FieldType("wstring"),
        FieldType("my_pkg/msg/Pose"),
        FieldType("std_msgs/msg/Header"),
        FieldType("geometry_msgs/msg/Point", Array.FIXED, 2),
        FieldType("string", string_bound=7),
    ]


def test_time_and_header_by_generation():
    text = "Header header\ntime t\nduration[] d"
    bases = [item.type.base for item in _parse(text, ROS1)[0].fields]
    assert bases == ["std_msgs/msg/Header", "time", "duration"]
    bases = [item.type.base for item in _parse(text, ROS2)[0].fields]
    assert bases == [
        "my_pkg/msg/Header",
        "builtin_interfaces/msg/Time",
        "builtin_interfaces/msg/Duration",
    ]


def test_constants_keep_value_and_text():
    text = "int8 A = -3 # minus\nfloat32 B=1.50\nbool C=True\nuint32 D=0x10\nstring E= a # b "
    found, problems = _parse(text, ROS1)
    assert not problems
    assert [(item.name, item.value, item.text) for item in found.constants] == [
        ("A", -3, "-3"),
        ("B", 1.5, "1.50"),
        ("C", True, "True"),
        ("D", 16, "0x10"),
        ("E", "a # b", "a # b"),
    ]
    found, _ = _parse("string E=\"x # y\"  # note\nstring F='q' # z")
    assert [item.value for item in found.constants] == ["x # y", "q"]


def test_defaults_of_ros2():
    found, problems = _parse(
        'int32 a 5\nfloat64 b 1 # one\nstring c "x y"\nbool d true\nint8[3] e [1, -2, 3]\n'
        "string[] f ['p, q', \"r\"]\nfloat32[<=2] g []"
    )
    assert not problems
    values = [item.default for item in found.fields]
    assert values == [5, 1.0, "x y", True, (1, -2, 3), ("p, q", "r"), ()]


def test_comments_and_empty_lines_say_nothing():
    found, problems = _parse("# a\n\n   # b\n  int32   a   # c\n@verbatim\n")
    assert not problems
    assert [item.name for item in found.fields] == ["a"]


@pytest.mark.parametrize(
    ("text", "ros_version", "expected"),
    [
        ("int32", ROS2, "Thing.msg:1:1: error: 'int32' has a type but no name"),
        ("int32 9a", ROS2, "Thing.msg:1:7: error: '9a' cannot be a name"),
        ("int32 a-b", ROS2, "Thing.msg:1:7: error: 'a-b' cannot be a name"),
        ("\nflaot32 a", ROS2, "Thing.msg:2:1: error: 'flaot32' is not a type"),
        ("int32[-1] a", ROS2, "Thing.msg:1:1: error: 'int32[-1]' is not a type"),
        ("int32<=3 a", ROS2, "Thing.msg:1:1: error: only strings have a bound, int32 not"),
        ("a/b/c/d x", ROS2, "Thing.msg:1:1: error: 'a/b/c/d' is not a type"),
        ("int8 A=200", ROS1, "Thing.msg:1:8: error: int8 A: 200 is outside of int8's range"),
        ("bool A=maybe", ROS1, "error: bool A: 'maybe' is neither true nor false"),
        ("float32 A=x", ROS1, "error: float32 A: 'x' is not a number"),
        ("int8 A=1.5", ROS1, "error: int8 A: '1.5' is not a whole number"),
        ("Pose A=1", ROS1, "error: a constant cannot be of type 'Pose'"),
        ("int8 a\nint8 a", ROS2, "Thing.msg:2:6: error: 'a' is there already"),
        ("int32 a 5", ROS1, "Thing.msg:1:9: error: '5' follows the field's name; ROS 1 fields"),
        ("int8[2] a [1]", ROS2, "2 values are needed, 1 are given"),
        ("int8[<=1] a [1, 2]", ROS2, "at most 1 values are allowed, 2 are given"),
        ("int8[] a 5", ROS2, "the default of an array is written [a, b, …], not '5'"),
        ("Pose a 5", ROS2, "error: Pose fields have no default"),
    ],
)
def test_wrong_lines_are_reported_at_their_place(text, ros_version, expected):
    _, problems = _parse(text, ros_version)
    assert len(problems) == 1
    assert expected in problems[0]


def test_all_problems_of_a_file_come_at_once_and_right_lines_stay():
    found, problems = _parse("int32\nint32 a\nflaot32 b\nint32 c")
    assert len(problems) == 2
    assert [item.name for item in found.fields] == ["a", "c"]


def test_a_mistyped_primitive_has_a_remedy():
    diagnostics = Diagnostics()
    parse_message("flaot32 a", "p/msg/T", ROS2, diagnostics=diagnostics)
    assert "did you mean 'float32'" in str(next(iter(diagnostics)))


def test_parts_are_split_with_their_first_lines():
    parts = split_parts("int32 a\n---\n\nint32 b", 2, file="S.srv", diagnostics=Diagnostics())
    assert parts == (("int32 a", 1), ("\nint32 b", 3))


@pytest.mark.parametrize(
    ("text", "count", "expected"),
    [
        ("int32 a", 2, "S.srv:1: error: a service has 1 line(s) of '---', this file has 0"),
        ("---\n---\n---", 3, "S.srv:3: error: an action has 2 line(s) of '---', this file has 3"),
    ],
)
def test_missing_or_extra_separators_are_reported(text, count, expected):
    diagnostics = Diagnostics()
    assert split_parts(text, count, file="S.srv", diagnostics=diagnostics) is None
    assert str(next(iter(diagnostics))).startswith(expected)


def test_without_a_collector_a_problem_is_raised():
    with pytest.raises(InterfaceError, match="<p/msg/T>:1: 'int32' has a type but no name"):
        parse_message("int32", "p/msg/T", ROS2, diagnostics=None)
