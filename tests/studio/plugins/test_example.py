"""The scout's panel."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.graph import Node
from gazelle.interfaces import message_type
from gazelle.studio import Server
from gazelle.studio.plugins import Panel
from gazelle.studio.plugins.panel_sources import named_file
from gazelle.studio.plugins.panel_state import checked_layout

_WORKSPACE = Path(__file__).parents[3] / "examples" / "scout_ws" / "src"


def test_the_scouts_panel_drives_and_stops_before_a_wall(
    server: Server, node: Node, page: Any, talk: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(_WORKSPACE))
    listed = {entry["name"]: entry for entry in page.call("plugin.list")}
    assert listed["scout_robot.Cruise"]["title"] == "Scout Cruise"
    speeds: list[float] = []
    node.create_subscription(
        "/cmd_vel", message_type("geometry_msgs/msg/Twist"), lambda got: speeds.append(got.linear.x)
    )
    name = "scout_robot.Cruise"
    page.open("plugin", name=name)

    def scan(distance_m: float) -> None:
        ranges = [0.1, *[distance_m] * 3, 0.1]
        talk("/scan", "sensor_msgs/msg/LaserScan", angle_min=-0.4, angle_increment=0.2,
             range_min=0.05, range_max=10.0, ranges=ranges)  # fmt: skip

    page.call("plugin.event", name=name, widget="speed", value=0.3)
    page.call("plugin.event", name=name, widget="go")
    scan(3.0)
    eventually(lambda: speeds[-2:] == [0.3, 0.3])
    scan(0.4)
    eventually(lambda: speeds[-1] == 0.0)


def test_the_how_tos_panel_is_a_panel(tmp_path: Path) -> None:
    page = Path(__file__).parents[3] / "docs" / "howto" / "panels.md"
    blocks = page.read_text(encoding="utf-8").split("```python\n")[1:]
    text = next(block.split("```")[0] for block in blocks if "class Speed" in block)
    file = tmp_path / "speed.py"
    file.write_text(text)
    (source,) = named_file(str(file))
    assert source.title == "Speed"
    made: dict[str, Any] = {"__name__": "howto"}
    exec(compile(text, str(file), "exec"), made)
    assert issubclass(made["Speed"], Panel)
    assert checked_layout(made["Speed"])
