"""Reading MCAP files, finished ones and those whose writer was killed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

from gazelle.bag.mcap.chunks import Chunk, decompress, messages_in
from gazelle.bag.mcap.records import MAGIC
from gazelle.bag.mcap.structure import LOOSE, Structure, read_structure
from gazelle.bag.ordering import Piece, by_time
from gazelle.bag.storage import (
    BagError,
    BagMessage,
    Connection,
    Storage,
    Summary,
    Wanted,
    counts_of,
    packs_of,
)

__all__ = ["McapBag"]


class McapBag:
    """An open MCAP file.

    Attributes:
        path: the file.
        is_indexed: it was closed properly.
        profile: what its header says, such as ``ros2``.
    """

    storage: str = Storage.MCAP

    def __init__(self, path: Path) -> None:
        """Open a file.

        Raises:
            BagError: it cannot be read or is not MCAP.
        """
        self.path = path
        try:
            self._file = path.open("rb")
        except OSError as error:
            raise BagError(f"Error opening file: {path}: {error.strerror}") from None
        if self._file.read(len(MAGIC)) != MAGIC:
            self._file.close()
            raise BagError(f"{path}: this is not an MCAP file")
        self._structure: Structure = read_structure(self._file)
        self.is_indexed = self._structure.is_indexed
        self.profile = self._structure.profile

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All channels, by number."""
        return tuple(one for _, one in sorted(self._structure.connections.items()))

    @property
    def summary(self) -> Summary:
        """What is in it."""
        chunks = self._structure.chunks
        return Summary(
            counts_of(chunks),
            min((one.start_ns for one in chunks), default=0),
            max((one.end_ns for one in chunks), default=0),
            self.path.stat().st_size,
            packs_of(chunks),
            self.is_indexed,
            self._structure.lost,
        )

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` channels between two stamps.

        Raises:
            BagError: a chunk is damaged.
        """
        numbers = {one.id for one in self.connections if wanted is None or wanted(one)}
        low = 0 if start_ns is None else start_ns
        high = (1 << 64) if end_ns is None else end_ns
        pieces = [
            Piece(chunk.start_ns, partial(self._load, chunk, numbers, low, high))
            for chunk in self._structure.chunks
            if chunk.end_ns >= low and chunk.start_ns <= high and numbers & chunk.counts.keys()
        ]
        return by_time(pieces)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _load(self, chunk: Chunk, numbers: set[int], low: int, high: int) -> Iterator[BagMessage]:
        self._file.seek(chunk.start)
        data = self._file.read(chunk.size)
        if chunk.compression != LOOSE:
            data = decompress(data, chunk.compression, chunk.uncompressed)
        connections = self._structure.connections
        for number, stamp_ns, message in messages_in(data):
            if number in numbers and low <= stamp_ns <= high:
                yield BagMessage(connections[number], stamp_ns, message)
