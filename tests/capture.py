"""Reading what is printed, also while other threads go on printing.

pytest's own ``readouterr`` reads the file and then empties it; what a thread writes in between is
lost, and a test that waits for it waits for ever. Here the file is left as it is, and each look
goes on where the one before ended.
"""

from __future__ import annotations

import codecs
import os
from collections.abc import Callable
from typing import Any

import pytest

__all__ = ["capfd", "capsys"]


@pytest.fixture
def capfd(capfd: pytest.CaptureFixture[str]) -> pytest.CaptureFixture[str]:
    """pytest's, with nothing lost."""
    return _lossless(capfd, _text_of_file)


@pytest.fixture
def capsys(capsys: pytest.CaptureFixture[str]) -> pytest.CaptureFixture[str]:
    """pytest's, with nothing lost."""
    return _lossless(capsys, lambda text: str(text.getvalue()))


def _text_of_file(file: Any) -> str:
    # Seeking would move where the others write.
    data = os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0)
    # The last character may not be whole yet.
    return codecs.getincrementaldecoder("utf-8")(errors="replace").decode(data)


def _lossless(
    capture: pytest.CaptureFixture[str], text_of: Callable[[Any], str]
) -> pytest.CaptureFixture[str]:
    result = type(capture.readouterr())
    seen = [0, 0]

    def readouterr() -> Any:
        # Setup, call and teardown of a test have a capture each; a closed one leaves its text.
        texts = [capture._captured_out, capture._captured_err]
        running: Any = capture._capture
        if running is not None:
            texts[0] += text_of(running.out.tmpfile)
            texts[1] += text_of(running.err.tmpfile)
        new = [text[begin:] for text, begin in zip(texts, seen, strict=True)]
        seen[:] = map(len, texts)
        return result(*new)

    capture.readouterr = readouterr
    return capture
