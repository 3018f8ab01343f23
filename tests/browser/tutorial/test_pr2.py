"""The robot of PR2CTL in Gazebo's window: View, then Show Physics, Bounding Boxes, Joints."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.browser.scene.gazebo_page import GazeboPage
from tests.browser.tutorial.robot import Robot

pytestmark = [pytest.mark.slow, pytest.mark.tutorial]


def test_view_shows_physics_boxes_and_joints(
    launch: Callable[..., Robot], window: Callable[..., Any]
) -> None:
    """P3, with ``roslaunch tutorial_controller robot.launch`` as it is."""
    robot = launch("tutorial_controller", "robot.launch")
    page = GazeboPage(window(robot.url), None, robot.eventually)
    page.eventually(lambda: "pr2" in page.report()["models"])
    # The page looks at the robot by itself; the office's walls are at most sides of it.
    page.eventually(lambda: page.report()["camera"]["distance"] < 4)
    page.click("pr2::base_link")
    page.eventually(lambda: page.report()["selected"] == {"model": "pr2"})
    for name, mode, least in (("Collisions", "collisions", 3), ("Bounding Boxes", "boxes", 3)):
        assert page.overlays(mode) == 0
        page.view(name)
        assert page.overlays(mode) >= least
        page.seen.page.wait_for_timeout(300)
        page.seen.shot(mode)
        page.view(name)
    assert page.overlays("joints") == 0
    page.view("Joints")
    page.view("Transparent")
    assert page.overlays("joints") == 2
    for link in ("base_link", "wheel1", "wheel2"):
        there = robot.link_pose(f"pr2::{link}").position
        assert page.pose(f"pr2::{link}")[:3] == pytest.approx([there.x, there.y, there.z], abs=0.01)
    page.seen.shot("joints")
