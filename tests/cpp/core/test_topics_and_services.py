"""Topics, services and time of a program of C++ beside nodes of Python."""

from __future__ import annotations

import signal
import sys
from typing import Any

import pytest
from tests.cpp.core.conftest import Probe
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="nodes of C++ run on Linux for now")


@pytest.fixture
def graph(free_port: int) -> Any:
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one


def test_a_message_goes_from_python_to_cpp_and_back(graph: Graph, probe: Probe) -> None:
    string, got = message_type("std_msgs/msg/String"), []
    node = graph.create_node("tester")
    node.create_subscription("out", string, lambda message: got.append(message.data))
    publisher = node.create_publisher("in", string)
    running = probe("echo")
    running.wait_for_line("ready /probe")
    eventually(lambda: publisher.matched and graph.publisher_count("/out"))
    publisher.publish(string(data="hello"))
    eventually(lambda: got)
    assert got == ["hello from /tester"]
    assert running.stop(signal.SIGINT) == 0
    running.wait_for_line("ended by signal-2")


def test_the_ends_of_a_node_are_seen_as_those_of_any_other(graph: Graph, probe: Probe) -> None:
    running = probe("echo")
    running.wait_for_line("ready")
    out, heard = ("/out", "std_msgs/msg/String"), ("/in", "std_msgs/msg/String")
    eventually(lambda: out in graph.node_info("/probe").publications)
    eventually(lambda: heard in graph.node_info("/probe").subscriptions)
    assert graph.node_info("/probe").pid == running.popen.pid


def test_a_node_is_shut_down_by_one_of_its_name(graph: Graph, probe: Probe) -> None:
    running = probe("echo")
    running.wait_for_line("ready")
    graph.create_node("probe")
    running.wait_for_line(r"shutdown request: \[/probe\]")


def test_a_latched_message_comes_to_late_subscriptions_here_and_there(
    graph: Graph, probe: Probe
) -> None:
    running = probe("latched")
    running.wait_for_line("ready")
    got: list[str] = []
    string = message_type("std_msgs/msg/String")
    node = graph.create_node("tester")
    node.create_subscription("map", string, lambda message: got.append(message.data))
    eventually(lambda: got)
    assert got == ["last"]
    assert [line for line in running.lines if line.startswith("late")] == ["late last"]


def test_messages_inside_a_process_are_not_copied_and_types_are_checked(probe: Probe) -> None:
    running = probe("inside")
    assert running.wait() == 0
    assert "same bytes 1" in running.lines
    assert "count 1" in running.lines
    assert "wrong type came" not in running.text
    assert "[graph.type-mismatch]" in running.text


def test_cpp_answers_a_service_of_python_nodes(graph: Graph, probe: Probe) -> None:
    running = probe("serve")
    running.wait_for_line("ready")
    trigger = service_type("std_srvs/srv/Trigger")
    client = graph.create_node("tester").create_client("trigger", trigger)
    assert client.call(trigger.Request()).message == "for /tester"
    with pytest.raises(Exception, match="not today"):
        client.call(trigger.Request())
    assert client.call(trigger.Request()).success


def test_cpp_calls_a_service_of_python_nodes(graph: Graph, probe: Probe) -> None:
    trigger = service_type("std_srvs/srv/Trigger")
    running = probe("ask")
    running.wait_for_line("before 1")
    graph.create_node("tester").create_service(
        "trigger", trigger, lambda _request: trigger.Response(success=True, message="yes")
    )
    assert running.wait() == 0
    assert "answer yes" in running.lines
    assert "five 1" in running.lines


def test_simulated_time_comes_by_messages_and_jumps_are_told(graph: Graph, probe: Probe) -> None:
    graph.parameters.set("/use_sim_time", True)
    clock = message_type("rosgraph_msgs/msg/Clock")
    publisher = graph.create_node("world").create_publisher("/clock", clock)

    def show(seconds: int) -> None:
        message = clock()
        message.clock.sec = seconds
        publisher.publish(message)

    running = probe("sleep")
    running.wait_for_line("ready 1")
    eventually(lambda: publisher.subscription_count > 0 and publisher.matched)

    def has_started() -> bool:
        show(1)
        return any(line.startswith("start") for line in running.lines)

    eventually(has_started)
    running.wait_for_line("start 1000000000")
    show(2)
    running.wait_for_line("reached 0")
    assert not any(line.startswith("alarm") for line in running.lines)
    show(3)
    running.wait_for_line("alarm 0")
    show(1)
    running.wait_for_line("jump -2000000000")
    running.wait_for_line("woken 1")


def test_simulated_time_is_looked_up_on_a_page_where_there_is_one(
    graph: Graph, probe: Probe
) -> None:
    from gazelle.graph.shared_clock_discovery import share_clock

    graph.parameters.set("/use_sim_time", True)
    clock = message_type("rosgraph_msgs/msg/Clock")
    publisher = graph.create_node("world").create_publisher("/clock", clock)
    shared = share_clock(publisher)
    assert shared is not None
    shared.show(1_000_000_000)
    running = probe("sleep")
    running.wait_for_line("start 1000000000")
    # No message is ever published: what is on the page is all there is.
    shared.show(2_000_000_000)
    running.wait_for_line("reached 0")
    shared.show(3_000_000_000)
    running.wait_for_line("alarm 0")
    shared.show(1_000_000_000)
    running.wait_for_line("jump -2000000000")
    running.wait_for_line("woken 1")
    shared.close()
