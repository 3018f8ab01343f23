from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError
from gazelle.graph import (
    Graph,
    IllegalNameError,
    Level,
    ServiceCallError,
    ServiceUnavailableError,
    offer_loggers,
)
from gazelle.graph import node as node_module
from gazelle.graph.process_queries import ask_process, shut_down_node
from gazelle.interfaces import (
    message_type,
    ros1_message_type,
    ros1_service_type,
    service_type,
)

String = message_type("std_msgs/msg/String")
Empty = service_type("std_srvs/srv/Empty")
Wait = Callable[..., Any]


def test_names_are_resolved_and_remapped(graph: Graph) -> None:
    node = graph.create_node("n", namespace="ns", remappings={"in": "/out", "~p": "q"})
    assert (node.name, node.namespace) == ("/ns/n", "/ns")
    assert node.create_publisher("in", String).topic == "/out"
    assert node.create_publisher("x", String).topic == "/ns/x"
    assert node.create_subscription("~p", String, print).topic == "/ns/q"
    assert node.resolve_name("~y") == "/ns/n/y"
    with pytest.raises(IllegalNameError, match="Character \\[-\\]"):
        node.create_publisher("my-topic", String)


def test_a_callback_of_the_transport_knows_who_publishes_without_asking(
    graph: Graph, other: Graph, inbox: Any, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = graph.create_node("n")
    node.create_subscription(
        "in", String, lambda _message: inbox(node.publisher_names("in")), inline=True
    )
    # Whoever asks there waits for an answer that nobody can take meanwhile.
    monkeypatch.setattr(graph.discovery, "ask", None)
    talker = other.create_node("talker").create_publisher("in", String)
    eventually(lambda: graph.publisher_count("/in") == 1 and talker.subscription_count == 1)
    talker.publish(String(data="x"))
    assert inbox.wait_for(1) == [("/talker",)]


def test_ros_namespace_is_the_default_namespace(join: Callable[..., Graph]) -> None:
    graph = join(environ={"ROS_NAMESPACE": "robot1"})
    assert graph.create_node("n").name == "/robot1/n"


def test_anonymous_nodes_live_side_by_side(graph: Graph) -> None:
    names = {graph.create_node("n", anonymous=True).name for _ in range(3)}
    assert len(names) == 3
    assert set(graph.node_names()) == names


def test_newer_node_of_the_same_name_ends_the_older(
    graph: Graph, other: Graph, inbox: Any, eventually: Wait, capsys: pytest.CaptureFixture[str]
) -> None:
    older = graph.create_node("n")
    older.create_publisher("old", String)
    older.on_shutdown(inbox)
    newer = other.create_node("n")
    assert inbox.wait_for(1) == ["new node registered with same name"]
    eventually(lambda: older.closed and "/old" not in dict(other.topic_names_and_types()))
    assert not newer.closed
    eventually(lambda: other.node_names() == ("/n",))
    assert "shutdown request: [/n] Reason: new node registered with same name" in (
        capsys.readouterr().err
    )


def test_older_node_that_is_heard_of_late_ends_too(
    graph: Graph, other: Graph, inbox: Any, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Word of a node takes a moment: of two that start at once none knows of the other."""
    older = graph.create_node("n")
    older.on_shutdown(inbox)
    with monkeypatch.context() as late:
        late.setattr(other.discovery, "known", lambda: ())
        newer = other.create_node("n")
    # Where the true word has not come meanwhile.
    other._duplicate_nodes._on_entity(older.entity, True)
    assert inbox.wait_for(1) == ["new node registered with same name"]
    assert not newer.closed


def test_nobody_is_asked_to_make_way_any_more_once_the_graph_is_left(
    graph: Graph, other: Graph
) -> None:
    """The thread that asks may be late."""
    older = graph.create_node("n")
    other.close()
    session, zid = other.session, graph.zid
    assert not shut_down_node(session, other.domain, zid, "/n", "reason")
    assert ask_process(session, other.domain, zid) == (0, "")
    assert not older.closed


def test_younger_node_does_not_make_way(graph: Graph, other: Graph) -> None:
    graph.create_node("n")
    since_ns = graph._duplicate_nodes._claims["/n"].since_ns
    newer = other.create_node("n")
    assert not other._shut_node_down("/n", "asked by the older one", since_ns)
    assert not newer.closed


def test_a_callback_that_outlives_its_node_is_no_error(
    graph: Graph, other: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    node = graph.create_node("n")
    publisher = node.create_publisher("out", String)
    begun, ended = threading.Event(), threading.Event()

    threads: list[threading.Thread] = []

    def pass_on(message: Any) -> None:
        threads.append(threading.current_thread())
        begun.set()
        ended.wait(stretched())
        publisher.publish(message)

    node.create_subscription("in", String, pass_on)
    other.create_node("m").create_publisher("in", String, latch=True).publish(String(data="x"))
    assert begun.wait(stretched())
    node.shutdown()
    ended.set()
    threads[0].join(stretched())
    assert capsys.readouterr().err == ""


def test_shutdown_takes_everything_off_the_graph(
    graph: Graph, other: Graph, eventually: Wait
) -> None:
    node = graph.create_node("n")
    node.create_publisher("a", String)
    node.create_subscription("b", String, print)
    node.create_service("c", Empty, print)
    node.create_client("d", Empty)
    eventually(lambda: len(other.entities()) == 6)
    assert len(other.node_info("n").publications) == 2
    reasons: list[str] = []
    node.on_shutdown(reasons.append)
    node.shutdown("bye")
    node.shutdown("again")
    assert reasons == ["bye"]
    eventually(lambda: not other.entities())
    assert graph.nodes == ()
    with pytest.raises(GraphError, match="node /n is shut down; it cannot create x"):
        node.create_publisher("x", String)


def test_log_goes_to_console_and_rosout(
    graph: Graph, other: Graph, inbox: Any, eventually: Wait, capsys: pytest.CaptureFixture[str]
) -> None:
    node = graph.create_node("talker")
    log_class = ros1_message_type("rosgraph_msgs/Log")
    other.create_node("listener").create_subscription("/rosout", log_class, inbox)
    eventually(lambda: node._rosout is not None and node._rosout.matched)
    node.log("debug", "not shown")
    node.log("warn", "careful")
    message = inbox.wait_for(1)[0]
    assert (message.level, message.name, message.msg) == (4, "/talker", "careful")
    assert message.file.endswith("test_node.py")
    assert message.function == "test_log_goes_to_console_and_rosout"
    assert capsys.readouterr().err.endswith("]: careful\n")


def test_loggers_are_read_and_set_by_services(graph: Graph, other: Graph, eventually: Wait) -> None:
    node = graph.create_node("talker")
    offer_loggers(node)
    caller = other.create_node("caller")
    get: Any = ros1_service_type("roscpp/GetLoggers")
    put: Any = ros1_service_type("roscpp/SetLoggerLevel")
    ask = caller.create_client("/talker/get_loggers", get)
    tell = caller.create_client("/talker/set_logger_level", put)
    assert ask.wait_for_service(stretched(10)) and tell.wait_for_service(stretched(10))
    (logger,) = ask.call(get._request_class()).loggers
    assert (logger.name, logger.level) == ("ros", "info")
    tell.call(put._request_class("ros", "debug"))
    assert node.log_level is Level.DEBUG
    with pytest.raises(ServiceCallError, match="'loud' is no level; there are debug, info, warn"):
        tell.call(put._request_class("ros", "loud"))


def test_what_a_node_that_outlives_its_shutdown_makes_reaches_nobody(
    graph: Graph, other: Graph, eventually: Wait
) -> None:
    node = graph.create_node("n")
    node.outlives = True
    before = node.create_publisher("x", String)
    node.shutdown()
    before.publish(String(data="late"))
    after = node.create_publisher("x", String, latch=True)
    after.publish(String(data="late"))
    node.create_subscription("x", String, print)
    server = node.create_service("s", Empty, print)
    client = node.create_client("s", Empty)
    with pytest.raises(ServiceUnavailableError, match="this client was closed"):
        client.call(Empty.Request())
    for one in (after, server, client):
        one.unregister()
    assert not after.matched
    # The end of `before` may still be on its way to the other process.
    eventually(lambda: "/x" not in dict(other.topic_names_and_types()))
    assert not other.services()


@pytest.mark.parametrize("kind", ["Publisher", "Subscription", "ServiceServer", "ServiceClient"])
def test_what_is_being_made_while_its_node_shuts_down_is_taken_off_the_graph(
    kind: str, graph: Graph, monkeypatch: pytest.MonkeyPatch, eventually: Callable[..., Any]
) -> None:
    node = graph.create_node("closing", rosout=False)
    make = getattr(node_module, kind)

    def make_late(*words: Any, **more: Any) -> Any:
        node.shutdown()
        return make(*words, **more)

    monkeypatch.setattr(node_module, kind, make_late)
    if kind == "Publisher":
        node.create_publisher("topic", "std_msgs/msg/String")
    elif kind == "Subscription":
        node.create_subscription("topic", "std_msgs/msg/String", print)
    elif kind == "ServiceServer":
        node.create_service("service", Empty, print)
    else:
        node.create_client("service", Empty)
    eventually(lambda: not graph.entities())
