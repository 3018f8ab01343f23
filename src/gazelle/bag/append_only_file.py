"""A file that only grows: what is written is the system's at once, also when we are killed."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from gazelle.bag.storage import BagError

__all__ = ["AppendedFile"]

_MAX_BUFFERS = 512
_PIECE_BYTES = 1 << 20


class AppendedFile:
    """Appends without a buffer of its own.

    Attributes:
        path: the file.
        size: bytes written.
        restored: how often somebody had removed it and it was written anew.
    """

    def __init__(self, path: Path, start: int | None = None) -> None:
        """Create the file, empty; or go on in one that is there.

        Args:
            path: the file.
            start: where to go on; what is behind it goes. None creates the file anew.

        Raises:
            BagError: the file system refuses it.
        """
        self.path = path
        self.size = start or 0
        self.restored = 0
        anew = os.O_CREAT | os.O_TRUNC if start is None else 0
        try:
            self._file = os.open(path, os.O_RDWR | anew, 0o644)
            if start is not None:
                os.ftruncate(self._file, start)
                os.lseek(self._file, start, os.SEEK_SET)
        except OSError as error:
            raise BagError(f"Error opening file: {path}: {error.strerror}") from None

    def append(self, pieces: Sequence[bytes]) -> None:
        """Write pieces one after the other.

        Raises:
            BagError: the file system refuses it, as when it is full.
        """
        waiting = [memoryview(piece) for piece in pieces if piece]
        try:
            self._restore_if_removed()
            while waiting:
                count = os.writev(self._file, waiting[:_MAX_BUFFERS])
                self.size += count
                waiting = _rest(waiting, count)
        except OSError as error:
            raise BagError(f"Error writing to file: {self.path}: {error.strerror}") from None

    def replace(self, data: bytes, position: int) -> None:
        """Write over bytes that are there."""
        os.pwrite(self._file, data, position)

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)

    def _restore_if_removed(self) -> None:
        """Write everything into a new file when the old one is in no folder any more."""
        if os.fstat(self._file).st_nlink:
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        new = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
        try:
            at = 0
            while piece := os.pread(self._file, _PIECE_BYTES, at):
                at += os.write(new, piece)
        except OSError:
            os.close(new)
            self.path.unlink()
            raise
        os.close(self._file)
        self._file = new
        self.restored += 1


def _rest(pieces: list[memoryview], written: int) -> list[memoryview]:
    for index, piece in enumerate(pieces):
        if written < len(piece):
            return [piece[written:], *pieces[index + 1 :]]
        written -= len(piece)
    return []
