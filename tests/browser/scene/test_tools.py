"""Tools of the view, used with the mouse."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.browser.scene.rviz_page import RvizPage

pytestmark = pytest.mark.slow


@pytest.fixture
def above(rviz: RvizPage) -> RvizPage:
    """RViz looking straight down, so that pixels are places."""
    rviz.eventually(lambda: rviz.report()["fixedFrame"] == "map")
    rviz.seen.panel("rviz").get_by_label("View type").select_option("TopDownOrtho")
    rviz.eventually(lambda: rviz.report()["camera"]["kind"] == "TopDownOrtho")
    return rviz


def test_nav_goal_is_dragged_to_a_place_and_a_direction(above: RvizPage, bench: Any) -> None:
    old = bench.listen("/move_base_simple/goal", "geometry_msgs/msg/PoseStamped")
    new = bench.listen("/goal_pose", "geometry_msgs/msg/PoseStamped")
    above.seen.panel("rviz").get_by_role("button", name="2D Nav Goal").click()
    above.drag(above.project(1.0, 0.5), above.project(1.0, 2.0))
    bench.eventually(lambda: old and new)
    goal = old[0]
    assert goal.header.frame_id == "map"
    assert goal.pose.position.x == pytest.approx(1.0, abs=0.05)
    assert goal.pose.position.y == pytest.approx(0.5, abs=0.05)
    yaw = 2 * math.atan2(goal.pose.orientation.z, goal.pose.orientation.w)
    assert yaw == pytest.approx(math.pi / 2, abs=0.05)
    assert above.report()["tool"] == "Move Camera"


def test_pose_estimate_carries_rviz_s_covariance(above: RvizPage, bench: Any) -> None:
    got = bench.listen("/initialpose", "geometry_msgs/msg/PoseWithCovarianceStamped")
    above.seen.panel("rviz").get_by_role("button", name="2D Pose Estimate").click()
    above.drag(above.project(-1.0, 0.0), above.project(-2.0, 0.0))
    bench.eventually(lambda: got)
    assert got[0].pose.covariance[0] == got[0].pose.covariance[7] == 0.25
    assert got[0].pose.covariance[35] == pytest.approx(0.0685, abs=1e-3)
    assert abs(got[0].pose.pose.orientation.z) == pytest.approx(1.0, abs=0.01)


def test_point_is_published_where_one_clicks(above: RvizPage, bench: Any) -> None:
    got = bench.listen("/clicked_point", "geometry_msgs/msg/PointStamped")
    above.seen.panel("rviz").get_by_role("button", name="Publish Point").click()
    above.seen.page.mouse.click(*above.project(0.5, -0.5))
    bench.eventually(lambda: got)
    assert (got[0].point.x, got[0].point.y) == (
        pytest.approx(0.5, abs=0.05),
        pytest.approx(-0.5, abs=0.05),
    )


def test_measure_tells_the_length_between_two_clicks(above: RvizPage) -> None:
    panel = above.seen.panel("rviz")
    panel.get_by_role("button", name="Measure").click()
    above.seen.page.mouse.click(*above.project(0.0, 0.0))
    above.seen.page.mouse.click(*above.project(1.0, 0.0))
    above.eventually(lambda: "Length: " in panel.get_by_role("status").inner_text())
    text = panel.get_by_role("status").inner_text()
    assert float(text.split("Length: ")[1].split()[0]) == pytest.approx(1.0, abs=0.03)


def test_mouse_and_keys_move_the_camera_as_in_rviz(rviz: RvizPage) -> None:
    canvas = rviz.seen.panel("rviz").locator("canvas").first
    box = canvas.bounding_box()
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    before = rviz.report()["camera"]
    rviz.drag(middle, (middle[0] + 80, middle[1] + 40))
    turned = rviz.report()["camera"]
    assert turned["yaw"] < before["yaw"] - 0.2
    assert turned["focal"] == before["focal"]
    rviz.seen.page.mouse.wheel(0, -300)
    rviz.eventually(lambda: rviz.report()["camera"]["distance"] < before["distance"] * 0.9)
    canvas.focus()
    rviz.seen.page.keyboard.press("Shift+ArrowLeft")
    assert rviz.report()["camera"]["focal"] != before["focal"]


def test_screenshot_is_a_png_of_the_view(rviz: RvizPage) -> None:
    with rviz.seen.page.expect_download() as waiting:
        rviz.seen.panel("rviz").get_by_role("button", name="Screenshot").click()
    data = waiting.value.path().read_bytes()
    assert data.startswith(b"\x89PNG")
    assert len(data) > 5000


def test_video_is_a_webm(rviz: RvizPage) -> None:
    button = rviz.seen.panel("rviz").get_by_role("button", name="Record a video")
    button.click()
    rviz.seen.page.wait_for_timeout(1500)
    with rviz.seen.page.expect_download() as waiting:
        button.click()
    assert waiting.value.path().read_bytes().startswith(b"\x1a\x45\xdf\xa3")
