"""What the tests of all bridges share: a graph, and means to wait without sleeping."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from gazelle.graph import Graph

_PATIENCE_S = 20.0


class Inbox:
    """Collects what a callback gets and lets a test wait for it."""

    def __init__(self) -> None:
        self.items: list[Any] = []
        self._changed = threading.Condition()

    def __call__(self, item: Any) -> None:
        with self._changed:
            self.items.append(item)
            self._changed.notify_all()

    def wait_for(self, count: int) -> list[Any]:
        with self._changed:
            assert self._changed.wait_for(lambda: len(self.items) >= count, _PATIENCE_S), self.items
            return list(self.items)


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def make_inbox() -> type[Inbox]:
    return Inbox


@pytest.fixture
def eventually() -> Callable[[Callable[[], Any]], Any]:
    """Waits until a condition gives something true, and returns it."""

    def wait(condition: Callable[[], Any]) -> Any:
        deadline = time.monotonic() + _PATIENCE_S
        pause = threading.Event()
        while not (found := condition()):
            assert time.monotonic() < deadline, "did not happen in time"
            pause.wait(0.005)
        return found

    return wait


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """What the robot's side has joined; carries the hub."""
    with Graph.open(port=free_port, environ={}) as opened:
        yield opened
