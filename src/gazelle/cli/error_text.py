"""What a terminal shows of errors: lines without end are cut, and odd dashes are pointed out."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["error_text", "printed_characters"]

_DASHES = "‐‑‒–—―−"
_LONG_DASHES = "—―"
_QUOTES = "‘’‚‛“”„‟"
_MAX_LINE = 1000
# What is wrong stands at the start of a line or at its end, behind what is quoted.
_HEAD = 400
_TAIL = 100


def printed_characters(argv: Sequence[str]) -> list[str]:
    """Return a line for each word that was most likely typed otherwise.

    Web pages turn ``-r`` into ``–r`` and quotation marks into curly ones; the shell and every
    command take them for letters. What a word is meant for is not known here, so this is for
    commands that have failed.
    """
    return [line for word in argv if (line := _about(word))]


def error_text(error: object) -> str:
    """Return the text of an error, the middle of lines that nobody could read left out."""
    return "\n".join(map(_shortened, str(error).split("\n")))


def _about(word: str) -> str:
    rest = word.lstrip(_DASHES + "-")
    if word[:1] and word[0] in _DASHES and rest[:1].isalpha():
        is_long = word[0] in _LONG_DASHES or len(word) - len(rest) > 1
        meant = ("--" if is_long and len(rest) > 1 else "-") + rest
        return (
            f"'{word}' begins with {_named(word[0])}, a dash of printed text; options begin with "
            f"'-': {meant}"
        )
    found = next((one for one in word if one in _QUOTES), "")
    if found:
        return (
            f"'{word}' holds {_named(found)}, a quotation mark of printed text; the shell knows ' "
            'and " only'
        )
    if "\u00a0" in word:
        return f"'{word}' holds {_named(chr(0xA0))}, a space of printed text that parts no words"
    return ""


def _named(character: str) -> str:
    return f"'{character}' (U+{ord(character):04X})"


def _shortened(line: str) -> str:
    if len(line) <= _MAX_LINE:
        return line
    left_out = len(line) - _HEAD - _TAIL
    return f"{line[:_HEAD]} … ({left_out} characters) … {line[-_TAIL:]}"
