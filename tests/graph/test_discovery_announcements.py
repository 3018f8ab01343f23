"""When others get to see what a node offers."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Graph, Kind
from gazelle.graph.ros2_node_parameters import NodeParameters
from gazelle.interfaces import service_type

EMPTY = service_type("std_srvs/srv/Empty")


def _answer(_request: Any) -> Any:
    return EMPTY.Response()


def _services(graph: Graph) -> set[str]:
    return {one.name for one in graph.entities() if one.kind is Kind.SERVICE}


def test_what_is_made_together_is_seen_together(join: Callable[..., Graph]) -> None:
    node, other = join().create_node("robot"), join()
    with node.announced_together():
        for name in ("/a", "/b"):
            node.create_service(name, EMPTY, _answer)
        assert _services(other) == set()
        # They work before they are told.
        client = other.create_node("asks").create_client("/a", EMPTY)
    assert other.wait_for_service("/b", 30.0)
    assert _services(other) == {"/a", "/b"}
    client.call(EMPTY.Request(), timeout_s=stretched(30))


def test_blocks_in_one_another_end_with_the_outermost(join: Callable[..., Graph]) -> None:
    node, other = join().create_node("robot"), join()
    with node.announced_together():
        NodeParameters(node, "/robot", {})
        assert _services(other) == set()
    assert other.wait_for_service("/robot/get_parameter_types", 30.0)


def test_what_another_thread_makes_meanwhile_is_seen_at_once(join: Callable[..., Graph]) -> None:
    node, other = join().create_node("robot"), join()
    with node.announced_together():
        made = threading.Thread(target=node.create_service, args=("/b", EMPTY, _answer))
        made.start()
        made.join()
        assert other.wait_for_service("/b", 30.0)


def test_what_is_taken_back_before_is_never_seen(join: Callable[..., Graph]) -> None:
    node, other = join().create_node("robot"), join()
    with node.announced_together():
        node.create_service("/a", EMPTY, _answer).unregister()
        node.create_service("/b", EMPTY, _answer)
    assert other.wait_for_service("/b", 30.0)
    assert _services(other) == {"/b"}


def test_an_error_does_not_hide_what_was_made(join: Callable[..., Graph]) -> None:
    node, other = join().create_node("robot"), join()
    with pytest.raises(RuntimeError), node.announced_together():
        node.create_service("/a", EMPTY, _answer)
        raise RuntimeError
    assert other.wait_for_service("/a", 30.0)
    node.create_service("/b", EMPTY, _answer)
    assert other.wait_for_service("/b", 30.0)
