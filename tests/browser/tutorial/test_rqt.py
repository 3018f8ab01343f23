"""T7 and what rqt does beside: node graph, tf tree, files of RViz and rqt, layouts, bags."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.browser.scene.rviz_page import RvizPage
from tests.browser.tutorial.terminal import Session

from gazelle.interfaces import message_type

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_PERSPECTIVE = {
    "keys": {},
    "groups": {
        "pluginmanager": {
            "keys": {
                "running-plugins": {
                    "type": "repr",
                    "repr": "{'rqt_plot/Plot': [1], 'rqt_topic/TopicPlugin': [1]}",
                }
            },
            "groups": {
                "plugin__rqt_plot__Plot__1": {
                    "keys": {},
                    "groups": {
                        "plugin": {
                            "keys": {"topics": {"type": "repr", "repr": "['/turtle1/pose/x']"}},
                            "groups": {},
                        }
                    },
                }
            },
        }
    },
}


@pytest.fixture
def waffle(session: Callable[..., Session], workspaces_dir: Path) -> Session:
    """``roslaunch turtlebot3_fake turtlebot3_fake.launch`` with its RViz."""
    begun = session(
        "roslaunch turtlebot3_fake turtlebot3_fake.launch",
        cwd=workspaces_dir / "turtlebot3_ws",
        TURTLEBOT3_MODEL="waffle",
    )
    begun.shows(begun.first, "rviz")
    return begun


def test_fake_waffle_has_its_rviz_file_its_nodes_and_its_frames(
    waffle: Session, workspaces_dir: Path, look: Any
) -> None:
    seen = look(waffle.url, theme="light", size=(1440, 900))
    rviz = RvizPage(seen, waffle)
    file = next(workspaces_dir.glob("turtlebot3_ws/**/turtlebot3_fake.rviz"))
    wanted = yaml.safe_load(file.read_text(encoding="utf-8"))["Visualization Manager"]
    rviz.eventually(lambda: rviz.report()["fixedFrame"] == wanted["Global Options"]["Fixed Frame"])
    names = {each["Name"] for each in wanted["Displays"] if each["Enabled"]}
    rviz.eventually(lambda: names <= set(rviz.report()["displays"]))
    rviz.eventually(lambda: rviz.counts("RobotModel").get("placed", 0) >= 8)
    seen.shot("rviz")
    waffle.opens("rqt_graph", "rqt_graph")
    graph = seen.panel("rqt_graph")
    graph.get_by_role("button", name="Node /turtlebot3_fake_node").wait_for()
    waffle.opens("rosrun rqt_tf_tree rqt_tf_tree", "rqt_tf_tree")
    tree = seen.panel("rqt_tf_tree")
    tree.get_by_role("button", name="base_footprint", exact=True).wait_for()
    assert tree.get_by_role("button", name="odom", exact=True).is_visible()
    seen.shot("frames")
    _saves_and_restores_a_layout(seen)


def _saves_and_restores_a_layout(seen: Any) -> None:
    menu = seen.page.get_by_role("button", name="Layout", exact=True)
    menu.click()
    seen.page.get_by_role("menuitem", name="Save layout as…").click()
    seen.page.get_by_label("Name").fill("waffle")
    seen.page.keyboard.press("Enter")
    assert "Layout waffle is saved" in seen.toast()
    menu.click()
    seen.page.get_by_role("menuitem", name="Graph and topics").click()
    seen.panel("rviz").wait_for(state="detached")
    menu.click()
    seen.page.get_by_role("menuitem", name="waffle", exact=True).click()
    for kind in ("rviz", "displays", "rqt_graph", "rqt_tf_tree"):
        seen.panel(kind).wait_for(state="attached")


def test_rqt_opens_a_perspective_beside_the_turtle(
    session: Callable[..., Session], tmp_path: Path, look: Any
) -> None:
    (tmp_path / "mine.perspective").write_text(json.dumps(_PERSPECTIVE), encoding="utf-8")
    begun = session("roscore")
    begun.opens("rosrun rqt_gui rqt_gui --perspective-file mine.perspective", "rqt_gui")
    seen = look(begun.url)
    curve = seen.panel("rqt_plot").get_by_role("listitem")
    curve.wait_for()
    assert curve.inner_text().startswith("/turtle1/pose/x")
    seen.panel("rqt_topic").wait_for()
    assert seen.page.locator("[data-panel]").count() == 2
    seen.shot("perspective")


def test_bag_recorded_on_the_page_plays_on_from_where_it_was_scrubbed_to(
    bench: Any, look: Any, tmp_path: Path
) -> None:
    seen = look(bench.url, "rqt_bag")
    panel = seen.panel("rqt_bag")
    panel.get_by_label("Record to").fill(str(tmp_path / "count.bag"))
    panel.get_by_role("button", name="Record").click()
    panel.get_by_role("button", name="Stop").wait_for()
    count = bench.node.create_publisher("/count", message_type("std_msgs/msg/Float64"))
    bench.eventually(lambda: count.matched)
    for number in range(20):
        bench.publish("/count", "std_msgs/msg/Float64", data=float(number))
        seen.page.wait_for_timeout(60)
    panel.get_by_role("button", name="Stop").click()
    bench.eventually(lambda: panel.get_by_label("Bag to open").input_value())
    panel.get_by_role("button", name="Open").click()
    timeline = panel.get_by_role("slider", name="Time in the bag")
    timeline.wait_for()
    heard = bench.listen("/count", "std_msgs/msg/Float64")
    box = timeline.bounding_box()
    middle = box["y"] + box["height"] / 2
    seen.page.mouse.click(box["x"] + box["width"] / 2, middle)
    # Scrubbing publishes what was last there.
    bench.eventually(lambda: heard and 5.0 < heard[-1].data < 15.0)
    scrubbed = heard[-1].data
    heard.clear()
    panel.get_by_role("button", name="Play").click()
    bench.eventually(lambda: heard and heard[-1].data == 19.0)
    first = heard[0].data
    assert scrubbed <= first <= scrubbed + 1
    assert sorted({each.data for each in heard}) == [float(each) for each in range(int(first), 20)]
    seen.shot("played")
