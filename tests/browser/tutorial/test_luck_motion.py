"""LUCK in the panel MotionPlanning: document LUCK's launch file, and what its person does (L6)."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.browser.motion.motion_panel import MotionPanel
from tests.patience import stretched

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_READY = [0.0, 0.5, -0.6, 0.0, 0.4, 0.0]
_HOME = [0.0] * 6
# Where the tip's own y axis points to then.
_TIP_Y = [0.328, 0.738, -0.590]
_AROUND = [1.6, *_READY[1:]]
_STARTING_S = 180.0
# What a machine needs that has other things to do; nothing here is measured in wall time.
_PATIENCE_S = 180.0
_LOOK = "gazelle.look({kind: 'Orbit', focal: [0, 0, 0.3], distance: 1.6, yaw: -0.9, pitch: 0.4})"
_MAX_POINTS = 40


class Arm:
    """The launched arm and the page that its launch opens.

    Attributes:
        ui: the panel and the view.
    """

    def __init__(self, launched: Any, look: Any) -> None:
        self._launched = launched
        launched.wait_for_line("You can start planning now!", _STARTING_S)
        line = launched.wait_for_line(r"gazebo: http://127\.0\.0\.1:\d+/\?token=\w+$", _STARTING_S)
        seen = look(line.split("gazebo: ")[1].strip(), size=(1440, 900))
        seen.page.set_default_timeout(stretched(_PATIENCE_S) * 1000)
        self.ui = MotionPanel(seen, self)
        self.ui.well()

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return self._launched.eventually(condition, _PATIENCE_S)

    def positions(self) -> list[float]:
        """Where the joints are in the simulation."""
        message = self._launched.messages({"/joint_states": 2}, _PATIENCE_S)["/joint_states"][-1]
        return self.row(message.name, message.position)

    def row(self, names: Any, values: Any) -> list[float]:
        """Values of the arm's joints."""
        by_name = dict(zip(names, map(float, values), strict=True))
        return [by_name[name] for name in _JOINTS]

    def listen(self, topic: str, kind: str) -> list[Any]:
        """Return a list that a topic's messages are added to."""
        from gazelle.interfaces import message_type

        got: list[Any] = []
        self._launched.node.create_subscription(topic, message_type(kind), got.append)
        return got

    def tip(self, positions: list[float]) -> list[float]:
        """Where the tip is then, in the planning frame."""
        answer = self._launched.call(
            "/compute_fk",
            "moveit_msgs/srv/GetPositionFK",
            fk_link_names=["link_6"],
            robot_state=_state(positions),
        )
        place = answer.pose_stamped[0].pose.position
        return [float(place.x), float(place.y), float(place.z)]

    def collides(self, positions: list[float]) -> bool:
        """Whether move_group says so."""
        kind = "moveit_msgs/srv/GetStateValidity"
        words = {"group_name": "test_group", "robot_state": _state(positions)}
        return not self._launched.call("/check_state_validity", kind, **words).valid


def _state(positions: list[float]) -> dict[str, Any]:
    return {"joint_state": {"name": _JOINTS, "position": positions}, "is_diff": True}


@pytest.fixture
def arm(gazelle: Any, workspaces_dir: Path, tmp_path: Path, look: Any) -> Iterator[Arm]:
    """``ros2 launch luck_gazebo gazebo_moveit.launch.py``, exactly as it is printed."""
    own = {"GAZELLE_STUDIO": "1", "XDG_CONFIG_HOME": str(tmp_path / "config")}
    words = ("ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py")
    yield Arm(gazelle(*words, cwd=workspaces_dir / "ros2_ws", **own), look)


def test_person_drags_plans_watches_and_executes(arm: Arm) -> None:
    _drag_the_goal(arm)
    _plan_and_execute(arm)
    _past_an_obstacle(arm)
    _impossible_goals(arm)
    _stop_on_the_way(arm)


def _drag_the_goal(arm: Arm) -> None:
    """The arrows at the tip move the goal, and the arm's own joints follow."""
    ui = arm.ui
    ui.page.evaluate(_LOOK)
    ui.choose("Goal state", "ready")
    ui.tab("Joints")
    before = ui.place_of(_JOINTS)
    assert before == pytest.approx(_READY, abs=1e-4)
    tip = arm.tip(before)
    ui.drag("y", 0.5)
    ui.eventually(lambda: math.dist(arm.tip(ui.place_of(_JOINTS)), tip) > 0.03)
    # An arrow moves the tip along itself alone.
    shift = [one - other for one, other in zip(arm.tip(ui.place_of(_JOINTS)), tip, strict=True)]
    along = [part / math.hypot(*shift) for part in shift]
    assert along == pytest.approx(_TIP_Y, abs=0.05)
    ui.rviz.seen.shot("dragged")
    ui.tab("Planning")


