"""Reading files that may be endless, enormous, no files at all, or saved by a newer Gazelle."""

from __future__ import annotations

import errno
import math
import os
import select
import stat
from glob import glob

from gazelle.errors import GazelleError

__all__ = [
    "HOW_TO_RAISE",
    "TEXT_BYTES",
    "FileLimitError",
    "LimitError",
    "exists",
    "is_file",
    "is_folder",
    "names_matching",
    "read_limited",
    "read_text_limited",
    "refused_version",
    "scaled",
]

# Python's glob goes into itself at each "/".
_MAX_PATTERN_DEPTH = 100
_VARIABLE = "GAZELLE_LIMITS"
HOW_TO_RAISE = f"if the file means it, set the environment variable {_VARIABLE}=10 for ten times"
"""What to do about a limit, for messages."""
TEXT_BYTES = 64 << 20
"""Size of the largest text that is read, in bytes."""
_MEBIBYTE = 1 << 20
_CHUNK = 4 << 20


class LimitError(GazelleError):
    """The work a file asks for is above a limit."""


class FileLimitError(OSError):
    """A file is larger than is read, or is no file with an end.

    Attributes:
        reason: which of it, without the advice that ``strerror`` ends with.
    """

    def __init__(self, number: int, reason: str, path: str, advice: str = "") -> None:
        self.reason = reason
        super().__init__(number, reason + advice, path)


def refused_version(what: str, version: object, known: int) -> str:
    """Return why a saved file is not read, empty for a version that is known.

    Args:
        what: names the file, such as ``the layout 'desk'``.
        version: as it stands in the file.
        known: the newest that this Gazelle reads; it reads the older ones, too.
    """
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        return f"{what} is of version {version!r}, which is none: versions are 1, 2, 3 …"
    if version <= known:
        return ""
    text = f"{what} is of version {version}, saved by a newer Gazelle; this one reads versions up "
    return text + f"to {known} (pip install --upgrade gazelle-sim)"


def exists(path: str | os.PathLike[str]) -> bool:
    """Tell whether something of this name is there; False where nobody can tell."""
    return os.path.exists(path)  # noqa: PTH110


def is_file(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file of this name is there; False where nobody can tell."""
    return os.path.isfile(path)  # noqa: PTH113


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Tell whether a folder of this name is there; False where nobody can tell."""
    return os.path.isdir(path)  # noqa: PTH112


def names_matching(pattern: str, folder: str | os.PathLike[str]) -> list[str]:
    """Return what a pattern with ``*``, ``?``, ``[…]`` and ``**`` finds in a folder, sorted.

    The names are relative to the folder. What no path can be finds nothing.
    """
    if "\0" in pattern or pattern.count("/") + pattern.count(os.sep) > _MAX_PATTERN_DEPTH:
        return []
    return sorted(glob(pattern, root_dir=folder, recursive=True))  # noqa: PTH207


def scaled(count: int) -> int:
    """Return a limit times what ``GAZELLE_LIMITS`` says, which is 1 when it is not set.

    Raises:
        GazelleError: the variable is not a number above 0.
    """
    text = os.environ.get(_VARIABLE, "")
    if not text:
        return count
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not (math.isfinite(factor) and factor > 0):
        raise GazelleError(f"{_VARIABLE}='{text}' is not a number above 0, such as 10")
    return int(count * factor)


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
