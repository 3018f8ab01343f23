"""Random messages of every type."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.interfaces import Duration, Time, default_types, known_types
from gazelle.interfaces.definition import (
    FORMATS,
    NUMPY_NAMES,
    Array,
    FieldType,
    RosVersion,
    attribute_name,
)

Maker = Callable[[str, RosVersion, int], Any]


@pytest.fixture(scope="session")
def every_message() -> tuple[str, ...]:
    """Full names of all messages shipped, parts of services and actions too."""
    names = list(known_types())
    names += [name + end for name in known_types("srv") for end in ("_Request", "_Response")]
    ends = ("_Goal", "_Result", "_Feedback", "_SendGoal_Request", "_GetResult_Response")
    names += [name + end for name in known_types("action") for end in ends]
    return tuple(names)


@pytest.fixture(scope="session")
def make_message() -> Maker:
    """A function: full name, generation, seed → a message full of random values."""
    return lambda name, ros_version, seed: _message(name, ros_version, random.Random(seed))


def _message(name: str, ros_version: RosVersion, rng: random.Random) -> Any:
    cls: Any = default_types().class_of(name, ros_version)
    made = cls()
    if name in ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"):
        made.sec, made.nanosec = rng.randrange(2**31), rng.randrange(10**9)
        return made
    for item in cls.FIELDS:
        setattr(made, attribute_name(item.name), _value(item.type, ros_version, rng))
    if name == "rosgraph_msgs/msg/Log":
        made.level = 8
    if name == "shape_msgs/msg/SolidPrimitive":
        made.dimensions = made.dimensions[:3]
    if name == "rcl_interfaces/msg/ParameterDescriptor":
        made.floating_point_range, made.integer_range = [], []
    return made


def _value(kind: FieldType, ros_version: RosVersion, rng: random.Random) -> Any:
    if kind.array is not Array.ONE:
        return _values(kind, ros_version, rng)
    if kind.base == "time":
        return Time(rng.randrange(2**31), rng.randrange(10**9))
    if kind.base == "duration":
        return Duration(rng.randrange(-(2**31), 2**31), rng.randrange(10**9))
    if kind.is_message:
        return _message(kind.base, ros_version, rng)
    if kind.is_string:
        return "".join(rng.choice("abc äß€😀") for _ in range(rng.randrange(9)))
    return _number(FORMATS[kind.base], kind.base, rng)


def _number(letter: str, base: str, rng: random.Random) -> Any:
    if letter == "?":
        return rng.random() < 0.5
    if letter in "fd":
        return float(np.float32(rng.uniform(-1e6, 1e6)))
    bits = np.dtype(NUMPY_NAMES[letter]).itemsize * 8
    if base == "byte":
        return rng.randrange(128)
    low = 0 if letter.isupper() else -(2 ** (bits - 1))
    return low + rng.randrange(2**bits)


def _values(kind: FieldType, ros_version: RosVersion, rng: random.Random) -> Any:
    count = kind.size if kind.array is Array.FIXED else rng.randrange(min(4, kind.size or 4) + 1)
    one = FieldType(kind.base)
    found = [_value(one, ros_version, rng) for _ in range(count)]
    if kind.base not in FORMATS:
        return found
    if ros_version is RosVersion.ROS2:
        return np.array(found, NUMPY_NAMES[FORMATS[kind.base]])
    return bytes(found) if kind.base in ("uint8", "char") else tuple(found)
