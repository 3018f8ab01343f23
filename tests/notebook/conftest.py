"""What a test of notebooks leaves behind."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest


@pytest.fixture(autouse=True)
def _no_picture_is_being_drawn_afterwards() -> Iterator[None]:
    """The first picture's kernels may be compiling after the cell is shown."""
    yield
    for thread in threading.enumerate():
        if thread.name == "gazelle still":
            thread.join()
