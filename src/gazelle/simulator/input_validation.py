"""What comes into a world from outside: whether its numbers can be, who sent it, and when.

Every topic and service of the simulator comes through here (`gazelle.simulator.plugins.context`),
and every number of a viewer's request (`gazelle.simulator.gui.fields`).
A number that is none, or that nothing in a world can have, would spoil the whole state at the next
step; so it is refused with the name of its field. The limits are far beyond robots: a position of
100 km, a speed of 10 km/s, ten million newtons.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from gazelle.errors import GazelleError
from gazelle.graph.errors import ServiceRefusedError
from gazelle.interfaces.definition import Array, attribute_name

__all__ = [
    "Arrival",
    "InputRefusedError",
    "Inputs",
    "Limit",
    "number_problem",
    "problem_of",
    "refusal",
]


class Limit:
    """The largest number that a world takes, by what it means."""

    ANY = 1e12
    POSITION_M = 1e5
    ANGLE_RAD = 1e6
    SPEED = 1e4
    LOAD = 1e7
    MASS_KG = 1e9


_FLOATS = frozenset({"float32", "float64"})
_RECENT_NS = 1_000_000_000
_MAX = 4
# By type and field; everything inside of a field has its limit.
_LIMITS = {
    ("geometry_msgs/Pose", "position"): Limit.POSITION_M,
    ("geometry_msgs/Transform", "translation"): Limit.POSITION_M,
    ("geometry_msgs/Twist", "linear"): Limit.SPEED,
    ("geometry_msgs/Twist", "angular"): Limit.SPEED,
    ("geometry_msgs/Wrench", "force"): Limit.LOAD,
    ("geometry_msgs/Wrench", "torque"): Limit.LOAD,
    ("gazebo_msgs/ApplyBodyWrench_Request", "reference_point"): Limit.POSITION_M,
    ("gazebo_msgs/ApplyLinkWrench_Request", "reference_point"): Limit.POSITION_M,
    ("gazebo_msgs/ApplyJointEffort_Request", "effort"): Limit.LOAD,
    ("gazebo_msgs/SetModelConfiguration_Request", "joint_positions"): Limit.ANGLE_RAD,
    ("gazebo_msgs/SetLinkProperties_Request", "mass"): Limit.MASS_KG,
    ("trajectory_msgs/JointTrajectoryPoint", "positions"): Limit.ANGLE_RAD,
}


class InputRefusedError(GazelleError):
    """Raised by a service whose request cannot be; the caller and the log hear why, and whose."""


class Arrival(NamedTuple):
    """The last thing that came by one topic or service.

    Attributes:
        name: of the topic or service.
        caller: node that called the service, empty where nobody knows and for topics.
        time_ns: simulated time.
    """

    name: str
    caller: str
    time_ns: int


class Inputs:
    """Remembers what came last by each topic and service, to name it when a world goes wrong."""

    def __init__(self) -> None:
        self._arrivals: dict[str, Arrival] = {}

    def note(self, name: str, time_ns: int, caller: str = "") -> None:
        """Remember that something came."""
        self._arrivals[name] = Arrival(name, caller, time_ns)

    def forget(self, name: str) -> None:
        """Forget a topic or service that is there no more."""
        self._arrivals.pop(name, None)

    def recent(self, now_ns: int) -> tuple[Arrival, ...]:
        """Return what came within the last simulated second, the latest first, a few at most."""
        found = [one for one in self._arrivals.values() if now_ns - one.time_ns <= _RECENT_NS]
        return tuple(sorted(found, key=lambda one: -one.time_ns)[:_MAX])


def refusal(response: Any, text: str) -> Any:
    """Return a service's response that says why nothing was done.

    Raises:
        ServiceRefusedError: the response has no place for that, so the call fails.
    """
    if not hasattr(response, "success"):
        raise ServiceRefusedError(text)
    response.success = False
    for name in ("status_message", "message"):
        if hasattr(response, name):
            setattr(response, name, text)
    return response


class _Part(NamedTuple):
    """A field of a message that holds numbers, or that is a message and may have some inside."""

    name: str
    is_number: bool
    is_array: bool
    limit: float | None


def problem_of(message: Any) -> str:
    """Return what is wrong with the first number of a message that cannot be, or nothing."""
    return next(_problems(message, "", Limit.ANY), "")


def number_problem(value: float, name: str, limit: float = Limit.ANY) -> str:
    """Return what is wrong with a field's number, or nothing."""
    # False for what is no number, too.
    if abs(value) <= limit:
        return ""
    text = f"is {value:g}, beyond the ±{limit:g}" if math.isfinite(value) else f"is {value:g}"
    return f"field '{name}' {text}, which nothing in a world can have"


def _problems(message: Any, prefix: str, limit: float) -> Iterator[str]:
    kind: Any = type(message)
    for part in _parts(kind):
        value = getattr(message, part.name)
        name, within = prefix + part.name, part.limit or limit
        if part.is_number:
            yield from (
                _numbers(value, name, within) if part.is_array else _number(value, name, within)
            )
        elif part.is_array:
            for index, item in enumerate(value):
                yield from _problems(item, f"{name}[{index}].", within)
        else:
            yield from _problems(value, f"{name}.", within)


def _number(value: float, name: str, limit: float) -> Iterator[str]:
    if problem := number_problem(value, name, limit):
        yield problem


def _numbers(values: Any, name: str, limit: float) -> Iterator[str]:
    array = np.asarray(values, float)
    if not array.size or (np.abs(array) <= limit).all():
        return
    index = int(np.argmin(np.abs(array) <= limit))
    yield from _number(float(array[index]), f"{name}[{index}]", limit)


@cache
def _parts(kind: Any) -> tuple[_Part, ...]:
    type_name = kind.TYPE_NAME.replace("/msg/", "/").replace("/srv/", "/")
    return tuple(
        _Part(
            attribute_name(item.name),
            item.type.base in _FLOATS,
            item.type.array is not Array.ONE,
            _LIMITS.get((type_name, item.name)),
        )
        for item in kind.FIELDS
        if item.type.base in _FLOATS or item.type.is_message
    )
