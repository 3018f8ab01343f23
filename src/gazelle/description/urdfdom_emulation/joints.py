"""``<joint>`` as urdfdom 3.0.1 reads it: the first mistake ends the whole file."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from gazelle.description.urdfdom_emulation.console import Console, Rejected
from gazelle.description.urdfdom_emulation.tinyxml import Element
from gazelle.description.urdfdom_emulation.values import (
    BadValueError,
    Origin,
    number_of,
    origin_of,
    vector_of,
)

__all__ = ["ReadJoint", "read_joint"]

_TYPES = ("planar", "floating", "revolute", "continuous", "prismatic", "fixed")
_WITHOUT_AXIS = ("floating", "fixed")


class ReadJoint(NamedTuple):
    """What is left of a joint: its ends' names, empty when missing, and where it is."""

    name: str
    parent: str
    child: str
    T_parent_joint: Origin


class _Part(NamedTuple):
    """A child element: what to say when it is broken, and where that is said."""

    tag: str
    check: Callable[[Element, Console], None]
    line: int
    complaint: str


def read_joint(tag: Element, console: Console) -> ReadJoint:
    """Read a joint.

    Raises:
        Rejected: urdfdom refuses it, and with it the file.
    """
    name = tag.attributes.get("name")
    if name is None:
        raise console.reject(("joint", 345), "unnamed joint found")
    try:
        origin = origin_of(tag, console)
    except Rejected:
        message = f"Malformed parent origin element for joint [{name}]"
        raise console.reject(("joint", 362), message) from None
    kind = _type_of(tag, name, console)
    if kind not in _WITHOUT_AXIS:
        _check_axis(tag, name, console)
    if tag.first("limit") is None:
        _check_needs_no_limit(kind, name, console)
    for part in _PARTS:
        child = tag.first(part.tag)
        if child is not None:
            _check_part(part, child, name, console)
    return ReadJoint(name, _end(tag, "parent"), _end(tag, "child"), origin)


def _end(tag: Element, which: str) -> str:
    end = tag.first(which)
    return end.attributes.get("link", "") if end is not None else ""


def _type_of(tag: Element, name: str, console: Console) -> str:
    kind = tag.attributes.get("type")
    if kind is None:
        message = f"joint [{name}] has no type, check to see if it's a reference."
        raise console.reject(("joint", 401), message)
    if kind not in _TYPES:
        message = f"Joint [{name}] has no known type [{kind}]"
        raise console.reject(("joint", 420), message)
    return kind


def _check_axis(tag: Element, name: str, console: Console) -> None:
    axis = tag.first("axis")
    if axis is None or "xyz" not in axis.attributes:
        return
    try:
        vector_of(axis.attributes["xyz"])
    except BadValueError as mistake:
        message = f"Malformed axis element for joint [{name}]: {mistake}"
        raise console.reject(("joint", 440), message) from None


def _check_needs_no_limit(kind: str, name: str, console: Console) -> None:
    if kind == "revolute":
        message = f"Joint [{name}] is of type REVOLUTE but it does not specify limits"
        raise console.reject(("joint", 461), message)
    if kind == "prismatic":
        message = f"Joint [{name}] is of type PRISMATIC without limits"
        raise console.reject(("joint", 466), message)


def _check_part(part: _Part, tag: Element, name: str, console: Console) -> None:
    try:
        part.check(tag, console)
    except Rejected:
        message = f"Could not parse {part.complaint} [{name}]"
        raise console.reject(("joint", part.line), message) from None


def _check_limit(tag: Element, console: Console) -> None:
    _check_number(tag, "lower", 112, console)
    _check_number(tag, "upper", 128, console)
    _check_needed(tag, "effort", ("joint", 136), "joint limit: no effort", console)
    _check_number(tag, "effort", 144, console)
    _check_needed(tag, "velocity", ("joint", 152), "joint limit: no velocity", console)
    _check_number(tag, "velocity", 160, console)


def _check_safety(tag: Element, console: Console) -> None:
    _check_number(tag, "soft_lower_limit", 184, console)
    _check_number(tag, "soft_upper_limit", 201, console)
    _check_number(tag, "k_position", 218, console)
    _check_needed(tag, "k_velocity", ("joint", 226), "joint safety: no k_velocity", console)
    _check_number(tag, "k_velocity", 234, console)


def _check_calibration(tag: Element, console: Console) -> None:
    _check_number(tag, "rising", 258, console)
    _check_number(tag, "falling", 275, console)


def _check_mimic(tag: Element, console: Console) -> None:
    message = "joint mimic: no mimic joint specified"
    _check_needed(tag, "joint", ("joint", 292), message, console)
    _check_number(tag, "multiplier", 311, console)
    _check_number(tag, "offset", 329, console)


def _check_dynamics(tag: Element, console: Console) -> None:
    _check_number(tag, "damping", 65, console)
    _check_number(tag, "friction", 81, console)
    if "damping" not in tag.attributes and "friction" not in tag.attributes:
        message = "joint dynamics element specified with no damping and no friction"
        raise console.reject(("joint", 88), message)


def _check_needed(
    tag: Element, word: str, place: tuple[str, int], message: str, console: Console
) -> None:
    if word not in tag.attributes:
        raise console.reject(place, message)


def _check_number(tag: Element, word: str, line: int, console: Console) -> None:
    text = tag.attributes.get(word)
    if text is None:
        return
    try:
        number_of(text)
    except BadValueError:
        message = f"{word} value ({text}) is not a valid float"
        raise console.reject(("joint", line), message) from None


# In urdfdom's order; some of its sentences have two spaces.
_PARTS = (
    _Part("limit", _check_limit, 454, "limit element for joint"),
    _Part("safety_controller", _check_safety, 477, "safety element for joint"),
    _Part("calibration", _check_calibration, 490, "calibration element for joint "),
    _Part("mimic", _check_mimic, 503, "mimic element for joint "),
    _Part("dynamics", _check_dynamics, 516, "joint_dynamics element for joint"),
)
