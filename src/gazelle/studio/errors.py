"""What goes wrong, as the page is told."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NotRequired, TypedDict

from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, NotFoundError

__all__ = ["ErrorValue", "StudioError", "error_value", "unknown"]


class ErrorValue(TypedDict):
    """What went wrong.

    Attributes:
        hint: what to do about it.
        known: what exists instead.
    """

    message: str
    hint: NotRequired[str]
    known: NotRequired[list[str]]


class StudioError(GazelleError):
    """A request that cannot be done.

    Attributes:
        hint: what to do about it, may be empty.
        known: what exists instead.
    """

    def __init__(self, message: str, *, hint: str = "", known: Iterable[str] = ()) -> None:
        self.hint = hint
        self.known = tuple(known)
        super().__init__(message)


def unknown(kind: str, name: str, existing: Iterable[str], *, hint: str = "") -> StudioError:
    """Return the error of a name that is none of the existing ones."""
    known = nearest_names(name, existing)
    return StudioError(f"there is no {kind} '{name}'", hint=hint, known=known)


def error_value(error: BaseException) -> ErrorValue:
    """Return an error as the protocol has it: ``message``, and ``hint`` and ``known`` if any."""
    if isinstance(error, StudioError):
        value: ErrorValue = {"message": str(error)}
        if error.hint:
            value["hint"] = error.hint
        if error.known:
            value["known"] = list(error.known)
        return value
    if isinstance(error, NotFoundError):
        message, _, rest = str(error).partition("\n")
        value = {"message": message}
        if rest.strip():
            value["hint"] = rest.strip()
        if error.nearest:
            value["known"] = list(error.nearest)
        return value
    if isinstance(error, GazelleError):
        return {"message": str(error)}
    return {
        "message": f"{type(error).__name__}: {error}",
        "hint": "this is a fault of Studio, please report it",
    }
