"""launch_testing_ros: waiting for topics, passing messages on, spinning in a thread."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.compat.launch_ros.launch_testing_ros import (
    DataRepublisher,
    MessagePump,
    WaitForTopics,
    get_rmw_output_filter,
)
from gazelle.compat.rclpy.context import Context
from gazelle.compat.rclpy.node import Node
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.launch.environment import drop_in_folder

_STRING: Any = message_type("std_msgs/msg/String")


@pytest.fixture
def node(free_port: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Node]:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    with Graph.open(port=free_port, role="hub", environ={}):
        context = Context()
        context.init()
        made = Node("tester", context=context)
        pump = MessagePump(made, context)
        pump.start()
        yield made
        pump.stop()
        made.destroy_node()
        context.try_shutdown()


def test_topics_are_waited_for(node: Node) -> None:
    publisher = node.create_publisher(_STRING, "/a", 10)
    node.create_timer(0.01, lambda: publisher.publish(_STRING(data="here")))
    with WaitForTopics([("/a", _STRING)], timeout=stretched(30)) as waiting:
        assert waiting.topics_received() == {"/a"}
        assert {one.data for one in waiting.received_messages("/a")} == {"here"}
        with pytest.raises(KeyError, match="No messages received for topic: /b"):
            waiting.received_messages("/b")
    with pytest.raises(RuntimeError, match="Did not receive messages on these topics"):
        WaitForTopics([("/silent", _STRING)], timeout=0.05).__enter__()


def test_messages_are_passed_on_changed_or_dropped(node: Node) -> None:
    def change(message: Any) -> Any:
        return None if message.data == "drop" else _STRING(data=message.data.upper())

    passing = DataRepublisher(node, "/in", "/out", _STRING, change)
    got: list[str] = []
    came = threading.Event()

    def take(message: Any) -> None:
        got.append(message.data)
        came.set()

    node.create_subscription(_STRING, "/out", take, 10)
    publisher = node.create_publisher(_STRING, "/in", 10)
    for text in ("drop", "keep"):
        publisher.publish(_STRING(data=text))
    assert came.wait(stretched(30))
    assert got == ["KEEP"]
    assert (passing.get_num_received(), passing.get_num_republished()) == (2, 1)
    assert [one.data for one in passing.get_republished()] == ["keep"]
    passing.shutdown()


def test_filters_of_middlewares_come_from_the_index(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "share/ament_index/resource_index/rmw_output_prefixes"
    folder.mkdir(parents=True)
    (folder / "rmw_x").write_text("one\ntwo\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert get_rmw_output_filter("rmw_x", "prefixes") == ["one", "two"]
    assert get_rmw_output_filter("rmw_x", "patterns") == []
    with pytest.raises(TypeError, match='Unsupported filter_type "colours"'):
        get_rmw_output_filter("rmw_x", "colours")


def test_module_is_where_users_import_it_from(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(drop_in_folder()))
    module = import_module("launch_testing_ros")
    assert module.WaitForTopics is WaitForTopics
    assert import_module("launch_testing_ros.wait_for_topics").WaitForTopics is WaitForTopics
    own = import_module("launch_testing.test_runner").LaunchTestRunner
    assert issubclass(module.LaunchTestRunner, own)
    leave_out = import_module("launch_testing_ros.tools").basic_output_filter(["noise"], [])
    assert leave_out("noise 1\ngood\n").splitlines() == ["good"]
