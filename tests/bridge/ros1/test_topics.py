"""Topics over the bridge, both ways."""

from __future__ import annotations

import contextlib
import socket
import struct
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
from tests.bridge.ros1.peer import Peer, read_block, string_bytes

from gazelle.bridge.ros1 import Bridge
from gazelle.graph import Graph, Kind
from gazelle.interfaces import from_ros1, md5sum, message_type, ros1_message_type, to_ros1

Eventually = Callable[[Callable[[], Any]], Any]
STRING = "std_msgs/String"
STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"


def state_of(peer: Peer) -> tuple[dict[str, list[str]], ...]:
    """Publishers, subscribers and services of the master: name → nodes."""
    return tuple(dict(side) for side in peer.call("getSystemState"))


def publisher_uri(peer: Peer, node: str) -> str:
    return str(peer.call("lookupNode", node))


def heard(stream: socket.socket, say: Callable[[], None]) -> bytes:
    """What arrives after something was said; nothing while the way is not open yet."""
    stream.settimeout(0.1)
    say()
    with contextlib.suppress(TimeoutError):
        return read_block(stream)
    return b""


def test_topic_of_a_node_is_registered_under_its_own_name(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    talker = graph.create_node("talker", rosout=False)
    talker.create_publisher("/chatter", "std_msgs/msg/String")
    eventually(lambda: state_of(peer)[0].get("/chatter") == ["/talker"])
    assert peer.call("getTopicTypes") == [["/chatter", STRING]]
    assert peer.call("getPublishedTopics", "") == [["/chatter", STRING]]


def test_subscriber_of_ros1_gets_header_and_messages(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    out = graph.create_node("talker", rosout=False).create_publisher(
        "/chatter", "std_msgs/msg/String"
    )
    eventually(lambda: "/chatter" in state_of(peer)[0])
    assert not out.matched
    header, stream = peer.subscribe(publisher_uri(peer, "/talker"), "/chatter")
    assert header == {
        "callerid": "/talker",
        "latching": "0",
        "md5sum": STRING_MD5,
        "message_definition": "string data\n",
        "topic": "/chatter",
        "type": STRING,
    }
    eventually(lambda: out.matched)
    out.publish(out.message_class(data="one"))
    assert read_block(stream) == string_bytes("one")
    stream.close()
    eventually(lambda: not out.matched)


def test_sequence_is_counted_in_the_header(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    scan = message_type("sensor_msgs/msg/LaserScan")
    out = graph.create_node("lidar", rosout=False).create_publisher("/scan", scan)
    eventually(lambda: "/scan" in state_of(peer)[0])
    _, stream = peer.subscribe(publisher_uri(peer, "/lidar"), "/scan")
    eventually(lambda: out.matched)
    for number in (1, 2, 3):
        message = scan(ranges=[float(number)], angle_max=1.5)
        message.header.frame_id = "laser"
        message.header.stamp.sec = number
        out.publish(message)
    view: Any = ros1_message_type("sensor_msgs/LaserScan")
    got = [from_ros1(view, read_block(stream)) for _ in range(3)]
    assert [one.header.seq for one in got] == [1, 2, 3]
    assert [one.header.stamp.secs for one in got] == [1, 2, 3]
    assert [list(one.ranges) for one in got] == [[1.0], [2.0], [3.0]]
    assert got[0].header.frame_id == "laser"


def test_image_arrives_to_the_byte(graph: Graph, peer: Peer, eventually: Eventually) -> None:
    image = message_type("sensor_msgs/msg/Image")
    out = graph.create_node("camera", rosout=False).create_publisher("/image", image)
    eventually(lambda: "/image" in state_of(peer)[0])
    _, stream = peer.subscribe(publisher_uri(peer, "/camera"), "/image")
    eventually(lambda: out.matched)
    pixels = bytes(range(256)) * 3600
    message = image(height=480, width=640, encoding="rgb8", step=1920, data=pixels)
    out.publish(message)
    got = read_block(stream)
    assert got[:4] == struct.pack("<I", 1)
    assert got[4:] == to_ros1(message)[4:]


def test_late_subscriber_gets_what_was_latched(
    graph: Graph, make_peer: Callable[..., Peer], eventually: Eventually
) -> None:
    out = graph.create_node("map", rosout=False).create_publisher(
        "/note", "std_msgs/msg/String", latch=True
    )
    out.publish(out.message_class(data="kept"))
    first, second = make_peer("/first"), make_peer("/second")
    eventually(lambda: "/note" in state_of(first)[0])
    for peer in (first, second):
        header, stream = peer.subscribe(publisher_uri(peer, "/map"), "/note")
        assert header["latching"] == "1"
        assert read_block(stream) == string_bytes("kept")


def test_each_connection_carries_its_own_publisher_only(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    outs = [
        graph.create_node(name, rosout=False).create_publisher("/tf_note", "std_msgs/msg/String")
        for name in ("left", "right")
    ]
    eventually(lambda: state_of(peer)[0].get("/tf_note") == ["/left", "/right"])
    streams = [
        peer.subscribe(publisher_uri(peer, name), "/tf_note")[1] for name in ("/left", "/right")
    ]
    for out, text in zip(outs, ("L", "R"), strict=True):
        eventually(partial(getattr, out, "matched"))
        out.publish(out.message_class(data=text))
    assert [read_block(stream) for stream in streams] == [string_bytes("L"), string_bytes("R")]


def test_subscriber_with_another_md5sum_is_refused_in_words_of_ros(
    graph: Graph, peer: Peer, eventually: Eventually
) -> None:
    node = graph.create_node("talker", rosout=False)
    node.create_publisher("/chatter", "std_msgs/msg/String")
    eventually(lambda: "/chatter" in state_of(peer)[0])
    uri = publisher_uri(peer, "/talker")
    header, _ = peer.subscribe(uri, "/chatter", "std_msgs/Int32", md5sum("std_msgs/Int32"))
    assert header["error"] == (
        "Client [/peer] wants topic [/chatter] to have datatype/md5sum "
        "[std_msgs/Int32/da5909fbe378aeaf85e547e830cc1bb7], but our version has "
        f"[{STRING}/{STRING_MD5}] Dropping connection."
    )


def test_topic_of_ros1_reaches_subscriptions(
    graph: Graph, peer: Peer, inbox: Any, eventually: Eventually
) -> None:
    peer.publish_on("/hello", STRING, STRING_MD5, string_bytes("a"), string_bytes("b"))
    eventually(lambda: [one for one in graph.topics() if one.publishers == ("/peer",)])
    assert graph.topic_names_and_types()[0] == ("/hello", "std_msgs/msg/String")
    assert not peer.headers
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/hello", "std_msgs/msg/String", inbox)
    assert [one.data for one in inbox.wait_for(2)] == ["a", "b"]
    assert peer.headers[0]["callerid"] == "/listener"
    assert state_of(peer)[1]["/hello"] == ["/listener"]
    assert "/peer" in graph.node_names()


def test_latched_topic_of_ros1_reaches_late_subscriptions(
    graph: Graph, peer: Peer, make_inbox: Any, eventually: Eventually
) -> None:
    peer.publish_on("/note", STRING, STRING_MD5, string_bytes("kept"), latching="1")
    eventually(lambda: graph.publisher_count("/note"))
    for name in ("early", "late"):
        inbox = make_inbox()
        node = graph.create_node(name, rosout=False)
        node.create_subscription("/note", "std_msgs/msg/String", inbox)
        assert [one.data for one in inbox.wait_for(1)] == ["kept"]


def test_nothing_comes_back_over_the_bridge(
    graph: Graph, peer: Peer, inbox: Any, eventually: Eventually
) -> None:
    node = graph.create_node("both", rosout=False)
    out = node.create_publisher("/loop", "std_msgs/msg/String")
    node.create_subscription("/loop", "std_msgs/msg/String", inbox)
    eventually(lambda: state_of(peer)[0].get("/loop") == ["/both"])
    peer.publish_on("/loop", STRING, STRING_MD5, string_bytes("theirs"))
    peer.call("registerSubscriber", "/loop", STRING, peer.uri)
    eventually(lambda: sorted(state_of(peer)[0]["/loop"]) == ["/both", "/peer"])
    _, stream = peer.subscribe(publisher_uri(peer, "/both"), "/loop")
    inbox.wait_for(1)
    eventually(lambda: graph.subscription_count("/loop") == 2)
    eventually(lambda: heard(stream, lambda: out.publish(out.message_class(data="ours"))))
    assert [one.data for one in inbox.wait_for(2)][:2] == ["theirs", "ours"]
    assert {one.data for one in inbox.items[1:]} == {"ours"}
    ours = [one for one in graph.entities() if one.kind is Kind.PUBLISHER and one.name == "/loop"]
    assert sorted(one.node for one in ours) == ["/both", "/peer"]


def test_log_changes_its_type_on_the_way(
    graph: Graph, peer: Peer, inbox: Any, eventually: Eventually
) -> None:
    log = ros1_message_type("rosgraph_msgs/Log")
    theirs = log(level=8, name="/peer", msg="from ROS 1")
    peer.publish_on("/rosout", log._type, log._md5sum, to_ros1(theirs))
    node = graph.create_node("talker")
    node.create_subscription("/rosout", "rcl_interfaces/msg/Log", inbox)
    got = inbox.wait_for(1)[0]
    assert (got.level, got.msg) == (40, "from ROS 1")
    eventually(lambda: "/talker" in state_of(peer)[0].get("/rosout", []))
    header, stream = peer.subscribe(publisher_uri(peer, "/talker"), "/rosout")
    assert (header["type"], header["md5sum"]) == (log._type, log._md5sum)
    view: Any = log

    def say() -> None:
        node.log("warn", "from here", console=False)

    found = from_ros1(view, eventually(lambda: heard(stream, say)))
    assert (found.level, found.msg, found.name) == (4, "from here", "/talker")


def test_publisher_with_another_md5sum_is_told_once(
    graph: Graph, peer: Peer, bridge: Bridge, capfd: pytest.CaptureFixture[str],
    eventually: Eventually,
) -> None:  # fmt: skip
    peer.publish_on("/hello", STRING, "0" * 32, string_bytes("x"))
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/hello", "std_msgs/msg/String", lambda message: None)
    seen: list[str] = []

    def told() -> bool:
        seen.append(capfd.readouterr().err)
        return "with md5sum 000" in "".join(seen)

    eventually(told)
    assert f"but {STRING_MD5} is known here; its messages are dropped" in "".join(seen)


def test_publisher_without_a_place_is_told(
    graph: Graph, peer: Peer, capfd: pytest.CaptureFixture[str], eventually: Eventually
) -> None:
    peer.place = ["TCPROS", "127.0.0.1", "odd"]
    peer.publish_on("/hello", STRING, STRING_MD5)
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/hello", "std_msgs/msg/String", lambda message: None)
    seen: list[str] = []

    def told() -> bool:
        seen.append(capfd.readouterr().err)
        return "names no place for TCPROS: ['TCPROS', '127.0.0.1', 'odd']" in "".join(seen)

    eventually(told)


def test_connection_is_made_again_when_it_breaks(graph: Graph, peer: Peer, inbox: Any) -> None:
    peer.publish_on("/hello", STRING, STRING_MD5, string_bytes("x"))
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/hello", "std_msgs/msg/String", inbox)
    inbox.wait_for(1)
    peer.streams[-1].close()
    assert [one.data for one in inbox.wait_for(2)] == ["x", "x"]


def test_any_type_is_taken_from_ros1(
    graph: Graph, peer: Peer, inbox: Any, eventually: Eventually
) -> None:
    peer.publish_on("/hello", STRING, STRING_MD5, string_bytes("raw"))
    node = graph.create_node("recorder", rosout=False)
    node.create_subscription("/hello", None, inbox, raw=True)
    data, type_name = inbox.wait_for(1)[0]
    assert type_name == "std_msgs/msg/String"
    assert data.endswith(b"raw\0")
