"""Programs of roscpp beside nodes of Python: topics, services, parameters, time, names, logs."""

from __future__ import annotations

import signal
from typing import Any

import pytest
from tests.cpp.roscpp.conftest import Probe
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import message_type, ros1_message_type, service_type


def own_lines(running: Any) -> list[str]:
    """What the program said, without what Gazelle told of compiling."""
    return [line for line in running.lines if line and not line.startswith("gazelle: ")]


def lines_of(running: Any, *words: str) -> list[str]:
    return [line for line in running.lines if line.startswith(words)]


def test_callbacks_of_every_signature_hear_a_node_of_python(graph: Graph, probe: Probe) -> None:
    string, got = message_type("std_msgs/msg/String"), []
    node = graph.create_node("tester")
    node.create_subscription("out", string, lambda message: got.append(message.data))
    publisher = node.create_publisher("in", string)
    running = probe("echo")
    running.wait_for_line("ready")
    eventually(lambda: publisher.matched and graph.publisher_count("/out"))
    publisher.publish(string(data="hello"))
    eventually(lambda: got)
    assert got == ["heard hello"]
    words = ("member", "pointer", "mutable", "event", "function", "bound")
    eventually(lambda: len(lines_of(running, *words)) == len(words))
    assert sorted(lines_of(running, *words)) == [
        "bound data hello",
        "event hello from /tester std_msgs/String",
        "function hello",
        "member hello",
        "mutable hello!",
        "pointer hello",
    ]
    assert running.stop(signal.SIGINT) == 0
    assert "ended" in running.lines


def test_parameters_are_those_of_python_nodes(graph: Graph, probe: Probe) -> None:
    graph.parameters.set("/python", {"deep": [1, {"value": 4.5}]})
    running = probe("parameters", "_private:=3")
    assert running.wait() == 0
    assert own_lines(running) == [
        "text hello",
        "number 2.5",
        "rounded 3",
        "list 3",
        "table x",
        "text is no number",
        "private 3",
        "default 7",
        "python 4.5",
        "found /text",
        "deleted",
        "wrong type told",
    ]
    assert graph.parameters.get("/made") == [1, {"name": "two"}]
    assert graph.parameters.get("/probe/private") == 3


def test_names_are_resolved_and_remapped(probe: Probe, graph: Graph) -> None:
    running = probe("names", "__name:=other", "__ns:=/robot", "chatter:=/elsewhere")
    assert running.wait() == 0
    assert own_lines(running)[:6] == [
        "node /robot/other in /robot",
        "remapped /elsewhere",
        "private /robot/other/x",
        "below /robot/below/y",
        "bad name told",
        "package 1",
    ]


def test_services_are_asked_both_ways(graph: Graph, probe: Probe) -> None:
    switch = service_type("std_srvs/srv/SetBool")
    node = graph.create_node("tester")
    node.create_service(
        "python", switch, lambda request: switch.Response(success=True, message=f"{request.data}")
    )
    running = probe("services")
    running.wait_for_line("ready")
    assert lines_of(running, "own", "refused", "nobody", "somebody", "python") == [
        "own on",
        "refused",
        "nobody",
        "python True",
    ]
    client = node.create_client("switch", switch)
    assert client.call(switch.Request(data=True)).message == "on"
    with pytest.raises(Exception, match="switch"):
        client.call(switch.Request(data=False))


def test_timers_follow_simulated_time(graph: Graph, probe: Probe) -> None:
    graph.parameters.set("/use_sim_time", True)
    clock = message_type("rosgraph_msgs/msg/Clock")
    publisher = graph.create_node("world").create_publisher("/clock", clock)
    running = probe("timers")
    running.wait_for_line("ready 1")
    running.wait_for_line("wall")
    running.wait_for_line("steady")
    now = 0

    def step() -> bool:
        nonlocal now
        now += 1
        message = clock()
        message.clock.sec, message.clock.nanosec = now // 4, now % 4 * 250_000_000
        publisher.publish(message)
        return len(lines_of(running, "tick")) >= 3

    eventually(step)
    assert running.wait() == 0
    assert lines_of(running, "once")
    assert len(lines_of(running, "once")) == 1


def test_queues_drop_the_oldest_and_hand_over_the_object_itself(probe: Probe) -> None:
    running = probe("queues")
    assert running.wait() == 0
    assert own_lines(running)[:6] == [
        "waiting 1",
        "last 50",
        "one 1",
        "all 50",
        "same object 1",
        "subscribers 2",
    ]


