"""SLAMBOT in RViz's panel: scan, cloud, picture, frames and model, where they truly are."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.browser.scene.rviz_page import RvizPage
from tests.browser.tutorial.robot import Robot

pytestmark = [pytest.mark.slow, pytest.mark.tutorial]

_FRAMES = 11
# Both stand on base_link, which is 0.025 m above base_footprint: slam_robot_gazebo.urdf.
_LASER_HEIGHT_M, _CAMERA_HEIGHT_M = 0.025 + 1.09, 0.025 + 1.15
_SCAN, _CLOUD = "/scan", "/depth_camera/depth/points"
_PICTURE = "/camera/rgb/image_raw"


@pytest.fixture(scope="module")
def slambot(launch: Callable[..., Robot]) -> Robot:
    """``roslaunch slam_robot slam_robot_gazebo.launch``: in the museum, time runs."""
    return launch("slam_robot", "slam_robot_gazebo.launch")


@pytest.fixture
def rviz(slambot: Robot, window: Callable[..., Any]) -> RvizPage:
    """``rosrun rviz rviz`` beside it."""
    url = slambot.type("rosrun", "rviz", "rviz")
    assert url == slambot.url
    page = RvizPage(window(url, "rviz"), slambot)
    page.eventually(lambda: page.report()["fixedFrame"] == "odom")
    return page


def _placed(robot: Robot, points_m: Any, height_m: float) -> Any:
    """Points of a sensor on the robot's axis, in the world."""
    pose = robot.model_pose("slam_robot")
    turn, at = pose.orientation, pose.position
    yaw = 2 * math.atan2(turn.z, turn.w)
    along = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    placed = np.array(points_m, float)
    placed[:, :2] = placed[:, :2] @ along.T + [at.x, at.y]
    placed[:, 2] += height_m + at.z
    return placed


def _farthest(shown_m: Any, truth_m: Any) -> float:
    """How far the worst of the shown points is from all true ones, metres."""
    worst = 0.0
    for each in np.asarray(shown_m, np.float32):
        away = truth_m.astype(np.float32) - each
        worst = max(worst, float(np.einsum("ij,ij->i", away, away).min()))
    return math.sqrt(worst)


def test_scan_cloud_picture_frames_and_model_are_shown(slambot: Robot, rviz: RvizPage) -> None:
    """S7 and T6: laser and depth data, each point where the simulation has it."""
    for topic, display in ((_SCAN, "LaserScan"), (_CLOUD, "PointCloud2"), (_PICTURE, "Image")):
        rviz.add(topic, display)
    rviz.row("TF").get_by_role("checkbox", name="Show TF").check()
    scan = slambot.message(_SCAN)
    ranges = np.asarray(scan.ranges)
    seen = np.isfinite(ranges)
    rviz.eventually(lambda: abs(rviz.counts("LaserScan").get("points", 0) - seen.sum()) <= 3)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    ranges, angles = ranges[seen], angles[seen]
    rays = np.stack([ranges * np.cos(angles), ranges * np.sin(angles), 0 * ranges], axis=1)
    truth = _placed(slambot, rays, _LASER_HEIGHT_M)
    # Sensor noise of 0.01 m is in both.
    assert _farthest(_points(rviz, "LaserScan", 1), truth) < 0.1

    rviz.eventually(lambda: rviz.counts("PointCloud2").get("points", 0) > 1000)
    cloud = slambot.message(_CLOUD)
    values = np.asarray(cloud.data, np.uint8).reshape(-1, cloud.point_step)[:, :12].copy()
    xyz = values.view("<f4").reshape(-1, 3)
    finite = xyz[np.isfinite(xyz).all(axis=1)]
    # The page's budget is 100,000 points: every fourth of 640 × 480.
    assert rviz.counts("PointCloud2")["points"] == pytest.approx(len(finite) / 4, rel=0.02)
    truth = _placed(slambot, finite, _CAMERA_HEIGHT_M)
    assert _farthest(_points(rviz, "PointCloud2", 500), truth) < 0.02

    rviz.eventually(lambda: rviz.counts("Image").get("pictures", 0) > 1)
    assert rviz.display("Image")["status"]["Image"] == "640 x 480"
    rviz.shows("TF", frames=_FRAMES, names=_FRAMES)
    _check_model(slambot, rviz)
    rviz.seen.page.evaluate("gazelle.look({focal: [0, 0, 0.7], distance: 7, yaw: 2.6}, 'rviz')")
    for name in ("LaserScan", "PointCloud2", "Image", "TF", "RobotModel"):
        assert rviz.display(name)["level"] == "ok", rviz.display(name)["status"]
    rviz.seen.page.wait_for_timeout(500)
    rviz.seen.shot()


