from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError
from gazelle.graph import (
    Graph,
    Node,
    ServiceCallError,
    ServiceTimeoutError,
    ServiceUnavailableError,
)
from gazelle.interfaces import ros1_service_type, service_type

SetBool = service_type("std_srvs/srv/SetBool")
Trigger = service_type("std_srvs/srv/Trigger")
OldSetBool = ros1_service_type("std_srvs/SetBool")


@pytest.fixture
def server(graph: Graph) -> Node:
    return graph.create_node("server")


@pytest.fixture
def caller(other: Graph) -> Node:
    return other.create_node("caller")


def _echo(request: Any) -> Any:
    return SetBool.Response(success=request.data, message="done")


def test_requests_are_answered_in_and_across_processes(server: Node, caller: Node) -> None:
    server.create_service("set", SetBool, _echo)
    for node in (server, caller):
        client = node.create_client("set", SetBool)
        assert client.wait_for_service(stretched(10))
        for data in (True, False):
            assert client.call(SetBool.Request(data=data)) == SetBool.Response(
                success=data, message="done"
            )


def test_ros1_classes_call_ros2_handlers_and_back(server: Node, caller: Node) -> None:
    server.create_service("new", SetBool, _echo)
    server.create_service(
        "old", OldSetBool, lambda request: OldSetBool._response_class(request.data, "old")
    )
    new = caller.create_client("new", OldSetBool)
    assert new.wait_for_service(stretched(10))
    assert new.call(OldSetBool._request_class(True)).message == "done"
    old = caller.create_client("old", SetBool)
    assert old.wait_for_service(stretched(10))
    assert old.call(SetBool.Request(data=True)).message == "old"


def test_what_a_handler_raises_reaches_the_caller(
    server: Node, caller: Node, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(_request: Any) -> Any:
        raise ValueError("no such joint")

    server.create_service("fail", SetBool, fail)
    client = caller.create_client("fail", SetBool)
    assert client.wait_for_service(stretched(10))
    with pytest.raises(ServiceCallError) as caught:
        client.call(SetBool.Request())
    assert str(caught.value) == (
        "service [/fail] responded with an error: error processing request: no such joint"
    )
    assert "ValueError: no such joint" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("answer", "text"),
    [
        (None, "service cannot process request: service handler returned None"),
        ("x", "service handler returned a str, not a"),
    ],
)
def test_bad_answers_are_errors(server: Node, caller: Node, answer: Any, text: str) -> None:
    server.create_service("bad", SetBool, lambda _request: answer)
    client = caller.create_client("bad", SetBool)
    assert client.wait_for_service(stretched(10))
    with pytest.raises(ServiceCallError, match=text):
        client.call(SetBool.Request())


def test_missing_service_is_unavailable_at_once(server: Node, caller: Node) -> None:
    server.create_service("/robot/reset", SetBool, _echo)
    client = caller.create_client("/robot/rest", SetBool)
    assert not client.wait_for_service(0.0)
    with pytest.raises(ServiceUnavailableError) as caught:
        client.call(SetBool.Request())
    assert str(caught.value) == "service [/robot/rest] unavailable; did you mean /robot/reset?"


def test_other_type_is_told(server: Node, caller: Node) -> None:
    server.create_service("set", Trigger, lambda _request: Trigger.Response())
    client = caller.create_client("set", SetBool)
    assert client.wait_for_service(stretched(10))
    with pytest.raises(
        ServiceUnavailableError, match=r"it has type std_srvs/srv/Trigger, the client"
    ):
        client.call(SetBool.Request())


def test_slow_service_times_out(server: Node, caller: Node) -> None:
    release = threading.Event()

    def slow(request: Any) -> Any:
        release.wait(stretched(30))
        return _echo(request)

    server.create_service("slow", SetBool, slow)
    client = caller.create_client("slow", SetBool)
    assert client.wait_for_service(stretched(10))
    with pytest.raises(ServiceTimeoutError, match=r"service \[/slow\] did not answer in 0.1 s"):
        client.call(SetBool.Request(), timeout_s=0.1)
    release.set()


def test_requests_are_handled_side_by_side(server: Node, caller: Node) -> None:
    both = threading.Barrier(2, timeout=stretched(30))

    def meet(request: Any) -> Any:
        both.wait()
        return _echo(request)

    server.create_service("meet", SetBool, meet)
    client = caller.create_client("meet", SetBool)
    assert client.wait_for_service(stretched(10))
    first = threading.Thread(target=client.call, args=(SetBool.Request(),))
    first.start()
    assert client.call(SetBool.Request(data=True), timeout_s=stretched(30)).success
    first.join(stretched(30))


def test_wait_for_service_wakes_when_it_comes(server: Node, caller: Node) -> None:
    client = caller.create_client("later", SetBool)
    found: list[bool] = []
    waiter = threading.Thread(target=lambda: found.append(client.wait_for_service(stretched(10))))
    waiter.start()
    server.create_service("later", SetBool, _echo)
    waiter.join(stretched(30))
    assert found == [True]


def test_unregistered_service_is_gone(
    server: Node, caller: Node, eventually: Callable[..., Any]
) -> None:
    service = server.create_service("set", SetBool, _echo)
    client = caller.create_client("set", SetBool)
    assert client.wait_for_service(stretched(10))
    service.unregister()
    service.unregister()
    eventually(lambda: not client.available)
    client.unregister()
    client.unregister()
    with pytest.raises(ServiceUnavailableError, match="this client was closed"):
        client.call(SetBool.Request())


def test_request_of_another_class_is_refused(caller: Node) -> None:
    with pytest.raises(GraphError, match="the request is a str"):
        caller.create_client("set", SetBool).call("x")


def test_client_that_is_given_up_ends_its_call(server: Node, caller: Node) -> None:
    under_way, held = threading.Event(), threading.Event()

    def hold(_request: Any) -> Any:
        under_way.set()
        held.wait()
        return Trigger.Response()

    server.create_service("hold", Trigger, hold)
    client = caller.create_client("hold", Trigger)
    assert client.wait_for_service(stretched(10))
    failed: list[Exception] = []

    def call() -> None:
        try:
            client.call(Trigger.Request())
        except GraphError as error:
            failed.append(error)

    calling = threading.Thread(target=call)
    calling.start()
    assert under_way.wait(stretched(30))
    client.unregister()
    calling.join(stretched(30))
    assert not calling.is_alive()
    held.set()
    assert [type(one) for one in failed] == [ServiceUnavailableError]
    assert str(failed[0]) == "service [/hold]: this client was closed"
