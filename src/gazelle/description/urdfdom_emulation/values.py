"""Numbers, rotations and ``<origin>`` as urdfdom_headers 1.0 and urdfdom read them."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from gazelle.description.urdfdom_emulation.console import Console
from gazelle.description.urdfdom_emulation.tinyxml import Element
from gazelle.geometry import Vector3

__all__ = [
    "BadValueError",
    "Origin",
    "check_colour",
    "number_of",
    "origin_of",
    "quaternion_from_rpy",
    "rpy_from_quaternion",
    "vector_of",
]

Quaternion = tuple[float, float, float, float]
# A C++ stream skips white space before a number and refuses everything behind it.
_NUMBER = re.compile(r"[ \t\n\v\f\r]*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
# Beyond this sine of the pitch, roll and yaw turn about the same axis.
_POLE = 0.99999


class BadValueError(ValueError):
    """A text is no number or vector; the message is urdfdom's own."""


class Origin(NamedTuple):
    """A place in metres and a turn."""

    xyz_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    quat_xyzw: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


def number_of(text: str) -> float:
    """Return a number.

    Raises:
        BadValueError: anything else stands in the text, white space behind it included, or
            the number is too large.
    """
    value = float(text) if _NUMBER.fullmatch(text) else math.inf
    if math.isinf(value):
        raise BadValueError("Failed converting string to double")
    return value


def vector_of(text: str) -> Vector3:
    """Return three numbers with spaces between them; tabs and line breaks do not separate.

    Raises:
        BadValueError: a part is no number, or there are more or fewer than three.
    """
    values = []
    for piece in filter(None, text.split(" ")):
        try:
            values.append(number_of(piece))
        except BadValueError:
            reason = f"Unable to parse component [{piece}] to a double"
            raise BadValueError(f"{reason} (while parsing a vector value)") from None
    if len(values) != 3:
        found = f"Parser found {len(values)} elements but 3 expected"
        raise BadValueError(f"{found} while parsing vector [{text}]")
    return values[0], values[1], values[2]


def check_colour(text: str) -> None:
    """Look at a colour; how many numbers it has does not matter to urdfdom.

    Raises:
        BadValueError: a part is no number from 0 to 1.
    """
    for piece in filter(None, text.split(" ")):
        reason = f"Unable to parse component [{piece}] to a double (while parsing a color value)"
        try:
            value = number_of(piece)
        except BadValueError:
            raise BadValueError(reason) from None
        if not 0.0 <= value <= 1.0:
            raise BadValueError(reason)


def quaternion_from_rpy(rpy: Vector3) -> Quaternion:
    """Return the unit quaternion xyzw of roll, pitch and yaw in radians about fixed axes."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2.0), math.cos(a / 2.0)) for a in rpy)
    x = sr * cp * cy - cr * sp * sy
    y = cr * sp * cy + sr * cp * sy
    z = cr * cp * sy - sr * sp * cy
    w = cr * cp * cy + sr * sp * sy
    length = math.sqrt(x * x + y * y + z * z + w * w)
    return x / length, y / length, z / length, w / length


def rpy_from_quaternion(quat_xyzw: Quaternion) -> Vector3:
    """Return roll, pitch and yaw in radians; at the poles roll is 0."""
    x, y, z, w = quat_xyzw
    sine = -2.0 * (x * z - w * y)
    if sine <= -_POLE:
        return 0.0, -math.pi / 2.0, 2.0 * math.atan2(x, -y)
    if sine >= _POLE:
        return 0.0, math.pi / 2.0, 2.0 * math.atan2(-x, y)
    xx, yy, zz, ww = x * x, y * y, z * z, w * w
    roll = math.atan2(2.0 * (y * z + w * x), ww - xx - yy + zz)
    yaw = math.atan2(2.0 * (x * y + w * z), ww + xx - yy - zz)
    return roll, math.asin(sine), yaw


def origin_of(owner: Element, console: Console) -> Origin:
    """Return the pose in an element's first ``<origin>``.

    Raises:
        Rejected: a vector in it is broken.
    """
    tag = owner.first("origin")
    if tag is None:
        return Origin()
    origin = Origin()
    if (xyz := tag.attributes.get("xyz")) is not None:
        origin = origin._replace(xyz_m=_vector(xyz, 102, console))
    if (rpy := tag.attributes.get("rpy")) is not None:
        turn = quaternion_from_rpy(_vector(rpy, 114, console))
        origin = origin._replace(quat_xyzw=turn)
    return origin


def _vector(text: str, line: int, console: Console) -> tuple[float, float, float]:
    try:
        return vector_of(text)
    except BadValueError as mistake:
        raise console.reject(("pose", line), str(mistake)) from None