def _plan_and_execute(arm: Arm) -> None:
    ui = arm.ui
    # moveit.rviz says so: the path again and again, each state for 0.05 s.
    assert ui.panel.get_by_label("State Display Time").input_value() == "0.05 s"
    assert ui.panel.get_by_label("Loop").is_checked()
    ui.choose("Goal state", "ready")
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    ui.eventually(lambda: ui.counts()["path"] > 0)
    place = ui.panel.get_by_label("Place in the planned path")
    texts = {place.get_attribute("aria-valuetext")}
    ui.eventually(lambda: texts.add(place.get_attribute("aria-valuetext")) or len(texts) > 2)
    place.focus()
    ui.page.keyboard.press("End")
    first, last = place.get_attribute("aria-valuetext").removesuffix(" s").split(" / ")
    assert first == last and float(last) > 0
    ui.rviz.seen.shot("planned")
    assert arm.positions() == pytest.approx(_HOME, abs=0.01), "planning moves nothing"
    ui.press("Execute")
    ui.says("Executed: SUCCESS (1)")
    assert arm.positions() == pytest.approx(_READY, abs=0.01)


def _past_an_obstacle(arm: Arm) -> None:
    """A box where the straight way leads through."""
    ui = arm.ui
    between = [0.8, *_READY[1:]]
    x, y, z = arm.tip(between)
    ui.tab("Scene Objects")
    ui.add_solid("Box", x=0.1, y=0.1, z=0.1)
    ui.place_object(x=round(x, 3), y=round(y, 3), z=round(z, 3))
    ui.eventually(lambda: arm.collides(between))
    assert not arm.collides(_READY) and not arm.collides(_AROUND)
    ui.tab("Joints")
    ui.type("joint_1 position", str(_AROUND[0]))
    ui.tab("Planning")
    ui.type("Velocity scaling", "1")
    ui.type("Acceleration scaling", "1")
    paths = arm.listen("/display_planned_path", "moveit_msgs/msg/DisplayTrajectory")
    before = len(paths)
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    joints = ui.eventually(lambda: paths[before:])[-1].trajectory[0].joint_trajectory
    planned = [arm.row(joints.joint_names, point.positions) for point in joints.points]
    assert planned[-1] == pytest.approx(_AROUND, abs=1e-3)
    assert not any(map(arm.collides, _thinned(planned)))
    ui.rviz.seen.shot("around")
    states = arm.listen("/joint_states", "sensor_msgs/msg/JointState")
    ui.press("Execute")
    ui.says("Executed: SUCCESS (1)")
    assert arm.positions() == pytest.approx(_AROUND, abs=0.01)
    driven = [arm.row(one.name, one.position) for one in states]
    assert not any(map(arm.collides, _thinned(driven)))


def _thinned(rows: list[list[float]]) -> list[list[float]]:
    return rows[:: math.ceil(len(rows) / _MAX_POINTS)]


def _impossible_goals(arm: Arm) -> None:
    """MoveIt's code, and the pair that collides or why no pose is found."""
    ui = arm.ui
    ui.tab("Scene Objects")
    ui.panel.locator("[data-object=Box]").click()
    x, y, z = arm.tip(_HOME)
    ui.place_object(x=round(x, 3), y=round(y, 3), z=round(z, 3))
    ui.eventually(lambda: arm.collides(_HOME))
    ui.tab("Planning")
    ui.choose("Goal state", "home")
    assert "collides with Box" in ui.says("Goal: link_", "Collisions")
    ui.eventually(lambda: ui.counts()["red"] > 0)
    ui.rviz.seen.shot("in the way")
    ui.press("Plan")
    words = ui.says("GOAL_IN_COLLISION (-12)")
    assert "'Box'" in words and "link 'link_" in words
    ui.tab("Scene Objects")
    ui.panel.locator("[data-object=Box]").click()
    ui.press("Remove")
    ui.shows(objects=0)
    ui.tab("Planning")
    ui.choose("Goal state", "ready")
    ui.page.evaluate("gazelle.look({distance: 6})")
    ui.drag("y", -8)
    words = ui.says("NO_IK_SOLUTION (-31)", "Inverse kinematics")
    assert "'link_6'" in words and "out of reach" in words
    ui.rviz.seen.shot("out of reach")


def _stop_on_the_way(arm: Arm) -> None:
    ui = arm.ui
    ui.choose("Goal state", "ready")
    ui.type("Velocity scaling", "0.1")
    ui.press("Plan & Execute")
    ui.eventually(lambda: arm.positions()[0] < _AROUND[0] - 0.05)
    ui.press("Stop")
    ui.says("Stopped.")
    ui.eventually(lambda: _stands(arm))
    stopped = arm.positions()
    assert 0.1 < stopped[0] < _AROUND[0] - 0.05
    # The rest of the way in one go.
    ui.type("Velocity scaling", "1")
    ui.press("Plan & Execute")
    ui.says("Executed: SUCCESS (1)")
    assert arm.positions() == pytest.approx(_READY, abs=0.01)
    ui.rviz.seen.shot("there")


def _stands(arm: Arm) -> bool:
    before = arm.positions()
    time.sleep(0.2)
    return arm.positions() == pytest.approx(before, abs=1e-3)
