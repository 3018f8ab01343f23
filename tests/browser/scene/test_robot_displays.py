"""RobotModel, Effort, Camera and DepthCloud: displays that need more than their topic."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.browser.scene.rviz_page import RvizPage, stamped
from tests.installed_packages import code_of_page, installed

pytestmark = pytest.mark.slow

_ARM = """<robot name="arm">
  <material name="orange"><color rgba="1 0.5 0.1 1"/></material>
  <link name="base_link"><visual><geometry><box size="0.4 0.4 0.2"/></geometry>
    <material name="orange"/></visual>
    <collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision></link>
  <link name="odom_arm"><visual><origin xyz="0 0 0.3"/><geometry>
    <cylinder radius="0.05" length="0.6"/></geometry></visual></link>
  <link name="hand"><visual><geometry><mesh filename="package://nowhere/hand.stl"/></geometry>
    </visual></link>
  <joint name="shoulder" type="revolute"><parent link="base_link"/><child link="odom_arm"/>
    <origin xyz="0 0 0.1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  <joint name="wrist" type="fixed"><parent link="odom_arm"/><child link="hand"/>
    <origin xyz="0 0 0.6"/></joint>
</robot>"""

_INFO = {
    "width": 64,
    "height": 48,
    "k": [50.0, 0, 32, 0, 50, 24, 0, 0, 1],
    "p": [50.0, 0, 32, 0, 0, 50, 24, 0, 0, 0, 1, 0],
}


def test_robot_is_drawn_at_its_frames_and_tells_of_lost_links(rviz: RvizPage, bench: Any) -> None:
    bench.graph.parameters.set("/robot_description", _ARM)
    rviz.shows("RobotModel", links=3, placed=1, shapes=3)
    status = rviz.display("RobotModel")["status"]
    assert status["URDF"] == "URDF parsed OK"
    assert "No transform from [odom_arm, hand]" in status["Transform"]
    assert "package://nowhere/hand.stl" in status["Meshes"]
    rviz.set("RobotModel", "Collision Enabled", True)
    rviz.shows("RobotModel", collisions=1)
    rviz.seen.shot()


def test_the_first_look_is_at_the_robot(rviz: RvizPage, bench: Any) -> None:
    link = (
        "<link name='base_link'><visual><geometry><box size='.4 .4 .2'/></geometry></visual></link>"
    )
    bench.graph.parameters.set("/robot_description", f"<robot name='bot'>{link}</robot>")
    rviz.shows("RobotModel", links=1, placed=1)

    def camera() -> Any:
        return rviz.seen.page.evaluate("gazelle.scene('rviz').camera")

    # base_link is at x = 1.5 m of map, and half a metre wide.
    rviz.eventually(lambda: camera()["focal"] == pytest.approx([1.5, 0.0, 0.0], abs=0.05))
    assert 0.4 < camera()["distance"] < 1.2


def test_robot_without_a_description_is_told(rviz: RvizPage) -> None:
    # Who describes it may be started later.
    rviz.eventually(lambda: rviz.display("RobotModel")["level"] == "warn")
    assert "robot_description" in rviz.display("RobotModel")["status"]["URDF"]


def test_efforts_are_arrows_at_the_joints(rviz: RvizPage, bench: Any) -> None:
    bench.graph.parameters.set("/robot_description", _ARM)
    moved = {
        "header": stamped("base_link"),
        "child_frame_id": "odom_arm",
        "transform": {"rotation": {"w": 1.0}},
    }
    bench.keep_publishing("/tf", "tf2_msgs/msg/TFMessage", lambda _: {"transforms": [moved]}, hz=9)
    state = {"name": ["shoulder"], "position": [0.0], "velocity": [0.0], "effort": [6.0]}
    bench.keep_publishing("/joint_states", "sensor_msgs/msg/JointState", lambda _: state, hz=5)
    rviz.add("/joint_states", "Effort")
    rviz.shows("Effort", joints=1, arrows=1)


def test_camera_lays_the_scene_over_its_picture(rviz: RvizPage, bench: Any) -> None:
    header = stamped("base_link")
    rgb = np.full((48, 64, 3), 120, np.uint8)
    image = {
        "header": header, "width": 64, "height": 48, "encoding": "rgb8", "step": 192,
        "data": rgb.tobytes(),
    }  # fmt: skip
    bench.keep_publishing("/camera/image", "sensor_msgs/msg/Image", lambda _: image, hz=6)
    bench.keep_publishing(
        "/camera/camera_info",
        "sensor_msgs/msg/CameraInfo",
        lambda _: _INFO | {"header": header},
        hz=6,
    )
    rviz.add("/camera/image", "Camera")
    rviz.eventually(lambda: rviz.counts("Camera").get("pictures", 0) > 2)
    rviz.shows("Camera", overlaid=1)
    assert rviz.display("Camera")["level"] == "ok"
    rviz.seen.shot()


def test_depth_image_becomes_points(rviz: RvizPage, bench: Any) -> None:
    header = stamped("base_link")
    depth = np.full((48, 64), 2.0, np.float32)
    depth[:, :10] = np.nan
    image = {
        "header": header, "width": 64, "height": 48, "encoding": "32FC1", "step": 256,
        "data": depth.tobytes(),
    }  # fmt: skip
    bench.keep_publishing("/depth/image", "sensor_msgs/msg/Image", lambda _: image, hz=6)
    bench.keep_publishing(
        "/depth/camera_info",
        "sensor_msgs/msg/CameraInfo",
        lambda _: _INFO | {"header": header},
        hz=6,
    )
    rviz.add("/depth/image", "DepthCloud")
    rviz.shows("DepthCloud", points=48 * 54)


def test_file_of_rviz_opens_with_its_view(rviz: RvizPage, bench: Any, tmp_path: Any) -> None:
    text = """Visualization Manager:
  Global Options: {Fixed Frame: odom, Background Color: 10; 20; 30}
  Displays:
    - {Class: rviz/Grid, Name: Ground, Enabled: true, Cell Size: 2, Value: true}
    - {Class: rviz/LaserScan, Name: Front, Enabled: true, Topic: /front, Size (m): 0.1, Value: true}
    - {Class: rviz/Nonsense, Name: Odd, Enabled: true, Value: true}
  Views:
    Current: {Class: rviz/TopDownOrtho, Scale: 80, Angle: 0, X: 1, Y: 2}
