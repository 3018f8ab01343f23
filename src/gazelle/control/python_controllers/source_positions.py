"""Where in a user's code an error arose."""

from __future__ import annotations

import traceback
from pathlib import Path

__all__ = ["located"]


def located(error: BaseException, folder: Path) -> str:
    """Return an error in words, with file and line of the last frame below a folder."""
    words = f"{type(error).__name__}: {error}"
    if isinstance(error, SyntaxError) and error.filename:
        return f"{error.filename}:{error.lineno}: {words}"
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(frame.filename).is_relative_to(folder)]
    if not own:
        return words
    last = own[-1]
    return f"{last.filename}:{last.lineno} in {last.name}(): {words}"