def test_latched_messages_and_who_connects(graph: Graph, probe: Probe) -> None:
    running = probe("latched")
    running.wait_for_line("ready")
    assert "got the map" in running.lines
    got: list[str] = []
    string = message_type("std_msgs/msg/String")
    node = graph.create_node("tester")
    subscription = node.create_subscription("map", string, lambda message: got.append(message.data))
    eventually(lambda: got == ["the map"])
    running.wait_for_line("connected /tester")
    subscription.unregister()
    running.wait_for_line("left /tester")


def test_logs_have_levels_and_forms(graph: Graph, probe: Probe) -> None:
    log, heard = message_type("rcl_interfaces/msg/Log"), []
    node = graph.create_node("tester")
    node.create_subscription("/rosout", log, lambda message: heard.append(message.msg))
    running = probe("logs")
    running.wait_for_line("ready")
    said = [line.rpartition("]: ")[2] for line in own_lines(running) if "]: " in line]
    assert sorted(said) == sorted(
        ["info 1", "warn 2", "error", "once", "throttled", "condition 1", "heard"]
    )
    eventually(lambda: "warn 2" in heard)
    kind = service_type("roscpp/srv/SetLoggerLevel")
    setter = node.create_client("/probe/set_logger_level", kind)
    setter.call(kind.Request(logger="ros.unknown_package.quiet", level="debug"))
    running.wait_for_line("by service")


def test_a_message_of_any_type_and_a_class_of_the_users_own(graph: Graph, probe: Probe) -> None:
    pose = message_type("geometry_msgs/msg/PoseStamped")
    string = message_type("std_msgs/msg/String")
    copies: list[Any] = []
    texts: list[str] = []
    node = graph.create_node("tester")
    publisher = node.create_publisher("in", pose)
    own = node.create_publisher("own", string)
    node.create_subscription("own_out", string, lambda message: texts.append(message.data))
    running = probe("any")
    running.wait_for_line("ready")
    eventually(lambda: publisher.matched and own.matched)
    sent = pose()
    sent.header.frame_id, sent.pose.position.x = "map", 2.5
    publisher.publish(sent)
    running.wait_for_line("geometry_msgs/PoseStamped d3812c3cbc69362b77dc0b19b345f8f5")
    node.create_subscription("copy", pose, copies.append)
    eventually(lambda: copies)
    assert copies == [sent]
    own.publish(string(data="from python"))
    running.wait_for_line("own from python")
    eventually(lambda: texts == ["made by hand"])


def test_messages_of_several_topics_are_matched(probe: Probe) -> None:
    running = probe("filters")
    assert running.wait() == 0
    assert own_lines(running)[:8] == [
        "exact 2",
        "exact 3",
        "near 1.000000 1.1",
        "near 2.000000 2.1",
        "near 3.000000 3.1",
        "near 4.000000 4.1",
        "cache 2",
        "before 4",
    ]


def test_bags_of_python_are_read_and_written(probe: Probe, tmp_path: Any) -> None:
    from gazelle.bag import open_bag

    file = tmp_path / "test.bag"
    _write_bag(file)
    running = probe("bags", str(file))
    assert running.wait() == 0
    assert own_lines(running)[:4] == [
        "/a one 1",
        "/n std_msgs/Int32 1.5",
        "/a two 2",
        "missing told",
    ]
    first, second = open_bag(file), open_bag(tmp_path / "test.bag.copy")
    rows = [[(one.stamp_ns, bytes(one.data)) for one in bag.messages()] for bag in (first, second)]
    assert rows[0] == rows[1]
    assert len(rows[0]) == 3
    first.close()
    second.close()


def _write_bag(file: Any) -> None:
    from gazelle.bag import Connection, Encoding
    from gazelle.bag.ros1.writer import Ros1Writer
    from gazelle.interfaces import md5sum, ros1_definition, to_ros1

    string, number = ros1_message_type("std_msgs/String"), ros1_message_type("std_msgs/Int32")
    writer = Ros1Writer(file)
    names = ("std_msgs/String", "std_msgs/Int32")
    text, whole = (
        writer.add(Connection(i, topic, name, Encoding.ROS1, ros1_definition(name), md5sum(name)))
        for i, (topic, name) in enumerate(zip(("/a", "/n"), names, strict=True))
    )
    writer.write(text, 1_000_000_000, to_ros1(string(data="one")))
    writer.write(whole, 1_500_000_000, to_ros1(number(data=7)))
    writer.write(text, 2_000_000_000, to_ros1(string(data="two")))
    writer.close()
