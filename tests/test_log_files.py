"""Log files on a disk that may be full."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.log_files import LogStream


class Disk:
    """What writes to files, as long as there is room."""

    def __init__(self, write: Callable[[int, bytes], int]) -> None:
        self.is_full = False
        self._write = write

    def write(self, descriptor: int, data: bytes) -> int:
        if self.is_full:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return self._write(descriptor, data[:3])


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Disk:
    made = Disk(os.write)
    monkeypatch.setattr("gazelle.log_files.os.write", made.write)
    return made


def test_lines_of_a_full_disk_are_left_out_and_that_is_told_once(
    tmp_path: Path, disk: Disk, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "node.log"
    stream = LogStream(path)
    stream.write("one\n")
    disk.is_full = True
    stream.write("two\n")
    stream.write("three\n")
    assert capsys.readouterr().err == (
        f"warning: {path}: No space left on device; what cannot be written is missing there\n"
    )
    disk.is_full = False
    stream.write("four\n")
    disk.is_full = True
    stream.write("five\n")
    assert capsys.readouterr().err == ""
    stream.close()
    stream.write("six\n")
    assert path.read_text(encoding="utf-8").splitlines() == [
        "one",
        "… 2 lines are missing here: they could not be written",
        "four",
    ]
