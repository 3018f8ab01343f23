"""The encodings of ``sensor_msgs/Image`` (sensor_msgs/image_encodings.h)."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from gazelle.diagnostics import did_you_mean

__all__ = ["CV_NAMES", "CvBridgeError", "Encoding", "find_encoding"]


class CvBridgeError(TypeError):
    """An image cannot be converted."""


class Encoding(NamedTuple):
    """What an encoding's name says.

    Attributes:
        dtype: numpy's name of one value.
        channels: values per pixel.
        order: letters of the channels, such as ``bgr``; ``mono``; empty when only the type is
            known, as for ``8UC3``.
        bits: of one value.
    """

    dtype: str
    channels: int
    order: str = ""
    bits: int = 8

    @property
    def is_colour(self) -> bool:
        """True when it says what the values mean."""
        return bool(self.order)

    @property
    def cv_type(self) -> str:
        """OpenCV's word for its type, such as ``8UC3``."""
        return f"{CV_NAMES[self.dtype]}C{self.channels}"


CV_NAMES = {
    "uint8": "8U",
    "int8": "8S",
    "uint16": "16U",
    "int16": "16S",
    "int32": "32S",
    "float32": "32F",
    "float64": "64F",
}
_DTYPES = {word: name for name, word in CV_NAMES.items()}
_PLAIN = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)(?:C(\d+))?")
_COLOURS = ("rgb", "bgr", "rgba", "bgra")
_SINGLE = ("mono", "bayer_rggb", "bayer_bggr", "bayer_gbrg", "bayer_grbg")
_NAMED = {
    **{f"{order}{bits}": (order, len(order), bits) for order in _COLOURS for bits in (8, 16)},
    **{f"{order}{bits}": (order, 1, bits) for order in _SINGLE for bits in (8, 16)},
    "yuv422": ("uyvy", 2, 8),
    "uyvy": ("uyvy", 2, 8),
    "yuv422_yuy2": ("yuyv", 2, 8),
    "yuyv": ("yuyv", 2, 8),
}


def find_encoding(name: str) -> Encoding:
    """Return what an encoding's name says.

    Raises:
        CvBridgeError: there is none of the name.
    """
    if name in _NAMED:
        order, channels, bits = _NAMED[name]
        return Encoding(f"uint{bits}", channels, order, bits)
    match = _PLAIN.fullmatch(name)
    if match is None:
        hint = did_you_mean(name, [*_NAMED, "8UC1", "8UC3", "16UC1", "32FC1", "64FC1"])
        raise CvBridgeError(f"Unrecognized image encoding [{name}]; {hint}".rstrip("; "))
    dtype = _DTYPES[match[1]]
    return Encoding(dtype, int(match[2] or 1), "", np.dtype(dtype).itemsize * 8)
