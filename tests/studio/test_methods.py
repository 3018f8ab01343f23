"""Methods of the graph: types, publishing, services, parameters, nodes, files."""

from __future__ import annotations

import base64
import http.client
import math
import queue
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from tests.patience import eventually, stretched
from tests.studio.page import Page, RefusedError

from gazelle.graph import Graph, Node, offer_loggers
from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    ReconfigureServer,
    enum_edit_method,
)
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters
from gazelle.interfaces import service_type
from gazelle.studio import Server


@pytest.fixture
def heard(node: Node) -> Any:
    """Subscribes a topic and returns the queue of its messages."""

    def listen(topic: str, type_name: str) -> queue.SimpleQueue[Any]:
        messages: queue.SimpleQueue[Any] = queue.SimpleQueue()
        node.create_subscription(topic, type_name, messages.put)
        return messages

    return listen


@pytest.fixture(autouse=True)
def _no_publishers(page: Page) -> Iterator[None]:
    yield
    for row in page.call("publisher.list"):
        page.call("publisher.remove", id=row["id"])


def test_type_get_has_all_sub_messages_inside(page: Page) -> None:
    value = page.call("type.get", type="geometry_msgs/PoseStamped")
    assert value["type"] == "geometry_msgs/msg/PoseStamped"
    assert value["kind"] == "msg"
    header, pose = value["fields"]
    assert [one["name"] for one in header["fields"]] == ["stamp", "frame_id"]
    w = pose["fields"][1]["fields"][3]
    assert w == {"name": "w", "type": "float64", "array": None, "default": 1}
    assert "Pose pose" in value["text"]


def test_type_get_tells_arrays_constants_and_parts(page: Page) -> None:
    matrix = page.call("type.get", type="geometry_msgs/msg/PoseWithCovariance")["fields"][1]
    assert matrix["array"] == 36
    marker = page.call("type.get", type="visualization_msgs/Marker")
    assert _named(marker["fields"], "points")["array"] == "[]"
    assert _named(marker["constants"], "CUBE") == {"name": "CUBE", "type": "int32", "value": 1}
    service = page.call("type.get", type="std_srvs/SetBool")
    assert service["kind"] == "srv"
    assert [one["name"] for one in service["fields"]] == ["request", "response"]
    assert service["fields"][1]["fields"][1]["name"] == "message"
    action = page.call("type.get", type="example_interfaces/action/Fibonacci")
    assert [one["name"] for one in action["fields"]] == ["goal", "result", "feedback"]
    assert "---" in action["text"]


def test_type_list_and_unknown_types(page: Page) -> None:
    assert "std_msgs/msg/String" in page.call("type.list")
    assert "std_srvs/srv/Empty" in page.call("type.list", kind="srv")
    with pytest.raises(RefusedError, match="there is no kind 'msgs' of type"):
        page.call("type.list", kind="msgs")
    with pytest.raises(RefusedError) as caught:
        page.call("type.get", type="geometry_msgs/Twits")
    assert "not found" in str(caught.value)


def test_publish_reads_texts_as_yaml(page: Page, heard: Any) -> None:
    messages = heard("/goal", "geometry_msgs/PoseStamped")
    pose = {"position": {"x": "1.5", "y": 2}, "orientation": "{w: 1}"}
    message = {"header": {"stamp": "now", "frame_id": "3"}, "pose": pose}
    value = page.call("topic.publish", topic="/goal", type="geometry_msgs/PoseStamped",
                      message=message)  # fmt: skip
    assert value == {}
    got = messages.get(timeout=stretched())
    assert (got.pose.position.x, got.pose.position.y, got.pose.orientation.w) == (1.5, 2.0, 1.0)
    assert got.header.frame_id == "3"
    assert got.header.stamp.sec > 0


def test_publish_takes_what_echo_spells(page: Page, heard: Any) -> None:
    messages = heard("/limits", "std_msgs/Float64MultiArray")
    page.call("topic.publish", topic="/limits", type="std_msgs/Float64MultiArray",
              message={"data": ["Infinity", "-Infinity", "NaN", "2.5", 1]})  # fmt: skip
    data = list(messages.get(timeout=stretched()).data)
    assert data[:2] == [math.inf, -math.inf]
    assert math.isnan(data[2])
    assert data[3:] == [2.5, 1.0]


