"""Numpy archives: read though they may be damaged or too large, and kept for the next run."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Mapping
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING, Any

from gazelle.cache_folders import is_trusted, is_usable, tell_not_kept
from gazelle.documents.files import HOW_TO_RAISE, scaled

if TYPE_CHECKING:
    from numpy.typing import NDArray


__all__ = ["ArchiveError", "keep_arrays", "keeps_arrays", "kept_arrays", "read_arrays"]

_MAX_BYTES = 1 << 30


class ArchiveError(ValueError):
    """The bytes are no numpy archive, or one that is not read; the text says why."""


def read_arrays(path: Path) -> dict[str, NDArray[Any]]:
    """Return the arrays of an ``.npz`` by name, of any shape; objects of Python are never made.

    Raises:
        OSError: the file cannot be read.
        ArchiveError: it is damaged, no archive, or too large.
    """
    with path.open("rb") as file:
        try:
            with zipfile.ZipFile(file) as packed:
                _check_size(packed)
                return {
                    name.removesuffix(".npy"): _array(packed, name) for name in packed.namelist()
                }
        except ArchiveError:
            raise
        except MemoryError:
            raise ArchiveError("there is no memory for it") from None
        except Exception as error:
            # zipfile, its decompressors and numpy have errors of their own each.
            raise ArchiveError(str(error) or type(error).__name__) from error


def kept_arrays(file: Path) -> dict[str, NDArray[Any]] | None:
    """Return the arrays of a file by name, of any shape; None when it is not there or damaged."""
    if not is_trusted(file.parent):
        return None
    try:
        return read_arrays(file)
    except (OSError, ArchiveError):
        return None


def keep_arrays(file: Path, arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write arrays of any shape beside and rename, so that a reader never sees half a file.

    A read-only home, or a full one, only costs the time of the next run, and is told once.
    """
    import numpy as np

    # Typed loosely: NumPy before 2.2 knows no other argument, and would save one as an array.
    loose: dict[str, Any] = dict(arrays)
    if not is_usable(file.parent):
        return
    made: Path | None = None
    try:
        with NamedTemporaryFile(dir=file.parent, suffix=".tmp", delete=False) as target:
            made = Path(target.name)
            np.savez(target, **loose)
        made.replace(file)
    except OSError as error:
        tell_not_kept("convex pieces of meshes", file.parent, error)
        if made is not None:
            made.unlink(missing_ok=True)


def keeps_arrays(folder: Path) -> bool:
    """Tell whether files can be kept in a folder, which is made where it is missing."""
    return is_usable(folder)


def _check_size(packed: zipfile.ZipFile) -> None:
    """Refuse what says that it is too large; what lies about it ends at the size it says."""
    size = sum(one.file_size for one in packed.infolist())
    if size > scaled(_MAX_BYTES):
        raise ArchiveError(
            f"it holds {size} bytes, at most {scaled(_MAX_BYTES)} are read; {HOW_TO_RAISE}"
        )


def _array(packed: zipfile.ZipFile, name: str) -> NDArray[Any]:
    import numpy as np

    with packed.open(name) as file:
        version = np.lib.format.read_magic(file)
        read = np.lib.format.read_array_header_1_0
        if version != (1, 0):
            read = np.lib.format.read_array_header_2_0
        shape, _, kind = read(file)
    # numpy makes room for the shape before it reads: one that the file does not hold is refused.
    if math.prod(shape) * kind.itemsize > packed.getinfo(name).file_size:
        raise ArchiveError(f"'{name}' says that it is {shape}, and holds less")
    with packed.open(name) as file:
        found: NDArray[Any] = np.lib.format.read_array(file, allow_pickle=False)
        return found
