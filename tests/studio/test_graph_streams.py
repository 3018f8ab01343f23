"""Streams of the graph: who is there, echo, rates, plots, rosout."""

from __future__ import annotations

import math
import threading
from typing import Any

import pytest
from tests.patience import eventually, scale, stretched
from tests.studio.conftest import Talk
from tests.studio.page import Page, RefusedError

from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionServer
from gazelle.studio.graph_view import plot

_FIBONACCI = "example_interfaces/action/Fibonacci"


def test_graph_names_nodes_topics_services_and_actions(page: Page, node: Node) -> None:
    node.create_publisher("/said", "std_msgs/String")
    node.create_subscription("/heard", "std_msgs/Int32", lambda _message: None)
    node.create_service("/asked", _service("std_srvs/Trigger"), lambda request: request)
    server = ActionServer(
        node, "/count", _FIBONACCI, on_goal=lambda goal: goal.accept(), ros_version=2
    )
    value = page.call("graph.get")
    server.close()
    own = next(one for one in value["nodes"] if one["name"] == "/test")
    assert own["namespace"] == "/"
    assert "/said" in own["publishes"]
    assert "/heard" in own["subscribes"]
    assert "/asked" in own["serves"]
    assert _row(value["topics"], "/said") == {
        "name": "/said",
        "type": "std_msgs/msg/String",
        "publishers": ["/test"],
        "subscribers": [],
        "hidden": False,
    }
    assert _row(value["services"], "/asked") == {
        "name": "/asked",
        "type": "std_srvs/srv/Trigger",
        "nodes": ["/test"],
    }
    assert _row(value["actions"], "/count") == {
        "name": "/count",
        "type": "example_interfaces/action/Fibonacci",
        "servers": ["/test"],
        "clients": [],
    }


def test_graph_is_told_again_when_it_changes(page: Page, node: Node) -> None:
    stream = page.open("graph")
    publisher = node.create_publisher("/new_one", "std_msgs/String")
    stream.until(lambda value: _has(value["topics"], "/new_one"))
    publisher.unregister()
    stream.until(lambda value: not _has(value["topics"], "/new_one"))


def test_names_of_gazelle_itself_never_appear(page: Page, graph: Graph) -> None:
    hidden = graph.create_node("viewer", namespace="/_gazelle", rosout=False)
    hidden.create_publisher("/_gazelle/poses", "std_msgs/String")
    hidden.create_publisher("/plain", "std_msgs/String")
    hidden.create_service("/_gazelle/do", _service("std_srvs/Trigger"), lambda request: request)
    text = repr(page.call("graph.get")) + repr(page.open("graph").next())
    assert "_gazelle/" not in text
    assert "/plain" not in text
    hidden.shutdown()


def test_hidden_topics_of_ros2_are_marked(page: Page, node: Node) -> None:
    node.create_publisher("/turtle/_canvas", "sensor_msgs/Image")
    assert _row(page.call("graph.get")["topics"], "/turtle/_canvas")["hidden"] is True


