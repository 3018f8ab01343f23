"""Real viewers over Foxglove's own server."""

from __future__ import annotations

import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.foxglove.conftest import Viewer
from tests.bridge.foxglove.test_bridge_assets import write_package
from tests.patience import at_most

from gazelle.bridge.foxglove import Allow, FoxgloveBridge, SdkViewers
from gazelle.errors import GraphError
from gazelle.graph import Graph
from gazelle.interfaces import from_cdr, message_type, service_type, to_cdr

Make = Callable[..., FoxgloveBridge]
Connect = Callable[[FoxgloveBridge], Viewer]
Eventually = Callable[[Callable[[], Any]], Any]
STRING = "std_msgs/msg/String"
String = message_type(STRING)
SetBool = service_type("std_srvs/srv/SetBool")


def texts(viewer: Viewer, topic: str) -> list[str]:
    return [from_cdr(String, data).data for data, _ in viewer.messages.get(topic, ())]


def test_viewer_reads_messages_and_goes(
    graph: Graph, make_served: Make, connect: Connect, eventually: Eventually
) -> None:
    out = graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    viewer = connect(make_served())
    assert viewer.info["capabilities"] == ["connectionGraph", "time", "assets"]
    viewer.subscribe("/chatter")
    row = viewer.channels["/chatter"]
    assert (row["encoding"], row["schemaEncoding"], row["schemaName"]) == ("cdr", "ros2msg", STRING)
    assert "string data" in row["schema"]
    viewer.wait_for(lambda: out.matched)
    out.publish(String(data="hello"))
    viewer.wait_for(lambda: texts(viewer, "/chatter") == ["hello"])
    stamp_ns = viewer.messages["/chatter"][0][1]
    assert abs(time.time_ns() - stamp_ns) < 60e9
    viewer.wait_for(lambda: viewer.times)
    viewer.close()
    eventually(lambda: not out.matched)


def test_unsubscribing_and_topics_that_end(
    graph: Graph, make_served: Make, connect: Connect
) -> None:
    out = graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    viewer = connect(make_served())
    number = viewer.subscribe("/chatter")
    viewer.wait_for(lambda: out.matched)
    viewer.unsubscribe(number)
    viewer.wait_for(lambda: not out.matched)
    viewer.subscribe("/chatter")
    viewer.wait_for(lambda: out.matched)
    out.unregister()
    viewer.wait_for(lambda: "/chatter" not in viewer.channels)


def test_every_viewer_gets_what_was_latched(
    graph: Graph, make_served: Make, connect: Connect
) -> None:
    node = graph.create_node("maps", rosout=False)
    node.create_publisher("/map_name", STRING, latch=True).publish(String(data="hall"))
    bridge = make_served()
    for _ in range(2):
        viewer = connect(bridge)
        viewer.subscribe("/map_name")
        viewer.wait_for(lambda: texts(viewer, "/map_name"))  # noqa: B023
        assert texts(viewer, "/map_name") == ["hall"]


def test_looking_is_all_unless_more_is_allowed(
    graph: Graph, make_served: Make, connect: Connect
) -> None:
    node = graph.create_node("lamp", rosout=False)
    node.create_service("/lamp", SetBool, print)
    node.create_subscription("/orders", STRING, print)
    viewer = connect(make_served())
    viewer.wait_for(lambda: "/orders" in viewer.channels)
    assert viewer.services == {}
    viewer.advertise("/orders", STRING)
    viewer.send({"op": "getParameters", "parameterNames": [], "id": "all"})
    viewer.wait_for(lambda: len(viewer.heard.get("status", ())) == 2)
    assert "parameterValues" not in viewer.heard
    assert graph.publisher_count("/orders") == 0


def test_viewer_publishes(graph: Graph, make_served: Make, connect: Connect) -> None:
    got: list[str] = []
    node = graph.create_node("listener", rosout=False)
    node.create_subscription("/orders", STRING, lambda message: got.append(message.data))
    viewer = connect(make_served(Allow.PUBLISH))
    assert viewer.info["supportedEncodings"] == ["cdr", "json"]
    viewer.wait_for(lambda: "/orders" in viewer.channels)
    viewer.publish(viewer.advertise("/orders", STRING), to_cdr(String(data="go")))
    viewer.wait_for(lambda: got == ["go"])
    other = connect(make_served())
    other.wait_for(lambda: "/orders" in other.channels)
    viewer.close()
    other.wait_for(lambda: graph.publisher_count("/orders") == 0)


def test_viewer_calls_a_service(graph: Graph, make_served: Make, connect: Connect) -> None:
    def switch(request: Any) -> Any:
        if not request.data:
            raise ValueError("it stays on")
        return SetBool.Response(success=True, message="on")

    graph.create_node("lamp", rosout=False).create_service("/lamp", SetBool, switch)
    viewer = connect(make_served(Allow.SERVICES))
    call = viewer.call("/lamp", to_cdr(SetBool.Request(data=True)))
    assert viewer.services["/lamp"]["request"]["schemaName"] == "std_srvs/srv/SetBool_Request"
    answer = from_cdr(SetBool.Response, viewer.wait_for(lambda: viewer.answers.get(call)))
    assert (answer.success, answer.message) == (True, "on")
    viewer.call("/lamp", to_cdr(SetBool.Request(data=False)))
    failure = viewer.wait_for(lambda: viewer.heard.get("serviceCallFailure"))[0]
    assert "it stays on" in failure["message"]


