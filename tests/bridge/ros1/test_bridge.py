"""The bridge as a whole: masters, names, ends."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.bridge.ros1.peer import Peer, ask, string_bytes
from tests.patience import stretched

from gazelle.bridge.ros1 import Address, Bridge, MasterAddress
from gazelle.bridge.ros1.master_connection import EmbeddedMaster
from gazelle.errors import GraphError
from gazelle.graph import Graph

Eventually = Callable[[Callable[[], Any]], Any]
HERE = "127.0.0.1"
ADDRESS = Address(HERE, HERE, frozenset({HERE}))
STRING = "std_msgs/String"
STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"


@pytest.fixture
def master(next_port: Callable[[], int]) -> Iterator[EmbeddedMaster]:
    """A master that is not the bridge's, with parameters of its own."""
    with Graph.open(port=next_port(), environ={}) as elsewhere:
        found = EmbeddedMaster(
            elsewhere.parameters, MasterAddress(HERE, 0), ADDRESS, lambda: None, print
        )
        yield found
        found.close()


@pytest.fixture
def joined(make_bridge: Callable[..., Bridge], master: EmbeddedMaster) -> Bridge:
    """A bridge that has joined that master."""
    port = int(master.uri.rstrip("/").rpartition(":")[2])
    return make_bridge(MasterAddress(HERE, port))


def test_second_bridge_is_refused(bridge: Bridge, make_bridge: Callable[..., Bridge]) -> None:
    with pytest.raises(GraphError, match="already runs on this graph") as raised:
        make_bridge()
    assert "[bridge.second]" in str(raised.value)


def test_port_of_another_program_is_told(make_bridge: Callable[..., Bridge]) -> None:
    with socket.create_server((HERE, 0)) as other:
        port = other.getsockname()[1]
        with pytest.raises(GraphError, match=f"port {port} is taken by a program") as raised:
            make_bridge(MasterAddress(HERE, port))
    assert "[bridge.master-port-taken]" in str(raised.value)


def test_master_on_another_machine_must_run(make_bridge: Callable[..., Bridge]) -> None:
    with pytest.raises(GraphError, match="no ROS 1 master answers at") as raised:
        make_bridge(MasterAddress("nowhere.invalid", 11311))
    assert "[bridge.no-master]" in str(raised.value)


def test_nodes_of_both_sides_show_on_the_other(
    graph: Graph, bridge: Bridge, peer: Peer, eventually: Eventually
) -> None:
    graph.create_node("talker", namespace="/robot")
    peer.publish_on("/hello", STRING, STRING_MD5)
    eventually(lambda: bridge.nodes == (("/robot/talker",), ("/peer",)))
    # The bridge knows of a node a little before the master does.
    eventually(lambda: "/robot/talker" in str(peer.call("getSystemState")[0]))
    uri = peer.call("lookupNode", "/robot/talker")
    assert ask(uri, "getPid", "/peer")[0] == 1
    assert ask(uri, "getPublications", "/peer")[2] == [["/rosout", "rosgraph_msgs/Log"]]
    assert ask(uri, "getSubscriptions", "/peer")[2] == []
    assert ask(uri, "getMasterUri", "/peer")[2] == bridge.master.uri
    assert graph.node_info("/peer").publications[0].name == "/hello"


