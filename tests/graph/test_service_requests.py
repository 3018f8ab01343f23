"""Threads that take turns, and services whose requests are begun in turn."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.graph.service_requests import InTurn, Turn, Turns
from gazelle.interfaces import service_type

SetBool = service_type("std_srvs/srv/SetBool")
_MANY = 30


def _in_threads(turns: list[Turn], work: Any) -> list[threading.Thread]:
    def run(place: int) -> None:
        with turns[place]:
            work(place)

    # The last one starts first.
    threads = [threading.Thread(target=run, args=(place,)) for place in range(len(turns))]
    for thread in reversed(threads):
        thread.start()
    return threads


def test_turns_come_in_the_order_in_which_they_were_taken() -> None:
    turns, came = Turns(), list[int]()
    for thread in _in_threads([turns.take("key") for _ in range(_MANY)], came.append):
        thread.join(stretched())
    assert came == list(range(_MANY))
    assert not turns._last


def test_turns_of_another_key_are_not_waited_for() -> None:
    turns = Turns()
    turns.take("busy")
    with turns.take("free"):
        pass


def test_turn_that_ends_unused_lets_nobody_pass_those_before_it() -> None:
    turns, came = Turns(), list[str]()
    first, second, third = (turns.take() for _ in range(3))
    second.end()
    thread = threading.Thread(target=lambda: (third.wait(), came.append("third")))
    thread.start()
    came.append("first")
    first.end()
    thread.join(stretched())
    assert came == ["first", "third"]


@pytest.fixture
def ends(graph: Graph, other: Graph) -> tuple[Any, Any]:
    return graph.create_node("server"), other.create_node("caller")


def test_requests_of_one_client_begin_in_the_order_sent(ends: tuple[Any, Any]) -> None:
    server, caller = ends
    begun: list[str] = []

    def begin(request: Any) -> Any:
        begun.append("yes" if request.data else "no")
        return lambda: SetBool.Response(success=request.data)

    server.create_service("set", SetBool, InTurn(begin))
    client = caller.create_client("set", SetBool)
    assert client.wait_for_service(stretched())
    wanted = [number % 3 == 0 for number in range(_MANY)]
    answers = [client.send(SetBool.Request(data=data)) for data in wanted]
    assert [answer().success for answer in answers] == wanted
    assert begun == ["yes" if data else "no" for data in wanted]


def test_request_that_is_under_way_holds_up_no_other(ends: tuple[Any, Any]) -> None:
    """Its second part not the next of its client, its first not those of other clients."""
    server, caller = ends
    go_on, begun = threading.Event(), list[bool]()

    def finish(data: bool) -> Any:
        assert not data or go_on.wait(stretched())
        return SetBool.Response(success=data)

    def begin(request: Any) -> Any:
        begun.append(request.data)
        return lambda: finish(request.data)

    server.create_service("second", SetBool, InTurn(begin))
    server.create_service("first", SetBool, InTurn(lambda one: (finish(one.data), begin(one))[1]))
    for name, is_other in (("second", False), ("first", True)):
        go_on.clear()
        begun.clear()
        slow = caller.create_client(name, SetBool)
        quick = server.create_client(name, SetBool) if is_other else slow
        assert slow.wait_for_service(stretched()) and quick.wait_for_service(stretched())
        waits = slow.send(SetBool.Request(data=True))
        if not is_other:
            eventually(lambda: begun == [True])
        assert not quick.call(SetBool.Request(data=False), stretched()).success
        go_on.set()
        assert waits().success


def test_handler_in_turn_that_fails_holds_up_nobody(ends: tuple[Any, Any]) -> None:
    server, caller = ends

    def begin(request: Any) -> Any:
        if request.data:
            raise ValueError("not this one")
        return lambda: SetBool.Response(message="well")

    server.create_service("set", SetBool, InTurn(begin))
    client = caller.create_client("set", SetBool)
    assert client.wait_for_service(stretched())
    fails, does = (client.send(SetBool.Request(data=data)) for data in (True, False))
    assert does().message == "well"
    with pytest.raises(Exception, match="not this one"):
        fails()