"""
    _open_file(rviz, text)
    rviz.eventually(lambda: list(rviz.report()["displays"]) == ["Ground", "Front"])
    report = rviz.report()
    assert report["fixedFrame"] == "odom"
    assert report["displays"]["Front"]["topic"] == "/front"
    assert (report["camera"]["kind"], report["camera"]["scale"]) == ("TopDownOrtho", 80)


def test_file_of_rviz_may_name_a_display_of_a_pip_package(
    rviz: RvizPage, bench: Any, tmp_path: Any
) -> None:
    text = """Visualization Manager:
  Global Options: {Fixed Frame: odom}
  Displays:
    - {Class: far_displays/Speed, Name: Fast, Enabled: true, Topic: /speed, Value: true}
    - {Class: far_displays/Nonsense, Name: Odd, Enabled: true, Value: true}
"""
    twist = {"header": stamped("base_link"), "twist": {"linear": {"x": 1.5}}}
    bench.keep_publishing("/speed", "geometry_msgs/msg/TwistStamped", lambda _: twist, hz=6)
    source = code_of_page("A display of RViz")
    points = {
        "gazelle.displays": {"speed": "far_displays:SPEED", "gone": "far_displays:MISSING"},
    }
    with installed(tmp_path / "site", "far_displays", source, points):
        _open_file(rviz, text)
        rviz.shows("Fast", markers=1)
        toast = rviz.seen.toast()
    assert "These display classes are not known and were left out: Nonsense" in toast
    assert "module 'far_displays' has no attribute 'MISSING'" in toast
    rviz.seen.shot()


def _open_file(rviz: RvizPage, text: str) -> None:
    rviz.seen.panel("displays").get_by_role("button", name="More").click()
    with rviz.seen.page.expect_file_chooser() as waiting:
        rviz.seen.page.get_by_role("menuitem", name="Open a .rviz file…").click()
    waiting.value.set_files(
        files=[{"name": "robot.rviz", "mimeType": "text/plain", "buffer": text.encode()}]
    )
