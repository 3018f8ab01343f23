"""move_base while tf comes late."""

from __future__ import annotations

import re
from typing import Any

from tests.nodes.move_base.test_node import _PARAMETERS, _goal, start, world

__all__ = ["start", "world"]


def _tolerance(seconds: float) -> dict[str, Any]:
    return {
        name: {**_PARAMETERS[name], "transform_tolerance": seconds}
        for name in ("global_costmap", "local_costmap")
    }


def _texts(said: list[Any]) -> list[str]:
    return [one.msg for one in said if one.level >= 30]


def test_box_in_the_way_is_avoided_though_scans_wait_for_tf(bench, world, start) -> None:
    world.late_steps = 6
    # Two thirds of the room's height, not on the map.
    world.boxes[:50, 58:62] = True
    client = start(**_tolerance(2.0))
    goal = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: goal.is_done)
    assert goal.text == "Goal reached."
    assert not world.touched


def test_goal_ends_with_the_reason_where_tf_is_too_late(bench, world, start) -> None:
    world.late_steps = 14
    client = start(**_tolerance(0.3), planner_patience=3.0)
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    goal = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: goal.is_done)
    assert goal.status.name == "ABORTED"
    assert re.fullmatch(
        r"Failed to find a valid plan\. Even after executing recovery behaviors\. Last reason: "
        r"Unable to get starting pose of robot, unable to create global plan: the transform from "
        r"base_footprint to map is \d\.\d+ s old, transform_tolerance is 0\.3 s",
        goal.text,
    )
    # Three seconds before each behaviour, and a word in each second.
    late = [text for text in _texts(said) if text.startswith("/move_base/global_costmap: the tran")]
    assert len(late) >= 6


def test_robot_goes_on_once_tf_is_in_time_again(bench, world, start) -> None:
    client = start(**_tolerance(0.3))
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    first = client.send_goal(_goal(2.0, 1.0))
    bench.eventually(lambda: first.is_done)
    assert first.text == "Goal reached."
    world.late_steps = 20
    second = client.send_goal(_goal(5.0, 1.0))
    bench.eventually(lambda: any("Could not get robot pose" in one for one in _texts(said)))
    world.late_steps = 0
    bench.eventually(lambda: second.is_done)
    assert second.text == "Goal reached."
