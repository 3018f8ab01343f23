"""Fields of a viewer's request: JSON of any kind comes in, numbers that a world takes come out."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from gazelle.simulator.input_validation import InputRefusedError, Limit, number_problem

__all__ = ["Fields", "flag_of", "number_of"]

_MISSING: Any = object()
_SHOWN = 40


class Fields:
    """What a request brought; every reader refuses what is missing or wrong, by its name."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        """Wrap a JSON object; null counts as missing."""
        self.values = values

    @classmethod
    def read(cls, text: str) -> Fields:
        """Return the fields of a text.

        Raises:
            InputRefusedError: it is no JSON object.
        """
        try:
            values = json.loads(text)
        except RecursionError:
            raise InputRefusedError("this is no request: it is nested too deeply") from None
        except ValueError as error:
            raise InputRefusedError(f"this is no request, nor JSON: {error}") from None
        if not isinstance(values, dict):
            raise InputRefusedError(f"a request is a JSON object, not {_shown(values)}")
        return cls(values)

    def __contains__(self, name: str) -> bool:
        return self.values.get(name) is not None

    def text(self, name: str, default: str = _MISSING) -> str:
        """Return a text."""
        value = self.any(name, default)
        if not isinstance(value, str):
            raise _wrong(name, "a text", value)
        return value

    def flag(self, name: str) -> bool:
        """Return true or false."""
        return flag_of(self.any(name), name)

    def number(self, name: str, limit: float = Limit.ANY, default: float = _MISSING) -> float:
        """Return a number within ± a limit."""
        return number_of(self.any(name, default), name, limit)

    def numbers(self, name: str, counts: tuple[int, ...], *limits: float) -> tuple[float, ...]:
        """Return a list of numbers.

        Args:
            name: of the field.
            counts: how many there may be.
            limits: of the first ones, `Limit.ANY` for those behind.
        """
        values = self.any(name)
        wanted = " or ".join(str(count) for count in counts)
        if not isinstance(values, list):
            raise _wrong(name, f"a list of {wanted} numbers", values)
        if len(values) not in counts:
            raise InputRefusedError(f"field '{name}' has {wanted} numbers, not {len(values)}")
        every = (*limits, *[Limit.ANY] * len(values))
        return tuple(
            number_of(value, f"{name}[{place}]", every[place]) for place, value in enumerate(values)
        )

    def any(self, name: str, default: Any = _MISSING) -> Any:
        """Return whatever JSON value it is."""
        value = self.values.get(name)
        if value is not None:
            return value
        if default is _MISSING:
            raise InputRefusedError(f"field '{name}' is missing")
        return default


def number_of(value: Any, name: str, limit: float = Limit.ANY) -> float:
    """Return a JSON value as a number within ± a limit.

    Raises:
        InputRefusedError: it is none, or nothing in a world can have it.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _wrong(name, "a number", value)
    try:
        number = float(value)
    except OverflowError:
        digits = len(str(abs(value)))
        raise InputRefusedError(
            f"field '{name}' is a number of {digits} digits, which nothing in a world can have"
        ) from None
    if problem := number_problem(number, name, limit):
        raise InputRefusedError(problem)
    return number


def flag_of(value: Any, name: str) -> bool:
    """Return a JSON value as true or false.

    Raises:
        InputRefusedError: it is neither.
    """
    if not isinstance(value, bool):
        raise _wrong(name, "true or false", value)
    return value


def _wrong(name: str, wanted: str, value: Any) -> InputRefusedError:
    return InputRefusedError(f"field '{name}' is {wanted}, not {_shown(value)}")


def _shown(value: Any) -> str:
    """Show a value in a few characters, also one that is nested deeply or has many digits."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return "a list"
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"
