"""Arrays that took long to compute, kept on disk for the next run."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.documents.npz_files import ArchiveError, read_arrays

__all__ = ["keep_arrays", "keeps_arrays", "kept_arrays"]


def kept_arrays(file: Path) -> dict[str, NDArray[Any]] | None:
    """Return the arrays of a file by name, of any shape; None when it is not there or damaged."""
    try:
        return read_arrays(file)
    except (OSError, ArchiveError):
        return None


def keep_arrays(file: Path, arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write arrays of any shape beside and rename, so that a reader never sees half a file.

    A read-only home only costs the time of the next run.
    """
    # Typed loosely: NumPy before 2.2 knows no other argument, and would save one as an array.
    loose: dict[str, Any] = dict(arrays)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with NamedTemporaryFile(dir=file.parent, suffix=".tmp", delete=False) as target:
            np.savez(target, **loose)
        Path(target.name).replace(file)
    except OSError:
        return


def keeps_arrays(folder: Path) -> bool:
    """Tell whether files can be kept in a folder, which is made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
