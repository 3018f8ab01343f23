from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.errors import NotFoundError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type
from gazelle.simulator.intra_process_node import LocalNode

STRING = "std_msgs/String"


def test_a_message_reaches_subscribers_as_the_same_object() -> None:
    node, got = LocalNode(), []
    publisher = node.create_publisher("chatter", message_type(STRING))
    assert not publisher.matched
    subscription = node.create_subscription("/chatter", None, got.append)
    assert publisher.matched
    message = message_type(STRING)(data="hello")
    publisher.publish(message)
    assert got[0] is message
    subscription.unregister()
    assert not publisher.matched


def test_a_latched_message_waits_for_late_subscribers() -> None:
    node, got = LocalNode(), []
    node.create_publisher("a", message_type(STRING), latch=True).publish(
        message_type(STRING)(data="kept")
    )
    node.create_subscription("a", None, got.append)
    assert [message.data for message in got] == ["kept"]


def test_services_answer_and_unknown_ones_name_the_nearest() -> None:
    node, empty = LocalNode(), service_type("std_srvs/Empty")
    service = node.create_service("/pause", empty, lambda request: empty.Response())
    assert node.call("pause", empty.Request()) == empty.Response()
    with pytest.raises(NotFoundError, match="service '/paus' not found; did you mean '/pause'"):
        node.call("/paus", empty.Request())
    service.unregister()
    assert node.services == ()


def test_parameters_are_kept() -> None:
    node = LocalNode()
    node.parameters.set("/use_sim_time", True)
    assert node.parameters.has("/use_sim_time")
    assert node.parameters.get("/rate", 5) == 5
    with pytest.raises(KeyError):
        node.parameters.get("/rate")


@pytest.fixture
def nodes(free_port: int) -> Iterator[tuple[LocalNode, Node]]:
    """A node without a graph that has joined one, and another node of that graph."""
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        local = LocalNode()
        local.join(graph.create_node("local", rosout=False))
        yield local, graph.create_node("other", rosout=False)
        local.leave()


def test_a_node_that_joins_a_graph_is_heard_there(nodes: tuple[LocalNode, Node]) -> None:
    local, other = nodes
    got: list[Any] = []
    other.create_subscription("/chatter", message_type(STRING), got.append)
    publisher = local.create_publisher("/chatter", message_type(STRING))
    eventually(lambda: publisher.matched)
    publisher.publish(message_type(STRING)(data="hello"))
    eventually(lambda: [one.data for one in got] == ["hello"])


def test_what_was_latched_before_a_graph_is_joined_is_heard_there(free_port: int) -> None:
    got: list[Any] = []
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        local = LocalNode()
        publisher = local.create_publisher("/map", message_type(STRING), latch=True)
        publisher.publish(message_type(STRING)(data="kept"))
        local.join(graph.create_node("local", rosout=False))
        other = graph.create_node("other", rosout=False)
        other.create_subscription("/map", message_type(STRING), got.append)
        eventually(lambda: [one.data for one in got] == ["kept"])


def test_a_node_that_joins_a_graph_hears_others_but_not_itself(
    nodes: tuple[LocalNode, Node],
) -> None:
    local, other = nodes
    got: list[Any] = []
    local.create_subscription("/go", message_type(STRING), got.append)
    own = local.create_publisher("/go", message_type(STRING))
    theirs = other.create_publisher("/go", message_type(STRING))
    eventually(lambda: theirs.matched)
    own.publish(message_type(STRING)(data="own"))
    local.publish("/go", message_type(STRING)(data="once"))
    theirs.publish(message_type(STRING)(data="theirs"))
    eventually(lambda: len(got) >= 3)
    assert [one.data for one in got] == ["own", "once", "theirs"]


def test_services_are_answered_for_the_graph(nodes: tuple[LocalNode, Node]) -> None:
    local, other = nodes
    empty = service_type("std_srvs/Empty")
    local.create_service("/pause", empty, lambda request: empty.Response())
    client = other.create_client("/pause", empty)
    assert eventually(lambda: client.call(empty.Request())) == empty.Response()


def test_a_node_that_leaves_is_not_there_any_more(nodes: tuple[LocalNode, Node]) -> None:
    local, other = nodes
    publisher = local.create_publisher("/chatter", message_type(STRING))
    other.create_subscription("/chatter", message_type(STRING), lambda message: None)
    eventually(lambda: publisher.matched)
    local.leave()
    assert not publisher.matched
