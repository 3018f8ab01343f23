"""Images as arrays (ros_numpy.image)."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.compat.images.encodings import Encoding, find_encoding
from gazelle.interfaces import ros1_message_type

__all__ = ["image_to_numpy", "numpy_to_image"]


def image_to_numpy(msg: Any) -> NDArray[Any]:
    """Return the pixels: (height, width), and channels where there are several.

    Raises:
        TypeError: the encoding is not known.
        ValueError: the image has fewer bytes than its size says.
    """
    kind = find_encoding(msg.encoding)
    dtype = np.dtype(kind.dtype).newbyteorder(">" if msg.is_bigendian else "<")
    height, width = int(msg.height), int(msg.width)
    data = np.frombuffer(bytes(msg.data), np.uint8)
    step, row = int(msg.step), width * kind.channels * dtype.itemsize
    wanted = step * (height - 1) + row if height else 0
    if len(data) < wanted or (height and step < row):
        size = f"{width}×{height} {msg.encoding} with step {step}"
        raise ValueError(f"the image's data have {len(data)} bytes, {size} needs {wanted}")
    strides = (step, kind.channels * dtype.itemsize, dtype.itemsize)
    pixels: NDArray[Any] = np.ndarray((height, width, kind.channels), dtype, data, strides=strides)
    return pixels[..., 0] if kind.channels == 1 else pixels


def numpy_to_image(arr: NDArray[Any], encoding: str, *, msg_type: Any = None) -> Any:
    """Return the image of an array of pixels.

    Args:
        arr: (height, width) or (height, width, channels).
        encoding: what the values mean, such as ``rgb8``.
        msg_type: class of the image.

    Raises:
        TypeError: the encoding is not known, or the array does not fit it.
    """
    kind = find_encoding(encoding)
    _check(arr, encoding, kind)
    pixels = np.ascontiguousarray(arr)
    image = (msg_type or ros1_message_type("sensor_msgs/Image"))()
    image.height, image.width = arr.shape[:2]
    image.encoding = encoding
    image.step = arr.shape[1] * kind.channels * arr.dtype.itemsize
    order = arr.dtype.byteorder
    image.is_bigendian = order == ">" or (order == "=" and sys.byteorder == "big")
    image.data = pixels.tobytes()
    return image


def _check(arr: NDArray[Any], encoding: str, kind: Encoding) -> None:
    if arr.ndim not in (2, 3):
        raise TypeError(f"Array must be two or three dimensional, this one is of shape {arr.shape}")
    channels = arr.shape[2] if arr.ndim == 3 else 1
    if channels != kind.channels:
        raise TypeError(f"Array has {channels} channels, {encoding} requires {kind.channels}")
    if arr.dtype.newbyteorder("=") != np.dtype(kind.dtype):
        raise TypeError(f"Array is {arr.dtype}, {encoding} requires {kind.dtype}")
