"""Fixtures for built-in nodes: a graph, a node that runs in a thread, a keyboard."""

from __future__ import annotations

import os
import pty
import sys
import termios
import threading
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.nodes.host import run_node


class Bench:
    """A graph with built-in nodes and a node of the test.

    Attributes:
        graph: the graph.
        node: the test's own.
    """

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self.node = graph.create_node("test", rosout=False)
        self._running: list[tuple[threading.Event, threading.Thread, list[int]]] = []

    def start(self, name: str, *words: str) -> None:
        """Run a built-in node (``package/type``) in a thread."""
        stop, codes = threading.Event(), []

        def run() -> None:
            codes.append(run_node({"node": name, "argv": list(words)}, self.graph, stop))

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        self._running.append((stop, thread, codes))

    def stop(self) -> list[int]:
        """Tell all nodes to end; return their exit codes."""
        for stop, _thread, _codes in self._running:
            stop.set()
        return self.wait()

    def wait(self) -> list[int]:
        """Wait for the end of all nodes; return their exit codes."""
        for _stop, thread, _codes in self._running:
            thread.join(stretched())
        return [code for _stop, _thread, codes in self._running for code in codes]

    def listen(self, topic: str, kind: str) -> list[Any]:
        """Return a list that a topic's messages are added to."""
        got: list[Any] = []
        self.node.create_subscription(topic, kind, got.append)
        return got

    def call(self, name: str, kind: str, /, **fields: Any) -> Any:
        """Call a service."""
        from gazelle.interfaces import service_type

        service = service_type(kind)
        client = self.node.create_client(name, service)
        assert client.wait_for_service(stretched()), name
        return client.call(service.Request(**fields), timeout_s=stretched())

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return eventually(condition)


@pytest.fixture
def bench(free_port: int) -> Iterator[Bench]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        made = Bench(graph)
        yield made
        made.stop()


class Keyboard:
    """A pseudo terminal as standard input.

    Attributes:
        before: its settings at the beginning.
    """

    def __init__(self) -> None:
        self._keys, self.seen = pty.openpty()
        self.before = termios.tcgetattr(self.seen)

    @property
    def settings(self) -> list[Any]:
        """The settings now."""
        return termios.tcgetattr(self.seen)

    def type(self, text: str) -> None:
        """Press keys."""
        os.write(self._keys, text.encode())

    def hang_up(self) -> None:
        """Close the window of the terminal."""
        os.close(self._keys)
        self._keys = -1

    def close(self) -> None:
        """Take the terminal away."""
        for one in (self._keys, self.seen):
            if one >= 0:
                os.close(one)


@pytest.fixture
def keyboard(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> Iterator[Keyboard]:
    made = Keyboard()
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(fileno=lambda: made.seen))
    yield made
    # Nodes that read it end first.
    bench.stop()
    made.close()
