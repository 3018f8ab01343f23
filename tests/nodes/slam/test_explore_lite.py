"""The node that explores, with somebody who drives at once wherever it wants."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster
from gazelle.mapping.grids import OccupancyGrid
from gazelle.nodes.map_server.occupancy_grid import message_of_grid


class World:
    """A corridor of 6 m, known as far as the robot has been; move_base knows the way."""

    def __init__(self, bench: Any, refuses: bool) -> None:
        self.bench, self.refuses = bench, refuses
        self.goals: list[tuple[float, float]] = []
        self.known = 20
        kind = "nav_msgs/msg/OccupancyGrid"
        self.maps = bench.node.create_publisher("/map", kind, latch=True)
        StaticTransformBroadcaster(bench.node).send(StampedPose("map", "base_link", 0, Pose()))
        self.server = ActionServer(
            bench.node, "move_base", "move_base_msgs/MoveBase", on_goal=self._on_goal, ros_version=1
        )
        self.publish()

    def publish(self) -> None:
        cells = np.full((20, 60), 100, np.int8)
        cells[5:15, 1:59] = 0
        cells[:, self.known :] = -1
        if self.known >= 60:
            cells[5:15, 1:59] = 0
        grid = OccupancyGrid(cells, 0.1, (-0.5, -1.0, 0.0))
        self.maps.publish(message_of_grid(grid, "map", 0))

    def _on_goal(self, goal: ServerGoal) -> None:
        at = goal.request.target_pose.pose.position
        self.goals.append((at.x, at.y))
        goal.accept()
        if self.refuses:
            goal.abort(text="no way")
            return
        self.known += 20
        self.publish()
        goal.succeed()


@pytest.mark.parametrize("refuses", [False, True])
def test_it_drives_to_frontiers_until_there_is_none(
    bench: Any, capfd: pytest.CaptureFixture[str], refuses: bool
) -> None:
    world = World(bench, refuses)
    bench.start("explore_lite/explore", "_costmap_topic:=map", "_planner_frequency:=20",
                "_transform_tolerance:=0.0", "_visualize:=true")  # fmt: skip
    said: list[str] = []

    def is_over() -> bool:
        said.extend(capfd.readouterr())
        return "no frontier left" in "".join(said)

    bench.eventually(is_over)
    text = "".join(said)
    assert "frontiers are not drawn" in text
    if refuses:
        assert len(world.goals) == 1
        assert "cannot be reached; it is left out" in text
    else:
        # The border of what is known, as it moves away: at 1.5 m and at 3.5 m.
        assert [round(x, 1) for x, _ in world.goals] == pytest.approx([1.5, 3.5], abs=0.15)
    assert bench.stop() == [0]
