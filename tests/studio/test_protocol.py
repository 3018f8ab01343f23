"""The WebSocket: calls, channels, the two classes of delivery, and what is malformed."""

from __future__ import annotations

import contextlib
import gc
import json
import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import eventually, stretched
from tests.studio.conftest import Talk
from tests.studio.page import Page, RefusedError, Stream
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from gazelle import __version__
from gazelle.graph import Graph
from gazelle.studio import Server, Studio
from gazelle.studio.protocol import METHODS, STREAMS
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream, StreamKind


def test_hello_names_version_session_and_graph(page: Page, graph: Graph, server: Server) -> None:
    hello = page.hello
    assert hello["op"] == "hello"
    assert hello["version"] == __version__
    assert hello["graph"] == {"port": graph.port, "domain": 0}
    assert hello["node"] == server.studio.node.name
    assert hello["panels"] == []


def test_unknown_method_names_the_nearest(page: Page) -> None:
    with pytest.raises(RefusedError) as caught:
        page.call("graph.gett")
    assert caught.value.error == {
        "message": "there is no method 'graph.gett'",
        "known": ["graph.get", "param.get"],
    }


def test_unknown_stream_names_the_nearest(page: Page) -> None:
    with pytest.raises(RefusedError, match=r"there is no stream 'topic\.ecko'") as caught:
        page.open("topic.ecko")
    assert "topic.echo" in caught.value.error["known"]


@pytest.mark.parametrize(
    ("params", "text"),
    [
        ([], "type.get: 'params' is an object, not []"),
        ({}, "type.get: parameter 'type' is missing; it is a text"),
        ({"type": 3}, "type.get: parameter 'type' is a text, not 3"),
        ({"type": "a/b/c/d"}, "type 'a/b/c/d' not found"),
    ],
)
def test_wrong_parameters_are_told(page: Page, params: Any, text: str) -> None:
    answer = page.raw(json.dumps({"op": "call", "method": "type.get", "params": params}))
    assert answer["op"] == "error"
    assert answer["error"]["message"] == text


@pytest.mark.parametrize("text", ["[]", "3", "null", '{"op":"dance"}', '{"op":["call"]}'])
def test_unknown_operations_get_an_error(page: Page, text: str) -> None:
    answer = page.raw(text)
    assert answer["error"]["message"] == "'op' is one of call, open, change, ack, close"
    assert page.call("graph.get")["nodes"]


@pytest.mark.parametrize("data", ["{", "\\ud800", "[" * 50_000, b"\x00\x01"])
def test_what_is_not_json_ends_the_connection(
    connected: Callable[..., Page], data: str | bytes
) -> None:
    page = connected()
    page.socket.send(data)
    eventually(lambda: page.socket.close_code is not None)
    assert page.socket.close_code == 1008


def test_messages_that_are_too_long_end_the_connection(connected: Callable[..., Page]) -> None:
    page = connected()
    with contextlib.suppress(ConnectionClosed):
        page.socket.send("x" * (33 << 20))
    eventually(lambda: page.socket.close_code is not None)
    assert page.socket.close_code == 1009


def test_a_channel_number_is_used_once(page: Page) -> None:
    stream = page.open("graph")
    stream.close()
    page.send(op="open", ch=stream.number, stream="graph")
    answer = stream.answer.get(timeout=stretched())
    assert answer["op"] == "failed"
    assert answer["error"]["message"].endswith("was used before on this connection")


