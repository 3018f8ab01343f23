"""A graph, a bridge that is the master, and nodes of ROS 1 written for tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from tests.bridge.ros1.peer import Peer
from tests.bridge.ros1.real import NO_ROS1, has_ros1

from gazelle.bridge.ros1 import Address, Bridge, MasterAddress
from gazelle.graph import Graph

_LOOPBACK = "127.0.0.1"
ADDRESS = Address(_LOOPBACK, _LOOPBACK, frozenset({_LOOPBACK, "localhost"}))


@pytest.fixture
def make_bridge(graph: Graph) -> Iterator[Callable[..., Bridge]]:
    """Makes bridges that are on the graph as processes of their own would be."""
    made: list[tuple[Graph, Bridge]] = []

    def make(place: MasterAddress | None = None) -> Bridge:
        own = Graph.open(port=graph.port, environ={})
        bridge = None
        try:
            bridge = Bridge(own, place or MasterAddress(_LOOPBACK, 0), ADDRESS)
        finally:
            if bridge is None:
                own.close()
        made.append((own, bridge))
        return bridge

    yield make
    for own, bridge in reversed(made):
        bridge.close()
        own.close()


@pytest.fixture
def bridge(make_bridge: Callable[..., Bridge]) -> Bridge:
    """A bridge that is the master."""
    return make_bridge()


@pytest.fixture
def make_peer(bridge: Bridge) -> Iterator[Callable[..., Peer]]:
    """Makes nodes of ROS 1."""
    made: list[Peer] = []

    def make(name: str = "/peer") -> Peer:
        made.append(Peer(bridge.master.uri, name))
        return made[-1]

    yield make
    for one in made:
        one.close()


@pytest.fixture
def peer(make_peer: Callable[..., Peer]) -> Peer:
    return make_peer()


@pytest.fixture(scope="session")
def real_ros() -> None:
    """Skips where ROS 1 is not installed."""
    if not has_ros1():
        pytest.skip(NO_ROS1)
