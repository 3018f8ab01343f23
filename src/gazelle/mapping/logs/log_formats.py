"""A log of any format that needs no graph, by its content."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.mapping.logs.carmen import read_carmen
from gazelle.mapping.logs.log_record import LogRecord, opened
from gazelle.mapping.logs.numpy_archive import read_archive

__all__ = ["LogRecord", "is_carmen", "read_log"]

_PEEK_BYTES = 1 << 16
_CARMEN_WORDS = (b"FLASER ", b"ROBOTLASER1 ", b"ODOM ", b"PARAM ", b"# CARMEN", b"RAWLASER1 ")


def read_log(path: Path, diagnostics: Diagnostics) -> Iterator[LogRecord]:
    """Yield the scans of a CARMEN log or of a numpy archive.

    Raises:
        OSError: the file cannot be read.
    """
    if is_carmen(path):
        yield from read_carmen(path, diagnostics)
    elif path.suffix == ".npz":
        yield from read_archive(path, diagnostics)
    else:
        diagnostics.report(
            "mapping.log-unreadable",
            "this is no CARMEN log (no line begins with FLASER, ROBOTLASER1 or ODOM), no .npz "
            "archive and no bag",
            SourceSpan(str(path)),
        )


def is_carmen(path: Path) -> bool:
    """Return whether a line near a file's start is one of CARMEN's; gzip may have packed it.

    Raises:
        OSError: the file cannot be read, or is damaged.
    """
    with opened(path) as file:
        start = file.read(_PEEK_BYTES)
    return any(start.startswith(word) or b"\n" + word in start for word in _CARMEN_WORDS)
