"""Services over the bridge, both ways."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

import pytest
from tests.bridge.ros1.peer import Peer, call_on
from tests.patience import stretched

from gazelle.graph import Graph, ServiceCallError
from gazelle.graph.errors import ServiceRefusedError
from gazelle.interfaces import from_ros1, ros1_service_type, service_type

Eventually = Callable[[Callable[[], Any]], Any]
SET_BOOL: Any = ros1_service_type("std_srvs/SetBool")


def offer(graph: Graph) -> None:
    kind = service_type("std_srvs/srv/SetBool")

    def answer(request: Any) -> Any:
        if not request.data:
            raise ServiceRefusedError("only true")
        return kind.Response(success=True, message="done")

    graph.create_node("server", rosout=False).create_service("/switch", kind, answer)


def registered(peer: Peer) -> bool:
    return ["/switch", ["/server"]] in peer.call("getSystemState")[2]


def test_service_of_the_graph_answers_ros1(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    offer(graph)
    eventually(lambda: registered(peer))
    header, stream = peer.open_service("/switch", SET_BOOL._md5sum, persistent="1")
    assert header == {
        "callerid": "/server",
        "md5sum": "09fb03525b03e7ea1fd3992bafd87e16",
        "type": "std_srvs/SetBool",
        "request_type": "std_srvs/SetBoolRequest",
        "response_type": "std_srvs/SetBoolResponse",
    }
    for _ in range(2):
        well, body = call_on(stream, b"\1")
        response = from_ros1(SET_BOOL._response_class, body)
        assert (well, response.success, response.message) == (True, True, "done")
    assert call_on(stream, b"\0") == (False, b"only true")


def test_connection_for_one_call_ends_after_it(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    offer(graph)
    eventually(lambda: registered(peer))
    _, stream = peer.open_service("/switch")
    assert call_on(stream, b"\1")[0]
    assert stream.recv(1) == b""


def test_probe_tells_the_type_and_ends(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    offer(graph)
    eventually(lambda: registered(peer))
    header, stream = peer.open_service("/switch", probe="1")
    assert header["type"] == "std_srvs/SetBool"
    assert stream.recv(1) == b""


def test_another_md5sum_is_refused(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    offer(graph)
    eventually(lambda: registered(peer))
    header, _ = peer.open_service("/switch", "0" * 32)
    assert header["error"] == f"md5sums do not match: [{'0' * 32}] vs. [{SET_BOOL._md5sum}]"


def test_service_of_ros1_answers_the_graph(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    def answer(request: bytes) -> bytes:
        if request == b"\0":
            raise ValueError("not that")
        return b"\1" + struct.pack("<I", 5) + b"hello"

    peer.serve("/theirs", "std_srvs/SetBool", SET_BOOL._md5sum, answer)
    kind = service_type("std_srvs/srv/SetBool")
    client = graph.create_node("client", rosout=False).create_client("/theirs", kind)
    assert client.wait_for_service(stretched(10))
    response = client.call(kind.Request(data=True), timeout_s=stretched(30))
    assert (response.success, response.message) == (True, "hello")
    with pytest.raises(ServiceCallError, match="responded with an error: not that"):
        client.call(kind.Request(data=False), timeout_s=stretched(30))
    assert [one.servers for one in graph.services() if one.name == "/theirs"] == [("/peer",)]
    peer.call("unregisterService", "/theirs", f"rosrpc://127.0.0.1:{peer.port}")
    eventually(lambda: not [one for one in graph.services() if one.name == "/theirs"])


def test_service_of_ros2_only_stays(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    node = graph.create_node("two", rosout=False)
    kind = service_type("rcl_interfaces/srv/GetParameters")
    node.create_service("/two/get_parameters", kind, lambda request: kind.Response())
    offer(graph)
    eventually(lambda: registered(peer))
    assert peer.call("getSystemState")[2] == [["/switch", ["/server"]]]
