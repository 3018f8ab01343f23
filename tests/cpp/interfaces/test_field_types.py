"""Fields, first values and constants as C++ writes them."""

from __future__ import annotations

import math

import pytest

from gazelle.cpp.interfaces.field_types import constant_lines, field_type, initial_value, literal
from gazelle.interfaces import Constant, Field, FieldType, RosVersion
from gazelle.interfaces.definition import Array

ROS1, ROS2 = RosVersion


@pytest.mark.parametrize(
    ("kind", "ros1", "ros2"),
    [
        (FieldType("bool"), "uint8_t", "bool"),
        (FieldType("byte"), "int8_t", "unsigned char"),
        (FieldType("float32", Array.FIXED, 3), "boost::array<float, 3>", "std::array<float, 3>"),
        (
            FieldType("int32", Array.SEQUENCE),
            "::gazelle::ros1::Vector<int32_t, ContainerAllocator>",
            "std::vector<int32_t>",
        ),
        (
            FieldType("std_msgs/msg/Header"),
            "::std_msgs::Header_<ContainerAllocator>",
            "::std_msgs::msg::Header",
        ),
    ],
)
def test_fields(kind: FieldType, ros1: str, ros2: str) -> None:
    assert field_type(kind, ROS1) == ros1
    assert field_type(kind, ROS2) == ros2


def test_bounded_sequences_of_ros2_have_a_class_of_their_own() -> None:
    kind = FieldType("string", Array.SEQUENCE, 4, 3)
    assert field_type(kind, ROS2) == "rosidl_runtime_cpp::BoundedVector<std::string, 4>"


def test_defaults_are_of_ros2() -> None:
    item = Field("x", FieldType("float64", Array.SEQUENCE), (0.5, 1.0))
    assert initial_value(item, ROS2) == "{0.5, 1.0}"
    assert initial_value(item, ROS1) == "{}"
    fixed = Field("x", FieldType("int16", Array.FIXED, 2), (1, 2))
    assert initial_value(fixed, ROS2) == "{{1, 2}}"


@pytest.mark.parametrize(
    ("base", "value", "text"),
    [
        ("int64", -(2**63), "(-9223372036854775807ll - 1)"),
        ("uint64", 2**64 - 1, "18446744073709551615ull"),
        ("float32", 0.25, "0.25f"),
        ("float64", math.inf, "std::numeric_limits<double>::infinity()"),
        ("float64", math.nan, "std::numeric_limits<double>::quiet_NaN()"),
        ("string", 'say "hi"\n', '"say \\"hi\\"\\n"'),
        ("wstring", "é", 'u"é"'),
        ("bool", True, "true"),
    ],
)
def test_values(base: str, value: float | str, text: str) -> None:
    assert literal(base, value, ROS2) == text


def test_whole_numbers_of_ros1_are_enumerators() -> None:
    constant = Constant("DEBUG", "byte", 1, "1")
    assert constant_lines(constant, ROS1) == "enum { DEBUG = 1 };"
    assert constant_lines(constant, ROS2) == "static constexpr unsigned char DEBUG = 1;"
    word = Constant("WORD", "string", "x", "x")
    assert constant_lines(word, ROS1) == 'inline static const std::string WORD{"x"};'
