"""Numbers as urdfdom_headers 1.0 reads them, and its rotations."""

from __future__ import annotations

import math
import re

__all__ = [
    "BadValueError",
    "check_colour",
    "number_of",
    "quaternion_from_rpy",
    "rpy_from_quaternion",
    "vector_of",
]

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

# A C++ stream skips white space before a number and refuses everything behind it.
_NUMBER = re.compile(r"[ \t\n\v\f\r]*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
# Beyond this sine of the pitch, roll and yaw turn about the same axis.
_POLE = 0.99999


class BadValueError(ValueError):
    """A text is no number or vector; the message is urdfdom's own."""


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
