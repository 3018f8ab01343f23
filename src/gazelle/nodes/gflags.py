"""Command lines as gflags reads them: ``-name box``, ``--name=box``, ``-allow-renaming``."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Literal

from gazelle.diagnostics import did_you_mean
from gazelle.errors import LaunchError

__all__ = ["Kind", "read_flags"]

Kind = Literal["bool", "double", "string"]
_YES = frozenset({"1", "t", "true", "y", "yes"})
_NO = frozenset({"0", "f", "false", "n", "no"})


def read_flags(
    argv: Sequence[str],
    kinds: Mapping[str, Kind],
    usage: str = "",
    *,
    on_unknown: Callable[[str], None] | None = None,
) -> dict[str, bool | float | str]:
    """Return the flags that are given; the last one of a name counts.

    ``-`` and ``--`` are one, ``-`` inside of a name is ``_``, ``-noflag`` is false, and a flag of
    truth takes a value behind ``=`` only. Words that belong to no flag are left alone, and so is
    what follows ``--``.

    Args:
        argv: of the command line.
        kinds: the program's flags.
        usage: what is added to a message about a wrong flag.
        on_unknown: told of flags that the program lacks, for those that allow reparsing
            (``AllowCommandLineReparsing``) and go on; its value counts as a word of no flag.

    Raises:
        LaunchError: a flag is unknown, has no value or a wrong one.
    """
    found: dict[str, bool | float | str] = {}
    rest = deque(argv)
    end = f"\n{usage}" if usage else ""
    while rest:
        word = rest.popleft()
        if word == "--":
            break
        if not word.startswith("-") or word == "-":
            continue
        written, equals, value = word[1:].removeprefix("-").partition("=")
        name, is_not = _known(written, kinds)
        if not name:
            hint = did_you_mean(written.replace("-", "_"), kinds)
            hint = f"; {hint}" if hint else ""
            message = f"unknown command line flag '{written}'{hint}"
            if on_unknown is None:
                raise LaunchError(f"{message}{end}")
            on_unknown(message)
            continue
        if kinds[name] == "bool":
            value = value if equals else "false" if is_not else "true"
        elif not equals:
            if not rest:
                raise LaunchError(f"flag '{word}' is missing its argument{end}")
            value = rest.popleft()
        found[name] = _value(name, kinds[name], value)
    return found


def _known(written: str, kinds: Mapping[str, Kind]) -> tuple[str, bool]:
    """Return a flag's name, empty for none, and whether ``no`` stood before it."""
    name = written.replace("-", "_")
    if name in kinds:
        return name, False
    bare = name.removeprefix("no")
    return (bare, True) if bare != name and kinds.get(bare) == "bool" else ("", False)


def _value(name: str, kind: Kind, value: str) -> bool | float | str:
    if kind == "string":
        return value
    try:
        if kind == "double":
            return float(value)
        if value.lower() in _YES | _NO:
            return value.lower() in _YES
    except ValueError:
        pass
    raise LaunchError(f"illegal value '{value}' specified for {kind} flag '{name}'")
