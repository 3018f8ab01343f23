"""A graph of its own for each test, on a free port, and means to wait without sleeping."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests import patience
from tests.patience import PATIENCE_S, await_change

from gazelle.graph import Graph, TimeJumpError


class Inbox:
    """Collects what a callback gets and lets a test wait for it."""

    def __init__(self) -> None:
        self.items: list[Any] = []
        self._changed = threading.Condition()

    def __call__(self, *items: Any) -> None:
        with self._changed:
            self.items.append(items[0] if len(items) == 1 else items)
            self._changed.notify_all()

    def wait_for(self, count: int, timeout_s: float = PATIENCE_S) -> list[Any]:
        with self._changed:
            in_time = await_change(self._changed, lambda: len(self.items) >= count, timeout_s)
            assert in_time, self.items
            return list(self.items)


def sleep_in_thread(sleep: Callable[[], Any]) -> tuple[threading.Thread, list[Any]]:
    """Begin a sleep on a clock; return its thread, and what it will have ended with."""
    outcome: list[Any] = []

    def run() -> None:
        try:
            outcome.append(sleep())
        except TimeJumpError as error:
            outcome.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread, outcome


@pytest.fixture
def port(free_port: int) -> int:
    return free_port


@pytest.fixture
def join(port: int) -> Iterator[Callable[..., Graph]]:
    """Opens graphs as if each were a process of its own."""
    opened: list[Graph] = []

    def open_one(**options: Any) -> Graph:
        opened.append(Graph.open(port=port, environ=options.pop("environ", {}), **options))
        return opened[-1]

    yield open_one
    for one in reversed(opened):
        one.close()


@pytest.fixture
def graph(join: Callable[..., Graph]) -> Graph:
    return join()


@pytest.fixture
def other(graph: Graph, join: Callable[..., Graph]) -> Graph:
    """A second member; the first one carries the hub."""
    return join()


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def make_inbox() -> type[Inbox]:
    return Inbox


@pytest.fixture
def eventually() -> Callable[..., Any]:
    """Waits until a condition gives something true, and returns it."""
    return patience.eventually
