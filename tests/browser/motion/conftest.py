"""The panel MotionPlanning on a move_group of the example arm, all in this process."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.browser.motion.motion_panel import MotionPanel
from tests.nodes.conftest import Bench as NodeBench
from tests.nodes.move_group.conftest import ArmBench

from gazelle.nodes.move_group.request_planner import RequestPlanner

_LOOK = "gazelle.look({kind: 'Orbit', focal: [0.2, 0, 0.4], distance: 2, yaw: -0.9, pitch: 0.4})"


class MotionDesk:
    """A person at the page, the arm, and what move_group was asked.

    Attributes:
        arm: move_group with controllers that go where they are told.
        requests: the ``MotionPlanRequest`` of every plan.
        ui: the panel.
    """

    def __init__(self, arm: ArmBench, requests: list[Any]) -> None:
        self.arm, self.requests = arm, requests
        self.ui: Any = None

    @property
    def positions(self) -> dict[str, float]:
        """Where the robot is."""
        return self.arm.robot.positions

    def scene(self) -> Any:
        """The planning scene that move_group has."""
        asked = {"components": 1 + 2 + 4 + 8 + 16}
        return self.arm.call("get_planning_scene", "GetPlanningScene", components=asked).scene

    def objects(self) -> dict[str, Any]:
        """Objects of the scene by name."""
        return {item.id: item for item in self.scene().world.collision_objects}

    def held(self) -> dict[str, Any]:
        """What the robot holds, by name."""
        bodies = self.scene().robot_state.attached_collision_objects
        return {body.object.id: body for body in bodies}


@pytest.fixture
def requests(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What move_group is asked to plan."""
    got: list[Any] = []
    plan = RequestPlanner.plan

    def noted(planner: RequestPlanner, scene: Any, request: Any, frame_of: Any) -> Any:
        got.append(request)
        return plan(planner, scene, request, frame_of)

    monkeypatch.setattr(RequestPlanner, "plan", noted)
    return got


@pytest.fixture
def open_desk(
    bench: Any, look: Any, requests: list[Any], tmp_path: Path
) -> Iterator[Callable[..., MotionDesk]]:
    """Starts move_group and opens the page; ``ros_version=1`` is ROS 1's."""
    transform = {
        "header": {"frame_id": "map"},
        "child_frame_id": "base_link",
        "transform": {"rotation": {"w": 1.0}},
    }
    nodes = NodeBench(bench.graph)
    made: list[ArmBench] = []

    def start(
        *, ros_version: int = 2, theme: str = "dark", end: Any = None, **changes: Any
    ) -> MotionDesk:
        bench.keep_publishing(
            "/tf", "tf2_msgs/msg/TFMessage", lambda _: {"transforms": [transform]}, hz=10
        )
        arm = ArmBench(nodes, ros_version, tmp_path)
        made.append(arm)
        arm.robot.follow("arm_controller", end)
        arm.start(**changes)
        desk = MotionDesk(arm, requests)
        seen = look(bench.url, "rviz", "motion_planning", theme=theme, size=(1440, 900))
        desk.ui = MotionPanel(seen, bench)
        desk.ui.well()
        desk.ui.page.evaluate(_LOOK)
        return desk

    yield start
    for one in made:
        one.stop()
    nodes.stop()


@pytest.fixture
def desk(open_desk: Callable[..., MotionDesk]) -> MotionDesk:
    return open_desk()