def _check_model(slambot: Robot, rviz: RvizPage) -> None:
    rviz.shows("RobotModel", links=_FRAMES - 1, placed=_FRAMES - 1)
    there = slambot.model_pose("slam_robot").position
    for frame, height_m in (
        ("base_footprint", 0.0),
        ("laser_radar_link", _LASER_HEIGHT_M),
        ("depth_camera_link", _CAMERA_HEIGHT_M),
    ):
        shown = rviz.seen.page.evaluate(f"gazelle.frame('{frame}', 'rviz')")
        assert shown[:3] == pytest.approx([there.x, there.y, there.z + height_m], abs=0.01)


def _points(rviz: RvizPage, display: str, every: int) -> Any:
    found = rviz.seen.page.evaluate(f"gazelle.points('{display}', {every}, 'rviz')")
    return np.array(found).reshape(-1, 3)


def test_goal_and_pose_estimate_are_published(slambot: Robot, rviz: RvizPage) -> None:
    """Dragged from a place into a direction, as in RViz; the frame is the fixed one."""
    rviz.seen.panel("rviz").get_by_label("View type").select_option("TopDownOrtho")
    rviz.eventually(lambda: rviz.report()["camera"]["kind"] == "TopDownOrtho")
    goal = _drag(slambot, rviz, "2D Nav Goal", "/move_base_simple/goal", "PoseStamped")
    kind = "PoseWithCovarianceStamped"
    estimate = _drag(slambot, rviz, "2D Pose Estimate", "/initialpose", kind).pose
    for pose in (goal.pose, estimate.pose):
        assert (pose.position.x, pose.position.y) == pytest.approx((1.0, 0.5), abs=0.05)
        assert 2 * math.atan2(pose.orientation.z, pose.orientation.w) == pytest.approx(
            math.pi / 2, abs=0.05
        )
    assert goal.header.frame_id == "odom"
    assert estimate.covariance[0] == 0.25


def _drag(robot: Robot, rviz: RvizPage, tool: str, topic: str, kind: str) -> Any:
    """Drag a tool along +y, and return what it publishes."""
    heard: list[Any] = []
    robot.launched.node.create_subscription(topic, f"geometry_msgs/msg/{kind}", heard.append)
    rviz.seen.panel("rviz").get_by_role("button", name=tool).click()
    rviz.drag(rviz.project(1.0, 0.5), rviz.project(1.0, 2.0))
    rviz.eventually(lambda: heard)
    return heard[0]


def test_gazebo_s_window_shows_museum_and_robot_and_rviz_comes_beside(
    slambot: Robot, window: Callable[..., Any]
) -> None:
    """S1 and S5: what the launch file's own ``gui`` opens."""
    seen = window(slambot.url, "gzclient")
    slambot.eventually(lambda: _models(seen) >= {"ISCAS_Museum", "slam_robot"})
    shown = seen.page.evaluate("gazelle.pose('slam_robot::base_footprint', 'gazebo')")
    there = slambot.link_pose("slam_robot::base_footprint").position
    assert shown[:3] == pytest.approx([there.x, there.y, there.z], abs=0.005)
    seen.page.wait_for_timeout(1500)
    seen.shot()
    slambot.type("rosrun", "rviz", "rviz")
    seen.panel("displays").get_by_role("treeitem", name="RobotModel").wait_for()
    assert seen.panel("rviz").is_visible()
    assert seen.panel("gazebo").is_visible()
    width = seen.panel("rviz").bounding_box()["width"]
    assert width > 400, "the view has room beside Gazebo's window"
    seen.shot("with_rviz")


def _models(seen: Any) -> set[str]:
    seen.page.wait_for_timeout(50)
    return set(seen.page.evaluate("window.gazelle?.scene ? gazelle.scene('gazebo').models : []"))
