"""One node of a graph gathers the log, however many were started."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.rosout import run


class Gatherer:
    """A rosout on a graph of its own process' kind: another session on the same port."""

    def __init__(self, port: int) -> None:
        self.graph = Graph.open(port=port, role="hub", environ={})
        self.stop = threading.Event()
        arguments = (NodeArguments("rosout"), self.graph, self.stop)
        self.thread = threading.Thread(target=run, args=arguments, daemon=True)

    def end(self) -> None:
        """End it and leave the graph."""
        self.stop.set()
        if self.thread.is_alive():
            self.thread.join(stretched())
        self.graph.close()


@pytest.fixture
def gatherers(free_port: int) -> Iterator[list[Gatherer]]:
    """Two that were not started yet."""
    both = [Gatherer(free_port), Gatherer(free_port)]
    yield both
    for one in both:
        one.end()


def _names(gatherers: list[Gatherer]) -> list[str]:
    return [node.name for one in gatherers for node in one.graph.nodes]


def _until(graph: Graph, condition: Callable[[], bool]) -> None:
    assert graph.discovery.wait_for(lambda _known: condition(), stretched())


def test_the_second_stands_by_and_takes_over_when_the_first_ends(
    gatherers: list[Gatherer],
) -> None:
    first, second = gatherers
    first.thread.start()
    _until(second.graph, lambda: "/rosout" in second.graph.node_names())
    second.thread.start()
    second.thread.join(1.2)
    assert _names([first]) == ["/rosout"]
    assert _names([second]) == []
    first.end()
    _until(second.graph, lambda: _names([second]) == ["/rosout"])


def test_of_two_that_begin_together_one_stays(
    gatherers: list[Gatherer], monkeypatch: pytest.MonkeyPatch
) -> None:
    together = threading.Barrier(len(gatherers))

    def nothing_yet(_graph: Graph) -> tuple[()]:
        together.wait(stretched())
        return ()

    with monkeypatch.context() as blind:
        # Neither sees the other at its start, the worst that can happen.
        blind.setattr(Graph, "entities", nothing_yet)
        for one in gatherers:
            one.thread.start()
        eventually(lambda: any(one.graph.nodes for one in gatherers))

    def stays_one() -> bool:
        before = _names(gatherers)
        # Two looks.
        gatherers[0].thread.join(1.2)
        return before == _names(gatherers) == ["/rosout"]

    eventually(stays_one)


def test_a_killed_one_comes_back(gatherers: list[Gatherer]) -> None:
    first, second = gatherers
    first.thread.start()
    _until(second.graph, lambda: "/rosout" in second.graph.node_names())
    _until(second.graph, lambda: first.graph.nodes)
    (node,) = first.graph.nodes
    assert second.graph.kill_node("/rosout")
    _until(second.graph, lambda: node.closed and _names([first]) == ["/rosout"])


def test_two_launches_of_one_moment_share_one(gazelle: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "empty.launch"
    file.write_text(
        '<launch><node pkg="topic_tools" type="relay" name="$(anon relay)" args="/a /b"/></launch>',
        encoding="utf-8",
    )
    both = [gazelle("roslaunch", str(file)) for _ in range(2)]
    for one in both:
        one.wait_for_line(r"process\[relay")
    watcher = both[0]
    watcher.eventually(lambda: len([n for n in watcher.graph.node_names() if "relay" in n]) == 2)
    watcher.eventually(lambda: len(watcher.graph.subscriptions_info("/rosout")) == 1)
    assert [one.popen.poll() for one in both] == [None, None]
    assert [one.stop() for one in both] == [0, 0]
