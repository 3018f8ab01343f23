"""What the tests of all bridges share: a graph, and means to wait without sleeping."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests import patience
from tests.patience import await_change

from gazelle.graph import Graph


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
            assert await_change(self._changed, lambda: len(self.items) >= count), self.items
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

    return patience.eventually


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """What the robot's side has joined; carries the hub."""
    with Graph.open(port=free_port, environ={}) as opened:
        yield opened