@pytest.mark.parametrize(
    ("message", "text"),
    [
        ({"linear": {"q": 1}}, "has no field 'q'"),
        ({"linear": 3}, "takes a list or a dictionary of its fields"),
        ({"linear": {"x": "fast"}}, "linear.x"),
        ({"linear": {"x": "[1"}}, "field 'linear.x': '[1' is not YAML"),
        ([], "parameter 'message' is an object, not []"),
    ],
)
def test_publish_refuses_what_does_not_fit(page: Page, message: Any, text: str) -> None:
    with pytest.raises(RefusedError) as caught:
        page.call("topic.publish", topic="/vel", type="geometry_msgs/Twist", message=message)
    assert text in str(caught.value)


def test_publisher_follows_expressions(page: Page, heard: Any) -> None:
    messages = heard("/waved", "geometry_msgs/Twist")
    settings = {
        "id": "a",
        "topic": "/waved",
        "type": "geometry_msgs/Twist",
        "rate_hz": 100,
        "message": {"angular": {"z": "0.5"}},
        "expressions": {"linear.x": "i * 2", "linear.y": "sin(t/2) if t >= 0 else 0"},
        "enabled": True,
    }
    assert page.call("publisher.set", **settings)["count"] >= 0
    got = [messages.get(timeout=stretched()) for _ in range(3)]
    assert [one.linear.x for one in got] == [0.0, 2.0, 4.0]
    assert all(0 <= one.linear.y < 1 for one in got)
    assert {one.angular.z for one in got} == {0.5}
    (row,) = page.call("publisher.list")
    assert row["id"] == "a"
    assert row["expressions"] == settings["expressions"]
    page.call("publisher.set", id="a", enabled=False)
    assert page.call("publisher.list")[0]["enabled"] is False
    assert page.call("publisher.remove", id="a") == {}
    assert page.call("publisher.list") == []


def test_publisher_of_rate_0_publishes_once(page: Page, heard: Any) -> None:
    messages = heard("/once", "std_msgs/Int16")
    settings = {"topic": "/once", "type": "std_msgs/Int16", "message": {"data": 4}, "rate_hz": 0}
    page.call("publisher.set", id="once", enabled=True, **settings)
    assert messages.get(timeout=stretched()).data == 4
    eventually(lambda: page.call("publisher.list")[0]["count"] == 1)
    assert page.call("publisher.list")[0]["enabled"] is False
    page.call("publisher.remove", id="once")


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"expressions": {"linear.x": "__import__('os')"}}, "there is no function '__import__'"),
        ({"expressions": {"linear.x": "t.__class__"}}, "cannot be part of an expression"),
        ({"expressions": {"linear.x": "tt"}}, "'tt' is not known here"),
        ({"expressions": {"linear.x": "1/0"}}, "'1/0': division by zero"),
        ({"expressions": {"linear.x": "2 +"}}, "is not an expression: invalid syntax"),
        ({"expressions": {"linear": "1"}}, "'linear' is no number"),
        ({"expressions": {"linear.w": "1"}}, "there is no field of geometry_msgs/msg/Twist"),
        ({"rate_hz": -1}, "parameter 'rate_hz' is a number from 0 to 1000"),
        ({"type": None}, "parameter 'type' is missing"),
    ],
)
def test_publisher_refuses_at_once(page: Page, changes: dict[str, Any], text: str) -> None:
    settings = {"id": "bad", "topic": "/bad", "type": "geometry_msgs/Twist", **changes}
    with pytest.raises(RefusedError) as caught:
        page.call("publisher.set", **settings)
    assert text in str(caught.value)
    assert page.call("publisher.list") == []


def test_an_expression_that_fails_later_stops_its_publisher(page: Page) -> None:
    expressions = {"data": "1 / max(3 - i, 0)"}
    page.call("publisher.set", id="late", topic="/late", type="std_msgs/Float64", rate_hz=1000,
              expressions=expressions, enabled=True)  # fmt: skip
    row = eventually(lambda: [one for one in page.call("publisher.list") if one["error"]])[0]
    assert row["error"] == "'1 / max(3 - i, 0)': division by zero"
    assert row["enabled"] is False
    assert row["count"] == 3
    page.call("publisher.remove", id="late")
    with pytest.raises(RefusedError, match="there is no publisher 'late'"):
        page.call("publisher.remove", id="late")


