"""MIRA in the page, as its document has it: looked at, played, commanded, tuned, filmed."""

from __future__ import annotations

import base64
import io
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.browser.scene.gazebo_page import GazeboPage
from tests.browser.tutorial.robot import Robot, choose_panel
from tests.shared_files import needs_shared

from gazelle.geometry import load_mesh

pytestmark = [pytest.mark.slow, pytest.mark.tutorial]

_PITCH_LIMIT_RAD, _ROLL_LIMIT_RAD = 0.44, -0.2
_ROLL, _PITCH = "/mira/roll_joint_position_controller", "/mira/pitch_joint_position_controller"


@pytest.fixture(scope="module")
def paused_mira(launch: Callable[..., Robot]) -> Robot:
    """``roslaunch urdf_exam mira_spawn.launch``: in the air, time stands still, no actuators."""
    return launch("urdf_exam", "mira_spawn.launch")


@pytest.fixture(scope="module")
def controlled_mira(launch: Callable[..., Robot]) -> Robot:
    """``roslaunch urdf_exam mira_spawn_controller.launch``."""
    return launch("urdf_exam", "mira_spawn_controller.launch")


def _gazebo(robot: Robot, window: Callable[..., Any], *panels: str) -> GazeboPage:
    """Gazebo's window, close to MIRA's face."""
    page = GazeboPage(window(robot.url, *panels), None, robot.eventually)
    page.eventually(lambda: "mira" in page.report()["models"])
    height_m = robot.model_pose("mira").position.z
    at = f"{{focal: [0, 0, {height_m + 0.03}], distance: 0.6, yaw: 1.1, pitch: 0.25}}"
    # The page looks at what is spawned by itself, once.
    page.seen.page.wait_for_timeout(500)
    page.seen.page.evaluate(f"gazelle.look({at}, 'gazebo')")
    return page


def _play(page: GazeboPage) -> None:
    page.seen.page.get_by_role("button", name="Play (Space)").click()


def _orange(page: GazeboPage) -> int:
    """How many pixels of the view have the colour in which Gazebo draws collisions."""
    red, green, blue = np.moveaxis(_view(page).astype(int), 2, 0)
    return int(((red > green + 40) & (green > blue + 25)).sum())


def _view(page: GazeboPage) -> Any:
    canvas = page.panel("gazebo").locator("canvas").first
    return _pixels(canvas.screenshot())


def _pixels(png: bytes) -> Any:
    image = pytest.importorskip("PIL.Image")
    with image.open(io.BytesIO(png)) as opened:
        return np.asarray(opened.convert("RGB"))


@needs_shared
def test_visuals_and_collisions_are_seen_apart(paused_mira: Robot, window: Any) -> None:
    """M2: the cylinder and the sphere of the URDF, over the meshes and without them."""
    page = _gazebo(paused_mira, window)
    assert page.overlays("collisions") == 0
    meshes_only = _orange(page)
    page.view("Collisions")
    page.view("Transparent")
    assert page.overlays("collisions") == 2
    page.eventually(lambda: _orange(page) > meshes_only + 5000)
    page.seen.shot("collisions")
    page.view("Collisions")
    page.view("Transparent")
    page.eventually(lambda: _orange(page) < meshes_only + 500)
    page.seen.shot("visuals")


@needs_shared
def test_play_lets_mira_fall_and_its_head_droop(paused_mira: Robot, window: Any) -> None:
    """M5: without actuators."""
    page = _gazebo(paused_mira, window, "gzclient")
    assert paused_mira.sim_time_s() == 0.0
    assert page.pose("mira::base_link")[2] == pytest.approx(0.2, abs=1e-3)
    _play(page)
    page.eventually(lambda: paused_mira.sim_time_s() > 2.5)
    page.seen.page.get_by_role("button", name="Pause (Space)").click()
    assert paused_mira.joint("pitch_joint") == pytest.approx(_PITCH_LIMIT_RAD, abs=0.01)
    assert paused_mira.joint("roll_joint") == pytest.approx(_ROLL_LIMIT_RAD, abs=0.01)
    for link in ("mira::base_link", "mira::yaw_M3_link"):
        _follows(page, paused_mira, link)
    assert page.pose("mira::base_link")[2] == pytest.approx(0.045, abs=2e-3)
    page.seen.page.evaluate("gazelle.look({focal: [0, 0, 0.08]}, 'gazebo')")
    page.seen.shot()


def _follows(page: GazeboPage, robot: Robot, link: str) -> None:
    """The page draws a link where the simulation has it, as soon as it has been told."""

    def is_there() -> bool:
        there = robot.link_pose(link).position
        return bool(np.allclose(page.pose(link)[:3], [there.x, there.y, there.z], atol=1e-3))

    page.eventually(is_there)


@needs_shared
def test_another_head_is_seen(
    launch: Callable[..., Robot], window: Any, workspaces_dir: Path, tmp_path: Path
) -> None:
    """M7: the document's next line in the URDF names ``cromulon.dae``."""
    package = tmp_path / "src" / "urdf_exam"
    shutil.copytree(workspaces_dir / "catkin_ws/src/urdf_exam", package)
    urdf = package / "urdf" / "mira_gazebo.urdf"
    for path in (urdf, urdf.parent):
        path.chmod(0o755)
    text = urdf.read_text(encoding="utf-8")
    urdf.write_text(text.replace("mira_head_v5.dae", "cromulon.dae"), encoding="utf-8")
    robot = launch("urdf_exam", "mira_spawn.launch", tmp_path)
    page = _gazebo(robot, window)
    cromulon = np.ptp(load_mesh(package / "meshes" / "cromulon.dae").vertices_m, axis=0)
    old = np.ptp(load_mesh(package / "meshes" / "mira_head_v5.dae").vertices_m, axis=0)
    page.eventually(lambda: _is_among(cromulon, _sizes_of_meshes(page)))
    assert not _is_among(old, _sizes_of_meshes(page))
    page.seen.shot()