def test_viewer_sets_and_follows_parameters(
    graph: Graph, make_served: Make, connect: Connect
) -> None:
    graph.parameters.set("/speed", 1.0)
    graph.parameters.set("/tree", {"dates": [1, 2.5], "limit": float("inf")})
    viewer = connect(make_served(Allow.PARAMETERS))
    viewer.send({"op": "getParameters", "parameterNames": [], "id": "all"})
    found = viewer.wait_for(lambda: viewer.heard.get("parameterValues"))[0]
    assert found["id"] == "all"
    rows = {row["name"]: row for row in found["parameters"]}
    assert rows["/speed"] == {"name": "/speed", "value": 1.0, "type": "float64"}
    assert rows["/tree/limit"]["value"] == "inf"
    viewer.send({"op": "subscribeParameterUpdates", "parameterNames": ["/speed"]})
    viewer.send(
        {"op": "setParameters", "parameters": [{"name": "/speed", "value": 2, "type": "float64"}]}
    )
    viewer.wait_for(lambda: graph.parameters.get("/speed") == 2.0)
    graph.parameters.set("/speed", 3.0)
    viewer.wait_for(lambda: _values(viewer, "/speed")[-1:] == [3.0])
    viewer.send({"op": "setParameters", "parameters": [{"name": "/speed"}]})
    viewer.wait_for(lambda: not graph.parameters.has("/speed"))


def _values(viewer: Viewer, name: str) -> list[Any]:
    told = viewer.heard.get("parameterValues", ())
    return [row["value"] for one in told for row in one["parameters"] if row["name"] == name]


def test_viewer_sees_the_connections(graph: Graph, make_served: Make, connect: Connect) -> None:
    graph.create_node("talker", rosout=False).create_publisher("/chatter", STRING)
    viewer = connect(make_served())
    viewer.wait_for(lambda: "/chatter" in viewer.channels)
    viewer.send({"op": "subscribeConnectionGraph"})

    def publishers() -> dict[str, list[str]]:
        told = viewer.heard.get("connectionGraphUpdate", ())
        return {r["name"]: r["publisherIds"] for one in told for r in one["publishedTopics"]}

    assert viewer.wait_for(lambda: publishers().get("/chatter")) == ["/talker"]


def test_viewer_gets_the_meshes_of_a_robot(
    make_served: Make, connect: Connect, tmp_path: Path
) -> None:
    folder = write_package(tmp_path)
    viewer = connect(make_served())
    for number, name in enumerate(("arm.stl", "none.stl")):
        uri = f"package://{folder.name}/meshes/{name}"
        viewer.send({"op": "fetchAsset", "uri": uri, "requestId": number})
    viewer.wait_for(lambda: len(viewer.assets) == 2)
    assert viewer.assets == {0: b"solid arm", 1: None}


def test_stalled_viewer_holds_up_nobody(graph: Graph, make_served: Make, connect: Connect) -> None:
    out = graph.create_node("camera", rosout=False).create_publisher("/image", STRING)
    bridge = make_served()
    stalled, other = connect(bridge), connect(bridge)
    for viewer in (stalled, other):
        # That one of them listens does not mean that the other does.
        viewer.subscribe("/image")
        viewer.wait_for(lambda: out.publish(String(data="begin")) or viewer.messages)  # noqa: B023
    out.publish(String(data="all begun"))
    other.wait_for(lambda: texts(other, "/image")[-1] == "all begun")
    other.messages.clear()
    big = "x" * 1_000_000
    with at_most(20.0):
        for number in range(100):
            out.publish(String(data=f"{number} {big}"))
            other.wait_for(lambda: len(other.messages.get("/image", ())) > number)  # noqa: B023
    assert [one.split()[0] for one in texts(other, "/image")] == [str(n) for n in range(100)]
    with at_most(10.0):
        bridge.close()


def test_taken_port_is_told() -> None:
    pytest.importorskip("foxglove", reason="needs pip install 'gazelle-sim[foxglove]'")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(GraphError, match="cannot be had") as raised:
            SdkViewers(_nobody(), host="127.0.0.1", port=port, allow=())
    assert f"port {port} of 127.0.0.1 cannot be had: " in str(raised.value)
    assert "[bridge.foxglove-port-taken]" in str(raised.value)
    assert "fix: end the other program, or choose another port with --port" in str(raised.value)


def test_missing_package_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "foxglove", None)
    with pytest.raises(GraphError, match="is not installed") as raised:
        SdkViewers(_nobody(), host="127.0.0.1", port=0, allow=())
    assert "[bridge.no-foxglove-sdk]" in str(raised.value)
    assert "fix: pip install 'gazelle-sim[foxglove]'" in str(raised.value)


class _Nobody:
    def read_asset(self, uri: str) -> bytes | None:
        return None


def _nobody() -> Any:
    return _Nobody()
