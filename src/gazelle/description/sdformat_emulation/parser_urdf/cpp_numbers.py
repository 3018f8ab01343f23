"""Numbers as the C++ library reads them from texts and writes them into texts."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable

__all__ = [
    "NumberCrashError",
    "brief_text",
    "exact_text",
    "leading_integer",
    "leading_number",
    "streamed_numbers",
]

_DECIMAL = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_NUMBER = re.compile(
    r"[ \t\n\v\f\r]*(?P<value>[+-]?0[xX](?:[0-9a-fA-F]+\.?[0-9a-fA-F]*|\.[0-9a-fA-F]+)"
    rf"(?:[pP][+-]?[0-9]+)?|{_DECIMAL}|[+-]?(?:inf(?:inity)?|nan))",
    re.IGNORECASE,
)
_STREAMED = re.compile(rf"[ \t\n\v\f\r]*(?P<value>{_DECIMAL})")
_INTEGER = re.compile(r"[ \t\n\v\f\r]*(?P<value>[+-]?[0-9]+)")


class NumberCrashError(ValueError):
    """A text at which the library ends the whole program: nobody catches what it throws.

    The message is what the program prints while it ends.
    """

    def __init__(self, kind: str, function: str) -> None:
        self.kind = kind
        thrown = f"terminate called after throwing an instance of 'std::{kind}'"
        super().__init__(f"{thrown}\n  what():  {function}")


def leading_number(text: str) -> float:
    """Return the number a text begins with; whatever follows it does not count (``std::stod``).

    Raises:
        NumberCrashError: it begins with none, or with one that no double holds.
    """
    found = _NUMBER.match(text)
    if found is None:
        raise NumberCrashError("invalid_argument", "stod")
    word = found["value"].lower()
    is_hexadecimal = "x" in word
    try:
        value = float.fromhex(word) if is_hexadecimal else float(word)
    except OverflowError:
        value = math.inf
    if any(letter in word for letter in ("inf", "nan")):
        return value
    mantissa = word.removeprefix("+").removeprefix("-").removeprefix("0x")
    digits = mantissa.partition("p" if is_hexadecimal else "e")[0]
    is_zero = not digits.strip("0.")
    if math.isinf(value) or (abs(value) < sys.float_info.min and not is_zero):
        raise NumberCrashError("out_of_range", "stod")
    return value


def leading_integer(text: str) -> int:
    """Return the integer a text begins with (``std::stoi``).

    Raises:
        NumberCrashError: it begins with none, or with one beyond 32 bits.
    """
    found = _INTEGER.match(text)
    if found is None:
        raise NumberCrashError("invalid_argument", "stoi")
    # A float first: Python refuses to read integers of thousands of digits.
    if not -(2.0**31) <= float(found["value"]) < 2.0**31:
        raise NumberCrashError("out_of_range", "stoi")
    return int(float(found["value"]))


def streamed_numbers(text: str, count: int) -> tuple[float, ...] | None:
    """Return the first numbers of a text, None when it has fewer; the rest does not count."""
    values: list[float] = []
    at = 0
    while len(values) < count:
        found = _STREAMED.match(text, at)
        if found is None or math.isinf(float(found["value"])):
            return None
        values.append(float(found["value"]))
        at = found.end()
    return tuple(values)


def exact_text(values: Iterable[float]) -> str:
    """Return numbers with up to 16 digits; a negative zero loses its sign."""
    return " ".join(f"{value:.16g}" if value else "0" for value in values)


def brief_text(values: Iterable[float]) -> str:
    """Return numbers with up to 6 digits, as a C++ stream writes them by itself."""
    return " ".join(f"{value:g}" for value in values)
