"""Node Graph, TF Tree, Nodes, Console, Logger Level, type browsers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow


def test_the_node_graph_follows_rqt_graphs_filters(bench: Any, look: Any) -> None:
    bench.publish("/scan", "sensor_msgs/msg/LaserScan")
    bench.publish("/alone", "std_msgs/msg/String")
    other = bench.graph.create_node("slam", rosout=False)
    from gazelle.interfaces import message_type

    other.create_subscription("/scan", message_type("sensor_msgs/msg/LaserScan"), print)
    seen = look(bench.url, "rqt_graph")
    panel = seen.panel("rqt_graph")
    panel.get_by_role("button", name="Node /slam").wait_for()
    assert _labels(panel) == ["/robot", "/slam"]
    assert panel.locator(".edge").count() == 1
    panel.get_by_label("What is shown").select_option("all")
    bench.eventually(lambda: _labels(panel) == ["/robot", "/scan", "/slam"])
    for hidden in ("Dead sinks", "Leaf topics"):
        panel.get_by_label(hidden).uncheck()
    bench.eventually(lambda: _labels(panel) == ["/alone", "/robot", "/scan", "/slam"])
    seen.shot("all")
    panel.get_by_role("button", name="/scan").click()
    assert "sensor_msgs" in panel.locator(".details").inner_text()
    assert panel.locator(".box.faded").count() == 1
    panel.get_by_label("Topics", exact=True).fill("-/alone")
    bench.eventually(lambda: _labels(panel) == ["/robot", "/scan", "/slam"])
    other.shutdown()


def test_the_node_graph_is_saved_as_dot_and_svg(bench: Any, look: Any) -> None:
    bench.publish("/scan", "sensor_msgs/msg/LaserScan")
    seen = look(bench.url, "rqt_graph")
    seen.panel("rqt_graph").get_by_role("button", name="Node /robot").wait_for()
    with seen.page.expect_download() as dot:
        seen.page.get_by_role("button", name="DOT").click()
    assert '"n:/robot" [label="/robot", shape=ellipse];' in Path(dot.value.path()).read_text()
    with seen.page.expect_download() as svg:
        seen.page.get_by_role("button", name="SVG").click()
    text = Path(svg.value.path()).read_text()
    assert text.startswith("<svg")
    assert "/robot" in text


def test_the_tf_tree_tells_rates_and_who_broadcasts(bench: Any, look: Any) -> None:
    def odom(t: float) -> dict[str, Any]:
        stamp = bench.graph.clock.now_ns()
        return {"transforms": [_transform("odom", "base_link", stamp)]}

    bench.keep_publishing("/tf", "tf2_msgs/msg/TFMessage", odom)
    seen = look(bench.url, "rqt_tf_tree")
    panel = seen.panel("rqt_tf_tree")
    panel.get_by_role("button", name="base_link").wait_for()
    label = panel.locator(".edge-label")
    bench.eventually(lambda: re.search(r"/robot(1\d|2\d)\.?\d* Hz", label.text_content()))
    assert panel.get_by_text("2 frames").is_visible()


def test_a_node_tells_what_it_does_and_is_killed(bench: Any, look: Any) -> None:
    victim = bench.graph.create_node("victim", rosout=False)
    asked: list[str] = []
    victim.on_shutdown(asked.append)
    from gazelle.interfaces import message_type

    victim.create_publisher("/said", message_type("std_msgs/msg/String"))
    seen = look(bench.url, "rqt_top")
    panel = seen.panel("rqt_top")
    panel.get_by_role("option", name="/victim").click()
    panel.get_by_text("/said").wait_for()
    panel.get_by_role("button", name="Kill").click()
    seen.page.get_by_role("dialog").get_by_role("button", name="Kill").click()
    bench.eventually(lambda: asked)
    assert "/victim was asked to shut down" in seen.toast()


def test_the_console_filters_by_level_and_text(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_console")
    panel = seen.panel("rqt_console")
    panel.get_by_label("Filter messages").wait_for()

    def say() -> bool:
        bench.node.log("info", "all is well")
        bench.node.log("warn", "battery at 20 %")
        bench.node.log("error", "wheel is stuck")
        return bool(panel.get_by_role("row").filter(has_text="wheel is stuck").count())

    bench.eventually(say)
    panel.get_by_role("button", name="Info").click()
    bench.eventually(lambda: panel.get_by_role("row").filter(has_text="all is well").count() == 0)
    assert panel.get_by_role("row").filter(has_text="battery").count() > 0
    panel.get_by_label("Filter messages").fill("wheel")
    bench.eventually(lambda: panel.get_by_role("row").filter(has_text="battery").count() == 0)
    panel.get_by_role("row").filter(has_text="wheel is stuck").first.click()
    assert "/robot" in panel.locator(".details").inner_text()
    with seen.page.expect_download() as saved:
        panel.get_by_role("button", name="CSV").click()
    lines = Path(saved.value.path()).read_text().splitlines()
    assert lines[0] == "message,severity,node,stamp,location"
    assert lines[1].startswith("wheel is stuck,error,/robot,")
    panel.get_by_role("button", name="Clear the messages").click()
    bench.eventually(lambda: panel.get_by_text("0 of 0").is_visible())


def test_a_loggers_level_is_set(bench: Any, look: Any) -> None:
    talkative = bench.graph.create_node("talker")
    seen = look(bench.url, "rqt_logger_level")
    panel = seen.panel("rqt_logger_level")
    panel.get_by_role("option", name="/talker").click()
    loggers = panel.get_by_label("Loggers")
    loggers.get_by_role("option").or_(loggers.get_by_text("tells of no logger")).first.wait_for()
    if loggers.get_by_role("option").count() == 0:
        assert "no" in seen.toast()
        talkative.shutdown()
        return
    panel.get_by_role("option", name="Error").click()
    bench.eventually(
        lambda: panel.get_by_role("option", name="Error").get_attribute("aria-selected") == "true"
    )
    talkative.shutdown()


def test_a_type_is_found_and_its_definition_read(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_msg")
    panel = seen.panel("rqt_msg")
    panel.get_by_label("Filter types").fill("geometry_msgs/msg/Twist")
    panel.get_by_role("option", name="geometry_msgs/msg/TwistStamped").click()
    panel.get_by_label("Definition").get_by_text("Header header").wait_for()
    assert panel.get_by_text("geometry_msgs/msg/Vector3").first.is_visible()


def _labels(panel: Any) -> list[str]:
    return sorted(panel.locator(".box-label").all_text_contents())


def _transform(parent: str, child: str, stamp_ns: int) -> dict[str, Any]:
    seconds, rest = divmod(stamp_ns, 10**9)
    return {
        "header": {"frame_id": parent, "stamp": {"sec": seconds, "nanosec": rest}},
        "child_frame_id": child,
        "transform": {"rotation": {"w": 1.0}},
    }
