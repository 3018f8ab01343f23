"""The encodings of ``sensor_msgs/Image`` (sensor_msgs/image_encodings.h), from one to another too.

Grey levels are made by OpenCV's fixed-point weights, as cv_bridge's are. What numpy does well is
done without OpenCV. Bayer patterns need OpenCV, and say so.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import did_you_mean

__all__ = ["CV_NAMES", "CvBridgeError", "Encoding", "convert_image", "find_encoding"]

CV_NAMES = {
    "uint8": "8U",
    "int8": "8S",
    "uint16": "16U",
    "int16": "16S",
    "int32": "32S",
    "float32": "32F",
    "float64": "64F",
}
_DTYPES = {cv_name: name for name, cv_name in CV_NAMES.items()}
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
Image = NDArray[Any]
_SHIFT = 14
# OpenCV's weights of red, green and blue (ITU-R BT.601) times 2**14.
_GREY = {"r": 4899, "g": 9617, "b": 1868}


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


def convert_image(image: Image, source: str, target: str) -> Image:
    """Return an image in another encoding, always a copy.

    Args:
        image: of shape (height, width) or (height, width, channels).
        source: its encoding.
        target: the encoding wanted.

    Raises:
        CvBridgeError: the conversion makes no sense; the text is cv_bridge's.
    """
    given, wanted = find_encoding(source), find_encoding(target)
    if source == target:
        return image.copy()
    same_channels = given.channels == wanted.channels
    if not given.is_colour and wanted.is_colour:
        text = f"[{source}] is not a color format. but [{target}] is."
        raise CvBridgeError(f"{text} The conversion does not make sense")
    if not given.is_colour and not same_channels:
        raise CvBridgeError(f"[{source}] and [{target}] do not have the same number of channel")
    if not wanted.is_colour and not same_channels:
        text = f"[{source}] is a color format but [{target}] is not"
        raise CvBridgeError(f"{text} so they must have the same OpenCV type, CV_8UC3, CV16UC1 ....")
    if given.is_colour and wanted.is_colour:
        image = _recoloured(image, given, wanted, source, target)
    return _scaled(image, given, wanted)


def _recoloured(image: Image, given: Encoding, wanted: Encoding, source: str, target: str) -> Image:
    if given.order == wanted.order:
        return image
    if wanted.order.startswith(("bayer", "uyvy", "yuyv")):
        raise CvBridgeError(f"Unsupported conversion from [{source}] to [{target}]")
    if given.order.startswith("bayer"):
        image, order = _debayered(image, given.order, source), "bgr"
    elif given.order in ("uyvy", "yuyv"):
        image, order = _of_yuv(image, given.order), "rgb"
    else:
        order = given.order
    if wanted.order == "mono":
        return image if order == "mono" else _grey(image, order)
    return _reordered(image, order, wanted.order)


def _reordered(image: Image, order: str, wanted: str) -> Image:
    full = np.iinfo(image.dtype).max
    planes = {"r": image, "g": image, "b": image} if order == "mono" else {}
    planes |= {letter: image[..., index] for index, letter in enumerate(order) if order != "mono"}
    planes.setdefault("a", np.full(image.shape[:2], full, image.dtype))
    return np.stack([planes[letter] for letter in wanted], axis=-1)


def _grey(image: Image, order: str) -> Image:
    total = np.full(image.shape[:2], 1 << (_SHIFT - 1), np.uint32)
    for index, letter in enumerate(order):
        if letter in _GREY:
            total += image[..., index].astype(np.uint32) * np.uint32(_GREY[letter])
    return (total >> _SHIFT).astype(image.dtype)


def _of_yuv(image: Image, order: str) -> Image:
    """Return RGB of ``uyvy`` or ``yuyv``, where two pixels share u and v (ITU-R BT.601)."""
    pairs = image.reshape(image.shape[0], -1, 4).astype(float)
    first = {letter: index for index, letter in reversed(list(enumerate(order)))}
    luma = pairs[..., [first["y"], first["y"] + 2]].reshape(image.shape[:2]) - 16.0
    u = np.repeat(pairs[..., first["u"]], 2, axis=1) - 128.0
    v = np.repeat(pairs[..., first["v"]], 2, axis=1) - 128.0
    luma = 1.164 * np.maximum(luma, 0.0)
    planes = (luma + 1.596 * v, luma - 0.813 * v - 0.391 * u, luma + 2.018 * u)
    return np.clip(np.rint(np.stack(planes, axis=-1)), 0, 255).astype(np.uint8)


def _debayered(image: Image, order: str, source: str) -> Image:
    try:
        import cv2  # type: ignore[import-not-found]
    except ImportError as error:
        raise CvBridgeError(
            f"[{source}] is a Bayer pattern, which needs OpenCV\n  fix: pip install opencv-python"
        ) from error
    # OpenCV names a pattern by its second row's second and third pixels.
    names = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}
    code = getattr(cv2, f"COLOR_Bayer{names[order.removeprefix('bayer_')]}2BGR")
    return np.asarray(cv2.cvtColor(image, code))


def _scaled(image: Image, given: Encoding, wanted: Encoding) -> Image:
    """Return values in another type; 8 and 16 bits of colours are stretched to full range."""
    if given.dtype == wanted.dtype:
        return image.copy()
    values = image.astype(np.float64)
    if given.is_colour and {given.bits, wanted.bits} == {8, 16}:
        values *= 65535 / 255 if wanted.bits == 16 else 255 / 65535
    kind = np.dtype(wanted.dtype)
    if kind.kind == "f":
        return values.astype(kind)
    limits = np.iinfo(kind)
    return np.clip(np.rint(np.nan_to_num(values)), limits.min, limits.max).astype(kind)
