"""Parameters of methods and streams, read with their types checked."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping
from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.studio.errors import StudioError
from gazelle.studio.json_text import finite_number

__all__ = ["Params"]

_MISSING: Any = object()
_MAX_LENGTH = 60
# Whatever it is: lists may be nested so deeply that `repr` finds no end.
_REPR = reprlib.Repr()
_REPR.maxstring = _REPR.maxother = _REPR.maxlong = _MAX_LENGTH + 1


class Params:
    """What a request brought; every reader raises `StudioError` for what is missing or wrong."""

    def __init__(self, where: str, values: Any) -> None:
        """Wrap the ``params`` of a request.

        Args:
            where: method or stream, for the errors.
            values: a JSON object; None counts as an empty one.
        """
        values = {} if values is None else values
        if not isinstance(values, dict):
            raise StudioError(f"{where}: 'params' is an object, not {_shown(values)}")
        self.where = where
        self.values: Mapping[str, Any] = values

    def __contains__(self, name: str) -> bool:
        return self.values.get(name) is not None

    def text(self, name: str, default: str = _MISSING) -> str:
        """Return a text."""
        value = self._value(name, default, "a text")
        if not isinstance(value, str):
            raise self._wrong(name, "a text", value)
        return value

    def number(
        self,
        name: str,
        default: float = _MISSING,
        *,
        least: float = -math.inf,
        most: float = math.inf,
    ) -> float:
        """Return a finite number within limits."""
        value = self._value(name, default, "a number")
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self._wrong(name, "a number", value)
        number = finite_number(value)
        if number is None or not least <= number <= most:
            raise self._wrong(name, f"a number from {least:g} to {most:g}", value)
        return number

    def whole(
        self, name: str, default: int = _MISSING, *, least: int = 0, most: int = 2**31
    ) -> int:
        """Return a whole number within limits."""
        value = self._value(name, default, "a whole number")
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if isinstance(value, bool) or not isinstance(value, int):
            raise self._wrong(name, "a whole number", value)
        if not least <= value <= most:
            raise self._wrong(name, f"a whole number from {least} to {most}", value)
        return value

    def flag(self, name: str, default: bool = _MISSING) -> bool:
        """Return true or false."""
        value = self._value(name, default, "true or false")
        if not isinstance(value, bool):
            raise self._wrong(name, "true or false", value)
        return value

    def texts(self, name: str, default: list[str] = _MISSING) -> list[str]:
        """Return a list of texts."""
        value = self._value(name, default, "a list of texts")
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self._wrong(name, "a list of texts", value)
        return value

    def numbers(
        self, name: str, default: list[float] = _MISSING, *, count: int | None = None
    ) -> list[float]:
        """Return a list of finite numbers, of a certain length if one is given."""
        wanted = "a list of numbers" if count is None else f"a list of {count} numbers"
        value = self._value(name, default, wanted)
        found = [finite_number(item) for item in value] if isinstance(value, list) else [None]
        numbers = [number for number in found if number is not None]
        if len(numbers) != len(found) or count not in (None, len(found)):
            raise self._wrong(name, wanted, value)
        return numbers

    def object(self, name: str, default: dict[str, Any] = _MISSING) -> dict[str, Any]:
        """Return a JSON object."""
        value = self._value(name, default, "an object")
        if not isinstance(value, dict):
            raise self._wrong(name, "an object", value)
        return value

    def any(self, name: str, default: Any = _MISSING) -> Any:
        """Return whatever JSON value it is."""
        return self._value(name, default, "a value")

    def _value(self, name: str, default: Any, wanted: str) -> Any:
        value = self.values.get(name)
        if value is not None:
            return value
        if default is _MISSING:
            raise StudioError(
                f"{self.where}: parameter '{name}' is missing; it is {wanted}",
                known=nearest_names(name, self.values),
            )
        return default

    def _wrong(self, name: str, wanted: str, value: Any) -> StudioError:
        return StudioError(f"{self.where}: parameter '{name}' is {wanted}, not {_shown(value)}")


def _shown(value: Any) -> str:
    text = _REPR.repr(value)
    return text if len(text) <= _MAX_LENGTH else f"{text[: _MAX_LENGTH - 3]}…"
