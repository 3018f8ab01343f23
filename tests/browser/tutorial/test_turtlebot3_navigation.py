"""T8, T9 and T10 as a person does them in the page: drive, see the map grow, save it, navigate."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from PIL import Image
from tests.browser.scene.rviz_page import RvizPage
from tests.browser.tutorial.terminal import Session

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

# The page draws in software beside a simulation in real time: on a busy machine all of it is slow.
_PATIENCE_S = 240.0
# Where turtlebot3_world.launch puts the robot; its odometry counts from the world's origin, and so
# gmapping's map does.
_START = np.array([-2.0, -0.5])
_GOAL = _START + np.array([0.0, 1.0])


@pytest.fixture
def world(session: Callable[..., Session], workspaces_dir: Path) -> Session:
    """``roslaunch turtlebot3_gazebo turtlebot3_world.launch`` with a burger."""
    begun = session(
        "roslaunch turtlebot3_gazebo turtlebot3_world.launch",
        cwd=workspaces_dir / "turtlebot3_ws",
        TURTLEBOT3_MODEL="burger",
    )
    begun.shows(begun.first, "gazebo")
    return begun


class _Burger:
    """The robot as the simulation knows it, in the world's frame, which is the map's."""

    def __init__(self, session: Session) -> None:
        self._first = session.first

    def pose(self) -> tuple[float, float, float]:
        """x, y and yaw."""
        kind = "gazebo_msgs/srv/GetModelState"
        found = self._first.call(
            "/gazebo/get_model_state", kind, model_name="turtlebot3_burger"
        ).pose
        x, y = found.position.x, found.position.y
        return x, y, 2 * math.atan2(found.orientation.z, found.orientation.w)

    def is_at(self, place: Any, within_m: float) -> bool:
        """Is it near a place of the map?"""
        return bool(np.hypot(*(np.array(self.pose()[:2]) - place)) < within_m)


def _patiently(rviz: RvizPage, session: Session, condition: Callable[[], Any]) -> Any:
    def patient() -> Any:
        rviz.seen.page.wait_for_timeout(100)
        return condition()

    return session.first.eventually(patient, _PATIENCE_S)


def _hold(rviz: RvizPage, session: Session, key: str, until: Callable[[], bool]) -> None:
    """Hold a key of Robot Steering."""
    rviz.seen.panel("rqt_robot_steering").locator("[data-keys=drive]").focus()
    rviz.seen.page.keyboard.down(key)
    _patiently(rviz, session, until)
    rviz.seen.page.keyboard.up(key)


def test_map_grows_is_saved_and_the_robot_drives_to_a_goal_in_it(
    world: Session, look: Any, tmp_path: Path
) -> None:
    slam = world.type("roslaunch turtlebot3_slam turtlebot3_slam.launch")
    world.shows(slam, "rviz")
    burger = _Burger(world)
    saved = _maps(world, burger, look, tmp_path)
    slam.stop()
    line = f"roslaunch turtlebot3_navigation turtlebot3_navigation.launch map_file:={saved}"
    world.shows(world.type(line), "rviz")
    _navigates(world, burger, look)


def _drawn(seen: Any) -> Any:
    return np.array(seen.page.evaluate("gazelle.frame('base_footprint', 'rviz')")[:2])


def _maps(world: Session, burger: _Burger, look: Any, folder: Path) -> Path:
    """T8 and T9."""
    seen = look(world.url, "rviz", "rqt_robot_steering", size=(1440, 900))
    rviz = RvizPage(seen, world)

    def known() -> int:
        return rviz.counts("Map").get("known", 0)

    _patiently(rviz, world, lambda: known() > 1000)
    first = known()
    seen.shot("first")
    # So slow that it does not matter when a busy machine lets the key go late.
    steering = seen.panel("rqt_robot_steering")
    for label, most in (("linear velocity in m/s", "0.1"), ("angular velocity in rad/s", "0.4")):
        field = steering.get_by_label(f"Largest {label}")
        field.fill(most)
        field.press("Enter")
    _hold(rviz, world, "w", lambda: burger.pose()[0] > _START[0] + 0.3)
    _hold(rviz, world, "a", lambda: burger.pose()[2] > 1.0)
    _patiently(rviz, world, lambda: known() > first + 100)
    seen.shot("grown")
    levels = {name: rviz.display(name)["level"] for name in ("Map", "LaserScan", "RobotModel")}
    assert set(levels.values()) == {"ok"}, levels
    # The robot is drawn where it truly is: the way from the map to it is right.
    _patiently(rviz, world, lambda: burger.is_at(_drawn(seen), 0.1))
    saver = world.type(f"rosrun map_server map_saver -f {folder / 'map'}")
    assert saver.wait() == 0
    said = re.search(r"Received a (\d+) X (\d+) map @ 0\.050", saver.text)
    assert said is not None, saver.text
    with Image.open(folder / "map.pgm") as picture:
        assert picture.size == (int(said[1]), int(said[2]))
        cells = np.asarray(picture)
    assert int((cells != 205).sum()) == pytest.approx(known(), rel=0.1)
    described = yaml.safe_load((folder / "map.yaml").read_text(encoding="utf-8"))
    assert described["resolution"] == 0.05
    seen.page.context.close()
    return folder / "map.yaml"


def _navigates(world: Session, burger: _Burger, look: Any) -> None:
    """T10."""
    seen = look(world.url, "rviz", size=(1440, 900))
    rviz = RvizPage(seen, world)
    _patiently(rviz, world, lambda: rviz.counts("Global Map/Costmap").get("width", 0) > 50)
    assert rviz.report()["camera"]["kind"] == "TopDownOrtho"
    x, y, yaw = burger.pose()
    # Ten centimetres off, as a hand is.
    begin = rviz.project(x - 0.1, y)
    seen.panel("rviz").get_by_role("button", name="2D Pose Estimate").click()
    rviz.drag(begin, rviz.project(x - 0.1 + math.cos(yaw), y + math.sin(yaw)))
    _patiently(rviz, world, lambda: rviz.counts("Amcl Particles").get("poses", 0) >= 500)
    seen.shot("estimate")
    seen.panel("rviz").get_by_role("button", name="2D Nav Goal").click()
    rviz.drag(rviz.project(*_GOAL), rviz.project(_GOAL[0], _GOAL[1] + 1))
    _patiently(rviz, world, lambda: rviz.counts("Planner Plan").get("poses", 0) > 5)
    _patiently(rviz, world, lambda: rviz.counts("Local Map/Planner").get("messages", 0) > 1)
    seen.shot("driving")
    # The tolerance of the package's parameters is 0.05 m; the map is as true as its SLAM.
    _patiently(rviz, world, lambda: burger.is_at(_GOAL, 0.15))
    rviz.shows("Goal", poses=1)
    rviz.shows("Local Map/Polygon", corners=4)
    for name, display in rviz.report()["displays"].items():
        assert display["level"] == "ok" or not display["enabled"], (name, display["status"])
    seen.shot("arrived")
