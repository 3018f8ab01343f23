"""A plug-in of pytest that makes messages and threads late: ``pytest -p tests.tardy``.

What comes by a topic waits up to a twentieth of a second, each subscription by itself, and so does
now and then a thread beside the test's own, at a call somewhere in its work: as on a machine with
much to do. No node may count on the order of two topics, and no test on what a thread has done
beside what it has seen of it, so one that fails with it does. The seed is in the header;
``GAZELLE_TARDY=SEED`` makes the same delays again, of messages to the letter.
"""

from __future__ import annotations

import os
import random
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

_LATEST_S = 0.05
_SHARE = 0.3
# Of a thread's calls: a busy one is late some ten times a second.
_SHARE_OF_CALLS = 1e-4
_SOURCES = str(Path(__file__).parents[1] / "src")


def _seed() -> int:
    return int(os.environ.setdefault("GAZELLE_TARDY", str(random.randrange(1_000_000))))


def pytest_configure() -> None:
    """Let threads that begin from now on be late."""
    draw = random.Random(_seed())

    def call(frame: FrameType, event: str, _argument: Any) -> None:
        is_late = event == "call" and draw.random() < _SHARE_OF_CALLS
        if is_late and frame.f_code.co_filename.startswith(_SOURCES):
            time.sleep(draw.uniform(0.0, _LATEST_S))

    threading.setprofile(call)


def pytest_report_header(config: pytest.Config) -> str:
    """Say how to do the same again."""
    return f"late messages: GAZELLE_TARDY={_seed()}"


@pytest.fixture(autouse=True)
def late_messages(request: pytest.FixtureRequest) -> Iterator[None]:
    """Let some messages be late in this test."""
    from gazelle.graph.subscription import Subscription

    draw = random.Random(f"{_seed()} {request.node.nodeid}")
    take = Subscription._handle

    def late(self: Subscription, item: Any) -> None:
        # What waits behind it is late enough: a stream must not fall back further and further.
        is_alone = self._take == self._callback_queue.put and self._callback_queue._items.empty()
        if is_alone and draw.random() < _SHARE:
            time.sleep(draw.uniform(0.0, _LATEST_S))
        take(self, item)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Subscription, "_handle", late)
        yield
