"""What people are told of an error beside its own words."""

from __future__ import annotations

__all__ = ["keep_explanation", "kept_explanation"]

_ATTRIBUTE = "_gazelle_explanation"


def keep_explanation(error: BaseException, message: str = "", fix: str = "") -> None:
    """Remember with an error a shorter or fuller message, and what to do."""
    setattr(error, _ATTRIBUTE, (message, fix))


def kept_explanation(error: BaseException) -> tuple[str, str]:
    """Return what was remembered: message and what to do, each empty without."""
    found: tuple[str, str] = getattr(error, _ATTRIBUTE, ("", ""))
    return found
