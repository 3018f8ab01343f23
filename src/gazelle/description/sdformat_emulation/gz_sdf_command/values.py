"""Texts of typed values read and printed as a release of sdformat does."""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import Parameter
from gazelle.description.sdformat_emulation.ignition_math import (
    euler_from_quat_wxyz,
    quat_wxyz_from_euler,
)
from gazelle.description.sdformat_emulation.release import Release
from gazelle.geometry import Pose

__all__ = [
    "PoseNotation",
    "bool_of",
    "default_text",
    "empty_pose",
    "notation_of",
    "number_of",
    "pose_of",
    "printed_pose",
    "printed_value",
]

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_WORD_NUMBER = re.compile(r"[+-]?(?:inf(?:inity)?|nan)", re.IGNORECASE)
_INTEGER = re.compile(r"[+-]?\d+")
_HEX = re.compile(r"[+-]?0x[0-9a-f]+", re.IGNORECASE)
_INT_LIMITS = {"int": (-(2**31), 2**31 - 1), "unsigned int": (-(2**64) + 1, 2**64 - 1)}
_VECTORS = {"vector2i": 2, "vector2d": 2, "vector3": 3, "quaternion": 3, "time": 2}
_DECIMALS = 1e6


class PoseNotation(NamedTuple):
    """How the text of a pose is written: angles in degrees, or a quaternion x y z w."""

    degrees: bool = False
    quaternion: bool = False

    @property
    def size(self) -> int:
        """How many numbers it takes."""
        return 7 if self.quaternion else 6


_RADIANS = PoseNotation()


def printed_value(
    parameter: Parameter, text: str, attributes: Mapping[str, str], console: Console
) -> str | None:
    """Return a value as the release prints it; None, with the reason on the console, if refused.

    Newer releases print what was written, older ones the value with six digits.

    Args:
        parameter: type and limits.
        text: what was written, trimmed and not empty.
        attributes: of the element, which say how a pose is written.
        console: receives reasons; its release decides.
    """
    if console.release.is_new:
        checked = _checked(parameter, text, attributes, console)
        return text if checked else None
    return _formatted(parameter, text, console)


def default_text(parameter: Parameter, console: Console, *, as_typed: bool = False) -> str:
    """Return what is printed for a value that nothing was written for.

    Args:
        parameter: the facts.
        console: its release decides.
        as_typed: the element is there and empty: newer releases print the default's value, not
            its spelling.
    """
    if console.release.is_new and not as_typed:
        return parameter.default
    if console.release is Release.V9:
        return _formatted(parameter, parameter.default, console) or ""
    return _typed_default(parameter)


def bool_of(text: str) -> bool | None:
    """Return a truth value in sdformat's words, None for other words."""
    part = text.strip().lower()
    return True if part in ("1", "true") else False if part in ("0", "false") else None


def number_of(text: str) -> float:
    """Return the number that an accepted text begins with, as ``std::stod`` does; 0 for none."""
    found = _HEX.match(text) or _NUMBER.match(text) or _WORD_NUMBER.match(text)
    if found is None:
        return 0.0
    return float(int(found[0], 16)) if _HEX.fullmatch(found[0]) else float(found[0])


def pose_of(text: str, notation: PoseNotation = _RADIANS) -> Pose:
    """Return the pose that an accepted text means, metres and radians unless `notation` says other.

    A text of another length is that of a default and means no rotation.
    """
    numbers = [number_of(part) for part in text.split()]
    x, y, z = (*numbers[:3], 0.0, 0.0, 0.0)[:3]
    if len(numbers) != notation.size:
        return Pose((x, y, z))
    if notation.quaternion:
        qx, qy, qz, qw = numbers[3:]
    else:
        angles = [math.radians(value) if notation.degrees else value for value in numbers[3:]]
        qw, qx, qy, qz = quat_wxyz_from_euler(*angles)
    return Pose((x, y, z), (qx, qy, qz, qw))


def empty_pose(attributes: Mapping[str, str]) -> str:
    """Return what is printed for a ``<pose>`` that is there and empty."""
    if notation_of(attributes).quaternion:
        return "0 0 0   0 0 0 1"
    spaced = "degrees" in attributes or "rotation_format" in attributes
    return "0 0 0   0 0 0" if spaced else "0 0 0 0 0 0"


def notation_of(attributes: Mapping[str, str]) -> PoseNotation:
    """Return how the attributes of a ``<pose>`` say that it is written."""
    degrees = bool(bool_of(attributes.get("degrees", "0")))
    return PoseNotation(degrees, attributes.get("rotation_format") == "quat_xyzw")