def test_echo_shows_type_stamp_and_count(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/posed")
    stamp = {"sec": 7, "nanosec": 500_000_000}
    talk("/posed", "geometry_msgs/PoseStamped", header={"stamp": stamp, "frame_id": "map"})
    item = stream.next()
    assert item["type"] == "geometry_msgs/msg/PoseStamped"
    assert item["stamp_s"] == 7.5
    assert item["count"] == 1
    assert item["message"]["header"] == {"stamp": stamp, "frame_id": "map"}
    assert item["message"]["pose"]["orientation"]["w"] == 1.0


def test_echo_cuts_long_arrays_and_spells_what_json_has_not(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/long_scan")
    ranges = [math.inf, -math.inf, math.nan, *range(500)]
    talk("/long_scan", "sensor_msgs/LaserScan", ranges=ranges)
    value = stream.next()["message"]["ranges"]
    assert value["…"] == 503
    assert value["head"][:4] == ["Infinity", "-Infinity", "NaN", 0.0]
    assert len(value["head"]) == 200


def test_echo_keeps_to_its_rate_and_loses_not_the_last(page: Page, talk: Talk) -> None:
    stream = page.open("topic.echo", topic="/fast", rate_hz=20)
    talk("/fast", "std_msgs/Int32", data=0)
    # The first look is at once, at whatever is the newest by then.
    items = [stream.next()]
    assert items[0]["message"]["data"] == 0
    for number in range(1, 100):
        talk("/fast", "std_msgs/Int32", data=number)
    while items[-1]["message"]["data"] != 99:
        items.append(stream.next())
    assert len(items) < 50


def test_echo_gives_a_latched_message_to_who_comes_late(page: Page, talk: Talk) -> None:
    talk("/latched", "std_msgs/String", data="kept", latch=True)
    for _ in range(2):
        assert page.open("topic.echo", topic="/latched").next()["message"]["data"] == "kept"


@pytest.mark.parametrize(
    ("params", "text"),
    [
        ({"topic": "/no way"}, "illegal name '/no way'"),
        ({"topic": "/a", "rate_hz": 0}, "parameter 'rate_hz' is a number from 0.01 to 1000, not 0"),
        ({}, "parameter 'topic' is missing"),
    ],
)
def test_echo_refuses_what_it_cannot_do(page: Page, params: dict[str, Any], text: str) -> None:
    with pytest.raises(RefusedError) as caught:
        page.open("topic.echo", **params)
    assert text in str(caught.value)


def test_stats_count_rate_bytes_and_delay(page: Page, talk: Talk, node: Node) -> None:
    stream = page.open("topic.stats", topics=["/ticking"])
    assert stream.next() == [
        {"topic": "/ticking", "hz": 0.0, "bytes_per_s": 0.0, "delay_s": None, "count": 0}
    ]
    pause = threading.Event()
    for _ in range(30):
        sec, nanosec = divmod(node.clock.now_ns() - 250_000_000, 1_000_000_000)
        stamp = {"sec": sec, "nanosec": nanosec}
        talk("/ticking", "geometry_msgs/PointStamped", header={"stamp": stamp})
        pause.wait(0.01)
    row = stream.until(lambda rows: rows[0]["count"] == 30)[0]
    assert 20 / scale() < row["hz"] < 110
    # 4 bytes of CDR, 8 of the stamp, 5 of the empty text, 3 of padding and three doubles.
    assert row["bytes_per_s"] == pytest.approx(44 * row["hz"], rel=1e-6)
    assert row["delay_s"] == pytest.approx(0.25, abs=0.1)


def test_stats_without_topics_are_of_what_is_shown(page: Page, talk: Talk) -> None:
    page.open("topic.echo", topic="/watched")
    talk("/watched", "std_msgs/String", data="x")
    rows = page.open("topic.stats").next()
    assert _row(rows, "/watched", "topic")["count"] == 1
    assert not _has(rows, "/ticking", "topic")


def test_plot_follows_fields_items_and_whole_messages(page: Page, talk: Talk) -> None:
    joints = {"name": ["a", "b"], "position": [1.0, 2.0], "velocity": [3.0]}
    talk("/arm", "sensor_msgs/JointState", latch=True, **joints)
    pose = talk("/pose2", "turtlesim/Pose")
    stream = page.open(
        "topic.plot", curves=["/pose2", "/arm/position", "/arm/velocity[0]", "/arm/position/1"]
    )
    assert stream.info["curves"] == [
        "/pose2/x",
        "/pose2/y",
        "/pose2/theta",
        "/pose2/linear_velocity",
        "/pose2/angular_velocity",
        "/arm/position[0]",
        "/arm/position[1]",
        "/arm/velocity[0]",
    ]
    values: dict[int, list[Any]] = {}

    def follow(curve: int, count: int) -> list[Any]:
        # Which curves come in one piece is a matter of time.
        while len(values.get(curve, [])) < count:
            for one in stream.next():
                values.setdefault(one["curve"], []).extend(one["v"])
        return values[curve]

    assert follow(6, 1) == [2.0]
    assert follow(7, 1) == [3.0]
    eventually(lambda: pose.matched)
    for number in range(3):
        talk("/pose2", "turtlesim/Pose", x=float(number), y=math.nan)
    assert follow(0, 3) == [0.0, 1.0, 2.0]
    assert follow(1, 3) == [None] * 3


def test_plot_loses_nothing(page: Page, talk: Talk) -> None:
    ramp = talk("/ramp", "std_msgs/Float64")
    stream = page.open("topic.plot", curves=["/ramp/data"])
    eventually(lambda: ramp.matched)
    for number in range(2000):
        talk("/ramp", "std_msgs/Float64", data=float(number))
    values: list[float] = []
    times: list[float] = []
    while len(values) < 2000:
        for row in stream.next():
            values += row["v"]
            times += row["t"]
    assert values == [float(number) for number in range(2000)]
    assert times == sorted(times)


def test_plot_of_something_else_names_what_there_is(page: Page, talk: Talk) -> None:
    talk("/pose3", "turtlesim/Pose")
    with pytest.raises(RefusedError) as caught:
        page.open("topic.plot", curves=["/pose3/thetta"])
    assert caught.value.error == {
        "message": "'/pose3/thetta': turtlesim/msg/Pose has no field 'thetta'",
        "known": ["theta"],
    }
    with pytest.raises(RefusedError, match="there is no such topic") as caught:
        page.open("topic.plot", curves=["/pose33/x"])
    assert caught.value.error["known"] == ["/pose3"]
    talk("/words", "std_msgs/String")
    with pytest.raises(RefusedError, match="'/words/data': nothing in it is a number"):
        page.open("topic.plot", curves=["/words/data"])


def test_plot_of_items_waits_for_a_message_and_says_so(
    page: Page, talk: Talk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plot, "_FIRST_MESSAGE_S", 0.05)
    talk("/arm", "sensor_msgs/JointState", position=[1.0])
    with pytest.raises(RefusedError) as caught:
        page.open("topic.plot", curves=["/arm/position"])
    assert caught.value.error == {
        "message": "'/arm/position': no message has come yet that says how many items it has",
        "hint": "name one, /arm/position[0], or try again when /arm has had a message",
    }
    assert page.open("topic.plot", curves=["/arm/position[0]"]).info["curves"] == [
        "/arm/position[0]"
    ]


def test_rosout_gives_the_last_ones_first(page: Page, graph: Graph) -> None:
    assert page.open("rosout").info is None
    speaker = graph.create_node("speaker")
    speaker.console = lambda *_args, **_options: None
    eventually(lambda: graph.publisher_count("/rosout"))
    for number in range(250):
        speaker.log("warn" if number % 2 else "info", f"line {number}")
    # Another page comes late.
    stream = page.open("rosout", level="warn")
    rows = stream.until(lambda rows: rows[-1]["message"] == "line 249")
    assert {row["level"] for row in rows} == {"warn"}
    assert rows[-1]["name"] == "/speaker"
    assert rows[-1]["file"].endswith("test_graph_streams.py")
    assert rows[-1]["function"] == "test_rosout_gives_the_last_ones_first"
    assert rows[-1]["line"] > 0
    speaker.shutdown()
    with pytest.raises(RefusedError, match="there is no level 'loud'") as caught:
        page.open("rosout", level="loud")
    assert caught.value.error["known"] == ["debug", "info", "warn", "error", "fatal"]


@pytest.mark.parametrize(
    ("ros_version", "kind"), [(1, "actionlib_tutorials/action/Fibonacci"), (2, _FIBONACCI)]
)
def test_action_tells_feedback_and_result(
    page: Page, node: Node, ros_version: Any, kind: str
) -> None:
    def run(goal: Any) -> None:
        goal.accept()
        goal.publish_feedback(goal_type.Feedback(sequence=[0, 1]))
        goal.succeed(goal_type.Result(sequence=[0, 1, 1]))

    name = f"/fib_{ros_version}"
    server = ActionServer(node, name, kind, on_goal=_later(run), ros_version=ros_version)
    goal_type = server.types
    stream = page.open("action", action=name, goal={"order": "3"})
    assert stream.info["type"] == kind
    last = stream.until(lambda item: item["result"] is not None)
    assert last["state"] == "SUCCEEDED"
    assert last["feedback"] == {"sequence": [0, 1]}
    assert last["result"] == {"sequence": [0, 1, 1]}
    assert stream.ended.get(timeout=stretched()) == {"op": "ended", "ch": stream.number}
    server.close()


def test_closing_an_action_cancels_it(page: Page, node: Node) -> None:
    cancelled = threading.Event()

    def on_goal(goal: Any) -> None:
        goal.accept()

    def on_cancel(goal: Any) -> bool:
        goal.cancel()
        cancelled.set()
        return True

    server = ActionServer(
        node, "/long", _FIBONACCI, on_goal=on_goal, on_cancel=on_cancel, ros_version=2
    )
    stream = page.open("action", action="/long", goal={"order": 3})
    stream.until(lambda item: item["state"] == "EXECUTING")
    stream.close()
    assert cancelled.wait(stretched())
    server.close()


def test_an_action_without_a_server_is_an_error(page: Page) -> None:
    with pytest.raises(RefusedError, match="there is no action '/nobody'"):
        page.open("action", action="/nobody", goal={})


def _later(run: Any) -> Any:
    """Runs a goal in a thread of its own, as programs do."""
    return lambda goal: threading.Thread(target=run, args=(goal,), daemon=True).start()


def _service(name: str) -> Any:
    from gazelle.interfaces import service_type

    return service_type(name)


def _row(rows: list[dict[str, Any]], name: str, key: str = "name") -> dict[str, Any]:
    return next(row for row in rows if row[key] == name)


def _has(rows: list[dict[str, Any]], name: str, key: str = "name") -> bool:
    return any(row[key] == name for row in rows)
