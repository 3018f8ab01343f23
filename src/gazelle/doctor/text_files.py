"""Files that the texts of parameters came from, known to readers for a while."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from gazelle.description.robot_description import TEXT_FILES_VARIABLE

__all__ = ["texts_known"]


@contextmanager
def texts_known(files: Sequence[str]) -> Iterator[None]:
    """Let readers find the files that parameters' texts came from, as a launcher does."""
    before = os.environ.get(TEXT_FILES_VARIABLE)
    os.environ[TEXT_FILES_VARIABLE] = os.pathsep.join(dict.fromkeys(files))
    try:
        yield
    finally:
        if before is None:
            del os.environ[TEXT_FILES_VARIABLE]
        else:
            os.environ[TEXT_FILES_VARIABLE] = before
