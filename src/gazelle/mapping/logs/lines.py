"""The lines of a log, packed by gzip or not, in bounds."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, cast

from gazelle.documents import HOW_TO_RAISE, FileLimitError, scaled

__all__ = ["lines_of", "opened"]

_MAGIC = b"\x1f\x8b"
_MAX_BYTES = 4 << 30
_MAX_LINE = 4 << 20


@contextmanager
def opened(path: Path) -> Iterator[BinaryIO]:
    """Open a log to read it; what gzip has packed is unpacked on the way.

    Raises:
        OSError: it cannot be read, or is damaged.
    """
    with path.open("rb") as file:
        is_packed = file.read(len(_MAGIC)) == _MAGIC
        file.seek(0)
        try:
            yield cast(BinaryIO, gzip.GzipFile(fileobj=file)) if is_packed else file
        except (EOFError, zlib.error) as error:
            raise OSError(0, f"the file is damaged: {error}", str(path)) from error


def lines_of(path: Path) -> Iterator[str]:
    """Yield the lines of a log.

    Raises:
        OSError: it cannot be read, is damaged, or longer than is read.
    """
    left = scaled(_MAX_BYTES)
    with opened(path) as file:
        while line := file.readline(_MAX_LINE):
            left -= len(line)
            if left < 0 or len(line) == _MAX_LINE:
                what = f"a line is longer than {_MAX_LINE} bytes"
                if left < 0:
                    what = f"it is longer than {scaled(_MAX_BYTES)} bytes"
                raise FileLimitError(0, what, str(path), f"; {HOW_TO_RAISE}" if left < 0 else "")
            yield line.decode(errors="replace")
