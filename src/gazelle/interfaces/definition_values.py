"""Values written in definitions: constants and defaults."""

from __future__ import annotations

import ast
import re

from gazelle.interfaces.definition import Array, FieldType, Scalar

__all__ = ["constant_value", "default_value"]

_RANGES = {
    "byte": (-128, 255),
    "char": (-128, 255),
    "int8": (-128, 127),
    "uint8": (0, 255),
    "int16": (-(2**15), 2**15 - 1),
    "uint16": (0, 2**16 - 1),
    "int32": (-(2**31), 2**31 - 1),
    "uint32": (0, 2**32 - 1),
    "int64": (-(2**63), 2**63 - 1),
    "uint64": (0, 2**64 - 1),
}
_BOOLS = {"true": True, "1": True, "false": False, "0": False}


def constant_value(base: str, text: str, *, quoted: bool) -> Scalar:
    """Return the value of a constant of a primitive type.

    Args:
        base: the primitive.
        text: the value as written.
        quoted: whether quotes around a string are not part of it (ROS 2).

    Raises:
        ValueError: the text is no value of that type; says why.
    """
    if base in ("string", "wstring"):
        return _unquoted(text) if quoted else text
    if base == "bool":
        if text.lower() not in _BOOLS:
            raise ValueError(f"'{text}' is neither true nor false")
        return _BOOLS[text.lower()]
    if base in ("float32", "float64"):
        try:
            return float(text)
        except ValueError:
            raise ValueError(f"'{text}' is not a number") from None
    return _integer(base, text)


def default_value(kind: FieldType, text: str) -> Scalar | tuple[Scalar, ...]:
    """Return a field's default as ROS 2 definitions write it.

    Raises:
        ValueError: the text is no value of that type; says why.
    """
    if kind.array is Array.ONE:
        return constant_value(kind.base, text, quoted=True)
    if not re.fullmatch(r"\[.*\]", text):
        raise ValueError(f"the default of an array is written [a, b, …], not '{text}'")
    items = _split_list(text[1:-1])
    count = len(items)
    if kind.array is Array.FIXED and count != kind.size:
        raise ValueError(f"{kind.size} values are needed, {count} are given")
    if kind.array is Array.SEQUENCE and kind.size and count > kind.size:
        raise ValueError(f"at most {kind.size} values are allowed, {count} are given")
    return tuple(constant_value(kind.base, item, quoted=True) for item in items)


def _integer(base: str, text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        try:
            number = int(text, 0)
        except ValueError:
            raise ValueError(f"'{text}' is not a whole number") from None
    low, high = _RANGES[base]
    if not low <= number <= high:
        raise ValueError(f"{number} is outside of {base}'s range {low}…{high}")
    return number


def _unquoted(text: str) -> str:
    if len(text) >= 2 and text[0] == text[-1] and text[0] in "\"'":
        try:
            value = ast.literal_eval(text)
        except (SyntaxError, ValueError):
            return text[1:-1]
        return str(value)
    return text


def _split_list(text: str) -> list[str]:
    pattern = re.compile(r"""\s*("(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*'|[^,]*?)\s*(?:,|$)""")
    items = [match.group(1) for match in pattern.finditer(text)]
    while items and not items[-1]:
        items.pop()
    return items
