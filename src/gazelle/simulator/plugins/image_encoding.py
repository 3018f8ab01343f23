"""Pictures as ROS encodings, JPEG, PNG and compressed depth."""

from __future__ import annotations

import io
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header

__all__ = [
    "compressed_depth_message",
    "compressed_message",
    "depth_millimetres",
    "encode_pixels",
    "encoding_name",
]

_ENCODINGS = {
    "R8G8B8": "rgb8",
    "RGB_INT8": "rgb8",
    "B8G8R8": "bgr8",
    "BGR_INT8": "bgr8",
    "L8": "mono8",
    "L_INT8": "mono8",
    "L16": "mono16",
    "L_INT16": "mono16",
    "BAYER_RGGB8": "bayer_rggb8",
    "BAYER_BGGR8": "bayer_bggr8",
    "BAYER_GBRG8": "bayer_gbrg8",
    "BAYER_GRBG8": "bayer_grbg8",
}
# ITU-R BT.601 luma.
_LUMA = np.array([0.299, 0.587, 0.114], np.float32)


def encoding_name(pixel_format: str) -> str:
    """Return the ROS encoding of an SDF ``<format>``; ``rgb8`` for an unknown one."""
    return _ENCODINGS.get(pixel_format.strip().upper(), "rgb8")


def encode_pixels(rgb: NDArray[np.uint8], encoding: str) -> NDArray[np.uint8] | NDArray[np.uint16]:
    """Return (H, W, 3) RGB as the pixels of a ROS encoding."""
    if encoding == "bgr8":
        return np.ascontiguousarray(rgb[:, :, ::-1])
    if encoding == "mono8":
        return np.asarray(np.rint(rgb @ _LUMA), np.uint8)
    if encoding == "mono16":
        return np.asarray(np.rint(rgb @ _LUMA * 257.0), np.uint16)
    if encoding.startswith("bayer_"):
        return _mosaic(rgb, encoding.removeprefix("bayer_")[:4])
    return rgb


def depth_millimetres(depth_m: NDArray[np.float32]) -> NDArray[np.uint16]:
    """Return (rows, columns) of depth, m, as 16UC1: millimetres, 0 for what is not seen."""
    return np.asarray(np.nan_to_num(depth_m * 1000.0, nan=0.0, posinf=0.0), np.uint16)


def compressed_message(
    time_ns: int, frame: str, rgb: NDArray[np.uint8], *, kind: str, quality: int, png_level: int
) -> Any:
    """Return a ``sensor_msgs/CompressedImage`` as compressed_image_transport makes it.

    Args:
        time_ns: of the header.
        frame: of the header.
        rgb: (rows, columns, 3).
        kind: ``png``, else JPEG.
        quality: JPEG's, in percent.
        png_level: zlib's.
    """
    from PIL import Image

    buffer = io.BytesIO()
    picture = Image.fromarray(rgb)
    if kind == "png":
        picture.save(buffer, "PNG", compress_level=png_level)
    else:
        picture.save(buffer, "JPEG", quality=quality)
    name = "png" if kind == "png" else "jpeg"
    return message_type("sensor_msgs/CompressedImage")(
        header=header(time_ns, frame),
        format=f"rgb8; {name} compressed bgr8",
        data=np.frombuffer(buffer.getvalue(), np.uint8),
    )


def compressed_depth_message(
    time_ns: int,
    frame: str,
    depth_m: NDArray[np.float32],
    *,
    depth_max_m: float,
    quantization: float,
    png_level: int,
) -> Any:
    """Return depth as compressed_depth_image_transport encodes 32FC1.

    A 12-byte header (format, quantisation A and B), then a 16-bit PNG of A / depth + B. Depth is
    (rows, columns), m.
    """
    from PIL import Image

    a = quantization * (quantization + 1.0)
    b = 1.0 - a / depth_max_m
    seen = np.isfinite(depth_m) & (depth_m > 0) & (depth_m < depth_max_m)
    inverse = np.zeros(depth_m.shape, np.uint16)
    inverse[seen] = np.asarray(a / depth_m[seen] + b, np.uint16)
    buffer = io.BytesIO()
    Image.fromarray(inverse).save(buffer, "PNG", compress_level=png_level)
    data = struct.pack("<iff", 0, a, b) + buffer.getvalue()
    return message_type("sensor_msgs/CompressedImage")(
        header=header(time_ns, frame),
        format="32FC1; compressedDepth png",
        data=np.frombuffer(data, np.uint8),
    )


def _mosaic(rgb: NDArray[np.uint8], pattern: str) -> NDArray[np.uint8]:
    mosaic = np.empty(rgb.shape[:2], np.uint8)
    for number, colour in enumerate(pattern):
        row, column = divmod(number, 2)
        mosaic[row::2, column::2] = rgb[row::2, column::2, "rgb".index(colour)]
    return mosaic
