"""A graph that nobody else is on."""

from __future__ import annotations

import contextlib
import itertools
import os
import socket
from collections.abc import Iterator

from gazelle.errors import GraphError
from gazelle.graph.errors import PortTakenError
from gazelle.graph.graph import Graph

__all__ = ["open_graph"]

# Below the ports that systems hand out by themselves (from 32768 on Linux): those may go to some
# connection between our look and our listening.
_FIRST, _COUNT = 12_000, 16_000
# Workers of pytest-xdist have neighbouring process numbers; a prime keeps their ports apart.
_STRIDE = 61
_numbers = itertools.count()


def open_graph(port: int | None = None) -> Graph:
    """Open a graph of one's own; the caller closes it.

    Its hub is in this process, so the port is taken from the first moment to the last, and no
    other test, also of another worker or another run, gets the same.

    Args:
        port: of the hub; a free one when None.

    Raises:
        GraphError: the port asked for has a graph already, or another program's listener.
    """
    if port is not None:
        graph = _own(port)
        if graph is None:
            raise GraphError(
                f"port {port} has a graph already, so the test would not be alone\n"
                "  fix: leave the port out: every test then gets a free one"
            )
        return graph
    for free in _free_ports():
        with contextlib.suppress(PortTakenError):
            graph = _own(free)
            if graph is not None:
                return graph
    raise GraphError(f"no port from {_FIRST} to {_FIRST + _COUNT - 1} is free")


def _own(port: int) -> Graph | None:
    """Open a graph, None when another process carries it."""
    graph = Graph.open(port=port, role="hub", environ={})
    if graph.is_hub:
        return graph
    graph.close()
    return None


def _free_ports() -> Iterator[int]:
    """Yield the ports that nobody listens on."""
    for _ in range(_COUNT):
        port = _FIRST + (os.getpid() * _STRIDE + next(_numbers)) % _COUNT
        with socket.socket() as probe:
            # Not the graph's, but the page and others count their own ports from its number.
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
        yield port
