"""relay, throttle and drop: what passes and what does not."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import LaunchError
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.topic_tools.relay import run_drop, run_relay, run_throttle

_INT = message_type("std_msgs/msg/Int32")


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


def _sent_through(
    graph: Graph, tool: Callable[..., int], words: list[str], out: str, last: int
) -> list[int]:
    """Send 1…9 through a tool, which must let `last` pass; return what has come out by then."""
    node = graph.create_node("test")
    got: list[int] = []
    arrived, stop = threading.Event(), threading.Event()

    def take(message: Any) -> None:
        got.append(message.data)
        if message.data == last:
            arrived.set()

    arguments = read_arguments(words, "tool")
    thread = threading.Thread(target=tool, args=(arguments, graph, stop))
    thread.start()
    publisher = node.create_publisher("/numbers", _INT)
    node.create_subscription(out, _INT, take)
    assert graph.discovery.wait_for(lambda _known: publisher.matched, 5.0)
    for number in range(1, 10):
        publisher.publish(_INT(data=number))
    assert arrived.wait(stretched(30)), got
    stop.set()
    thread.join()
    return got


def test_relay_passes_everything(graph: Graph) -> None:
    got = _sent_through(graph, run_relay, ["/numbers", "/again"], "/again", 9)
    assert got == list(range(1, 10))


def test_drop_leaves_out_x_of_y(graph: Graph) -> None:
    got = _sent_through(graph, run_drop, ["/numbers", "1", "3"], "/numbers_drop", 9)
    assert got == [2, 3, 5, 6, 8, 9]


def test_throttle_passes_the_first_of_every_period(graph: Graph) -> None:
    words = ["messages", "/numbers", "0.01"]
    assert _sent_through(graph, run_throttle, words, "/numbers_throttle", 1)[0] == 1


@pytest.mark.parametrize("name", ["wall_clock", "use_wall_clock"])
def test_throttle_goes_by_the_machines_time_under_the_names_of_both_ros(
    graph: Graph, name: str
) -> None:
    graph.parameters.set("/use_sim_time", True)
    words = ["messages", "/numbers", "0.01", f"_{name}:=true"]
    # Simulated time that nobody tells stands at 0, where nothing is ever due.
    assert _sent_through(graph, run_throttle, words, "/numbers_throttle", 1)[0] == 1


def test_throttle_counts_bytes_of_a_window(graph: Graph) -> None:
    # An Int32 has 4 bytes: after two of them there are not less than 8 in the last 100 s.
    words = ["bytes", "/numbers", "8", "100"]
    assert _sent_through(graph, run_throttle, words, "/numbers_throttle", 2) == [1, 2]


def test_a_lazy_tool_listens_only_while_somebody_listens_to_it(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    stop = threading.Event()
    publisher = graph.create_node("test").create_publisher("/numbers", _INT)
    arguments = read_arguments(["/numbers", "1", "2", "_lazy:=true"], "tool")
    thread = threading.Thread(target=run_drop, args=(arguments, graph, stop))
    thread.start()
    assert graph.discovery.wait_for(lambda _known: publisher.matched, 5.0)
    publisher.publish(_INT(data=1))
    assert graph.discovery.wait_for(lambda _known: not publisher.matched, 5.0)
    assert capsys.readouterr().out == "advertised as /numbers_drop\n"
    graph.create_node("other").create_subscription("/numbers_drop", _INT, print)
    assert graph.discovery.wait_for(lambda _known: publisher.matched, 5.0)
    stop.set()
    thread.join()


@pytest.mark.parametrize(
    ("tool", "words", "text"),
    [
        (run_relay, [], "0 arguments given\nusage: relay IN_TOPIC"),
        (run_drop, ["/a", "x", "3"], "'x' is not a positive number\nusage: drop"),
        (run_throttle, ["bytes", "/a", "3"], "3 arguments given\nusage: throttle messages"),
        (run_throttle, ["rate", "/a", "3"], "'rate' is neither 'messages' nor 'bytes'"),
    ],
)
def test_wrong_arguments_show_the_usage(
    graph: Graph, tool: Callable[..., int], words: list[str], text: str
) -> None:
    with pytest.raises(LaunchError, match=re.escape(text)):
        tool(read_arguments(words, "tool"), graph, threading.Event())
