"""The bridge with viewers that need no network and no further package."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.bridge.foxglove.conftest import PlainChannel, PlainViewers

from gazelle.bridge.foxglove import FoxgloveBridge
from gazelle.bridge.foxglove.server_interface import Requests
from gazelle.graph import Graph, ServiceRefusedError
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters
from gazelle.interfaces import from_cdr, message_type, service_type, to_cdr

Eventually = Callable[[Callable[[], Any]], Any]
STRING = "std_msgs/msg/String"
String = message_type(STRING)
SetBool = service_type("std_srvs/srv/SetBool")


def text_of(data: bytes) -> str:
    return str(from_cdr(String, data).data)


def test_topics_come_and_go(graph: Graph, viewers: PlainViewers, eventually: Eventually) -> None:
    node = graph.create_node("talker", rosout=False)
    out = node.create_publisher("/chatter", STRING)
    node.create_subscription("/orders", "geometry_msgs/msg/TwistStamped", print)
    node.create_subscription("/anything", None, print)
    node.create_publisher("/_hidden", STRING)
    eventually(lambda: {"/chatter", "/orders"} <= viewers.channels.keys())
    assert viewers.channels["/chatter"].type_name == STRING
    assert "string data" in viewers.channels["/chatter"].schema
    assert "MSG: geometry_msgs/Twist\n" in viewers.channels["/orders"].schema
    assert not {"/anything", "/_hidden"} & viewers.channels.keys()
    out.unregister()
    eventually(lambda: "/chatter" not in viewers.channels)


def test_two_types_of_a_topic_are_two_channels(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    node = graph.create_node("talker", rosout=False)
    words = node.create_publisher("/both", STRING)
    numbers = node.create_publisher("/both", "std_msgs/msg/Int32")

    def both() -> dict[str, PlainChannel]:
        found = {one.type_name: one for one in viewers.all_channels if one.topic == "/both"}
        return found if len(found) == 2 else {}

    channels = eventually(both)
    viewers.requests.subscribe(1, channels[STRING].number)
    eventually(lambda: words.matched)
    numbers.publish(message_type("std_msgs/msg/Int32")(data=5))
    words.publish(String(data="hello"))
    eventually(lambda: channels[STRING].sent)
    assert [text_of(data) for data, _ in channels[STRING].sent] == ["hello"]


def test_graph_is_listened_to_only_while_somebody_looks(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    out = graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    number = eventually(lambda: viewers.channels.get("/chatter")).number
    assert not out.matched
    viewers.requests.subscribe(1, number)
    viewers.requests.subscribe(2, number)
    eventually(lambda: out.matched)
    viewers.requests.unsubscribe(1, number)
    out.publish(String(data="one"))
    eventually(lambda: viewers.channels["/chatter"].sent)
    viewers.requests.unsubscribe(2, number)
    eventually(lambda: not out.matched)
    # The bridge's own subscription does not keep a topic on the list.
    viewers.requests.subscribe(1, number)
    eventually(lambda: out.matched)
    out.unregister()
    eventually(lambda: "/chatter" not in viewers.channels)
    eventually(lambda: graph.subscription_count("/chatter") == 0)


def test_late_viewers_get_what_was_latched(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    maps = graph.create_node("maps", rosout=False).create_publisher("/map_name", STRING, latch=True)
    other = graph.create_node("other", rosout=False).create_publisher("/map_name", STRING)
    maps.publish(String(data="hall"))
    channel = eventually(lambda: viewers.channels.get("/map_name"))
    viewers.requests.subscribe(1, channel.number)
    eventually(lambda: len(channel.sent) == 1)
    eventually(lambda: other.matched)
    other.publish(String(data="passing"))
    eventually(lambda: len(channel.sent) == 2)
    viewers.requests.subscribe(2, channel.number)
    eventually(lambda: len(channel.sent) == 3)
    assert [text_of(data) for data, _ in channel.sent] == ["hall", "passing", "hall"]


def test_type_that_nothing_defines_is_told_once(
    graph: Graph, viewers: PlainViewers, eventually: Eventually, capfd: pytest.CaptureFixture[str]
) -> None:
    from gazelle.graph import Entity, Kind
    from gazelle.graph.key_expressions import NO_HASH, token

    def announce(name: str) -> Any:
        entity = Entity(
            graph.zid, 900, graph.next_id(), Kind.PUBLISHER, "/alien", name, "nowhere/msg/X",
            NO_HASH,
        )  # fmt: skip
        return graph.session.liveliness().declare_token(token(graph.domain, entity))

    tokens = [announce("/first"), announce("/second")]
    graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    eventually(lambda: "/chatter" in viewers.channels)
    said = capfd.readouterr().err
    assert said.count("nothing here defines its type nowhere/msg/X") == 1
    assert "fix: start the bridge where the package that defines it is found" in said
    for one in tokens:
        one.undeclare()


def test_viewer_publishes_cdr_and_json(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    got: list[str] = []
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/orders", STRING, lambda message: got.append(message.data))
    eventually(lambda: "/orders" in viewers.channels)
    viewers.requests.advertise(1, 1, "/orders", STRING, "cdr")
    viewers.requests.advertise(1, 2, "/orders", "std_msgs/String", "json")
    viewers.requests.publish(1, 1, to_cdr(String(data="bytes")))
    viewers.requests.publish(1, 2, b'{"data": "words"}')
    eventually(lambda: sorted(got) == ["bytes", "words"])
    viewers.requests.unadvertise(1, 1)
    viewers.requests.unadvertise(1, 2)
    eventually(lambda: graph.publisher_count("/orders") == 0)


@pytest.mark.parametrize(
    ("topic", "kind", "words", "data", "said"),
    [
        ("/orders", "nowhere/msg/X", "cdr", b"", "cannot publish /orders as nowhere/msg/X"),
        ("/or ders", STRING, "cdr", b"", "cannot publish /or ders as std_msgs/msg/String"),
        ("/orders", STRING, "protobuf", b"", "protobuf is neither cdr nor json"),
        ("/orders", STRING, "cdr", b"\0\1\0\0\xff", "message on /orders is dropped: "),
        ("/orders", STRING, "json", b"{", "message on /orders is dropped: Expecting"),
        ("/orders", STRING, "json", b'{"dat": 1}', "message on /orders is dropped: "),
    ],
)
def test_what_viewers_cannot_publish_is_told(
    viewers: PlainViewers,
    topic: str,
    kind: str,
    words: str,
    data: bytes,
    said: str,
    capfd: pytest.CaptureFixture[str],
) -> None:
    viewers.requests.advertise(1, 1, topic, kind, words)
    viewers.requests.publish(1, 1, data)
    assert said in capfd.readouterr().err


def test_viewer_calls_services(graph: Graph, viewers: PlainViewers, eventually: Eventually) -> None:
    def switch(request: Any) -> Any:
        if not request.data:
            raise ServiceRefusedError("it stays on")
        return SetBool.Response(success=True, message="on")

    server = graph.create_node("lamp", rosout=False).create_service("/lamp", SetBool, switch)
    offer = eventually(lambda: viewers.services.get("/lamp"))
    assert offer.type_name == "std_srvs/srv/SetBool"
    assert offer.request.type_name == "std_srvs/srv/SetBool_Request"
    assert "bool data" in offer.request.schema
    assert "string message" in offer.response.schema
    answer = from_cdr(SetBool.Response, offer.answer(to_cdr(SetBool.Request(data=True))))
    assert (answer.success, answer.message) == (True, "on")
    with pytest.raises(RuntimeError, match="it stays on"):
        offer.answer(to_cdr(SetBool.Request(data=False)))
    server.unregister()
    eventually(lambda: "/lamp" not in viewers.services)


def test_viewer_reads_sets_and_follows_parameters(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    graph.parameters.set("/arm", {"speed": 1.5, "joints": ["a", "b"]})
    eventually(lambda: viewers.requests.get_parameters(["/arm/speed"]) == {"/arm/speed": 1.5})
    found = viewers.requests.get_parameters([])
    assert found["/arm/joints"] == ["a", "b"]
    assert viewers.requests.get_parameters(["/nothing"]) == {}
    # What came and went before a viewer was told of it is not told as gone.
    eventually(lambda: "/arm/joints" in _merged(viewers))
    after = viewers.requests.set_parameters({"/arm/speed": 2.5, "/arm/joints": None})
    assert after == {"/arm/speed": 2.5, "/arm/joints": None}
    assert graph.parameters.get("/arm") == {"speed": 2.5}
    eventually(lambda: {"/arm/joints": None}.items() <= _merged(viewers).items())
    graph.parameters.set("/new", 7)
    eventually(lambda: _merged(viewers).get("/new") == 7)


def test_viewer_reads_sets_and_follows_parameters_of_nodes(
    graph: Graph,
    viewers: PlainViewers,
    eventually: Eventually,
    capfd: pytest.CaptureFixture[str],
) -> None:
    node = graph.create_node("talker", rosout=False)
    own = NodeParameters(
        node,
        "/talker",
        {"rate": 1.5, "words": ["a", "b"], "fixed": 3},
        descriptors={"fixed": Descriptor(read_only=True)},
    )
    asked = ["/talker.rate", "/talker.words", "/talker.fixed"]
    values = {"/talker.rate": 1.5, "/talker.words": ["a", "b"], "/talker.fixed": 3}
    eventually(lambda: viewers.requests.get_parameters(asked) == values)
    everything = viewers.requests.get_parameters([])
    assert {name: everything[name] for name in asked} == values
    after = viewers.requests.set_parameters({"/talker.rate": 2, "/talker.fixed": 4})
    assert after == {"/talker.rate": 2.0, "/talker.fixed": 3}
    assert own.values["rate"] == 2.0
    assert isinstance(own.values["rate"], float)
    assert "a viewer cannot set parameter /talker.fixed: " in capfd.readouterr().err
    eventually(lambda: _merged(viewers).get("/talker.rate") == 2.0)
    own.close()
    eventually(lambda: viewers.requests.get_parameters(asked) == {})


def _merged(viewers: PlainViewers) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for one in list(viewers.parameters):
        found |= one
    return found


def test_parameter_that_cannot_be_set_is_told(
    viewers: PlainViewers, capfd: pytest.CaptureFixture[str]
) -> None:
    wanted: dict[str, Any] = {"/a b": 1, "/gone": None, "/": {}}
    assert viewers.requests.set_parameters(wanted) == dict.fromkeys(wanted)
    said = capfd.readouterr().err
    assert "a viewer cannot set parameter /a b: illegal parameter name" in said
    assert "a viewer cannot set parameter /: that is the whole tree" in said
    assert "a viewer cannot delete parameter /gone: it is not set" in said


def test_viewers_are_told_simulated_time(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    node = graph.create_node("simulator", rosout=False)
    clock = node.create_publisher("/clock", "rosgraph_msgs/msg/Clock")
    out = node.create_publisher("/chatter", STRING)
    graph.parameters.set("/use_sim_time", True)
    graph.clock.use(False)
    channel = eventually(lambda: viewers.channels.get("/chatter"))
    eventually(lambda: not clock.matched)
    viewers.requests.subscribe(1, channel.number)
    eventually(lambda: clock.matched and out.matched)
    tick = message_type("rosgraph_msgs/msg/Clock")()
    tick.clock.sec, tick.clock.nanosec = 12, 500

    def told() -> bool:
        clock.publish(tick)
        return 12_000_000_500 in viewers.times

    eventually(told)
    out.publish(String(data="now"))
    eventually(lambda: channel.sent)
    assert channel.sent[0][1] == 12_000_000_500
    viewers.requests.unsubscribe(1, channel.number)
    eventually(lambda: not clock.matched)


def test_viewers_are_told_wall_time_and_when_messages_were_sent(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    out = graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    channel = eventually(lambda: viewers.channels.get("/chatter"))
    viewers.requests.subscribe(1, channel.number)
    eventually(lambda: out.matched)
    before = eventually(lambda: len(viewers.times) > 2 and viewers.times[-1])
    out.publish(String(data="now"))
    eventually(lambda: channel.sent)
    assert 0 <= channel.sent[0][1] - before < 60e9
    assert viewers.times == sorted(set(viewers.times))


def test_viewers_see_who_is_connected(
    graph: Graph, viewers: PlainViewers, eventually: Eventually
) -> None:
    talker = graph.create_node("talker", rosout=False)
    talker.create_publisher("/chatter", STRING)
    listener = graph.create_node("listener", rosout=False)
    listener.create_subscription("/chatter", STRING, print)
    listener.create_service("/lamp", SetBool, print)
    number = eventually(lambda: viewers.channels.get("/chatter")).number
    viewers.requests.subscribe(1, number)
    eventually(lambda: viewers.connections and "/lamp" in viewers.connections.servers)
    assert viewers.connections is not None
    assert viewers.connections.publishers["/chatter"] == ("/talker",)
    assert viewers.connections.subscribers["/chatter"] == ("/listener",)
    assert viewers.connections.servers["/lamp"] == ("/listener",)


def test_bridge_leaves_nothing_behind(
    graph: Graph, make_bridge: Callable[..., FoxgloveBridge], eventually: Eventually
) -> None:
    made: list[PlainViewers] = []

    def make(requests: Requests) -> PlainViewers:
        made.append(PlainViewers(requests))
        return made[0]

    bridge = make_bridge(make)
    graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    eventually(lambda: "/chatter" in made[0].channels)
    assert made[0].services == {}
    made[0].requests.subscribe(1, made[0].channels["/chatter"].number)
    eventually(lambda: graph.subscription_count("/chatter") == 1)
    bridge.close()
    assert made[0].closed
    assert made[0].channels == {}
    eventually(lambda: "/foxglove_bridge" not in graph.node_names())
    eventually(lambda: graph.subscription_count("/chatter") == 0)


def test_second_bridge_has_another_name(
    graph: Graph, make_bridge: Callable[..., FoxgloveBridge], eventually: Eventually
) -> None:
    for _ in range(2):
        make_bridge(PlainViewers)
    names = [one for one in graph.node_names() if one.startswith("/foxglove_bridge")]
    assert len(names) == 2
