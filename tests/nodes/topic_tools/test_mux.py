"""mux and demux: what is selected passes, and the services choose."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.patience import await_change, stretched

from gazelle.errors import LaunchError
from gazelle.graph import Node, ServiceCallError
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.topic_tools.mux import run_demux, run_mux

_INT = message_type("std_msgs/msg/Int32")


def _call(node: Node, name: str, kind: str, **fields: Any) -> Any:
    service = service_type(f"topic_tools/srv/{kind}")
    client = node.create_client(name, service)
    assert client.wait_for_service(stretched())
    return client.call(service.Request(**fields), stretched())


class _Heard:
    def __init__(self, node: Node, topic: str) -> None:
        self.numbers: list[int] = []
        self._changed = threading.Condition()
        node.create_subscription(topic, _INT, self._take)

    def _take(self, message: Any) -> None:
        with self._changed:
            self.numbers.append(message.data)
            self._changed.notify_all()

    def wait_for(self, number: int) -> None:
        with self._changed:
            assert await_change(self._changed, lambda: number in self.numbers)


def test_mux_passes_the_selected_topic(bench: Any) -> None:
    node = bench.node
    bench.start("topic_tools/mux", "/out", "/a", "/b")
    heard = _Heard(node, "/out")
    one, other = (node.create_publisher(name, _INT, latch=True) for name in ("/a", "/b"))
    one.publish(_INT(data=1))
    heard.wait_for(1)
    assert _call(node, "/mux/select", "MuxSelect", topic="/b").prev_topic == "/a"
    # Comes while /b is selected, however late.
    one.publish(_INT(data=2))
    for number in (3, 4):
        other.publish(_INT(data=number))
        heard.wait_for(number)
    assert heard.numbers == [1, 3, 4]
    assert _call(node, "/mux/select", "MuxSelect", topic="__none").prev_topic == "/b"


def test_topics_of_a_mux_are_added_and_deleted(bench: Any) -> None:
    node = bench.node
    bench.start("topic_tools/mux", "/out", "/a", "/b", "_initial_topic:=/b")
    _call(node, "/mux/add", "MuxAdd", topic="c")
    assert list(_call(node, "/mux/list", "MuxList").topics) == ["/a", "/b", "/c"]
    with pytest.raises(ServiceCallError, match="topic \\[/b\\] is selected; select another"):
        _call(node, "/mux/delete", "MuxDelete", topic="/b")
    _call(node, "/mux/delete", "MuxDelete", topic="/a")
    assert list(_call(node, "/mux/list", "MuxList").topics) == ["/b", "/c"]
    with pytest.raises(ServiceCallError, match="is among its topics already"):
        _call(node, "/mux/add", "MuxAdd", topic="/c")
    with pytest.raises(ServiceCallError, match="no topic \\[/a\\]"):
        _call(node, "/mux/select", "MuxSelect", topic="/a")


def test_demux_publishes_on_the_selected_topic(bench: Any) -> None:
    node = bench.node
    bench.start("topic_tools/demux", "/in", "/a", "/b")
    first, second = _Heard(node, "/a"), _Heard(node, "/b")
    talker = node.create_publisher("/in", _INT, latch=True)
    talker.publish(_INT(data=1))
    first.wait_for(1)
    assert _call(node, "/demux/select", "DemuxSelect", topic="/b").prev_topic == "/a"
    talker.publish(_INT(data=2))
    second.wait_for(2)
    assert (first.numbers, second.numbers) == ([1], [2])


def test_missing_topics_show_the_usage(bench: Any) -> None:
    with pytest.raises(LaunchError, match=r"1 arguments given\nusage: mux OUT_TOPIC IN_TOPIC1"):
        run_mux(read_arguments(["/out"], "mux"), bench.graph, threading.Event())
    with pytest.raises(LaunchError, match=r"0 arguments given\nusage: demux IN_TOPIC"):
        run_demux(read_arguments([], "demux"), bench.graph, threading.Event())
