"""Reading files that may be endless, enormous, or no files at all."""

from __future__ import annotations

import errno
import os
import select
import stat
from pathlib import Path

from gazelle.limits.scale import HOW_TO_RAISE, scaled

__all__ = ["FileLimitError", "read_limited"]

_MEBIBYTE = 1 << 20
_CHUNK = 4 << 20


class FileLimitError(OSError):
    """A file is larger than is read, or is no file with an end; ``strerror`` says which."""


def read_limited(path: str | os.PathLike[str], most_bytes: int) -> bytes:
    """Return a file's bytes without waiting for ever and without filling the memory.

    Pipes are read to their end, as shells give them for ``<(command)``; one that nobody writes to
    is empty. Devices are refused.

    Args:
        path: the file.
        most_bytes: how many bytes are read at most; `scaled` applies.

    Raises:
        FileLimitError: it is larger, or a device.
        OSError: it cannot be read.
    """
    most = scaled(most_bytes)
    # Without waiting: opening a pipe that nobody writes to would.
    number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
    try:
        info = os.fstat(number)
        if stat.S_ISDIR(info.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        if stat.S_ISCHR(info.st_mode) or stat.S_ISBLK(info.st_mode):
            if str(path) == os.devnull:
                return b""
            raise FileLimitError(errno.EINVAL, "it is a device, not a file", str(path))
        if stat.S_ISREG(info.st_mode) and info.st_size > most:
            raise _too_large(path, f"it has {info.st_size} bytes", most)
        data = _read(number, most)
    finally:
        os.close(number)
    if len(data) > most:
        raise _too_large(path, "it goes on without end", most)
    return data


def _read(number: int, most: int) -> bytes:
    """Return what can be read; of something larger one byte more than the limit."""
    parts: list[bytes] = []
    count = 0
    while count <= most:
        try:
            part = os.read(number, min(_CHUNK, most + 1 - count))
        except BlockingIOError:
            select.select([number], [], [])
            continue
        if not part:
            break
        parts.append(part)
        count += len(part)
    return b"".join(parts)


def _too_large(path: str | os.PathLike[str], what: str, most: int) -> FileLimitError:
    text = f"{what}, the limit is {most / _MEBIBYTE:g} MiB ({HOW_TO_RAISE})"
    return FileLimitError(errno.EFBIG, text, str(Path(path)))
