"""What rosbag2 compressed as a whole: files (``NAME.mcap.zstd``) and single messages."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from gazelle.bag.compression_formats import decompress_file, decompressed
from gazelle.bag.storage import (
    BagError,
    BagMessage,
    BagReader,
    Connection,
    Summary,
    Wanted,
)
from gazelle.rich_display import shown_by

__all__ = ["SUFFIX", "CompressedFile", "CompressedMessages"]

SUFFIX = ".zstd"
_Opener = Callable[[Path], BagReader]


@shown_by("bags:bag_bundle")
class CompressedFile:
    """A compressed file, read from a copy that is gone when it is closed.

    Attributes:
        path: the compressed file.
    """

    def __init__(self, path: Path, opener: _Opener) -> None:
        """Decompress a file and open it.

        Args:
            path: the compressed file.
            opener: opens the file that is in it.

        Raises:
            BagError: it is damaged, or holds no bag.
        """
        self.path = path
        self._folder = tempfile.TemporaryDirectory(prefix="gazelle_bag_")
        copy = Path(self._folder.name) / path.name.removesuffix(SUFFIX)
        try:
            decompress_file(path, copy)
            self._bag = opener(copy)
        except BaseException:
            self._folder.cleanup()
            raise
        self.storage = self._bag.storage

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All topics, by number."""
        return self._bag.connections

    @property
    def summary(self) -> Summary:
        """What is in it; the size is that of the copy."""
        return self._bag.summary

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` topics between two stamps."""
        return self._bag.messages(wanted, start_ns, end_ns)

    def close(self) -> None:
        """Close the file and remove its copy."""
        self._bag.close()
        self._folder.cleanup()


class CompressedMessages:
    """A file whose messages are compressed one by one.

    Attributes:
        path: the file.
    """

    def __init__(self, bag: BagReader) -> None:
        """Read what another reader gives."""
        self.path = bag.path
        self.storage = bag.storage
        self._bag = bag

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All topics, by number."""
        return self._bag.connections

    @property
    def summary(self) -> Summary:
        """What is in it."""
        return self._bag.summary

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, decompressed.

        Raises:
            BagError: a message is damaged; names its topic and time.
        """
        for one in self._bag.messages(wanted, start_ns, end_ns):
            try:
                yield one._replace(data=decompressed(one.data, "zstd"))
            except BagError as error:
                where = f"{one.connection.topic} at {one.stamp_ns} ns"
                raise BagError(f"{self.path}: message of {where}: {error}") from None

    def close(self) -> None:
        """Close the file."""
        self._bag.close()
