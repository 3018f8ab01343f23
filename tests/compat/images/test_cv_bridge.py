"""cv_bridge without OpenCV: encodings, colours, compressed pictures, and its errors."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.compat.images.cv_bridge import CvBridge, CvBridgeError
from gazelle.compat.images.encodings import convert_image, find_encoding
from gazelle.interfaces import message_type

BRIDGE = CvBridge()
BGR = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [10, 20, 30]]], np.uint8)


@pytest.mark.parametrize(
    ("name", "dtype", "channels", "cv_type"),
    [
        ("bgr8", "uint8", 3, "8UC3"),
        ("rgba16", "uint16", 4, "16UC4"),
        ("mono8", "uint8", 1, "8UC1"),
        ("mono16", "uint16", 1, "16UC1"),
        ("32FC1", "float32", 1, "32FC1"),
        ("64FC4", "float64", 4, "64FC4"),
        ("8SC2", "int8", 2, "8SC2"),
        ("16U", "uint16", 1, "16UC1"),
        ("bayer_rggb8", "uint8", 1, "8UC1"),
        ("yuv422", "uint8", 2, "8UC2"),
    ],
)
def test_encoding_names_type_and_channels(
    name: str, dtype: str, channels: int, cv_type: str
) -> None:
    assert BRIDGE.encoding_to_dtype_with_channels(name) == (dtype, channels)
    assert find_encoding(name).cv_type == cv_type


@pytest.mark.parametrize("encoding", ["bgr8", "32FC1", "mono16", "16UC1", "bgra8", "64FC3", "8UC2"])
def test_image_comes_back_as_it_was(encoding: str) -> None:
    dtype, channels = BRIDGE.encoding_to_dtype_with_channels(encoding)
    shape = (3, 5) if channels == 1 else (3, 5, channels)
    image = np.arange(15 * channels, dtype=dtype).reshape(shape)
    message = BRIDGE.cv2_to_imgmsg(image, encoding)
    assert (message.height, message.width, message.encoding) == (3, 5, encoding)
    assert message.step == 5 * channels * image.itemsize
    back = BRIDGE.imgmsg_to_cv2(message)
    assert back.dtype == image.dtype and np.array_equal(back, image) and back.flags.writeable


@pytest.mark.reference
def test_colours_become_what_opencv_makes_of_them() -> None:
    message = BRIDGE.cv2_to_imgmsg(BGR, "bgr8")
    assert np.array_equal(BRIDGE.imgmsg_to_cv2(message, "rgb8"), BGR[..., ::-1])
    # OpenCV 4: cvtColor([[blue, green], [red, (10, 20, 30)]], COLOR_BGR2GRAY)
    assert BRIDGE.imgmsg_to_cv2(message, "mono8").tolist() == [[29, 150], [76, 22]]
    assert BRIDGE.imgmsg_to_cv2(message, "bgra8")[1, 1].tolist() == [10, 20, 30, 255]
    assert BRIDGE.imgmsg_to_cv2(message, "rgba16")[1, 1].tolist() == [7710, 5140, 2570, 65535]
    grey = BRIDGE.cv2_to_imgmsg(np.array([[0, 65535, 300]], np.uint16), "mono16")
    assert BRIDGE.imgmsg_to_cv2(grey, "mono8").tolist() == [[0, 255, 1]]
    assert BRIDGE.imgmsg_to_cv2(grey, "bgr8")[0, 1].tolist() == [255, 255, 255]
    plain = BRIDGE.cv2_to_imgmsg(np.array([[1.4, 300.0, -5.0]], np.float32))
    assert plain.encoding == "32FC1"
    assert BRIDGE.imgmsg_to_cv2(plain, "8UC1").tolist() == [[1, 255, 0]]


def test_yuv_becomes_rgb() -> None:
    white_and_black = np.array([[[128, 235], [128, 16]]], np.uint8)
    assert convert_image(white_and_black, "yuv422", "rgb8").tolist() == [[[255] * 3, [0] * 3]]
    red = np.array([[[82, 90], [82, 240]]], np.uint8)
    found = convert_image(red, "yuv422_yuy2", "bgr8")
    assert abs(found.astype(int) - [0, 0, 255]).max() <= 2, found


def test_padded_rows_and_big_endian_are_read() -> None:
    message: Any = message_type("sensor_msgs/Image")()
    message.height, message.width, message.encoding, message.step = 2, 2, "mono16", 6
    message.is_bigendian = 1
    message.data = b"\x01\x02\x03\x04\xff\xff\x05\x06\x07\x08\xff\xff"
    assert BRIDGE.imgmsg_to_cv2(message).tolist() == [[0x102, 0x304], [0x506, 0x708]]


@pytest.mark.parametrize("kind", ["png", "jpg", "bmp"])
def test_compressed_image_comes_back(kind: str) -> None:
    image = np.full((8, 8, 3), (10, 120, 240), np.uint8)
    message = BRIDGE.cv2_to_compressed_imgmsg(image, kind)
    assert message.format == kind
    back = BRIDGE.compressed_imgmsg_to_cv2(message)
    assert back.shape == image.shape and abs(back.astype(int) - image).max() <= 3
    rgb = BRIDGE.compressed_imgmsg_to_cv2(message, "rgb8")
    assert np.array_equal(rgb, back[..., ::-1])
    grey = BRIDGE.cv2_to_compressed_imgmsg(np.eye(4, dtype=np.uint8) * 200, "png")
    assert BRIDGE.compressed_imgmsg_to_cv2(grey)[0, 0] == 200


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (
            lambda: convert_image(BGR, "8UC3", "bgr8"),
            "[8UC3] is not a color format. but [bgr8] is.",
        ),
        (lambda: convert_image(BGR, "8UC3", "32FC1"), "do not have the same number of channel"),
        (lambda: convert_image(BGR, "bgr8", "32FC1"), "so they must have the same OpenCV type"),
        (
            lambda: convert_image(BGR, "bgr8", "yuv422"),
            "Unsupported conversion from [bgr8] to [yuv",
        ),
        (lambda: find_encoding("brg8"), "Unrecognized image encoding [brg8]; did you mean"),
        (lambda: find_encoding(""), "Unrecognized image encoding []"),
        (
            lambda: BRIDGE.cv2_to_imgmsg(BGR, "mono8"),
            "encoding specified as mono8, but image has incompatible type 8UC3",
        ),
        (lambda: BRIDGE.cv2_to_imgmsg(BGR.astype(np.int64)), "no images of type int64"),
        (lambda: BRIDGE.cv2_to_imgmsg(np.zeros(3, np.uint8)), "two or three dimensions, not 1"),
        (lambda: BRIDGE.cv2_to_compressed_imgmsg(BGR, "pgn"), "'pgn' is not known; did you mean"),
        (lambda: BRIDGE.cv2_to_compressed_imgmsg(BGR * 1.0), "type 64FC3 cannot be stored as jpg"),
    ],
)
def test_what_cannot_be_is_said_in_cv_bridges_words(call: Any, text: str) -> None:
    with pytest.raises(CvBridgeError) as caught:
        call()
    assert text in str(caught.value)


def test_missing_bytes_and_wrong_types_are_named() -> None:
    message = BRIDGE.cv2_to_imgmsg(BGR, "bgr8")
    message.data = bytes(message.data)[:-1]
    with pytest.raises(CvBridgeError, match=r"has 11 bytes and step 6, 2×2 bgr8 needs 12 bytes"):
        BRIDGE.imgmsg_to_cv2(message)
    with pytest.raises(TypeError, match="Your input type is not a numpy array"):
        BRIDGE.cv2_to_imgmsg([[1]])
    broken: Any = message_type("sensor_msgs/CompressedImage")(format="jpeg", data=b"no picture")
    with pytest.raises(CvBridgeError, match="compressed image of format 'jpeg' cannot be read"):
        BRIDGE.compressed_imgmsg_to_cv2(broken)


def test_bayer_patterns_ask_for_opencv(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "cv2", None)
    with pytest.raises(CvBridgeError, match=r"Bayer pattern, which needs OpenCV\n.*opencv-python"):
        convert_image(np.zeros((2, 2), np.uint8), "bayer_rggb8", "bgr8")


@pytest.mark.parametrize("library", ["rospy", "rclpy"])
def test_messages_take_the_form_of_the_program(passes: Callable[..., Any], library: str) -> None:
    passes(
        f"import {library}\n"
        + """
import numpy as np
from cv_bridge import CvBridge, CvBridgeError
from cv_bridge.core import CvBridge as Same
from sensor_msgs.msg import CompressedImage, Image
bridge = CvBridge()
assert Same is CvBridge and issubclass(CvBridgeError, TypeError)
message = bridge.cv2_to_imgmsg(np.zeros((2, 3, 3), np.uint8), encoding='bgr8')
assert isinstance(message, Image), type(message)
assert isinstance(bridge.cv2_to_compressed_imgmsg(np.zeros((2, 3, 3), np.uint8)), CompressedImage)
assert bridge.imgmsg_to_cv2(message, desired_encoding='mono8').shape == (2, 3)
"""
    )
