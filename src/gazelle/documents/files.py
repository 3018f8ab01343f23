"""Reading files that may be endless, enormous, or no files at all."""

from __future__ import annotations

import errno
import os
import select
import stat

from gazelle.documents.scale import HOW_TO_RAISE, scaled

__all__ = ["TEXT_BYTES", "FileLimitError", "read_limited", "read_text_limited"]

TEXT_BYTES = 64 << 20
"""Size of the largest text that is read, in bytes."""

_MEBIBYTE = 1 << 20
_CHUNK = 4 << 20


class FileLimitError(OSError):
    """A file is larger than is read, or is no file with an end.

    Attributes:
        reason: which of it, without the advice that ``strerror`` ends with.
    """

    def __init__(self, number: int, reason: str, path: str, advice: str = "") -> None:
        self.reason = reason
        super().__init__(number, reason + advice, path)


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


def read_text_limited(path: str | os.PathLike[str], most_bytes: int = TEXT_BYTES) -> str:
    """Return a file's text; errors as in `read_limited`.

    Raises:
        UnicodeDecodeError: it is not UTF-8.
    """
    text = read_limited(path, most_bytes).decode("utf-8")
    return text.replace("\r\n", "\n").replace("\r", "\n")


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
    text = f"{what}, the limit is {most / _MEBIBYTE:g} MiB"
    return FileLimitError(errno.EFBIG, text, str(path), f" ({HOW_TO_RAISE})")
