"""``$(…)`` in the attributes of launch files.

A ``$(name arguments)`` may stand anywhere in a text and within another one. Arguments are parted
by one blank; one in single or double quotes may hold blanks. A backslash takes the meaning of the
character behind it away.
"""

from __future__ import annotations

import re
from typing import Any

from gazelle.launch.ros2.frontend.expose import instantiate_substitution
from gazelle.launch.ros2.substitution import Substitution, TextSubstitution

__all__ = ["parse_if_substitutions", "parse_substitution", "replace_escaped_characters"]

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_MAX_DEPTH = 100


def replace_escaped_characters(data: str) -> str:
    """Return a text without the backslashes that keep characters from meaning something."""
    return re.sub(r"\\(.)", r"\1", data)


def parse_substitution(string_value: str) -> list[Substitution]:
    """Return texts and substitutions that a text is made of.

    Raises:
        ValueError: a ``$(`` is not closed or has no name.
        RuntimeError: there is no substitution of this name.
    """
    if not string_value:
        return [TextSubstitution(text=string_value)]
    return _Reader(string_value).template("")


def parse_if_substitutions(value: Any) -> Any:
    """Return a value with the substitutions in its texts; other scalars are left alone.

    Raises:
        ValueError: the items of a list have several types.
    """
    if not isinstance(value, list):
        return _value_or_substitutions(value)
    found = [_value_or_substitutions(item) for item in value]
    if len({type(item) for item in found if not isinstance(item, list)}) > 1:
        raise ValueError("The result is a non-uniform list")
    return found


def _value_or_substitutions(value: Any) -> Any:
    if not isinstance(value, str):
        return value
    found = parse_substitution(value)
    if len(found) == 1 and isinstance(found[0], TextSubstitution):
        return found[0].text
    return found


class _Reader:
    """Reads a text from left to right; a quote around it is the empty text outside of quotes."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._depth = 0

    def template(self, quote: str) -> list[Substitution]:
        """Read to the end, or to the closing quote."""
        found: list[Substitution] = []
        while not self._ends(quote):
            found.append(self._substitution(quote) if self._opens() else self._string(quote))
        return found

    def _ends(self, quote: str) -> bool:
        if self._at >= len(self._text):
            if quote:
                raise self._error(f"the quotation mark {quote} is not closed")
            return True
        return bool(quote) and self._text[self._at] == quote

    def _opens(self) -> bool:
        return self._text.startswith("$(", self._at)

    def _string(self, quote: str) -> Substitution:
        start = self._at
        while not self._ends(quote) and not self._opens():
            self._at += 2 if self._text[self._at] == "\\" else 1
            self._at = min(self._at, len(self._text))
        return _text_of(self._text[start : self._at])

    def _substitution(self, quote: str) -> Substitution:
        start = self._at
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise self._error(f"more than {_MAX_DEPTH} substitutions within each other")
        self._at += 2
        name = _NAME.match(self._text, self._at)
        if name is None:
            raise self._error("a '$(' needs the name of a substitution; write '\\$(' for the text")
        self._at = name.end()
        arguments = []
        while self._text.startswith(" ", self._at):
            self._at += 1
            arguments.append(self._argument(quote))
        if not self._text.startswith(")", self._at):
            raise self._error(f"'{self._text[start:]}' is not closed, or has more than one blank")
        self._at += 1
        self._depth -= 1
        found: Substitution = instantiate_substitution(name.group(), arguments)
        return found

    def _argument(self, quote: str) -> list[Substitution]:
        mark = self._text[self._at : self._at + 1]
        if not quote and mark in ("'", '"'):
            self._at += 1
            found = self.template(mark)
            self._at += 1
            return found
        found = []
        while self._at < len(self._text) and not self._ends_argument(quote):
            found.append(self._substitution(quote) if self._opens() else self._word(quote))
        if not found:
            raise self._error("an argument is empty; one blank parts them")
        return found

    def _word(self, quote: str) -> Substitution:
        start = self._at
        while self._at < len(self._text) and not self._ends_argument(quote) and not self._opens():
            self._at += 2 if self._text[self._at] == "\\" else 1
            self._at = min(self._at, len(self._text))
        return _text_of(self._text[start : self._at])

    def _ends_argument(self, quote: str) -> bool:
        character = self._text[self._at]
        if not quote and character in "'\"":
            raise self._error("a quotation mark within an argument; quote all of it, or none")
        if character == "(":
            raise self._error("a bracket within an argument; quote the argument, or write '\\('")
        return character in " )" or character == quote

    def _error(self, what: str) -> ValueError:
        return ValueError(f"in '{self._text}', character {self._at + 1}: {what}")


def _text_of(raw: str) -> TextSubstitution:
    return TextSubstitution(text=replace_escaped_characters(raw))
