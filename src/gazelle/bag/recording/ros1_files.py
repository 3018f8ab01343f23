"""ROS 1 bags while they are recorded: ``NAME.bag.active``, and a new file at every split."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from gazelle.bag.formats import ROS1, UNFINISHED
from gazelle.bag.ros1 import CHUNK_BYTES, Compression, Ros1Writer
from gazelle.bag.storage import BagMessage, Connection

__all__ = ["Ros1Files", "default_stem"]


def default_stem(prefix: str = "") -> str:
    """Return the name of a bag by the time: ``PREFIX_2026-11-22-10-30-00``."""
    date = time.strftime("%Y-%m-%d-%H-%M-%S")
    return f"{prefix}_{date}" if prefix else date


class Ros1Files:
    """Writes one ``.bag`` after the other.

    Attributes:
        path: where the bag that is being written ends up.
    """

    storage = ROS1.name
    encoding = ROS1.encoding

    def __init__(
        self,
        stem: Callable[[], str],
        *,
        split: bool = False,
        compression: Compression = Compression.NONE,
        chunk_bytes: int = CHUNK_BYTES,
        most_files: int = 0,
        repeat_latched: bool = False,
    ) -> None:
        """Prepare the first file; the first flush or message creates it.

        Args:
            stem: gives the name of each file, without ``.bag``.
            split: number the files.
            compression: of the chunks.
            chunk_bytes: when a chunk is full.
            most_files: the oldest file is deleted when there are more; 0 keeps all.
            repeat_latched: write the last messages of latched topics into every file.
        """
        self._stem = stem
        self._split = split
        self._options = {"compression": compression, "chunk_bytes": chunk_bytes}
        self._most_files = most_files
        self._repeats = repeat_latched
        self._count = 0
        self._done: list[Path] = []
        self._connections: list[Connection] = []
        self._own: dict[int, Connection] = {}
        self._latched: dict[int, BagMessage] = {}
        self._next()

    @property
    def size(self) -> int:
        """Bytes of the file that is being written."""
        return 0 if self._writer is None else self._writer.size

    @property
    def restored(self) -> int:
        """How often the file was written anew because somebody had removed it."""
        return 0 if self._writer is None else self._writer.restored

    def add(self, connection: Connection) -> Connection:
        """Add a connection; returns it with its number in these bags."""
        own = replace(connection, id=len(self._connections))
        self._connections.append(own)
        return own

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message."""
        own = self._own.get(connection.id)
        if own is None:
            own = self._own[connection.id] = self._file().add(connection)
        self._file().write(own, stamp_ns, data)
        if self._repeats and connection.latching:
            self._latched[connection.id] = BagMessage(connection, stamp_ns, data)

    def flush(self) -> None:
        """Hand everything to the system."""
        self._file().flush()

    def split(self, stamp_ns: int) -> Path:
        """Go on in a new file; returns the finished one."""
        done = self._finish()
        if self._most_files and len(self._done) >= self._most_files:
            self._done.pop(0).unlink(missing_ok=True)
        self._next()
        self._file()
        for message in self._latched.values():
            self.write(message.connection, stamp_ns, message.data)
        return done

    def close(self) -> None:
        """Finish the last file."""
        self._finish()

    def _next(self) -> None:
        stem = self._stem() + (f"_{self._count}" if self._split else "")
        self._count += 1
        self.path = Path(f"{stem}{ROS1.suffix}")
        self._active = Path(f"{stem}{ROS1.suffix}{UNFINISHED}")
        self._writer: Ros1Writer | None = None
        self._own = {}

    def _file(self) -> Ros1Writer:
        if self._writer is None:
            self._writer = Ros1Writer(self._active, **self._options)  # type: ignore[arg-type]
        return self._writer

    def _finish(self) -> Path:
        self._file().close()
        if self._active.exists():
            self._active.replace(self.path)
            self._done.append(self.path)
        return self.path
