"""A costmap's own thread."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, cast

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.nodes.navigation.live import LiveCostmap


class Slow(LiveCostmap):
    """Its update takes as long as the test wants."""

    def __init__(self, graph: Graph, said: list[str]) -> None:
        costmap = SimpleNamespace(options=SimpleNamespace(update_frequency=5.0), layers=())
        assembly = SimpleNamespace(
            settings=SimpleNamespace(name="local_costmap"),
            costmap=costmap,
            sources={},
        )
        publisher = SimpleNamespace(close=lambda: said.append("closed"))
        made: tuple[Any, ...] = (graph.create_node("mapper"), None, assembly, publisher)
        super().__init__(*cast(Any, made))
        self.said = said
        self.begun, self.goes_on = threading.Event(), threading.Event()

    def update(self) -> bool:
        self.begun.set()
        self.goes_on.wait(stretched())
        self.said.append("updated")
        return True


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of its own."""
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


def test_update_at_work_is_published_before_its_topics_close(graph: Graph) -> None:
    said: list[str] = []
    costmap = Slow(graph, said)
    costmap.start()
    assert costmap.begun.wait(stretched())
    closing = threading.Thread(target=costmap.close)
    closing.start()
    eventually(costmap._stop.is_set)
    costmap.goes_on.set()
    closing.join(stretched())
    assert said == ["updated", "closed"]