def test_service_call_fills_and_answers(page: Page, node: Node) -> None:
    kind = service_type("std_srvs/SetBool")
    node.create_service(
        "/lamp", kind, lambda request: kind.Response(success=request.data, message="on")
    )
    value = page.call("service.call", service="/lamp", request={"data": "true"})
    assert value == {"success": True, "message": "on"}
    with pytest.raises(RefusedError, match="there is no service '/lampe'") as caught:
        page.call("service.call", service="/lampe", request={})
    assert caught.value.error["known"] == ["/lamp"]


def test_a_service_that_fails_or_sleeps_is_told(page: Page, node: Node) -> None:
    going = threading.Event()
    kind = service_type("std_srvs/Trigger")

    def fail(_request: Any) -> Any:
        raise ValueError("no coal")

    def sleep(_request: Any) -> Any:
        going.wait(stretched())
        return kind.Response()

    node.log_level = 16  # type: ignore[assignment]
    node.create_service("/fails", kind, fail)
    node.create_service("/sleeps", kind, sleep)
    with pytest.raises(RefusedError, match="error processing request: no coal"):
        page.call("service.call", service="/fails")
    with pytest.raises(RefusedError, match=r"did not answer in 0\.1 s"):
        page.call("service.call", service="/sleeps", timeout_s=0.1)
    going.set()


def test_parameters_of_ros1(page: Page, graph: Graph) -> None:
    assert page.call("param.set", name="/arm/gains", value={"p": 1.5, "i": [1, 2]}) == {}
    assert graph.parameters.get("/arm/gains/p") == 1.5
    assert page.call("param.get", name="/arm/gains/i") == [1, 2]
    rows = page.call("param.list", name="/arm")
    assert rows == [
        {"name": "/arm/gains/i", "value": [1, 2]},
        {"name": "/arm/gains/p", "value": 1.5},
    ]
    assert page.call("param.delete", name="/arm/gains/p") == {}
    for method in ("param.get", "param.delete"):
        with pytest.raises(RefusedError, match="there is no parameter '/arm/gains/p'"):
            page.call(method, name="/arm/gains/p")
    with pytest.raises(RefusedError, match="parameter 'value' is missing"):
        page.call("param.set", name="/arm/x")


def test_parameters_of_ros2_nodes(page: Page, graph: Graph) -> None:
    node = graph.create_node("ros2_node", rosout=False)
    descriptors = {"speed": Descriptor("how fast", lowest=0.0, highest=3.0)}
    values = {"speed": 1.5, "name": "slow"}
    parameters = NodeParameters(node, "/ros2_node", values, descriptors=descriptors)
    rows = page.call("node.params", node="/ros2_node")
    assert _named(rows, "speed")["value"] == 1.5
    assert _named(rows, "speed")["type"] == "double"
    descriptor = _named(rows, "speed")["descriptor"]
    assert descriptor["description"] == "how fast"
    assert descriptor["range"] == {"from_value": 0.0, "to_value": 3.0, "step": 0.0}
    answer = page.call("node.param_set", node="/ros2_node", name="speed", value=2)
    assert answer == {"successful": True, "reason": ""}
    assert parameters.values["speed"] == 2.0
    refused = page.call("node.param_set", node="/ros2_node", name="nothing", value=2)
    assert refused["successful"] is False
    with pytest.raises(RefusedError, match="there is no ROS 2 node with parameters '/ros2_nod'"):
        page.call("node.params", node="/ros2_nod")
    node.shutdown()