def test_nothing_comes_behind_close(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/behind", rate_hz=1000)
    talk("/behind", "std_msgs/String", data="a")
    assert stream.next()["message"] == {"data": "a"}
    stream.close()
    page.call("graph.get")
    talk("/behind", "std_msgs/String", data="b")
    page.call("graph.get")
    assert stream.items.empty()


def test_latest_keeps_two_frames_under_way_and_then_gives_the_newest(
    page: Page, talk: Talk
) -> None:
    stream = page.open("topic.echo", topic="/lots", rate_hz=1000, acks=False)
    for number in range(50):
        talk("/lots", "std_msgs/Int32", data=number)
        _wait_for(stream, min(number + 1, 2))
    page.call("graph.get")
    assert stream.items.qsize() == 2
    assert [stream.next()["message"]["data"] for _ in range(2)] == [0, 1]
    stream.ack()
    assert stream.next()["message"]["data"] == 49


def test_acks_beyond_what_was_sent_give_no_credit(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/greedy", rate_hz=1000, acks=False)
    for _ in range(20):
        stream.ack()
    page.call("graph.get")
    for number in range(20):
        talk("/greedy", "std_msgs/Int32", data=number)
        _wait_for(stream, min(number + 1, 2))
    page.call("graph.get")
    assert stream.items.qsize() == 2


def test_a_page_that_never_acks_slows_nobody(connected: Callable[..., Page], talk: Talk) -> None:
    slow, quick = connected(), connected()
    stuck = slow.open("topic.echo", topic="/both", rate_hz=1000, acks=False)
    fine = quick.open("topic.echo", topic="/both", rate_hz=1000)
    for number in range(30):
        talk("/both", "std_msgs/Int32", data=number)
        assert fine.until(lambda item, n=number: item["message"]["data"] == n)
    assert stuck.items.qsize() == 2


def test_a_page_that_does_not_read_loses_its_batch_stream(
    connected: Callable[..., Page], talk: Talk, server: Server
) -> None:
    """What waits for it is bounded; everybody else goes on."""
    url = f"ws://127.0.0.1:{server.port}/ws?token={server.token}"
    with connect(url, compression=None, max_queue=1, max_size=None) as deaf:
        _flood(deaf, connected().open("rosout"), talk)


# Far more than the system keeps for a socket beside what the server holds.
_FLOOD = 600


def _flood(deaf: ClientConnection, quick: Stream, talk: Talk) -> None:
    deaf.recv()
    deaf.send(json.dumps({"op": "open", "ch": 1, "stream": "rosout", "params": {}}))
    line, seen = "x" * 100_000, 0
    for number in range(_FLOOD):
        talk("/rosout", "rcl_interfaces/Log", level=20, name="n", msg=f"{number} {line}")
        # Who reads goes on, and so does not fall behind itself.
        while seen < number - 20:
            seen += len(quick.next())
    while seen < _FLOOD:
        seen += len(quick.next())
    texts: list[str] = []
    while not any('"ended"' in text for text in texts[-1:]):
        texts.append(str(deaf.recv(stretched())))
    assert "the page is more than 8 MiB behind on this stream" in texts[-1]


def test_parameters_change_without_a_gap(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/first")
    talk("/first", "std_msgs/String", data="1")
    assert stream.next()["message"]["data"] == "1"
    stream.change(topic="/second")
    eventually(lambda: "/second" in page.call("graph.get")["topics"].__repr__())
    talk("/second", "std_msgs/String", data="2")
    assert stream.next()["message"]["data"] == "2"


def test_a_wrong_change_leaves_the_stream_as_it_was(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/steady")
    stream.change(topic=3)
    status = stream.status.get(timeout=stretched())
    assert status["level"] == "error"
    assert status["text"] == "topic.echo: parameter 'topic' is a text, not 3"
    talk("/steady", "std_msgs/String", data="on")
    assert stream.next()["message"]["data"] == "on"


def test_pages_come_and_go(connected: Callable[..., Page], server: Server, talk: Talk) -> None:
    for _ in range(5):
        page = connected()
        page.open("topic.echo", topic="/passing")
        page.close()
    eventually(lambda: not server.studio.pages)
    eventually(lambda: "/passing" not in server.studio.subscriptions.topics)
    stream = connected().open("topic.echo", topic="/passing")
    talk("/passing", "std_msgs/String", data="back")
    assert stream.next()["message"]["data"] == "back"


def test_many_pages_at_once(connected: Callable[..., Page], talk: Talk) -> None:
    streams = [connected().open("topic.echo", topic="/many") for _ in range(10)]
    talk("/many", "std_msgs/String", data="all")
    assert [one.next()["message"]["data"] for one in streams] == ["all"] * 10


def test_calls_that_hang_are_bounded(page: Page, server: Server, monkeypatch: Any) -> None:
    from gazelle.studio import connection, protocol

    going = threading.Event()
    methods = {**protocol.METHODS, "slow": lambda _studio, _params: going.wait(stretched())}
    monkeypatch.setattr(connection, "METHODS", methods)
    for number in range(256):
        page.expect(1000 + number)
        page.send(op="call", id=1000 + number, method="slow", params={})
    with pytest.raises(RefusedError, match="more than 256 calls have no answer yet"):
        page.call("graph.get")
    going.set()
    for number in range(256):
        assert page.answer(1000 + number) is True


def test_a_fault_of_a_method_is_an_answer(page: Page, monkeypatch: Any) -> None:
    from gazelle.studio import connection

    def broken(_studio: Any, _params: Any) -> Any:
        raise ZeroDivisionError("oh")

    monkeypatch.setattr(connection, "METHODS", {"broken": broken})
    with pytest.raises(RefusedError, match="ZeroDivisionError: oh") as caught:
        page.call("broken")
    assert caught.value.error["hint"] == "this is a fault of Studio, please report it"


def test_show_reaches_pages_or_the_first_that_comes(
    connected: Callable[..., Page], graph: Graph
) -> None:
    from gazelle.studio import Studio

    with Server(Studio(graph), port=0) as own:
        own.studio.pages.show("rqt_plot", {"curves": ["/odom"]})
        page = Page(own.port)
        assert page.hello["panels"] == ["rqt_plot"]
        shown = page.shown.get(timeout=stretched())
        assert shown == {"op": "show", "panel": "rqt_plot", "params": {"curves": ["/odom"]}}
        own.studio.pages.show("rqt_graph")
        assert page.shown.get(timeout=stretched())["panel"] == "rqt_graph"
        page.close()
        again = Page(own.port)
        assert again.hello["panels"] == []
        again.close()


def _wait_for(stream: Stream, count: int) -> None:
    eventually(lambda: stream.items.qsize() >= count)


def test_a_call_without_an_answer_ends_with_the_server(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    begun, goes_on = threading.Event(), threading.Event()
    threads: list[threading.Thread] = []

    def wait(_studio: Studio, _params: Params) -> None:
        threads.append(threading.current_thread())
        begun.set()
        goes_on.wait(stretched())

    monkeypatch.setitem(METHODS, "wait", wait)
    with Server(Studio(graph), port=0) as server:
        page = Page(server.port)
        page.send(op="call", id=1, method="wait", params={})
        assert begun.wait(stretched())
    page.close()
    goes_on.set()
    threads[0].join(stretched())
    gc.collect()
    assert "Task was destroyed" not in caplog.text


def test_a_stream_that_opens_after_its_page_has_gone_is_closed(
    server: Server, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, goes_on, closed = threading.Event(), threading.Event(), threading.Event()

    def open_late(_studio: Studio, _channel: Channel, _params: Params) -> OpenStream:
        begun.set()
        goes_on.wait(stretched())
        return OpenStream(closed.set)

    monkeypatch.setitem(STREAMS, "late", StreamKind(latest=False, open=open_late))
    with Page(server.port) as page:
        page.send(op="open", ch=1, stream="late", params={})
        assert begun.wait(stretched())
        page.send(op="close", ch=1)
        # Whatever was sent before it has been taken in.
        page.call("graph.get")
    eventually(lambda: not server.studio.pages)
    goes_on.set()
    assert closed.wait(stretched())


def test_call_whose_id_is_a_list_is_answered_without_it(page: Page) -> None:
    """One that is nested deeply can be read, and not be written again a few frames further in."""
    answer = page.raw('{"op":"call","id":[[[7]]],"method":"no.such"}')
    assert (answer["op"], answer["id"]) == ("error", None)
    assert page.call("graph.get")["nodes"]