def printed_pose(pose: Pose, *, signed_zero: bool = False, degrees: bool = False) -> str:
    """Return ``x y z roll pitch yaw`` with six digits.

    Args:
        pose: metres.
        signed_zero: print −0 as ``-0``, as old releases do.
        degrees: angles in degrees instead of radians, three spaces before them.
    """
    x, y, z, w = pose.quat_xyzw
    angles = euler_from_quat_wxyz((w, x, y, z))
    numbers = [*map(_rounded, pose.position_m)]
    if degrees:
        turned = [_short(math.degrees(value)) for value in angles]
    else:
        turned = [_short(_rounded(value)) for value in angles]
    parts = [_short(value) for value in numbers] + turned
    if not signed_zero:
        parts = ["0" if part == "-0" else part for part in parts]
    return " ".join(parts[:3]) + ("   " if degrees else " ") + " ".join(parts[3:])


def _checked(
    parameter: Parameter, text: str, attributes: Mapping[str, str], console: Console
) -> bool:
    kind = parameter.kind
    if kind == "bool":
        if bool_of(text) is None:
            console.error("bool", "Invalid boolean value")
            return False
    elif kind == "color":
        return _is_color(parameter, text, console)
    elif kind == "pose":
        return _is_pose(text, attributes, console)
    elif kind in _VECTORS:
        if _stream(text, _VECTORS[kind], kind) is None:
            message = f"Unknown error. Unable to set value [{text} ] for key[{parameter.key}]"
            console.error("stream", message)
            return False
    elif kind in ("double", "float", "int", "unsigned int"):
        value = _scalar(parameter, text, console)
        return value is not None and _is_within(parameter, value, console)
    return True


def _is_within(parameter: Parameter, value: float, console: Console) -> bool:
    for limit, location, part, extreme in (
        (parameter.least, "least", "less", "minimum"),
        (parameter.most, "most", "greater", "maximum"),
    ):
        if limit is None or not (value < limit if location == "least" else value > limit):
            continue
        message = (
            f"The value [{_short(value)}] is {part} than the {extreme} allowed value of "
            f"[{_long(limit)}] for key [{parameter.key}]"
        )
        console.error(location, message)
        return False
    return True


def _is_color(parameter: Parameter, text: str, console: Console) -> bool:
    values: list[float] = []
    for part in text.split():
        found = _NUMBER.match(part) or _WORD_NUMBER.match(part)
        if found is None:
            console.error(
                "color-word",
                f"Invalid argument. Unable to set value [{part}] for key [{parameter.key}].",
            )
            break
        values.append(float(found[0]))
        if not 0 <= values[-1] <= 1:
            break
    else:
        if len(values) in (3, 4):
            return True
    message = f"The value <{parameter.key}>{text}</{parameter.key}> is invalid."
    console.error("color", message)
    return False


def _is_pose(text: str, attributes: Mapping[str, str], console: Console) -> bool:
    form = attributes.get("rotation_format", "euler_rpy")
    if form not in ("euler_rpy", "quat_xyzw"):
        message = (
            f"Undefined attribute //pose[@rotation_format='{form}'], only 'euler_rpy' and "
            "'quat_xyzw' is supported."
        )
        console.error("rotation-format", message)
        return False
    notation = notation_of(attributes)
    if notation == (True, True):
        message = (
            "The attribute //pose[@degrees='true'] does not apply when parsing quaternions, "
            "//pose[@rotation_format='quat_xyzw']."
        )
        console.error("degrees-of-quaternion", message)
        return False
    return not any(map(bool, _pose_faults(text, form, notation.size, console)))


def _pose_faults(text: str, form: str, count: int, console: Console) -> Iterator[str]:
    parts = text.split()
    many = f"The value for //pose[@rotation_format='{form}'] must have {count} values, but "
    for number, part in enumerate(parts):
        found = _NUMBER.match(part) or _WORD_NUMBER.match(part)
        if found is None:
            fault = f"Invalid argument. Unable to set value [{text}] for key [pose]."
            console.error("pose-word", fault)
        elif not math.isfinite(float(found[0])):
            fault = "Pose values must be finite."
            console.error("pose-infinite", fault)
        elif number >= count:
            fault = f"{many}more than that were found in '{text}'."
            console.error("pose-many", fault)
        else:
            continue
        yield fault
        return
    if len(parts) != count:
        fault = f"{many}{len(parts)} were found instead in '{text}'."
        console.error("pose-few", fault)
        yield fault


