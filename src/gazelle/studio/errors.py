"""What goes wrong, as the page is told."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, NotFoundError

__all__ = ["StudioError", "error_value", "unknown"]


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


def error_value(error: BaseException) -> dict[str, Any]:
    """Return an error as the protocol has it: ``message``, and ``hint`` and ``known`` if any."""
    if isinstance(error, StudioError):
        value: dict[str, Any] = {"message": str(error)}
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
