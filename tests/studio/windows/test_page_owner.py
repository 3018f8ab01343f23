"""One page for a graph, whoever serves it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import pytest

from gazelle.graph import Graph
from gazelle.studio.security import token_of_user
from gazelle.studio.windows.page_owner import Request, page_port, present

_WAIT_S = 20.0


class _Command:
    """A window's command, as a process of its own would be."""

    def __init__(self, port: int, panel: str) -> None:
        self.graph = Graph.open(port=port, environ={})
        self.node = self.graph.create_node(panel, rosout=False)
        self.said: list[str] = []
        self._stop = threading.Event()
        self._heard = threading.Condition()
        self._thread = threading.Thread(
            target=present, args=(self.node, Request(panel), self._stop, self._say)
        )
        self._thread.start()

    def _say(self, text: str) -> None:
        with self._heard:
            self.said.append(text)
            self._heard.notify_all()

    def hears(self) -> str:
        with self._heard:
            assert self._heard.wait_for(lambda: self.said, _WAIT_S)
            return self.said[0]

    def serves(self) -> bool:
        return any(thread.name == "studio server" for thread in threading.enumerate())

    def end(self) -> None:
        self._stop.set()
        self._thread.join(_WAIT_S)
        self.graph.close()


@pytest.fixture
def command(free_port: int) -> Iterator[Callable[[str], _Command]]:
    with Graph.open(port=free_port, environ={}, role="hub"):
        begun: list[_Command] = []

        def begin(panel: str) -> _Command:
            begun.append(_Command(free_port, panel))
            return begun[-1]

        yield begin
        for one in begun:
            one.end()


def test_second_command_is_shown_on_the_page_of_the_first(
    command: Callable[[str], _Command],
) -> None:
    first = command("rqt_graph")
    url = first.hears().removeprefix("rqt_graph: ")
    assert url == f"http://127.0.0.1:{page_port(first.graph)}/?token={token_of_user()}"
    second = command("rqt_plot")
    assert second.hears() == f"rqt_plot: {url}"


def test_page_is_served_on_at_its_address_when_its_server_ends(
    command: Callable[[str], _Command],
) -> None:
    first = command("rqt_graph")
    first.hears()
    second = command("rqt_plot")
    second.hears()
    first.end()
    watcher = second.graph
    assert watcher.wait_for_service("/_gazelle/studio", _WAIT_S)
    third = command("rviz")
    assert third.hears() == f"rviz: http://127.0.0.1:{page_port(watcher)}/?token={token_of_user()}"


def test_graphs_side_by_side_have_pages_side_by_side(free_port: int) -> None:
    with Graph.open(port=free_port, environ={}) as graph:
        assert page_port(graph) in (0, free_port + 643)
