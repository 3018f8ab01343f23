"""Handlers of Python's logging on a disk that may be full."""

from __future__ import annotations

import errno
import logging
import os
from pathlib import Path
from typing import Any

import pytest

from gazelle.log_handlers import RotatingLog, WatchedLog


@pytest.mark.parametrize("kind", [RotatingLog, WatchedLog])
def test_handlers_tell_of_a_full_disk_once_and_close(
    kind: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    handler = kind(tmp_path / "rosout.log")

    class Full:
        def write(self, text: str) -> None:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        flush = close = lambda self: self.write("")

    handler.stream.close()
    handler.stream = Full()
    handler.reopenIfNeeded = lambda: None
    handler.shouldRollover = lambda record: False
    for _ in range(2):
        handler.handle(logging.LogRecord("rosout", 0, "", 0, "text", None, None))
    handler.close()
    assert capsys.readouterr().err == (
        f"warning: {tmp_path / 'rosout.log'}: No space left on device; "
        "what cannot be written is missing there\n"
    )
