"""A graph that closes waits for calls that are in the transport."""

from __future__ import annotations

import threading

from tests.patience import stretched

from gazelle.graph import Graph
from gazelle.graph.errors import GraphError
from gazelle.graph.sessions import CallsInFlight
from gazelle.interfaces import service_type


def test_waiting_threads_are_counted() -> None:
    calls = CallsInFlight()
    assert calls.wait_until_none(0.0)
    with calls.waiting():
        assert not calls.wait_until_none(0.0)
    assert calls.wait_until_none(0.0)


def test_no_thread_is_left_in_a_call_when_the_graph_is_closed(free_port: int) -> None:
    empty = service_type("std_srvs/Empty")
    asked, done = threading.Event(), threading.Event()
    ended: list[Exception] = []

    def never(request: object) -> object:
        asked.set()
        done.wait(stretched(30))
        return empty.Response()

    def call() -> None:
        try:
            node.create_client("/never", empty).call(empty.Request())
        except GraphError as error:
            ended.append(error)

    with Graph.open(port=free_port, role="hub", environ={}) as hub:
        hub.create_node("server", rosout=False).create_service("/never", empty, never)
        with Graph.open(port=free_port, role="client", environ={}) as graph:
            node = graph.create_node("caller", rosout=False)
            thread = threading.Thread(target=call, daemon=True)
            thread.start()
            assert asked.wait(stretched(30))
        assert graph.calls.wait_until_none(0.0)
        thread.join(stretched(30))
        done.set()
    assert not thread.is_alive()
    assert len(ended) == 1
