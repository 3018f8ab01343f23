from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import Endpoint, Graph, NoGraphError, PortTakenError, Qos, TopicInfo, locators
from gazelle.interfaces import message_type, service_type

String = message_type("std_msgs/msg/String")
SetBool = service_type("std_srvs/srv/SetBool")
Join = Callable[..., Graph]
Wait = Callable[..., Any]


def test_first_member_carries_the_hub_others_join(join: Join) -> None:
    first, second, tool = join(), join(role="hub"), join(role="client")
    assert (first.is_hub, second.is_hub, tool.is_hub) == (True, False, False)
    assert first.connected
    assert second.connected
    assert tool.connected


def test_port_of_a_stranger_is_one_clear_error(
    stranger: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.graph.graph._HUB_S", 0.2)
    for role in ("auto", "client"):
        with pytest.raises(PortTakenError) as caught:
            Graph.open(port=stranger, environ={}, role=role)  # type: ignore[arg-type]
        text = str(caught.value)
        place = locators.name_of_hub(stranger)
        assert f"the graph on port {stranger} does not answer: who listens at {place} is" in text
        assert "graph.port-taken" in text
        assert f"export GAZELLE_PORT={stranger + 1}" in text
    assert Graph.current() is None


def test_client_without_a_graph_is_told_how_to_start_one(port: int) -> None:
    with pytest.raises(NoGraphError, match="Unable to communicate with master!"):
        Graph.open(port=port, environ={}, role="client")


def test_fresh_client_sees_everything(
    graph: Graph, other: Graph, join: Join, eventually: Wait
) -> None:
    for number, member in enumerate((graph, other)):
        node = member.create_node(f"n{number}", rosout=False)
        for topic in range(20):
            node.create_publisher(f"t{topic}", String)
        node.create_subscription("t0", None, print)
        node.create_subscription("any", None, print)
        node.create_service(f"s{number}", SetBool, print)
    # Two nodes, 40 publishers, 4 subscriptions and 2 services: all announced, so all are seen.
    for member in (graph, other):
        eventually(lambda member=member: len(member.entities()) == 48)
    tool = join(role="client")
    topics = tool.topics()
    assert len(topics) == 21
    assert topics[0] == TopicInfo("/any", "*", (), ("/n0", "/n1"))
    assert topics[1] == TopicInfo("/t0", "std_msgs/msg/String", ("/n0", "/n1"), ("/n0", "/n1"))
    assert (topics[1].n_publishers, topics[1].n_subscriptions) == (2, 2)
    assert [(one.name, one.type_name, one.servers) for one in tool.services()] == [
        ("/s0", "std_srvs/srv/SetBool", ("/n0",)),
        ("/s1", "std_srvs/srv/SetBool", ("/n1",)),
    ]
    assert tool.node_names() == ("/n0", "/n1")
    assert graph.topics() == other.topics() == topics


def test_hidden_names_are_left_out(graph: Graph) -> None:
    node = graph.create_node("n", rosout=False)
    node.create_publisher("/_hidden", String)
    node.create_publisher("/a/_b/c", String)
    assert graph.topics() == ()
    assert len(graph.topics(include_hidden=True)) == 2


def test_node_info_knows_the_process(graph: Graph, join: Join, eventually: Wait) -> None:
    import os

    node = graph.create_node("n", rosout=False)
    node.create_publisher("a", String)
    node.create_client("s", SetBool)
    tool = join(role="client")
    eventually(lambda: len(tool.entities()) == 3)
    info = tool.node_info("n")
    assert info.publications == (Endpoint("/a", "std_msgs/msg/String"),)
    assert info.clients == (Endpoint("/s", "std_srvs/srv/SetBool"),)
    assert (info.pid, info.host) == (os.getpid(), socket.gethostname())
    with pytest.raises(NotFoundError, match="node '/m' not found"):
        graph.node_info("/m")


def test_node_can_be_killed_by_name(graph: Graph, join: Join, inbox: Any, eventually: Wait) -> None:
    node = graph.create_node("n")
    node.on_shutdown(inbox)
    tool = join(role="client")
    eventually(tool.node_names)
    assert tool.kill_node("/n")
    assert inbox.wait_for(1) == ["user request"]
    eventually(lambda: node.closed)


def test_domains_do_not_see_each_other(graph: Graph, join: Join) -> None:
    elsewhere = join(environ={"ROS_DOMAIN_ID": "7"})
    graph.create_node("n")
    assert elsewhere.node_names() == ()


def test_publishers_and_subscriptions_of_a_topic(
    graph: Graph, other: Graph, eventually: Wait
) -> None:
    graph.create_node("a").create_publisher("x", String, latch=True, reliable=False, queue_size=3)
    other.create_node("b").create_subscription("x", String, print)
    (publisher,) = eventually(lambda: other.publishers_info("x"))
    assert (publisher.node, publisher.type_name, publisher.qos) == (
        "/a",
        "std_msgs/msg/String",
        Qos(False, True, 3),
    )
    (subscription,) = eventually(lambda: graph.subscriptions_info("/x"))
    assert subscription.node == "/b"


def test_changes_of_the_graph_are_told(graph: Graph, other: Graph, inbox: Any) -> None:
    graph.discovery.listen(lambda entity, is_there: inbox(entity.node, is_there))
    node = other.create_node("n", rosout=False)
    assert inbox.wait_for(1) == [("/n", True)]
    node.shutdown()
    assert inbox.wait_for(2)[1] == ("/n", False)


def test_closed_graph_is_no_longer_current(graph: Graph) -> None:
    assert Graph.current() is graph
    graph.close()
    graph.close()
    assert Graph.current() is None
    for use in (lambda: graph.create_node("n"), graph.entities):
        with pytest.raises(GraphError, match="the graph is closed"):
            use()


def test_graphs_larger_than_a_channel_of_the_transport_are_listed(graph: Graph, join: Join) -> None:
    node = graph.create_node("many")
    for number in range(400):
        node.create_client(f"service_{number}", SetBool)
    late = join()
    found: list[int] = []
    # Where zenoh's own channel of 256 places is full, it holds the lock of the whole session.
    for one in (graph, late, join(role="client")):
        asking = threading.Thread(
            target=lambda one=one: found.append(len(one.entities())), daemon=True
        )
        asking.start()
        asking.join(stretched(30))
    assert [count > 400 for count in found] == [True, True, True]
