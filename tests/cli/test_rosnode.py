"""rosnode."""

from __future__ import annotations

import io
import os
import re
import socket

from gazelle.graph import Graph, Node
from gazelle.interfaces import ros1_service_type


def _like_ros_live(graph: Graph) -> None:
    publisher = graph.create_node("joint_state_publisher")
    state = graph.create_node("robot_state_publisher")
    rosout = graph.create_node("rosout", rosout=False)
    rosout.create_subscription("/rosout", "rcl_interfaces/msg/Log", print)
    publisher.create_publisher("/joint_states", "sensor_msgs/JointState")
    state.create_publisher("/tf", "tf2_msgs/TFMessage")
    state.create_publisher("/tf_static", "tf2_msgs/TFMessage")
    state.create_subscription("/joint_states", "sensor_msgs/JointState", print)
    for name in ("get_loggers", "set_logger_level"):
        kind = "GetLoggers" if name == "get_loggers" else "SetLoggerLevel"
        service = ros1_service_type(f"roscpp/{kind}")
        state.create_service(f"/robot_state_publisher/{name}", service, print)


def test_list_is_that_of_ros(graph, run, recorded) -> None:
    _like_ros_live(graph)
    assert run("rosnode", "list") == recorded("node_list")


def test_info_is_that_of_ros(graph, run, recorded) -> None:
    _like_ros_live(graph)

    def neutral(text: str) -> str:
        text = re.sub(r"\w+://[^\s)]*", "URI", text)
        text = re.sub(r"Pid: \d+", "Pid: N", text)
        text = re.sub(r"bound \(.*\) \[\d+\]", "bound", text)
        return re.sub(r"transport: \w+", "transport: T", text)

    ours = run("rosnode", "info", "/robot_state_publisher")
    assert neutral(ours.out) == neutral(recorded("node_info").out)
    assert f"Pid: {os.getpid()}\n" in ours.out
    assert "Connections" not in run("rosnode", "info", "-q", "/robot_state_publisher").out


def test_unknown_node_names_what_is_near(robot: Node, run) -> None:
    found = run("rosnode", "info", "robt")
    assert found.code == 0
    assert "Node [/robt]\nPublications: None\n" in found.out
    assert found.err == "cannot contact [/robt]: unknown node\n  did you mean '/robot'?\n"


def test_addresses_name_machine_port_and_process(robot: Node, run, port: int) -> None:
    uri = f"gazelle://{socket.gethostname()}:{port}/{os.getpid()}"
    assert run("rosnode", "list", "-u").out == f"{uri}\n"
    assert run("rosnode", "list", "-a").out == f"{uri} \t/robot\n"
    assert run("rosnode", "list", "/other").out == "\n"


def test_ping_asks_the_process(robot: Node, run, monkeypatch) -> None:
    monkeypatch.setattr("gazelle.cli.rosnode._PERIOD_S", 0.0)
    lines = run("rosnode", "ping", "-c", "2", "robot").out.splitlines()
    assert lines[:2] == [
        "rosnode: node is [/robot]",
        "pinging /robot with a timeout of 2.0s",
    ]
    assert all(re.fullmatch(r"reply from \S+\ttime=[\d.]+ms", line) for line in lines[2:4])
    assert re.fullmatch(r"ping average: [\d.]+ms", lines[4])
    every = run("rosnode", "ping", "-a").out
    assert every.startswith("Will ping the following nodes: \n * /robot\n\n")
    gone = run("rosnode", "ping", "-c1", "/robt")
    assert (gone.code, gone.err) == (
        0,
        "cannot ping [/robt]: unknown node\n  did you mean '/robot'?\n",
    )


def test_kill_ends_nodes(graph: Graph, run) -> None:
    first, second = graph.create_node("a"), graph.create_node("b")
    reasons: list[str] = []
    first.on_shutdown(reasons.append)
    found = run("rosnode", "kill", "/c")
    assert (found.code, found.err) == (1, "ERROR: Unknown node(s):\n * /c\n")
    assert run("rosnode", "kill", "a")[:2] == (0, "killing /a\nkilled\n")
    graph.discovery.wait_for(lambda known: all(one.node != "/a" for one in known), 5.0)
    assert reasons == ["user request"]
    assert run("rosnode", "kill", "-a").out == "killing /b\nkilled\n"
    graph.discovery.wait_for(lambda known: all(one.node != "/b" for one in known), 5.0)
    assert second.closed
    assert run("rosnode", "kill", "-a").err == "No nodes running\n"


def test_kill_lets_choose(graph: Graph, run, monkeypatch) -> None:
    graph.create_node("a")
    chosen = graph.create_node("b")
    ended: list[str] = []
    chosen.on_shutdown(ended.append)
    monkeypatch.setattr("sys.stdin", io.StringIO("x\n2\n"))
    out = run("rosnode", "kill").out
    assert out.startswith("1. /a\n2. /b\n\nPlease enter the number")
    assert "ERROR: invalid selection" in out
    graph.discovery.wait_for(lambda known: all(one.node != "/b" for one in known), 5.0)
    assert ended


def test_machine_lists_nodes(robot: Node, run) -> None:
    assert run("rosnode", "machine").out == f"{socket.gethostname()}\n"
    assert run("rosnode", "machine", "localhost").out == "/robot\n"
    assert run("rosnode", "machine", "mars").err.startswith(
        "ERROR: cannot resolve machine name [mars] to address"
    )


def test_cleanup_has_nothing_to_do_when_all_answer(robot: Node, run) -> None:
    assert run("rosnode", "cleanup") == (0, "", "")
