"""cv_bridge.CvBridge: between ``sensor_msgs/Image`` and numpy arrays, as OpenCV holds images."""

from __future__ import annotations

import io
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from gazelle.compat.images.encodings import CV_NAMES, CvBridgeError, convert_image, find_encoding
from gazelle.compat.ros_version import message_ros_version
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type, ros1_message_type

__all__ = ["CvBridge", "CvBridgeError"]

Image = NDArray[Any]

_AS_IS = "passthrough"
_QUALITY = 95
_FORMATS = {
    "jpg": "JPEG",
    "jpeg": "JPEG",
    "jpe": "JPEG",
    "png": "PNG",
    "bmp": "BMP",
    "dib": "BMP",
    "tif": "TIFF",
    "tiff": "TIFF",
    "webp": "WEBP",
    "ppm": "PPM",
    "pgm": "PPM",
    "pbm": "PPM",
}


class CvBridge:
    """Converts images; needs OpenCV for Bayer patterns only."""

    def imgmsg_to_cv2(self, img_msg: Any, desired_encoding: str = _AS_IS) -> Image:
        """Return an image of shape (height, width) or (height, width, channels).

        Args:
            img_msg: ``sensor_msgs/Image``.
            desired_encoding: ``bgr8`` for what OpenCV's functions expect; as sent by default.

        Raises:
            CvBridgeError: the encodings do not fit, or data are missing.
        """
        encoding = find_encoding(img_msg.encoding)
        kind = np.dtype(encoding.dtype).newbyteorder(">" if img_msg.is_bigendian else "<")
        height, width = int(img_msg.height), int(img_msg.width)
        row = width * encoding.channels * kind.itemsize
        step = int(img_msg.step) or row
        data = np.frombuffer(bytes(img_msg.data), np.uint8)
        if step < row or len(data) < step * height:
            text = f"{width}×{height} {img_msg.encoding} needs {max(row, step) * height} bytes"
            raise CvBridgeError(f"the image has {len(data)} bytes and step {step}, {text}")
        rows = np.ascontiguousarray(data[: step * height].reshape(height, step)[:, :row])
        image = rows.view(kind).reshape(height, width, encoding.channels).astype(encoding.dtype)
        if encoding.channels == 1:
            image = image[..., 0]
        if desired_encoding == _AS_IS:
            return image
        return convert_image(image, img_msg.encoding, desired_encoding)

    def cv2_to_imgmsg(self, cvim: Any, encoding: str = _AS_IS, header: Any = None) -> Any:
        """Return ``sensor_msgs/Image``.

        Args:
            cvim: numpy array.
            encoding: what its values mean; only their type, such as ``8UC3``, by default.
            header: the message's header.

        Raises:
            TypeError: it is no numpy array.
            CvBridgeError: array and encoding do not fit.
        """
        image, name = _checked(cvim)
        if encoding != _AS_IS:
            if find_encoding(encoding).cv_type != name:
                text = f"encoding specified as {encoding}, but image has incompatible type {name}"
                raise CvBridgeError(text)
            name = encoding
        message: Any = _message("Image")
        if header is not None:
            message.header = header
        message.height, message.width = image.shape[:2]
        message.encoding = name
        message.is_bigendian = image.dtype.byteorder == ">" or (
            image.dtype.byteorder == "=" and sys.byteorder == "big"
        )
        message.data = image.tobytes()
        message.step = len(message.data) // message.height if message.height else 0
        return message

    def compressed_imgmsg_to_cv2(self, cmprs_img_msg: Any, desired_encoding: str = _AS_IS) -> Image:
        """Return the image of a ``sensor_msgs/CompressedImage``, BGR or grey by default.

        It is of shape (height, width, 3), grey of shape (height, width).

        Raises:
            CvBridgeError: the bytes are no picture, or the encodings do not fit.
        """
        try:
            picture = PillowImage.open(io.BytesIO(bytes(cmprs_img_msg.data)))
            grey = picture.mode in ("1", "L", "I;16", "I")
            values = np.asarray(picture if grey else picture.convert("RGB"))
        except (OSError, SyntaxError) as error:
            text = f"a compressed image of format '{cmprs_img_msg.format}' cannot be read"
            raise CvBridgeError(f"{text}: {error}") from error
        image: Image = values.copy() if grey else values[..., ::-1].copy()
        if image.dtype == np.bool_:
            image = image.astype(np.uint8) * np.uint8(255)
        if desired_encoding == _AS_IS:
            return image
        name = f"mono{image.dtype.itemsize * 8}" if grey else "bgr8"
        return convert_image(image, name, desired_encoding)

    def cv2_to_compressed_imgmsg(self, cvim: Any, dst_format: str = "jpg") -> Any:
        """Return ``sensor_msgs/CompressedImage`` of a BGR, BGRA or grey image.

        Raises:
            TypeError: it is no numpy array.
            CvBridgeError: the format is not known or cannot hold the image.
        """
        image, name = _checked(cvim)
        if dst_format not in _FORMATS:
            hint = did_you_mean(dst_format, _FORMATS)
            raise CvBridgeError(f"image format '{dst_format}' is not known; {hint}".rstrip("; "))
        if name not in ("8UC1", "8UC3", "8UC4", "16UC1"):
            raise CvBridgeError(f"an image of type {name} cannot be stored as {dst_format}")
        if image.ndim == 3 and image.shape[2] == 1:
            image = image[..., 0]
        if image.ndim == 3:
            image = image[..., [2, 1, 0, 3][: image.shape[2]]]
        if _FORMATS[dst_format] == "JPEG":
            image = image[..., :3] if image.ndim == 3 else image
        target = io.BytesIO()
        picture = PillowImage.fromarray(np.ascontiguousarray(image))
        try:
            picture.save(target, _FORMATS[dst_format], quality=_QUALITY)
        except (OSError, ValueError) as error:
            raise CvBridgeError(f"cannot be stored as {dst_format}: {error}") from error
        message: Any = _message("CompressedImage")
        message.format = dst_format
        message.data = target.getvalue()
        return message

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return numpy's type and the number of channels of an encoding.

        Raises:
            CvBridgeError: there is none of the name.
        """
        found = find_encoding(encoding)
        return found.dtype, found.channels

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """Return OpenCV's word for a type, such as ``8UC3``."""
        return _cv_type(np.dtype(dtype), n_channels)


def _checked(cvim: Any) -> tuple[Image, str]:
    """Return the image and OpenCV's word for its type."""
    if not isinstance(cvim, np.ndarray | np.generic):
        raise TypeError("Your input type is not a numpy array")
    image: Image = np.asarray(cvim)
    if image.ndim not in (2, 3):
        raise CvBridgeError(f"an image has two or three dimensions, not {image.ndim}")
    return image, _cv_type(image.dtype, 1 if image.ndim == 2 else image.shape[2])


def _cv_type(dtype: np.dtype[Any], channels: int) -> str:
    cv_name = CV_NAMES.get(dtype.name)
    if cv_name is None:
        text = f"OpenCV has no images of type {dtype.name}"
        raise CvBridgeError(f"{text}\n  fix: convert it, for example with .astype('uint8')")
    return f"{cv_name}C{channels}"


def _message(name: str) -> Any:
    make = ros1_message_type if message_ros_version() == 1 else message_type
    return make(f"sensor_msgs/{name}")()
