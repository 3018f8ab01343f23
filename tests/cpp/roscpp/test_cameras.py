"""Images and calibrations of cameras in C++ of ROS 1."""

from __future__ import annotations

from pathlib import Path

from tests.cpp.roscpp.conftest import Probe
from tests.patience import eventually

from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type


def test_images_are_heard_with_what_their_camera_is(
    graph: Graph, camera: Probe, tmp_path: Path
) -> None:
    running = camera("images", cwd=tmp_path)
    running.wait_for_line("ready")
    assert {
        "both 641 /camera/camera_info",
        "filter raw",
        "function 640",
        "method 640",
        "same image",
    } <= set(running.lines)
    image = message_type("sensor_msgs/msg/Image")
    publisher = graph.create_node("tester").create_publisher("/camera/image", image)
    eventually(lambda: publisher.matched)
    publisher.publish(image(width=320))
    running.wait_for_line("method 320")


def test_a_calibration_is_taken_kept_and_read_again(
    graph: Graph, camera: Probe, tmp_path: Path
) -> None:
    file = tmp_path / "calibrations" / "left.yaml"
    running = camera("calibration", str(file), cwd=tmp_path)
    running.wait_for_line("ready")
    assert "not calibrated" in running.lines
    kind = service_type("sensor_msgs/srv/SetCameraInfo")
    request = kind.Request()
    request.camera_info.width, request.camera_info.height = 640, 480
    request.camera_info.k[0] = 500.5
    client = graph.create_node("tester").create_client("/set_camera_info", kind)
    assert client.call(request).success
    running.wait_for_line("read 500.5")
    assert running.wait() == 0
    assert "width 640" in running.lines
    assert "camera_name: left" in file.read_text()
