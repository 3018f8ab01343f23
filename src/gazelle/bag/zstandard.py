"""Zstandard: Python's own from 3.14 on, its backport before."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle.bag.records import BagError

__all__ = ["ZSTD_MAGIC", "compress", "decompress", "unpack_file"]

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
_PIECE = 1 << 20


def compress(data: bytes) -> bytes:
    """Return one frame."""
    found: bytes = _library().compress(data)
    return found


def decompress(data: bytes) -> bytes:
    """Return what a frame holds.

    Raises:
        BagError: it is damaged, or none.
    """
    library = _library()
    try:
        found: bytes = library.decompress(data)
    except (library.ZstdError, EOFError) as error:
        raise BagError(f"a piece of zstd is damaged: {error}") from None
    return found


def unpack_file(source: Path, target: Path) -> None:
    """Write what a compressed file holds into another.

    Raises:
        BagError: the file is damaged, or ends too early, or there is no room.
    """
    library = _library()
    try:
        with library.open(source, "rb") as packed, target.open("wb") as file:
            while piece := packed.read(_PIECE):
                file.write(piece)
    except (library.ZstdError, EOFError) as error:
        raise BagError(f"{source}: the file is damaged or not whole: {error}") from None
    except OSError as error:
        raise BagError(f"{source}: cannot be decompressed into {target.parent}: {error}") from None


def _library() -> Any:
    try:
        from compression import zstd  # type: ignore[import-not-found]  # Python 3.14
    except ImportError:
        from backports import zstd
    return zstd