def test_reconfigure_tells_groups_and_sets_values(page: Page, node: Node) -> None:
    method = enum_edit_method((EnumConstant("Low", 0), EnumConstant("High", 1)), "how")
    group = DynamicGroup(
        parameters=(
            DynamicParameter("gain", "double", 1.0, "of the loop", 0.0, 10.0),
            DynamicParameter("mode", "int", 0, "which", 0, 1, method),
        )
    )
    server = ReconfigureServer(node, "/test", group, lambda values, _level: values)
    assert page.call("reconfigure.list") == ["/test"]
    (told,) = page.call("reconfigure.get", node="/test")["groups"]
    gain, mode = told["parameters"]
    assert gain == {
        "name": "gain",
        "type": "double",
        "min": 0.0,
        "max": 10.0,
        "default": 1.0,
        "value": 1.0,
        "edit_method": None,
        "description": "of the loop",
    }
    assert [one["name"] for one in mode["edit_method"]["enum"]] == ["Low", "High"]
    values = page.call("reconfigure.set", node="/test", values={"gain": 20, "mode": "High"})
    assert values == {"gain": 10.0, "mode": 1}
    with pytest.raises(RefusedError, match="don't know parameter: gian"):
        page.call("reconfigure.set", node="/test", values={"gian": 1})
    assert server


def test_loggers_of_a_node(page: Page, node: Node) -> None:
    offer_loggers(node)
    assert page.call("logger.list") == [{"node": "/test"}]
    assert page.call("logger.list", node="/test") == [{"name": "ros", "level": "info"}]
    page.call("logger.set", node="/test", logger="ros", level="Debug")
    assert page.call("logger.list", node="/test")[0]["level"] == "debug"
    with pytest.raises(RefusedError, match="there is no level 'loud'"):
        page.call("logger.set", node="/test", logger="ros", level="loud")
    with pytest.raises(RefusedError, match="there is no node with loggers '/tset'"):
        page.call("logger.list", node="/tset")


def test_node_info_and_kill(page: Page, graph: Graph, server: Server) -> None:
    node = graph.create_node("victim", rosout=False)
    node.console = lambda *_args, **_options: None
    node.create_publisher("/cry", "std_msgs/String")
    info = page.call("node.info", node="/victim")
    assert info["publications"] == [{"name": "/cry", "type": "std_msgs/msg/String"}]
    assert info["pid"] > 0
    assert page.call("node.kill", node="/victim") == {"answered": True}
    eventually(lambda: "/victim" not in server.studio.node.graph.node_names())
    assert node.closed
    with pytest.raises(RefusedError, match="node '/victim' not found"):
        page.call("node.kill", node="/victim")
    with pytest.raises(RefusedError, match="this is Studio's own node"):
        page.call("node.kill", node=server.studio.node.name)


def test_joint_sliders_publish_joint_states(page: Page, heard: Any) -> None:
    messages = heard("/joint_states", "sensor_msgs/JointState")
    page.call("joints.publish", names=["a", "b"], positions=[0.5, 1])
    message = messages.get(timeout=stretched())
    assert list(message.name) == ["a", "b"]
    assert list(message.position) == [0.5, 1.0]
    assert message.header.stamp.sec > 0
    with pytest.raises(RefusedError, match="2 names and 1 positions do not go together"):
        page.call("joints.publish", names=["a", "b"], positions=[1])


def test_saved_files_are_fetched_once(page: Page, server: Server) -> None:
    data = base64.b64encode(b"\x89PNG").decode()
    path = page.call("file.save", name="../shot 1.png", base64=data)
    status, headers, body = _get(server, path)
    assert (status, body) == (200, b"\x89PNG")
    assert headers["Content-Disposition"] == 'attachment; filename="shot 1.png"'
    assert headers["Content-Type"] == "image/png"
    assert _get(server, path)[0] == 404
    text = page.call("file.save", name="plot.csv", text="t,v\n")
    assert _get(server, text)[2] == b"t,v\n"
    with pytest.raises(RefusedError, match="'base64' cannot be read"):
        page.call("file.save", name="x", base64="%")


def _get(server: Server, path: str) -> tuple[int, Any, bytes]:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=stretched())
    cookie = f"gazelle_studio_{server.port}={server.token}"
    connection.request("GET", path, headers={"Cookie": cookie})
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, answer.headers, body


def _named(rows: list[dict[str, Any]], name: str) -> dict[str, Any]:
    return next(row for row in rows if row["name"] == name)
