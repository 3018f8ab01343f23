"""A graph with a Studio on it, and pages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.studio.page import Page

from gazelle.graph import Graph, Node
from gazelle.interfaces import fill, message_type
from gazelle.studio import Server, Studio


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of the test."""
    with Graph.open(port=free_port, role="hub", environ={}) as opened:
        yield opened


@pytest.fixture
def node(graph: Graph) -> Iterator[Node]:
    """A node of the test."""
    made = graph.create_node("test", rosout=False)
    yield made
    made.shutdown()


@pytest.fixture
def server(graph: Graph) -> Iterator[Server]:
    """A server on the graph, on any free port."""
    with Server(Studio(graph), port=0) as made:
        yield made


@pytest.fixture
def connected(server: Server) -> Iterator[Callable[..., Page]]:
    """Opens pages; they close with the test."""
    pages: list[Page] = []

    def make(**headers: str) -> Page:
        pages.append(Page(server.port, **headers))
        return pages[-1]

    yield make
    for page in pages:
        page.close()


@pytest.fixture
def page(connected: Callable[..., Page]) -> Page:
    """A page."""
    return connected()


Talk = Callable[..., Any]


@pytest.fixture
def talk(node: Node) -> Talk:
    """Publishes a message with fields on a topic; each topic has one publisher."""
    publishers: dict[str, Any] = {}

    def publish(topic: str, type_name: str, **fields: Any) -> Any:
        message_class = message_type(type_name)
        latch = bool(fields.pop("latch", False))
        if topic not in publishers:
            publishers[topic] = node.create_publisher(topic, message_class, latch=latch)
        message = message_class()
        fill(message, fields)
        publishers[topic].publish(message)
        return publishers[topic]

    return publish
