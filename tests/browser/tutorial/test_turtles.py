"""T1, T2, T3 and T5: the turtle's window, the node graph, the plot, publishers and monitors."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
from tests.browser.tutorial.terminal import Session, open_panel

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]


@pytest.fixture
def turtle(session: Callable[..., Session]) -> Session:
    """``roscore`` with a turtle in it."""
    begun = session("roscore")
    begun.first.wait_for_line("setting /run_id to")
    begun.opens("rosrun turtlesim turtlesim_node", "turtlesim")
    return begun


def test_turtle_is_drawn_and_driven_while_all_numbers_of_its_pose_are_plotted(
    turtle: Session, look: Any
) -> None:
    poses = turtle.listen("/turtle1/pose", "turtlesim/msg/Pose")
    seen = look(turtle.url)
    stage = seen.panel("turtlesim").get_by_label("TurtleSim: drive with the arrow keys")
    turtle.eventually(lambda: _colour(seen, 100, 100) == pytest.approx([69, 86, 255], abs=6))
    turtle.opens("rqt_plot /turtle1/pose/", "rqt_plot")
    curves = seen.panel("rqt_plot").get_by_role("listitem")
    curves.nth(4).wait_for()
    fields = ("x", "y", "theta", "linear_velocity", "angular_velocity")
    names = [each.split("\n")[0] for each in curves.all_inner_texts()]
    assert names == [f"/turtle1/pose/{field}" for field in fields]
    stage.click()
    begin = poses[-1].x

    def drives(key: str, arrived: Callable[[Any], bool]) -> bool:
        stage.press(key)
        # Keys come as fast as a person's keyboard repeats them.
        seen.page.wait_for_timeout(100)
        return arrived(poses[-1])

    turtle.eventually(lambda: drives("ArrowUp", lambda pose: pose.x > begin + 0.7))
    turtle.eventually(lambda: drives("ArrowLeft", lambda pose: abs(pose.theta) > 0.5))
    for index, field in enumerate(fields):
        turtle.eventually(partial(_shows, curves.nth(index), poses, field))
    # The line behind the turtle is lighter than the blue around it.
    turtle.eventually(lambda: _colour(seen, 262, 250)[0] > 120)
    seen.shot("driven")


def test_graph_shows_who_drives_the_turtle_with_filters(turtle: Session, look: Any) -> None:
    driver = turtle.first.graph.create_node("teleop_turtle", rosout=False)
    driver.create_publisher("/turtle1/cmd_vel", "geometry_msgs/msg/Twist")
    turtle.opens("rqt_graph", "rqt_graph")
    seen = look(turtle.url)
    panel = seen.panel("rqt_graph")
    turtle.eventually(lambda: _labels(panel) == ["/teleop_turtle", "/turtlesim"])
    assert panel.locator(".edge").count() == 1
    panel.get_by_label("What is shown").select_option("all")
    turtle.eventually(lambda: "/turtle1/cmd_vel" in _labels(panel))
    panel.get_by_label("Topics", exact=True).fill("pose")
    turtle.eventually(lambda: "/turtle1/cmd_vel" not in _labels(panel))
    panel.get_by_label("Topics", exact=True).fill("")
    panel.get_by_role("button", name="Node /turtlesim").click()
    assert "subscribes to 1" in panel.locator(".details").inner_text()
    seen.shot("graph")


def test_easy_publisher_drives_in_waves_and_the_monitor_tells_rates(
    turtle: Session, look: Any
) -> None:
    poses = turtle.listen("/turtle1/pose", "turtlesim/msg/Pose")
    seen = look(turtle.url, size=(1500, 800))
    # The document opens both with rqt's own menu.
    turtle.opens("rosrun rqt_gui rqt_gui", "rqt_gui")
    open_panel(seen, "Topic Monitor")
    open_panel(seen, "Easy Message Publisher")
    panel = seen.panel("rqt_ez_publisher")
    panel.get_by_label("Topic", exact=True).fill("/turtle1/cmd_vel")
    panel.get_by_label("Topic", exact=True).press("Tab")
    kind = panel.get_by_label("Type", exact=True)
    turtle.eventually(lambda: "Twist" in kind.input_value())
    panel.get_by_label("Rate in Hz", exact=True).fill("20")
    panel.get_by_role("button", name="Add").click()
    panel.get_by_label("linear.x", exact=True).fill("1.0")
    panel.get_by_label("angular.z", exact=True).fill("2*sin(3*t)")
    panel.get_by_label("Publish /turtle1/cmd_vel repeatedly").check()
    turtle.eventually(lambda: poses[-1].angular_velocity > 0.5)
    turtle.eventually(lambda: poses[-1].angular_velocity < -0.5)
    assert poses[-1].linear_velocity == 1.0
    seen.shot("waves")
    seen.page.locator(".dv-tab").filter(has_text="Topic Monitor").click()
    seen.page.get_by_label("Subscribe /turtle1/pose", exact=True).check()
    seen.page.get_by_label("Subscribe /turtle1/cmd_vel", exact=True).check()
    monitor = seen.panel("rqt_topic")
    turtle.eventually(lambda: 10 < _rate(monitor, "/turtle1/cmd_vel") < 25)
    turtle.eventually(lambda: _rate(monitor, "/turtle1/pose") > 25)
    row = monitor.locator("[data-path='/turtle1/pose/linear_velocity']")
    turtle.eventually(lambda: re.search(r"\b1(\.0)?\b", row.inner_text()))
    seen.shot("rates")


def _shows(row: Any, poses: list[Any], field: str) -> bool:
    text = row.locator("output").inner_text()
    value = getattr(poses[-1], field)
    return bool(re.fullmatch(r"-?[\d.e-]+", text)) and abs(float(text) - value) < 0.1


def _rate(monitor: Any, topic: str) -> float:
    text = monitor.locator(f"[data-path='{topic}']").inner_text()
    found = re.search(r"B/s\s+([\d.]+)", text)
    return float(found[1]) if found else 0.0


def _labels(panel: Any) -> list[str]:
    return sorted(panel.locator(".box-label").all_text_contents())


def _colour(seen: Any, x: int, y: int) -> list[int]:
    """The colour of the turtle's canvas at one of its pixels."""
    script = """([x, y]) => [...document.querySelector('[data-panel=turtlesim] canvas')
        ?.getContext('2d').getImageData(x, y, 1, 1).data ?? []].slice(0, 3)"""
    return list(seen.page.evaluate(script, [x, y]))
