"""Cameras and optical frames."""

from __future__ import annotations

from tests.description.checks.pain import finding, place


def test_camera_on_an_optical_frame_looks_to_the_side() -> None:
    item = finding("pain_20_optical/on_optical_frame.urdf")
    assert item.code == "robot.camera-on-optical-frame"
    assert "camera 'camera' stands on the optical frame 'camera_optical_frame'" in item.message
    assert place(item) == '<sensor name="camera" type="camera">'
    assert "put the sensor on 'camera_link'" in item.fix
    assert "name 'camera_optical_frame' as frameName" in item.fix


def test_optical_frame_without_its_turn_is_reported() -> None:
    item = finding("pain_20_optical/not_turned.urdf")
    assert item.code == "robot.optical-frame-not-turned"
    assert "the camera looks along (1, 0, 0) of it instead of z" in item.message
    assert place(item).startswith('<joint name="camera_optical_joint"')
    assert '<origin rpy="-1.5708 0 -1.5708"/>' in item.fix
    assert "rotated in RViz" in item.phrase
