"""Programs over rclcpp by themselves, and beside nodes of Python."""

from __future__ import annotations

import signal
import sys

import pytest
from tests.cpp.rclcpp.conftest import Probe
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient, ActionServer, Ros2Status, ServerGoal
from gazelle.interfaces import message_type, service_type

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="nodes of C++ run on Linux for now")

_OVERRIDES = ("-p", "name:=given", "-p", "gains:=[1.5, 2.0]", "-p", "text:=word")


def test_what_rclcpp_promises_holds_inside_a_process(probe: Probe) -> None:
    """Signatures of callbacks, ownership, parameters, executors, wait sets, times."""
    running = probe("inside", "--ros-args", *_OVERRIDES)
    assert running.wait() == 0
    facts = [line for line in running.lines if line.endswith((" holds", " FAILS"))]
    assert [line for line in facts if line.endswith("FAILS")] == []
    assert len(facts) > 30


def test_messages_services_and_parameters_reach_nodes_of_python(graph: Graph, probe: Probe) -> None:
    string, got, late = message_type("std_msgs/msg/String"), [], []
    node = graph.create_node("tester")
    node.create_subscription("out", string, lambda message: got.append(message.data))
    publisher = node.create_publisher("in", string)
    running = probe("echo", "--ros-args", "-r", "__node:=renamed", "-p", "rate:=7")
    running.wait_for_line("ready /renamed")
    running.wait_for_line(r"\[INFO\] \[[0-9.]+\] \[renamed\]: I am renamed")
    eventually(lambda: publisher.matched and graph.publisher_count("/out"))
    publisher.publish(string(data="hello"))
    eventually(lambda: got)
    assert got == ["hello back"]
    node.create_subscription("map", string, lambda message: late.append(message.data))
    assert eventually(lambda: late) == ["last"]
    add = service_type("example_interfaces/srv/AddTwoInts")
    asked = node.create_client("add", add)
    assert asked.call(add.Request(a=20, b=22), timeout_s=10.0).sum == 42
    get = service_type("rcl_interfaces/srv/GetParameters")
    values = node.create_client("/renamed/get_parameters", get)
    (rate,) = values.call(get.Request(names=["rate"]), timeout_s=10.0).values
    assert (rate.type, rate.integer_value) == (2, 7)
    assert running.stop(signal.SIGINT) == 0
    assert running.lines[-2:] == ["spun", "end"]


def test_cpp_asks_a_service_of_python(graph: Graph, probe: Probe) -> None:
    add = service_type("example_interfaces/srv/AddTwoInts")
    node = graph.create_node("tester")
    node.create_service("add", add, lambda request: add.Response(sum=request.a + request.b))
    running = probe("ask")
    assert running.wait() == 0
    assert "sum 5" in running.lines


def test_a_managed_node_is_changed_by_others(graph: Graph, probe: Probe) -> None:
    change = service_type("lifecycle_msgs/srv/ChangeState")
    transition = message_type("lifecycle_msgs/msg/Transition")
    node, got = graph.create_node("tester"), []
    string = message_type("std_msgs/msg/String")
    node.create_subscription("out", string, got.append)
    running = probe("managed")
    running.wait_for_line("ready")
    client = node.create_client("/managed/change_state", change)
    assert client.wait_for_service(20.0)

    def change_to(number: int) -> bool:
        request = change.Request(transition=transition(id=number))
        return bool(client.call(request, timeout_s=10.0).success)

    assert change_to(1)
    running.wait_for_line("configured from unconfigured")
    assert not got
    assert change_to(3)
    eventually(lambda: got)
    assert change_to(4)
    assert not change_to(2)
    running.wait_for_line("error")
    state = service_type("lifecycle_msgs/srv/GetState")
    current = node.create_client("/managed/get_state", state)
    assert current.call(state.Request(), timeout_s=10.0).current_state.label == "unconfigured"
    assert not change_to(3)
    assert running.stop(signal.SIGINT) == 0


def test_a_client_of_python_sends_goals_to_a_server_of_cpp(graph: Graph, probe: Probe) -> None:
    running = probe("serve_action")
    running.wait_for_line("ready")
    client = ActionClient(
        graph.create_node("tester"), "fibonacci", "example_interfaces/Fibonacci", ros_version=2
    )
    assert client.wait_for_server(20.0)
    goal = client.send_goal({"order": 5})
    assert goal.wait(20.0)
    assert (goal.status, list(goal.result.sequence)) == (Ros2Status.SUCCEEDED, [0, 1, 1, 2, 3, 5])
    endless = client.send_goal({"order": 40})
    eventually(lambda: endless.feedback is not None)
    endless.cancel()
    assert endless.wait(20.0)
    assert endless.status is Ros2Status.CANCELED
    assert not client.send_goal({"order": 41}).is_accepted
    assert running.stop(signal.SIGINT) == 0


def test_a_client_of_cpp_sends_goals_to_a_server_of_python(graph: Graph, probe: Probe) -> None:
    def take(goal: ServerGoal) -> None:
        goal.accept()
        goal.publish_feedback({"sequence": [0, 1]})
        goal.succeed({"sequence": [0, 1, 1]})

    node = graph.create_node("tester")
    ActionServer(node, "fibonacci", "example_interfaces/Fibonacci", on_goal=take, ros_version=2)
    running = probe("act")
    assert running.wait() == 0
    assert "result 4 3" in running.lines


def test_timers_follow_simulated_time(graph: Graph, probe: Probe) -> None:
    clock = message_type("rosgraph_msgs/msg/Clock")
    publisher = graph.create_node("world").create_publisher("/clock", clock)

    def show(milliseconds: int) -> None:
        message = clock()
        message.clock.sec, rest = divmod(milliseconds, 1000)
        message.clock.nanosec = rest * 1_000_000
        publisher.publish(message)

    running = probe("sim_time", "--ros-args", "-p", "use_sim_time:=true")
    running.wait_for_line("simulated")
    running.wait_for_line("ready")
    eventually(lambda: publisher.matched)
    show(500)
    eventually(lambda: (show(1500), any(line.startswith("tick 1") for line in running.lines))[1])
    show(2500)
    running.wait_for_line("tick 2 at 2500000000")
    # Time goes back: the next call is a period later.
    show(100)
    show(1200)
    running.wait_for_line("tick 3 at 1200000000")
    assert running.stop(signal.SIGINT) == 0
