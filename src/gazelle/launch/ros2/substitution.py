"""Texts that are known only when a launch runs."""

from __future__ import annotations

import collections.abc
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import SourceSpan
from gazelle.launch.ros2.user_spans import calling_span

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "SomeSubstitutionsType",
    "SomeSubstitutionsType_types_tuple",
    "Substitution",
    "TextSubstitution",
]


class Substitution:
    """A text that is found out at run time.

    Attributes:
        span: the user's line that made it, None when no file did.
    """

    span: SourceSpan | None

    def __new__(cls, *_args: Any, **_kwargs: Any) -> Substitution:
        """Make it and note the user's line that did so, for messages."""
        instance = super().__new__(cls)
        instance.span = calling_span()
        return instance

    def describe(self) -> str:
        """Return a text for people."""
        return repr(self)

    def perform(self, context: LaunchContext) -> str:
        """Return the text.

        Raises:
            NotImplementedError: a subclass has not overridden it.
        """
        raise NotImplementedError("perform() not implemented for Substitution base class.")


class TextSubstitution(Substitution):
    """A text that is known already."""

    def __init__(self, *, text: str) -> None:
        super().__init__()
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self.__text = text

    @property
    def text(self) -> str:
        """The text."""
        return self.__text

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        return self.text


SomeSubstitutionsType = str | Substitution | Iterable[str | Substitution]
SomeSubstitutionsType_types_tuple = (str, Substitution, collections.abc.Iterable)
