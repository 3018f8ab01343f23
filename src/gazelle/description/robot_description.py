"""Where the text of a ``robot_description`` came from.

Findings about a parameter name file and line by it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from gazelle.description.source_maps import placed
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["TEXT_FILES_VARIABLE", "TEXT_NAME", "copy_name", "file_of_text", "read_text"]

TEXT_NAME = "<robot_description>"
TEXT_FILES_VARIABLE = "GAZELLE_TEXT_FILES"
_COPY_SUFFIX = ".text.xml"


def file_of_text(text: str, environ: Mapping[str, str] | None = None) -> str:
    """Return the file that holds exactly this text, or `TEXT_NAME`.

    A launcher lists the files whose text it put into parameters in ``GAZELLE_TEXT_FILES``; the
    processes it starts only see the text.
    """
    values = os.environ if environ is None else environ
    for name in values.get(TEXT_FILES_VARIABLE, "").split(os.pathsep):
        if name and _text_of(Path(name)) == text:
            return name
    return TEXT_NAME


def copy_name(parameter: str) -> str:
    """Return the name of the file that a launcher writes a parameter's text to."""
    return f"{parameter.strip('/').replace('/', '-')}{_COPY_SUFFIX}"


def read_text(text: str, diagnostics: Diagnostics) -> Tag | None:
    """Parse the text of a parameter; its elements stand where the user wrote them.

    That is a line of a xacro file where the text was made by xacro, else a line of the file
    that holds the text.

    Args:
        text: the document.
        diagnostics: receives ``xml.malformed`` and its like.

    Returns:
        The outermost element; None (and an error reported) when it is not well-formed.
    """
    span = file_of_text(text)
    root = parse_xml(text, span, diagnostics)
    if root is None:
        return None
    return placed(root)


def _text_of(path: Path) -> str | None:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None
