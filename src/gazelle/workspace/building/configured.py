"""Texts that CMake's ``configure_file()`` makes of a template."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from gazelle.documents import read_limited

__all__ = ["configured_text"]

_MAX_BYTES = 4_000_000
_AT = re.compile(r"@([\w./+-]+)@")
_BOTH = re.compile(r"@([\w./+-]+)@|\$\{([\w./+-]+)\}")


def configured_text(
    template: Path, variables: Mapping[str, str], options: frozenset[str]
) -> str | None:
    """Return what a template becomes; None when that is known only to CMake.

    Args:
        template: the ``.in`` file.
        variables: those whose values are known where the call stands.
        options: the call's words after its two files, such as ``@ONLY``.
    """
    try:
        text = read_limited(template, _MAX_BYTES).decode("utf-8")
    except (OSError, UnicodeDecodeError):
        return None
    if "COPYONLY" in options:
        return text
    if "#cmakedefine" in text:  # a header for a compiler
        return None
    pattern = _AT if "@ONLY" in options else _BOTH
    names = {next(filter(None, found.groups())) for found in pattern.finditer(text)}
    # CMake takes a variable without a value as empty. Here it may be one that find_package() or
    # the compiler's tests would have set.
    if not names <= variables.keys():
        return None

    def value(found: re.Match[str]) -> str:
        text = variables[next(filter(None, found.groups()))]
        return text.replace('"', '\\"') if "ESCAPE_QUOTES" in options else text

    return pattern.sub(value, text)