def test_connections_are_listed(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    node = graph.create_node("talker", rosout=False)
    node.create_publisher("/chatter", "std_msgs/msg/String")
    node.create_subscription("/hello", "std_msgs/msg/String", lambda message: None)
    peer.publish_on("/hello", STRING, STRING_MD5, string_bytes("x"))
    eventually(lambda: "/talker" in str(peer.call("getSystemState")[0]))
    uri = peer.call("lookupNode", "/talker")
    peer.subscribe(uri, "/chatter")
    wanted = [
        [1, "/peer", "o", "TCPROS", "/chatter", True],
        [2, "/peer", "i", "TCPROS", "/hello", True],
    ]
    eventually(lambda: ask(uri, "getBusInfo", "/peer")[2] == wanted)
    assert ask(uri, "getBusStats", "/peer")[2] == [[["/chatter", 0, [[1, 0, 0, 1]]]], [], []]


def test_node_that_ends_leaves_the_master(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    node = graph.create_node("talker")
    peer.call("registerSubscriber", "/rosout", "rosgraph_msgs/Log", peer.uri)
    eventually(lambda: peer.call("getSystemState")[0])
    node.shutdown()
    eventually(lambda: peer.call("getSystemState")[0] == [])
    eventually(lambda: peer.updates[-1] == ("publisherUpdate", ("/master", "/rosout", [])))


def test_shutdown_from_ros1_ends_the_node(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    node = graph.create_node("talker")
    eventually(lambda: peer.call("getSystemState")[0])
    assert ask(peer.call("lookupNode", "/talker"), "shutdown", "/rosnode", "user request")[0] == 1
    eventually(lambda: node.closed)


def test_ending_a_node_of_ros1_reaches_it(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    peer.publish_on("/hello", STRING, STRING_MD5)
    peer.call("registerSubscriber", "/in", STRING, peer.uri)
    eventually(lambda: graph.subscriptions_info("/in"))
    assert graph.kill_node("/peer", "enough")
    eventually(lambda: ("shutdown", ("/ros1_bridge", "enough")) in peer.updates)
    peer.call("unregisterPublisher", "/hello", peer.uri)
    eventually(lambda: not graph.subscriptions_info("/in"))


def test_newer_node_of_the_same_name_ends_the_older(
    graph: Graph, make_peer: Callable[..., Peer], eventually: Eventually
) -> None:
    node = graph.create_node("talker")
    peer = make_peer("/talker")
    eventually(lambda: peer.call("getSystemState")[0])
    peer.publish_on("/hello", STRING, STRING_MD5)
    eventually(lambda: node.closed)
    eventually(lambda: graph.publishers_info("/hello"))
    assert peer.call("lookupNode", "/talker") == peer.uri


def test_master_that_runs_is_joined_and_left(
    graph: Graph, master: EmbeddedMaster, joined: Bridge, eventually: Eventually
) -> None:
    assert joined.master.uri == master.uri
    assert not joined.master.is_embedded
    graph.create_node("talker").create_publisher("/chatter", "std_msgs/msg/String")
    eventually(lambda: ("/talker", "/chatter") in master.state().publishers)
    joined.close()
    assert not any(master.state()[:3])
    assert not master._master.registry.listeners("/any")


def test_name_that_ros1_uses_gets_an_ending(
    graph: Graph, master: EmbeddedMaster, make_bridge: Callable[..., Bridge],
    eventually: Eventually,
) -> None:  # fmt: skip
    graph.create_node("rosout", rosout=False).create_publisher("/a", "std_msgs/msg/String")
    peer = Peer(master.uri, "/rosout")
    peer.call("registerPublisher", "/hello", STRING, peer.uri)
    make_bridge(MasterAddress(HERE, int(master.uri.rstrip("/").rpartition(":")[2])))
    eventually(lambda: ("/rosout_gazelle", "/a") in master.state().publishers)
    eventually(lambda: graph.publishers_info("/hello"))
    assert graph.publishers_info("/hello")[0].node == "/ros1_bridge"
    assert not peer.updates
    peer.close()


def test_rosout_of_a_roscore_that_is_still_starting_does_not_end_ours(
    graph: Graph, master: EmbeddedMaster, make_bridge: Callable[..., Bridge],
    eventually: Eventually,
) -> None:  # fmt: skip
    ours = graph.create_node("rosout", rosout=False)
    ours.create_publisher("/a", "std_msgs/msg/String")
    make_bridge(MasterAddress(HERE, int(master.uri.rstrip("/").rpartition(":")[2])))
    eventually(lambda: "/a" in {topic for _, topic in master.state().publishers})
    peer = Peer(master.uri, "/rosout")
    peer.call("registerPublisher", "/rosout_agg", "rosgraph_msgs/Log", peer.uri)
    assert {("/rosout_gazelle", "/a"), ("/rosout", "/rosout_agg")} <= master.state().publishers
    peer.call("registerPublisher", "/hello", STRING, peer.uri)
    eventually(lambda: graph.publishers_info("/hello"))
    assert not ours.closed
    peer.close()


def test_parameters_of_both_sides_become_one(
    graph: Graph, master: EmbeddedMaster, make_bridge: Callable[..., Bridge],
    eventually: Eventually,
) -> None:  # fmt: skip
    graph.parameters.set("/ours", {"a": 1})
    graph.parameters.set("/both", "ours")
    for name, value in (("/theirs", [1.5, True]), ("/both", "theirs")):
        master.ask("setParam", "/peer", name, value)
    make_bridge(MasterAddress(HERE, int(master.uri.rstrip("/").rpartition(":")[2])))
    assert graph.parameters.get("/theirs") == [1.5, True]
    assert graph.parameters.get("/both") == "theirs"
    assert master.ask("getParam", "/peer", "/ours/a") == 1
    graph.parameters.set("/ours/a", 2)
    eventually(lambda: master.ask("getParam", "/peer", "/ours/a") == 2)
    master.ask("setParam", "/peer", "/theirs", "new")
    eventually(lambda: graph.parameters.get("/theirs") == "new")
    master.ask("deleteParam", "/peer", "/theirs")
    eventually(lambda: not graph.parameters.has("/theirs"))
    graph.parameters.delete("/ours/a")
    eventually(lambda: not master.ask("hasParam", "/peer", "/ours/a"))


def test_master_that_comes_back_learns_everything_again(
    graph: Graph, master: EmbeddedMaster, joined: Bridge, eventually: Eventually,
    capfd: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    graph.create_node("talker").create_publisher("/chatter", "std_msgs/msg/String")
    eventually(lambda: ("/talker", "/chatter") in master.state().publishers)
    master.close()
    seen: list[str] = []

    def told() -> bool:
        seen.append(capfd.readouterr().err)
        return "the master does not answer" in "".join(seen)

    eventually(told)
    port = int(master.uri.rstrip("/").rpartition(":")[2])
    again = EmbeddedMaster(
        graph.parameters, MasterAddress(HERE, port), ADDRESS, lambda: None, print
    )
    try:
        eventually(lambda: ("/talker", "/chatter") in again.state().publishers)
    finally:
        joined.close()
        again.close()


def test_master_that_was_started_anew_unseen_learns_everything_again(
    graph: Graph, master: EmbeddedMaster, joined: Bridge, eventually: Eventually,
    capfd: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    """Faster than the bridge looks; the one before left no connection open."""
    graph.create_node("talker").create_publisher("/chatter", "std_msgs/msg/String")
    graph.parameters.set("/ours", 1)
    eventually(lambda: ("/talker", "/chatter") in master.state().publishers)
    eventually(lambda: master.ask("getParam", "/peer", "/ours") == 1)
    master._master.registry.__init__()
    eventually(lambda: ("/talker", "/chatter") in master.state().publishers)
    eventually(lambda: master._master.registry.listeners("/any"))
    said: list[str] = []

    def is_over() -> bool:
        said.append(capfd.readouterr().err)
        return f"the master at {master.uri} answers again" in "".join(said)

    eventually(is_over)
    assert "".join(said).count("has forgotten everything; it is told again") == 1


def test_topic_that_ros1_does_not_define_is_told_once(
    graph: Graph, bridge: Bridge, peer: Peer, capfd: pytest.CaptureFixture[str],
    eventually: Eventually,
) -> None:  # fmt: skip
    node = graph.create_node("talker", rosout=False)
    node.create_publisher("/one", "geometry_msgs/msg/VelocityStamped")
    node.create_publisher("/two", "geometry_msgs/msg/VelocityStamped")
    eventually(lambda: len(peer.call("getSystemState")[0]) == 2)
    text = "".join(capfd.readouterr())
    assert text.count("VelocityStamped, which ROS 1 does not define") == 1


def test_topic_of_an_unknown_type_is_told(
    graph: Graph, bridge: Bridge, peer: Peer, capfd: pytest.CaptureFixture[str],
    eventually: Eventually,
) -> None:  # fmt: skip
    peer.publish_on("/odd", "odd_msgs/Odd", "0" * 32)
    peer.publish_on("/hello", STRING, STRING_MD5)
    eventually(lambda: graph.publishers_info("/hello"))
    text = capfd.readouterr().err
    assert text.count("does not cross the bridge") == 1
    assert (
        "topic /odd of /peer does not cross the bridge: "
        "nothing here defines its type odd_msgs/Odd\n"
        "  fix: start the bridge where the package that defines it is found"
    ) in text


def test_names_that_the_graph_cannot_have_do_no_harm(
    graph: Graph, master: EmbeddedMaster, joined: Bridge, eventually: Eventually
) -> None:
    # A real master takes any text for a name.
    master._master.registry.add_publisher("/odd-name", "/fine", STRING, "http://127.0.0.1:1/")
    master._master.registry.add_publisher("/peer", "/odd topic", STRING, "http://127.0.0.1:1/")
    eventually(lambda: graph.publishers_info("/fine"))
    assert graph.publishers_info("/fine")[0].node == "/ros1_bridge"
    assert not [one for one in graph.topics() if "odd" in one.name]


def test_ending_the_bridges_node_ends_the_bridge(graph: Graph, bridge: Bridge) -> None:
    ended = threading.Event()
    bridge.on_end(ended.set)
    assert graph.kill_node("/ros1_bridge")
    assert ended.wait(stretched(30))
