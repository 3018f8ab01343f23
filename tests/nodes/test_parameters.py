"""The periods of built-in nodes, on whatever clock."""

from __future__ import annotations

import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any

import pytest
from tests.patience import stretched

from gazelle import announcements
from gazelle.graph import Graph, Kind
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node, ticks

MS = 1_000_000


@pytest.fixture
def graph(bench: Any) -> Graph:
    found: Graph = bench.graph
    return found


@pytest.fixture
def show(graph: Graph) -> Callable[[int], None]:
    kind = message_type("rosgraph_msgs/msg/Clock")
    publisher = graph.create_node("simulator").create_publisher("/clock", kind)

    def publish(now_ns: int) -> None:
        message: Any = kind()
        message.clock.sec, message.clock.nanosec = divmod(now_ns, 1_000_000_000)
        publisher.publish(message)

    return publish


def test_ticks_go_on_when_the_time_becomes_simulated(
    bench: Any, graph: Graph, show: Callable[[int], None]
) -> None:
    node = graph.create_node("a")
    seen: SimpleQueue[int] = SimpleQueue()
    stop = threading.Event()
    # Only a node that began by wall time waits an hour of it.
    thread = threading.Thread(
        target=lambda: [seen.put(now_ns) for now_ns in ticks(node, 3600_000 * MS, stop)]
    )
    thread.start()
    bench.eventually(lambda: bool(node.clock._sleepers))
    graph.parameters.set("/use_sim_time", True)
    bench.eventually(lambda: node.clock.use_sim_time)
    bench.eventually(lambda: [one[0] for one in node.clock._sleepers] == [3600_000 * MS])
    show(3600_000 * MS)
    assert seen.get(timeout=stretched(30)) == 3600_000 * MS
    stop.set()
    thread.join(stretched(30))


def test_jump_back_while_the_caller_works_starts_anew_from_there(
    bench: Any, graph: Graph, show: Callable[[int], None]
) -> None:
    graph.parameters.set("/use_sim_time", True)
    node = graph.create_node("a")
    show(99_000 * MS)
    bench.eventually(lambda: node.clock.now_ns() == 99_000 * MS)
    stop = threading.Event()
    found = ticks(node, 10 * MS, stop)
    seen: SimpleQueue[int] = SimpleQueue()
    first = threading.Thread(target=lambda: seen.put(next(found)))
    first.start()
    bench.eventually(lambda: bool(node.clock._sleepers))
    show(99_010 * MS)
    assert seen.get(timeout=stretched(30)) == 99_010 * MS
    first.join(stretched(30))
    show(1_000 * MS)
    thread = threading.Thread(target=lambda: seen.put(next(found)))
    thread.start()
    bench.eventually(lambda: bool(node.clock._sleepers))
    assert [one[0] for one in node.clock._sleepers] == [1_010 * MS]
    show(1_010 * MS)
    assert seen.get(timeout=stretched(30)) == 1_010 * MS
    thread.join(stretched(30))


def _values(bench: Any, node: str, *names: str) -> list[Any]:
    kind = "rcl_interfaces/srv/GetParameters"
    found = bench.call(f"{node}/get_parameters", kind, names=list(names)).values
    return [value_from_message(one) for one in found]


def test_every_node_of_ros2_offers_what_it_was_started_with(bench: Any) -> None:
    bench.start(
        "tf2_ros/static_transform_publisher", "--frame-id", "a", "--child-frame-id", "b",
        "--ros-args", "-r", "__node:=fixed", "-p", "note:=here",
    )  # fmt: skip
    assert _values(bench, "/fixed", "note", "use_sim_time") == ["here", False]
    parameter: Any = message_type("rcl_interfaces/msg/Parameter")
    given = parameter(name="note", value=value_message("there"))
    kind = "rcl_interfaces/srv/SetParameters"
    result = bench.call("/fixed/set_parameters", kind, parameters=[given]).results[0]
    assert not result.successful
    assert result.reason == (
        "parameter 'note' is read when /fixed starts; start it with -p note:=… or a file of "
        "parameters"
    )
    assert bench.stop() == [0]


def test_nodes_that_say_more_have_their_services_once(bench: Any) -> None:
    bench.start("turtlesim/turtlesim_node", "--ros-args", "-p", "background_r:=7")
    assert _values(bench, "/turtlesim", "background_r", "background_g") == [7, 86]
    servers = [one for one in bench.graph.entities() if one.name == "/turtlesim/get_parameters"]
    assert [one.kind for one in servers].count(Kind.SERVICE) == 1
    assert bench.stop() == [0]


def test_what_a_node_waits_for_is_said_in_its_log(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(announcements, "_process", [])
    monkeypatch.setattr(announcements, "_told", set())
    node = start_node(NodeArguments(name="planner"), graph)
    said: list[tuple[str, str]] = []
    monkeypatch.setattr(node, "log", lambda level, text: said.append((level, text)))
    announcements.announce("compiling the kernels of arm planning")
    assert said == [("info", "compiling the kernels of arm planning")]
