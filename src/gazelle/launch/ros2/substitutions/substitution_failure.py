"""The error of substitutions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from gazelle.launch.ros2.substitution import Substitution
from gazelle.launch.ros2.user_spans import keep_explanation

__all__ = ["SubstitutionFailure", "counted", "described"]


class SubstitutionFailure(RuntimeError):  # noqa: N818 - the name users catch
    """A substitution has no value."""

    def explained(self, *, short: str = "", fix: str = "") -> SubstitutionFailure:
        """Return the error with what people are told of it."""
        keep_explanation(self, short, fix)
        return self


def described(substitutions: Iterable[Substitution]) -> str:
    """Return substitutions as a text for people."""
    return " + ".join(sub.describe() for sub in substitutions)


def counted(data: Sequence[Any], least: int, most: int, name: str) -> Sequence[Any]:
    """Return the arguments of a ``$(name …)`` if there are as many as it takes.

    Raises:
        TypeError: there are more or fewer.
    """
    if least <= len(data) <= most:
        return data
    if most == 0:
        raise TypeError(f"{name} substitution doesn't expect arguments")
    count = str(least) if least == most else f"{least} or {most}"
    word = "argument" if count == "1" else "arguments"
    raise TypeError(f"{name} substitution expects {count} {word}")
