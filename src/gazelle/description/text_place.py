"""The file that a text came from, so that findings about a parameter name file and line."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

__all__ = ["TEXT_FILES_VARIABLE", "TEXT_NAME", "place_of_text"]

TEXT_NAME = "<robot_description>"
TEXT_FILES_VARIABLE = "GAZELLE_TEXT_FILES"


def place_of_text(text: str, environ: Mapping[str, str] | None = None) -> str:
    """Return the file that holds exactly this text, or `TEXT_NAME`.

    A launcher lists the files whose text it put into parameters in ``GAZELLE_TEXT_FILES``; the
    processes it starts only see the text.
    """
    values = os.environ if environ is None else environ
    for name in values.get(TEXT_FILES_VARIABLE, "").split(os.pathsep):
        if name and _text_of(Path(name)) == text:
            return name
    return TEXT_NAME


def _text_of(path: Path) -> str | None:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None
