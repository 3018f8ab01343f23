"""Panels on things that run: dynamic_reconfigure, actions, turtlesim, a world, bags."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from gazelle.graph.dynamic_reconfigure import DynamicGroup, DynamicParameter, ReconfigureServer
from gazelle.interfaces import action_type

pytestmark = pytest.mark.slow


def test_a_dynamic_parameter_is_moved_with_its_slider(bench: Any, look: Any) -> None:
    heard: list[dict[str, Any]] = []
    group = DynamicGroup(
        "Default",
        (
            DynamicParameter("gain", "double", 0.5, "Proportional gain", 0.0, 2.0),
            DynamicParameter("verbose", "bool", False, "Say more"),
        ),
    )
    ReconfigureServer(
        bench.node, "/driver", group, lambda values, _level: heard.append(dict(values))
    )
    seen = look(bench.url, "rqt_reconfigure")
    panel = seen.panel("rqt_reconfigure")
    panel.get_by_role("option", name="/driver").click()
    slider = panel.get_by_label("gain slider")
    slider.wait_for()
    slider.fill("1.5")
    bench.eventually(lambda: heard and heard[-1]["gain"] == 1.5)
    panel.get_by_label("verbose", exact=True).check()
    bench.eventually(lambda: heard[-1]["verbose"] is True)
    assert heard[-1]["gain"] == 1.5


def test_a_value_that_another_client_sets_shows_at_once(bench: Any, look: Any) -> None:
    group = DynamicGroup(
        "Default", (DynamicParameter("gain", "double", 0.5, "Proportional gain", 0.0, 2.0),)
    )
    server = ReconfigureServer(bench.node, "/driver", group, lambda _values, _level: None)
    seen = look(bench.url, "rqt_reconfigure")
    panel = seen.panel("rqt_reconfigure")
    panel.get_by_role("option", name="/driver").click()
    panel.get_by_label("gain", exact=True).wait_for()
    server.set({"gain": 1.25})
    bench.eventually(lambda: panel.get_by_label("gain", exact=True).input_value() == "1.25")


def test_an_action_gives_feedback_and_its_result(bench: Any, look: Any) -> None:
    from gazelle.graph.actions import ActionServer

    kind = action_type("actionlib_tutorials/Fibonacci")
    orders: list[int] = []

    def on_goal(goal: Any) -> None:
        orders.append(goal.request.order)
        goal.accept()
        goal.publish_feedback(kind.Feedback(sequence=[0, 1]))
        goal.succeed(kind.Result(sequence=[0, 1, 1, 2]))

    ActionServer(bench.node, "/fibonacci", "actionlib_tutorials/Fibonacci", on_goal=on_goal)
    seen = look(bench.url, "action_caller")
    panel = seen.panel("action_caller")

    def chosen() -> bool:
        panel.get_by_label("Action", exact=True).fill("")
        panel.get_by_label("Action", exact=True).fill("/fibonacci")
        panel.get_by_label("Action", exact=True).press("Enter")
        seen.page.wait_for_timeout(150)
        return bool(panel.get_by_label("order").is_visible())

    bench.eventually(chosen)
    panel.get_by_label("order").fill("3")
    panel.get_by_role("button", name="Send goal").click()
    bench.eventually(lambda: "succeeded" in panel.get_by_role("status").inner_text().lower())
    assert orders == [3]
    assert "- 2" in panel.get_by_label("Result").inner_text()


def test_the_turtle_is_driven_with_the_arrow_keys_and_seen(
    gazelle: Any, studio_of: Any, look: Any
) -> None:
    core = gazelle("roscore")
    core.wait_for_line("setting /run_id to")
    gazelle("rosrun", "turtlesim", "turtlesim_node").wait_for_line("Spawning turtle")
    poses: list[Any] = []
    core.messages({"/turtle1/pose": 1})
    core.node.create_subscription("/turtle1/pose", "turtlesim/msg/Pose", poses.append)
    seen = look(studio_of(core), "turtlesim", "rqt_plot")
    stage = seen.panel("turtlesim").get_by_label("TurtleSim: drive with the arrow keys")
    seen.panel("turtlesim").get_by_text("Waiting for turtlesim").wait_for(state="hidden")
    seen.page.get_by_label("Topic field").fill("/turtle1/pose/")
    seen.page.keyboard.press("Enter")
    stage.click()
    seen.page.keyboard.press("ArrowUp")
    core.eventually(lambda: poses and poses[-1].x > 7.0)
    row = seen.panel("rqt_plot").get_by_role("listitem").filter(has_text="/turtle1/pose/x")
    core.eventually(lambda: re.search(r"\n7\.\d", row.inner_text()))
    seen.shot("driven")


def test_the_bar_pauses_steps_and_resets_a_world(gazelle: Any, studio_of: Any, look: Any) -> None:
    world = gazelle("roscore")
    world.wait_for_line("setting /run_id to")
    gazelle("gzserver", "empty.world").wait_for_line("Physics dynamic reconfigure ready")
    clock: list[float] = []
    world.messages({"/clock": 1})
    world.node.create_subscription(
        "/clock", "rosgraph_msgs/msg/Clock", lambda one: clock.append(_seconds(one.clock))
    )
    seen = look(studio_of(world), "rqt_graph")
    bar = seen.page.get_by_role("toolbar", name="Simulation")
    bar.wait_for()
    seen.page.get_by_role("button", name="Pause (Space)").click()
    seen.page.get_by_role("button", name="Play (Space)").wait_for()
    seen.page.wait_for_timeout(300)
    at = clock[-1]
    bar.get_by_label("Steps").fill("250")
    bar.get_by_role("button", name="Step").click()
    world.eventually(lambda: abs(clock[-1] - at - 0.25) < 1e-6)
    assert bar.get_by_label("Real-time factor", exact=True).inner_text() == "paused"
    bar.get_by_role("button", name="Reset").click()
    seen.page.get_by_role("menuitem", name="Reset time").click()
    world.eventually(lambda: bar.get_by_label("Simulation time").inner_text() == "00:00:00.000")
    count = len(clock)
    seen.page.locator("body").press(" ")
    seen.page.get_by_role("button", name="Pause (Space)").wait_for()
    world.eventually(lambda: len(clock) > count + 5)
    assert min(clock[count:]) < at
    bar.get_by_label("Wanted real-time factor").fill("0.5")
    bar.get_by_label("Wanted real-time factor").press("Enter")
    world.eventually(lambda: bar.get_by_label("Real-time factor", exact=True).inner_text() < "0.6")
    seen.shot("bar")


def test_topics_are_recorded_and_the_bag_is_scrubbed(bench: Any, look: Any, tmp_path: Path) -> None:
    bench.keep_publishing("/count", "std_msgs/msg/Float64", lambda t: {"data": t})
    seen = look(bench.url, "rqt_bag")
    panel = seen.panel("rqt_bag")
    panel.get_by_label("Record to").fill(str(tmp_path / "run.bag"))
    panel.get_by_role("button", name="Record").click()
    panel.get_by_text(re.compile(r"[1-9]\d messages")).wait_for()
    panel.get_by_role("button", name="Stop").click()
    bench.eventually(lambda: panel.get_by_label("Bag to open").input_value())
    assert (tmp_path / "run.bag").stat().st_size > 1000
    panel.get_by_role("button", name="Open").click()
    panel.get_by_text("/count").wait_for()
    timeline = panel.get_by_label("Time in the bag").and_(panel.get_by_role("slider"))
    timeline.focus()
    seen.page.keyboard.press("End")
    time = panel.get_by_role("status").or_(panel.locator("output"))
    bench.eventually(lambda: not time.last.inner_text().startswith("00:00:00.000"))
    seen.shot("opened")


def _seconds(stamp: Any) -> float:
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9
