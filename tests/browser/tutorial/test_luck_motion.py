"""LUCK in the panel MotionPlanning: document LUCK's launch file, and what its person does (L6)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.browser.scene.rviz_page import RvizPage

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_READY = [0.0, 0.5, -0.6, 0.0, 0.4, 0.0]
_HOME = [0.0] * 6
_STARTING_S = 120.0
_PATIENCE_S = 60.0
_LOOK = "gazelle.look({kind: 'Orbit', focal: [0, 0, 0.3], distance: 1.6, yaw: -0.9, pitch: 0.4})"


class Arm:
    """The launched arm and the page that its launch opens.

    Attributes:
        page: with RViz's view.
        panel: MotionPlanning.
    """

    def __init__(self, launched: Any, look: Any) -> None:
        self.launched = launched
        launched.wait_for_line("You can start planning now!", _STARTING_S)
        line = launched.wait_for_line(r"gazebo: http://127\.0\.0\.1:\d+/$", _STARTING_S)
        seen = look(line.split("gazebo: ")[1].strip(), size=(1440, 900))
        self.page = RvizPage(seen, self)
        self.panel = seen.panel("motion_planning")
        self.panel.wait_for()
        self.eventually(lambda: self.counts().get("goal", 0) > 0)

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return self.launched.eventually(condition, _PATIENCE_S)

    def counts(self) -> dict[str, int]:
        """What the display draws."""
        return self.page.counts("MotionPlanning")

    def well(self, display: str) -> None:
        """Wait until a display has nothing to complain about."""
        last: dict[str, Any] = {}

        def is_well() -> bool:
            last.update(self.page.display(display))
            return bool(last["level"] == "ok")

        try:
            self.eventually(is_well)
        except AssertionError:
            raise AssertionError(f"{display}: {last['status']}") from None

    def positions(self) -> list[float]:
        """Where the joints are in the simulation."""
        message = self.launched.messages({"/joint_states": 2})["/joint_states"][-1]
        by_name = dict(zip(message.name, message.position, strict=True))
        return [by_name[name] for name in _JOINTS]

    def tab(self, name: str) -> None:
        """Bring a tab to the front."""
        self.panel.get_by_role("tab", name=name).click()

    def press(self, name: str) -> None:
        """Press a button of the panel."""
        self.panel.get_by_role("button", name=name, exact=True).click()

    def goal(self, name: str) -> None:
        """Choose a goal state by its name."""
        self.panel.get_by_label("Goal state").select_option(name)

    def says(self, words: str) -> str:
        """Wait until the result line says something; returns the line."""
        line = self.panel.get_by_role("status", name="Result")
        line.filter(has_text=words).wait_for()
        return str(line.inner_text())

    def goal_joint(self, name: str) -> float:
        """Where the goal has a joint."""
        field = self.panel.get_by_label(f"{name} position")
        return float(field.input_value())


@pytest.fixture
def arm(gazelle: Any, workspaces_dir: Path, tmp_path: Path, look: Any) -> Iterator[Arm]:
    """``ros2 launch luck_gazebo gazebo_moveit.launch.py``, exactly as it is printed."""
    own = {"GAZELLE_STUDIO": "1", "XDG_CONFIG_HOME": str(tmp_path / "config")}
    words = ("ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py")
    yield Arm(gazelle(*words, cwd=workspaces_dir / "ros2_ws", **own), look)


def test_person_plans_watches_and_executes(arm: Arm) -> None:
    seen = arm.page.seen
    arm.well("MotionPlanning")
    # moveit.rviz says so: the path again and again, each state for 0.05 s.
    assert arm.panel.get_by_label("State Display Time").input_value() == "0.05 s"
    assert arm.panel.get_by_label("Loop").is_checked()
    arm.goal("ready")
    arm.press("Plan")
    arm.says("Planned: SUCCESS (1)")
    arm.eventually(lambda: arm.counts()["path"] > 0)
    place = arm.panel.get_by_label("Place in the planned path")
    place.focus()
    seen.page.keyboard.press("End")
    first, last = place.get_attribute("aria-valuetext").removesuffix(" s").split(" / ")
    assert first == last and float(last) > 0
    seen.shot("planned")
    assert arm.positions() == pytest.approx(_HOME, abs=0.01)
    arm.press("Execute")
    arm.says("Executed: SUCCESS (1)")
    assert arm.positions() == pytest.approx(_READY, abs=0.01)

    # A goal inside of something is told with MoveIt's code and with what is in the way.
    arm.tab("Scene Objects")
    for side, size in zip("xyz", ("0.4", "0.4", "0.15"), strict=True):
        arm.panel.get_by_label(f"Box {side} (m)").fill(size)
    arm.press("Add")
    arm.eventually(lambda: arm.counts()["objects"] == 1)
    height = arm.panel.get_by_label("Object z")
    height.fill("0.75")
    height.press("Enter")
    arm.tab("Planning")
    arm.goal("home")
    arm.eventually(lambda: arm.counts()["red"] > 0)
    seen.shot("in the way")
    arm.press("Plan")
    assert "'Box'" in arm.says("GOAL_IN_COLLISION (-12)")
    arm.tab("Scene Objects")
    arm.panel.locator("[data-object=Box]").click()
    arm.press("Remove")
    arm.eventually(lambda: arm.counts()["objects"] == 0)

    _drag_the_goal(arm)


def _drag_the_goal(arm: Arm) -> None:
    """Sliders and the arrows at the tip move the goal."""
    arm.tab("Joints")
    arm.panel.get_by_label("joint_1 position").fill("0.3")
    arm.panel.get_by_label("joint_1 position").press("Enter")
    assert arm.goal_joint("joint_1") == pytest.approx(0.3)
    arm.tab("Planning")
    arm.goal("ready")
    arm.tab("Joints")
    before = [arm.goal_joint(name) for name in _JOINTS]
    arm.page.seen.page.evaluate(_LOOK)
    at = arm.page.seen.page.evaluate("gazelle.handle('goal', 'move_z')")
    arm.page.drag((at["x"], at["y"]), (at["x"], at["y"] - 25))
    arm.eventually(lambda: [arm.goal_joint(name) for name in _JOINTS] != before)
    arm.page.seen.shot("dragged")
