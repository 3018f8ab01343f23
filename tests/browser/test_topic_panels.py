"""Topic Monitor, Plot and the publishers, as a person uses them."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow


def test_a_ticked_topic_shows_type_rate_bandwidth_and_values(bench: Any, look: Any) -> None:
    bench.keep_publishing(
        "/odom", "nav_msgs/msg/Odometry", lambda t: {"twist": {"twist": {"linear": {"x": 0.25}}}}
    )
    seen = look(bench.url, "rqt_topic", size=(1400, 800))
    panel = seen.panel("rqt_topic")
    seen.page.get_by_label("Filter topics").fill("odom")
    seen.page.get_by_label("Subscribe /odom", exact=True).check()
    row = panel.locator("[data-path='/odom']")
    bench.eventually(lambda: re.search(r"\n(1\d|2\d)\.\d\d", row.inner_text()))
    assert "nav_msgs/Odometry" in row.inner_text()
    assert re.search(r"\d kB/s", row.inner_text())
    for path in ("/odom/twist", "/odom/twist/twist", "/odom/twist/twist/linear"):
        panel.locator(f"[data-path='{path}'] .label").click()
    assert "0.25" in panel.locator("[data-path='/odom/twist/twist/linear/x']").inner_text()
    seen.page.get_by_label("Subscribe /odom", exact=True).uncheck()
    panel.locator("[data-path='/odom/twist']").wait_for(state="detached")


def test_a_value_is_dragged_onto_a_plot(bench: Any, look: Any) -> None:
    bench.keep_publishing(
        "/turtle1/pose", "turtlesim/msg/Pose", lambda t: {"x": 5 + math.sin(t), "theta": t}
    )
    seen = look(bench.url, "rqt_plot", "rqt_topic", size=(1400, 800))
    seen.page.get_by_label("Subscribe /turtle1/pose", exact=True).check()
    field = seen.panel("rqt_topic").locator("[data-path='/turtle1/pose/x']")
    field.wait_for()
    field.drag_to(seen.panel("rqt_plot").locator(".plot-area"))
    row = seen.panel("rqt_plot").get_by_role("listitem").filter(has_text="/turtle1/pose/x")
    bench.eventually(lambda: 3.9 < _number(row.locator("output").inner_text()) < 6.1)


def test_a_whole_topic_is_plotted_paused_and_saved(bench: Any, look: Any) -> None:
    """``rqt_plot /turtle1/pose/``: all numbers of the message."""
    bench.keep_publishing(
        "/turtle1/pose", "turtlesim/msg/Pose", lambda t: {"x": 5 + math.sin(2 * t), "y": 5.5}
    )
    seen = look(bench.url, "rqt_plot")
    seen.page.get_by_label("Topic field").fill("/turtle1/pose/")
    seen.page.keyboard.press("Enter")
    curves = seen.panel("rqt_plot").get_by_role("listitem")
    curves.nth(4).wait_for()
    assert [one.split("\n")[0] for one in curves.all_inner_texts()] == [
        f"/turtle1/pose/{name}"
        for name in ("x", "y", "theta", "linear_velocity", "angular_velocity")
    ]
    bench.eventually(lambda: _number(curves.nth(1).locator("output").inner_text()) == 5.5)
    seen.page.wait_for_timeout(1500)
    seen.shot("running")
    seen.page.get_by_role("button", name="Pause").click()
    with seen.page.expect_download() as download:
        seen.page.get_by_role("button", name="CSV").click()
    lines = Path(download.value.path()).read_text().splitlines()
    assert lines[0] == "time," + ",".join(
        f"/turtle1/pose/{name}"
        for name in ("x", "y", "theta", "linear_velocity", "angular_velocity")
    )
    assert len(lines) > 20
    assert all(abs(float(line.split(",")[2]) - 5.5) < 1e-6 for line in lines[1:])
    seen.page.get_by_role("button", name="Remove /turtle1/pose/").click()
    assert curves.count() == 0


def test_zooming_shows_a_part_and_the_whole_again(bench: Any, look: Any) -> None:
    bench.keep_publishing("/level", "std_msgs/msg/Float64", lambda t: {"data": math.sin(t)})
    seen = look(bench.url, "rqt_plot")
    seen.page.get_by_label("Topic field").fill("/level/data")
    seen.page.keyboard.press("Enter")
    seen.panel("rqt_plot").locator("canvas").wait_for()
    whole = seen.page.get_by_role("button", name="Show the whole window")
    assert whole.is_disabled()
    box = seen.panel("rqt_plot").locator(".u-over").bounding_box()
    seen.page.mouse.move(box["x"] + box["width"] * 0.5, box["y"] + 50)
    seen.page.mouse.down()
    seen.page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + 60, steps=5)
    seen.page.mouse.up()
    bench.eventually(whole.is_enabled)
    whole.click()
    bench.eventually(whole.is_disabled)


def test_a_value_that_is_no_number_is_not_plotted_as_zero(bench: Any, look: Any) -> None:
    bench.keep_publishing("/odd", "std_msgs/msg/Float64", lambda _: {"data": math.nan}, hz=10)
    seen = look(bench.url, "rqt_plot")
    seen.page.get_by_label("Topic field").fill("/odd/data")
    seen.page.keyboard.press("Enter")
    row = seen.panel("rqt_plot").get_by_role("listitem").filter(has_text="/odd/data")
    bench.eventually(lambda: row.locator("output").inner_text() == "NaN")


def test_a_plot_waits_for_a_topic_that_comes_later(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_plot")
    seen.page.get_by_label("Topic field").fill("/late/data")
    seen.page.keyboard.press("Enter")
    seen.panel("rqt_plot").get_by_text("no values yet").wait_for()
    bench.keep_publishing("/late", "std_msgs/msg/Float64", lambda t: {"data": 7.0})
    row = seen.panel("rqt_plot").get_by_role("listitem")
    bench.eventually(lambda: row.inner_text().split("\n")[-1] == "7")


def test_a_publisher_follows_an_expression_over_time(bench: Any, look: Any) -> None:
    heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    seen = look(bench.url, "rqt_publisher")
    _add_publisher(seen, "rqt_publisher", "/cmd_vel", "geometry_msgs/Twist", 20)
    panel = seen.panel("rqt_publisher")
    panel.get_by_label("linear.x", exact=True).fill("0.3")
    panel.get_by_label("angular.z", exact=True).fill("sin(t/2)")
    panel.get_by_label("Publish /cmd_vel repeatedly").check()
    bench.eventually(lambda: len(heard) > 20)
    assert {one.linear.x for one in heard[1:]} == {0.3}
    turns = [one.angular.z for one in heard]
    assert turns == sorted(turns)
    assert turns[-1] > turns[0]
    panel.get_by_text(re.compile(r"\d+ sent")).wait_for()
    panel.get_by_label("Publish /cmd_vel repeatedly").uncheck()
    seen.page.wait_for_timeout(300)
    count = len(heard)
    seen.page.wait_for_timeout(300)
    assert len(heard) == count


def test_a_publisher_is_found_again_after_a_reload(bench: Any, look: Any) -> None:
    heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    seen = look(bench.url)
    seen.page.keyboard.press("p")
    seen.page.get_by_role("menuitem", name="Message Publisher rqt_publisher", exact=True).click()
    _add_publisher(seen, "rqt_publisher", "/cmd_vel", "geometry_msgs/Twist", 20)
    panel = seen.panel("rqt_publisher")
    panel.get_by_label("linear.x", exact=True).fill("0.3")
    panel.get_by_label("Publish /cmd_vel repeatedly").check()
    bench.eventually(lambda: heard)
    bench.eventually(lambda: '"0.3"' in (seen.page.evaluate("sessionStorage['gazelle.tab']") or ""))
    seen.page.reload()
    again = panel.get_by_label("Publish /cmd_vel repeatedly")
    bench.eventually(again.is_checked)
    assert panel.get_by_label("linear.x", exact=True).input_value() == "0.3"
    again.uncheck()
    seen.page.wait_for_timeout(300)
    count = len(heard)
    seen.page.wait_for_timeout(300)
    assert len(heard) == count


def test_a_wrong_expression_is_told_at_its_publisher(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_publisher")
    _add_publisher(seen, "rqt_publisher", "/cmd_vel", "geometry_msgs/Twist", 10)
    panel = seen.panel("rqt_publisher")
    panel.get_by_label("linear.x", exact=True).fill("sine(t)")
    panel.get_by_label("Publish /cmd_vel repeatedly").check()
    problem = panel.get_by_role("alert")
    bench.eventually(lambda: "sine" in problem.inner_text())


def test_a_message_is_published_once(bench: Any, look: Any) -> None:
    heard = bench.listen("/chatter", "std_msgs/msg/String")
    seen = look(bench.url, "rqt_publisher")
    _add_publisher(seen, "rqt_publisher", "/chatter", "std_msgs/String", 1)
    seen.panel("rqt_publisher").get_by_label("data", exact=True).fill("012: yes")
    seen.page.get_by_role("button", name="Publish once").click()
    bench.eventually(lambda: heard)
    assert [one.data for one in heard] == ["012: yes"]


def test_the_easy_publisher_has_sliders(bench: Any, look: Any) -> None:
    heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    seen = look(bench.url, "rqt_ez_publisher")
    _add_publisher(seen, "rqt_ez_publisher", "/cmd_vel", "geometry_msgs/Twist", 20)
    panel = seen.panel("rqt_ez_publisher")
    panel.get_by_label("linear.x maximum").fill("2")
    panel.get_by_label("linear.x maximum").press("Enter")
    panel.get_by_label("Publish /cmd_vel repeatedly").check()
    panel.get_by_label("linear.x slider").fill("1.5")
    bench.eventually(lambda: heard and heard[-1].linear.x == pytest.approx(1.5, abs=0.01))
    seen.shot("sliders")


def _add_publisher(seen: Any, kind: str, topic: str, type_name: str, hz: float) -> None:
    panel = seen.panel(kind)
    panel.get_by_label("Topic", exact=True).fill(topic)
    seen.page.keyboard.press("Tab")
    panel.get_by_label("Type", exact=True).fill(type_name)
    panel.get_by_label("Rate in Hz", exact=True).fill(str(hz))
    panel.get_by_role("button", name="Add").click()
    panel.get_by_role("region", name=f"Publisher {topic}").locator("input").last.wait_for()


def _number(text: str) -> float:
    return float(text) if re.fullmatch(r"-?[\d.e+-]+", text) else math.nan
