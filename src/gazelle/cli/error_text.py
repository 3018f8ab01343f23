"""Errors as a terminal shows them: they quote what users wrote, which may be a whole file."""

from __future__ import annotations

__all__ = ["error_text"]

_MAX_LINE = 1000
# What is wrong stands at the start of a line or at its end, behind what is quoted.
_HEAD = 400
_TAIL = 100


def error_text(error: object) -> str:
    """Return the text of an error, the middle of lines that nobody could read left out."""
    return "\n".join(map(_shortened, str(error).split("\n")))


def _shortened(line: str) -> str:
    if len(line) <= _MAX_LINE:
        return line
    left_out = len(line) - _HEAD - _TAIL
    return f"{line[:_HEAD]} … ({left_out} characters) … {line[-_TAIL:]}"
