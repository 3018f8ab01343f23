"""What libraries warn of by Python's ``warnings``, in a line without their source."""

from __future__ import annotations

import sys
import warnings
from pathlib import PurePath
from typing import TextIO

__all__ = ["library_of", "shorten_library_warnings"]

_INSTALLED = ("site-packages", "dist-packages")
_PACKAGE = PurePath(__file__).parent
# They warn of what users wrote, as the originals do.
_FOR_USERS = ("compat", "launch")


def shorten_library_warnings() -> None:
    """Show warnings of installed libraries as one line each; those of users' files stay.

    Python writes the path and the line of code of a library that the user has never heard of.
    """
    whole = warnings.showwarning

    def show(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        library = library_of(filename)
        if library is None:
            whole(message, category, filename, lineno, file, line)
            return
        text = " ".join(str(message).split())
        stream = file or sys.stderr
        if stream is not None:
            stream.write(f"{library} warns: {text} ({category.__name__})\n")

    warnings.showwarning = show


def library_of(filename: str) -> str | None:
    """Return the library that a source file belongs to; None for a file of the user's."""
    path = PurePath(filename)
    if path.is_relative_to(_PACKAGE):
        own = path.relative_to(_PACKAGE).with_suffix("").parts
        return None if own[0] in _FOR_USERS else ".".join(("gazelle", *own))
    for folder in _INSTALLED:
        if folder in path.parts[:-1]:
            after = path.parts.index(folder) + 1
            return PurePath(path.parts[after]).stem
    return None
