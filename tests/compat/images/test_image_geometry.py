"""Cameras of image_geometry."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.compat.images.image_geometry import PinholeCameraModel, StereoCameraModel
from gazelle.interfaces import message_type, ros1_message_type

K = [500.0, 0, 320, 0, 400, 240, 0, 0, 1]
P = [500.0, 0, 320, 0, 0, 400, 240, 0, 0, 0, 1, 0]


def info(make: Any = ros1_message_type, **changed: Any) -> Any:
    message = make("sensor_msgs/CameraInfo")()
    values = {"k": K, "p": P, "r": [1.0, 0, 0, 0, 1, 0, 0, 0, 1], "d": [0.0] * 5} | changed
    for name, value in values.items():
        setattr(message, name if hasattr(message, name) else name.upper(), value)
    message.width, message.height = 640, 480
    message.header.frame_id = "optical"
    return message


def camera(**changed: Any) -> PinholeCameraModel:
    made = PinholeCameraModel()
    made.fromCameraInfo(info(**changed))
    return made


@pytest.mark.parametrize("make", [ros1_message_type, message_type])
def test_points_become_pixels_and_pixels_rays(make: Any) -> None:
    model = PinholeCameraModel()
    model.fromCameraInfo(info(make))
    assert model.project3dToPixel((0.2, -0.1, 2.0)) == (370.0, 220.0)
    ray = model.projectPixelTo3dRay((370.0, 220.0))
    assert ray == pytest.approx([0.2 / 2.01246118, -0.1 / 2.01246118, 2.0 / 2.01246118])
    assert (model.fx(), model.fy(), model.cx(), model.cy()) == (500, 400, 320, 240)
    assert (model.tfFrame(), model.fullResolution()) == ("optical", (640, 480))
    assert all(map(math.isnan, model.project3dToPixel((1, 1, 0))))
    assert model.getDeltaU(0.1, 2.0) == 25 and model.getDeltaX(25, 2.0) == pytest.approx(0.1)
    assert model.fovX() == pytest.approx(2 * math.atan(320 / 500))


def test_region_of_interest_and_binning_move_the_principal_point() -> None:
    message = info()
    message.roi.x_offset, message.roi.y_offset = 100, 40
    message.binning_x = message.binning_y = 2
    model = PinholeCameraModel()
    model.fromCameraInfo(message)
    assert (model.cx(), model.cy(), model.fx()) == (110, 100, 250)
    assert model.fullIntrinsicMatrix()[0, 2] == 320


def test_lens_bends_pixels_as_plumb_bob_says() -> None:
    model = camera(d=[-0.1, 0.02, 0.001, -0.002, 0.0])
    # By hand, at x = 0.4, y = 0: r2 = 0.16, radial = 0.984512.
    raw = model.unrectifyPoint((520.0, 240.0))
    x = 0.4 * 0.984512 - 0.002 * 3 * 0.16
    assert raw == pytest.approx((500 * x + 320, 400 * 0.001 * 0.16 + 240))


@pytest.mark.parametrize(
    "d", [[-0.3, 0.1, 0.001, 0.002, -0.01], [0.1, 0.2, 0, 0, 0.01, 0.05, 0.1, 0.02], []]
)
def test_rectifying_undoes_the_lens(d: list[float]) -> None:
    turned = [math.cos(0.02), 0, math.sin(0.02), 0, 1, 0, -math.sin(0.02), 0, math.cos(0.02)]
    model = camera(d=d, r=turned)
    for pixel in ((320.0, 240.0), (100.0, 60.0), (600.0, 470.0)):
        assert model.rectifyPoint(model.unrectifyPoint(pixel)) == pytest.approx(pixel, abs=1e-3)


def test_disparity_is_depth() -> None:
    stereo = StereoCameraModel()
    right = list(P)
    right[3] = -500.0 * 0.07
    stereo.fromCameraInfo(info(), info(p=right))
    (left_u, v), (right_u, _) = stereo.project3dToPixel((0.5, 0.25, 3.5))
    disparity = left_u - right_u
    assert disparity == pytest.approx(10.0)
    assert stereo.getZ(disparity) == pytest.approx(3.5)
    assert stereo.getDisparity(3.5) == pytest.approx(10.0)
    assert stereo.projectPixelTo3d((left_u, v), disparity) == pytest.approx((0.5, 0.25, 3.5))
    assert math.isinf(stereo.getZ(0))


def test_modules_can_be_imported(passes: Callable[..., Any]) -> None:
    passes("""
import rospy
from image_geometry import PinholeCameraModel, StereoCameraModel
from tf_conversions import transformations
import tf_conversions
assert transformations.quaternion_from_euler(0, 0, 0).tolist() == [0, 0, 0, 1]
""")
