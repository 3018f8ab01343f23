"""Compressed pieces of bags, decompressed no further than they say, and than there is room for.

A few kilobytes can be written that would be gigabytes, so nothing is decompressed whole before its
size is looked at.
"""

from __future__ import annotations

import bz2
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.bag.storage import BagError
from gazelle.documents import HOW_TO_RAISE, scaled

__all__ = ["ZSTD_MAGIC", "compress_zstd", "decompress_file", "decompressed"]

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
_MAX_BYTES = 512 << 20
_PIECE = 1 << 20
# Pictures of one colour shrink to a thousandth; what shrinks further is no recording.
_MAX_TIMES = 1000


def compress_zstd(data: bytes) -> bytes:
    """Return one frame."""
    frame: bytes = _zstd_library().compress(data)
    return frame


def decompressed(data: bytes, compression: str, size: int | None = None) -> bytes:
    """Return what a compressed piece of a bag holds.

    Args:
        data: one frame, or several one after the other.
        compression: ``bz2``, ``lz4`` or ``zstd``.
        size: how many bytes it has to hold, None where that is not known.

    Raises:
        BagError: it is damaged, or holds another number of bytes, or more than are unpacked
            (512 MiB).
    """
    most = scaled(_MAX_BYTES)
    name = f"a {'piece' if size is None else 'chunk'} of {compression}"
    if size is not None and size > most:
        raise _too_large(name, f"is said to hold {size} bytes", most)
    limit = most if size is None else size
    found, left = b"", data
    while left and len(found) <= limit:
        decompressor = _DECOMPRESSORS[compression]()
        try:
            found += decompressor.decompress(left, limit + 1 - len(found))
        except Exception as error:  # noqa: BLE001 - each library has errors of its own
            raise BagError(f"{name} is damaged: {error}") from None
        if not decompressor.eof and len(found) <= limit:
            raise BagError(f"{name} is damaged: it ends too early")
        left = decompressor.unused_data if decompressor.eof else b""
    if size is None and len(found) > limit:
        raise _too_large(name, "goes on and on", most)
    if size is not None and len(found) != size:
        number = f"more than {size}" if len(found) > size else f"{len(found)}"
        raise BagError(f"{name} holds {number} bytes, not {size}")
    return found


def decompress_file(source: Path, target: Path) -> None:
    """Write what a file compressed with zstd holds into another.

    Raises:
        BagError: the file is damaged, or ends too early, or there is no room, or it holds more
            than a thousand times its own size.
    """
    library = _zstd_library()
    try:
        left = scaled(max(_MAX_BYTES, _MAX_TIMES * source.stat().st_size))
        with library.open(source, "rb") as packed, target.open("wb") as file:
            while piece := packed.read(_PIECE):
                left -= len(piece)
                if left < 0:
                    raise BagError(
                        f"{source}: the file holds more than {_MAX_TIMES} times its own size, "
                        f"which no recording does; {HOW_TO_RAISE}"
                    )
                file.write(piece)
    except (library.ZstdError, EOFError) as error:
        raise BagError(f"{source}: the file is damaged or not whole: {error}") from None
    except OSError as error:
        raise BagError(f"{source}: cannot be decompressed into {target.parent}: {error}") from None


def _zstd_library() -> Any:
    """Return Zstandard: Python's own from 3.14 on, its backport before."""
    try:
        from compression import zstd  # type: ignore[import-not-found]  # Python 3.14
    except ImportError:
        from backports import zstd
    return zstd


def _too_large(name: str, what: str, most: int) -> BagError:
    text = f"{name} {what}, at most {most} are unpacked"
    return BagError(f"{text}; {HOW_TO_RAISE}")


def _lz4() -> Any:
    import lz4.frame

    return lz4.frame.LZ4FrameDecompressor()


_DECOMPRESSORS: dict[str, Callable[[], Any]] = {
    "bz2": bz2.BZ2Decompressor,
    "lz4": _lz4,
    "zstd": lambda: _zstd_library().ZstdDecompressor(),
}