def _is_among(size_m: Any, sizes_m: list[list[float]]) -> bool:
    return any(np.allclose(size_m, each, atol=1e-4) for each in sizes_m)


def _sizes_of_meshes(page: GazeboPage) -> list[list[float]]:
    """The boxes of what the page fetched to draw, read as the protocol has it."""
    script = """async () => {
      const names = performance.getEntriesByType('resource').map((each) => each.name);
      const meshes = [...new Set(names.filter((name) => name.includes('/mesh/')))];
      return Promise.all(meshes.map(async (name) => {
        const data = await (await fetch(name)).arrayBuffer();
        const places = new Float32Array(data, 16, 3 * new Uint32Array(data, 0, 1)[0]);
        return [0, 1, 2].map((axis) => {
          const along = places.filter((_, index) => index % 3 === axis);
          return Math.max(...along) - Math.min(...along);
        });
      }));
    }"""
    return list(page.seen.page.evaluate(script))


@needs_shared
def test_a_published_command_moves_the_joint_and_is_plotted(
    controlled_mira: Robot, window: Any
) -> None:
    """M10: ``rosrun rqt_gui rqt_gui`` beside Gazebo's window."""
    page = _gazebo(controlled_mira, window)
    seen = page.seen
    _play(page)
    assert controlled_mira.type("rosrun", "rqt_gui", "rqt_gui") == controlled_mira.url
    choose_panel(seen, "Message Publisher")
    panel = seen.panel("rqt_publisher")
    panel.get_by_label("Topic", exact=True).fill(f"{_ROLL}/command")
    seen.page.keyboard.press("Tab")
    panel.get_by_label("Rate in Hz", exact=True).fill("10")
    assert panel.get_by_label("Type", exact=True).input_value() == "std_msgs/msg/Float64"
    panel.get_by_role("button", name="Add").click()
    panel.get_by_label("data", exact=True).fill("0.1")
    panel.get_by_label(f"Publish {_ROLL}/command repeatedly").check()
    choose_panel(seen, "Plot")
    plot = seen.panel("rqt_plot")
    curves = (f"{_ROLL}/command/data", "/mira/joint_states/position[0]")
    for curve in curves:
        plot.get_by_label("Topic field").fill(curve)
        seen.page.keyboard.press("Enter")
    page.eventually(lambda: abs(controlled_mira.joint("roll_joint") - 0.1) < 2e-3)
    page.eventually(
        lambda: [abs(_value(plot, curve) - 0.1) < 3e-3 for curve in curves] == [True, True]
    )
    seen.shot()
    assert seen.page.locator(".toast").count() == 0


def _value(plot: Any, curve: str) -> float:
    text = plot.get_by_role("listitem").filter(has_text=curve).locator("output").inner_text()
    return float(text) if text not in ("", "–") else float("nan")


@needs_shared
def test_gains_are_changed_while_mira_runs(controlled_mira: Robot, window: Any) -> None:
    """M11: without its gain the controller lets the head fall, with it the head comes up."""
    url = controlled_mira.type("rosrun", "rqt_reconfigure", "rqt_reconfigure")
    page = _gazebo(controlled_mira, window, "gzclient", "rqt_reconfigure")
    assert url == controlled_mira.url
    if page.seen.page.get_by_role("button", name="Play (Space)").is_visible():
        _play(page)
    panel = page.seen.panel("rqt_reconfigure")
    panel.get_by_role("option", name=f"{_PITCH}/pid").click()
    gain = panel.get_by_label("p", exact=True)
    assert float(gain.input_value()) == 1.0
    assert abs(controlled_mira.joint("pitch_joint")) < 0.02
    gain.fill("0")
    gain.press("Enter")
    page.eventually(lambda: controlled_mira.joint("pitch_joint") > _PITCH_LIMIT_RAD - 0.02)
    _follows(page, controlled_mira, "mira::yaw_M3_link")
    page.seen.shot("slack")
    gain.fill("1")
    gain.press("Enter")
    page.eventually(lambda: abs(controlled_mira.joint("pitch_joint")) < 0.02)


@needs_shared
def test_the_camera_s_picture_is_shown(launch: Callable[..., Robot], window: Any) -> None:
    """M12: ``rosrun rqt_image_view rqt_image_view`` beside Gazebo's window."""
    robot = launch("urdf_exam", "mira_spawn_camera.launch")
    page = _gazebo(robot, window)
    _play(page)
    robot.type("rosrun", "rqt_image_view", "rqt_image_view")
    panel = page.seen.panel("rqt_image_view")
    panel.get_by_text("400 × 400").wait_for()
    assert panel.get_by_label("Image topic").input_value() == "/mira/camera1/image_raw"
    sent = robot.message("/mira/camera1/image_raw")
    rows = np.asarray(sent.data, np.uint8).reshape(sent.height, sent.width, 3)
    drawn = _shown_picture(panel)
    assert drawn.shape == rows.shape
    # Row by row: noise and JPEG even out, sky and ground do not.
    assert np.abs(drawn.mean(axis=(1, 2)) - rows.mean(axis=(1, 2))).max() < 4.0
    assert np.ptp(rows.mean(axis=(1, 2))) > 10
    page.seen.shot()


def _shown_picture(panel: Any) -> Any:
    script = "canvas => canvas.toDataURL('image/png').split(',')[1]"
    return _pixels(base64.b64decode(panel.locator("canvas").evaluate(script)))