def _formatted(parameter: Parameter, text: str, console: Console) -> str | None:
    """Return a value with the six digits of old releases."""
    kind = parameter.kind
    if kind == "bool":
        truth = bool_of(text)
        if truth is None:
            console.error("bool", "Invalid boolean value")
            return None
        return str(int(truth))
    if kind == "color":
        return _formatted_color(text)
    if kind == "pose":
        parts = " ".join(map(repr, _stream(text, 6, kind, lenient=True) or ()))
        return printed_pose(pose_of(parts), signed_zero=True)
    if kind in _VECTORS:
        values = _stream(text, _VECTORS[kind], kind, lenient=True) or ()
        whole = kind in ("vector2i", "time")
        return " ".join(str(int(v)) if whole else _short(_rounded(v)) for v in values)
    if kind in ("double", "float", "int", "unsigned int"):
        value = _scalar(parameter, text, console)
        return None if value is None else _short(value) if "int" not in kind else str(int(value))
    if text.lower() in ("true", "false"):
        return str(int(text.lower() == "true"))
    return text[:1] if kind == "char" else text


def _formatted_color(text: str) -> str:
    # Without alpha a colour is opaque.
    values = _stream(text, 4, "color") or (*(_stream(text, 3, "color") or (0.0,) * 3), 1.0)
    return " ".join(_short(_single(value)) for value in values)


def _typed_default(parameter: Parameter) -> str:
    kind, text = parameter.kind, parameter.default
    if kind == "bool":
        return str(int(bool(bool_of(text))))
    if kind in ("double", "float"):
        return _long(float(text)) if kind == "double" else f"{_single(float(text)):.9g}"
    if kind in ("vector2d", "vector3", "color"):
        parts = [_short(_rounded(float(part))) for part in text.split()]
        return " ".join("0" if part == "-0" else part for part in parts)
    return text


def _scalar(parameter: Parameter, text: str, console: Console) -> float | None:
    """Return the number a text begins with, as ``std::stod`` and ``std::stoi`` find it."""
    whole = "int" in parameter.kind
    lowered = {"true": "1", "false": "0"}.get(text.lower(), text)
    found = _HEX.match(lowered) or (_INTEGER if whole else _NUMBER).match(lowered)
    if found is None and not whole:
        found = _WORD_NUMBER.match(lowered)
    if found is None:
        message = f"Invalid argument. Unable to set value [{text} ] for key[{parameter.key}]."
        console.error("invalid", message)
        return None
    is_hex = _HEX.fullmatch(found[0]) is not None
    value = float(int(found[0], 16)) if is_hex else float(found[0])
    least, most = _INT_LIMITS.get(parameter.kind, (-math.inf, math.inf))
    overflows = math.isinf(value) and not _WORD_NUMBER.match(lowered)
    if overflows or not (math.isnan(value) or least <= value <= most):
        message = f"Out of range. Unable to set value [{text} ] for key[{parameter.key}]."
        console.error("range", message)
        return None
    return _single(value) if parameter.kind == "float" else value


def _stream(text: str, count: int, kind: str, *, lenient: bool = False) -> tuple[float, ...] | None:
    """Return numbers as C++'s streams read them: no ``inf``, and ``1.5`` is no integer.

    Args:
        text: the numbers.
        count: how many are read.
        kind: decides between integers and fractions.
        lenient: the first that fails is 0 and those behind it too, instead of None.
    """
    pattern = _INTEGER if kind in ("vector2i", "time") else _NUMBER
    values: list[float] = []
    rest = text.lstrip()
    while len(values) < count:
        found = pattern.match(rest)
        if found is None:
            break
        values.append(float(found[0]))
        rest = rest[found.end() :].lstrip()
    if len(values) == count:
        return tuple(values)
    if not lenient:
        return None
    return tuple(values + [0.0] * (count - len(values)))


def _rounded(value: float) -> float:
    """Return a number rounded to six decimals, halves away from zero."""
    if not math.isfinite(value) or abs(value) > 1e15:
        return value
    return math.copysign(math.floor(abs(value) * _DECIMALS + 0.5) / _DECIMALS, value)


def _single(value: float) -> float:
    try:
        return float(struct.unpack("f", struct.pack("f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


def _short(value: float) -> str:
    return f"{value:g}"


def _long(value: float) -> str:
    return f"{value:.17g}"
