"""The node collision_monitor: commands in, what zones leave of them out."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.interfaces import message_type

_PARAMETERS: dict[str, Any] = {
    "base_frame_id": "base_footprint",
    "odom_frame_id": "odom",
    "state_topic": "collision_monitor_state",
    "source_timeout": 20.0,
    "stop_pub_timeout": 100.0,
    "polygons": ["stop", "slow", "far"],
    "stop": {"type": "circle", "action_type": "stop", "radius": 0.3, "min_points": 2},
    "slow": {
        "type": "polygon", "action_type": "slowdown", "slowdown_ratio": 0.5, "min_points": 2,
        "points": "[[0.6, 0.6], [0.6, -0.6], [-0.6, -0.6], [-0.6, 0.6]]", "visualize": True,
        "polygon_pub_topic": "slow_zone",
    },
    "far": {"type": "polygon", "action_type": "approach", "footprint_topic": "outline"},
    "observation_sources": ["scan"],
    "scan": {"type": "scan", "topic": "scan"},
}  # fmt: skip


class _Robot:
    """Sends scans and commands, and hears what comes out."""

    def __init__(self, bench: Any) -> None:
        self.bench = bench
        node = bench.node
        self._scan = node.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
        self._command = node.create_publisher("/cmd_vel_smoothed", "geometry_msgs/msg/Twist")
        self.heard = bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
        self.states = bench.listen(
            "/collision_monitor_state", "nav2_msgs/msg/CollisionMonitorState"
        )
        bench.eventually(lambda: self._scan.matched and self._command.matched)

    def see(self, *ranges_m: float) -> None:
        scan: Any = self._scan.message_class(
            ranges=list(ranges_m), angle_min=0.0, angle_increment=0.01, range_min=0.05,
            range_max=5.0,
        )  # fmt: skip
        scan.header.frame_id = "base_footprint"
        scan.header.stamp.sec = int(time.time())
        self._scan.publish(scan)

    def leaves(self, x: float, of: float = 0.4) -> None:
        """Command until the speed that comes out is this one."""
        twist = self._command.message_class()
        twist.linear.x = of

        def sent() -> bool:
            self._command.publish(twist)
            return bool(self.heard) and self.heard[-1].linear.x == pytest.approx(x)

        self.bench.eventually(sent)


@pytest.fixture
def robot(bench: Any, tmp_path: Path) -> _Robot:
    file = tmp_path / "params.yaml"
    file.write_text(yaml.safe_dump({"collision_monitor": {"ros__parameters": _PARAMETERS}}))
    words = ("--ros-args", "--params-file", str(file))
    bench.start("nav2_collision_monitor/collision_monitor", *words)
    transition = message_type("lifecycle_msgs/msg/Transition")
    for label in ("configure", "activate"):
        request = {"transition": transition(label=label)}
        kind = "lifecycle_msgs/srv/ChangeState"
        assert bench.call("/collision_monitor/change_state", kind, **request).success
    return _Robot(bench)


def test_commands_are_slowed_and_stopped_by_what_the_scan_sees(bench: Any, robot: _Robot) -> None:
    robot.leaves(0.0)  # nothing was seen yet
    robot.see(2.0, 2.0, 2.0)
    robot.leaves(0.4)
    robot.see(2.0, 0.5, 0.5)
    robot.leaves(0.2)
    robot.see(0.2, 0.2, 2.0)
    robot.leaves(0.0)
    robot.see(math.inf, 2.0, 2.0)
    robot.leaves(0.4)
    # Another topic: its last message may come after the command.
    bench.eventually(lambda: len(robot.states) == 5)
    said = [(int(one.action_type), one.polygon_name) for one in robot.states]
    assert said == [(1, "invalid source"), (0, ""), (2, "slow"), (1, "stop"), (0, "")]


def test_zones_and_the_whole_node_are_switched_off(
    bench: Any, robot: _Robot, set_parameter: Callable[..., Any]
) -> None:
    robot.see(0.5, 0.5, 2.0)
    robot.leaves(0.2)
    assert set_parameter("slow.enabled", False) == ""
    robot.leaves(0.4)
    assert "only enabled of a zone or sensor changes" in set_parameter("slow.slowdown_ratio", 0.1)
    robot.see(0.2, 0.2, 2.0)
    robot.leaves(0.0)
    assert bench.call("/collision_monitor/toggle", "nav2_msgs/srv/Toggle", enable=False).success
    robot.leaves(0.4)


def test_approach_takes_the_outline_of_a_topic(bench: Any, robot: _Robot) -> None:
    out = bench.node.create_publisher("/outline", "geometry_msgs/msg/PolygonStamped")
    bench.eventually(lambda: out.matched)
    point = message_type("geometry_msgs/msg/Point32")
    outline: Any = out.message_class()
    outline.header.frame_id = "base_footprint"
    corners = ((0.2, 0.2), (0.2, -0.2), (-0.2, -0.2), (-0.2, 0.2))
    outline.polygon.points = [point(x=x, y=y) for x, y in corners]
    out.publish(outline)
    # 0.5 m are left, which 0.4 m/s takes 1.3 s for: less than time_before_collision, 2 s.
    robot.see(0.7, 0.7, 0.7, 0.7, 0.7)
    robot.leaves(0.4 * 1.3 / 2.0)
    bench.eventually(lambda: robot.states and robot.states[-1].polygon_name == "far")


def test_zones_are_shown(bench: Any, robot: _Robot) -> None:
    shown = bench.listen("/slow_zone", "geometry_msgs/msg/PolygonStamped")
    robot.see(2.0, 2.0, 2.0)
    bench.eventually(lambda: robot.leaves(0.4) or shown)
    assert len(shown[-1].polygon.points) == 4
    assert shown[-1].header.frame_id == "base_footprint"


@pytest.fixture
def set_parameter(bench: Any) -> Callable[[str, Any], str]:
    def made(name: str, value: Any) -> str:
        kind = "rcl_interfaces/srv/SetParameters"
        parameter: Any = message_type("rcl_interfaces/msg/Parameter")(name=name)
        if isinstance(value, bool):
            parameter.value.type, parameter.value.bool_value = 1, value
        else:
            parameter.value.type, parameter.value.double_value = 3, value
        answer = bench.call("/collision_monitor/set_parameters", kind, parameters=[parameter])
        return "" if answer.results[0].successful else str(answer.results[0].reason)

    return made
