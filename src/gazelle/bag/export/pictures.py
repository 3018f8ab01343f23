"""Images of bags as arrays of red, green and blue."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np

from gazelle.bag.storage import BagError

__all__ = ["IMAGE_TYPES", "picture"]

IMAGE_TYPES = ("Image", "CompressedImage")
_CHANNELS = {"rgb8": "RGB", "bgr8": "BGR", "rgba8": "RGBA", "bgra8": "BGRA"}
_GREY = {"mono8": np.uint8, "8UC1": np.uint8, "mono16": np.uint16, "16UC1": np.uint16}
_BAYER = ("bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8")


def picture(message: Any) -> Any:
    """Return an image message as an array ``(height, width, 3)`` of bytes.

    Depth (``32FC1``, metres) and 16 bit become grey from the nearest (black) to the farthest.

    Raises:
        BagError: the encoding is not known, or the data are too short.
    """
    if hasattr(message, "format"):
        from PIL import Image

        return np.asarray(Image.open(BytesIO(bytes(message.data))).convert("RGB"))
    height, width, step = message.height, message.width, message.step
    data = np.frombuffer(bytes(message.data), np.uint8)
    if len(data) < height * step:
        raise BagError(f"an image of {height} rows of {step} bytes holds only {len(data)} bytes")
    rows = data[: height * step].reshape(height, step)
    encoding = message.encoding
    if encoding in _CHANNELS:
        order = _CHANNELS[encoding]
        found = rows[:, : width * len(order)].reshape(height, width, len(order))
        return found[..., [order.index(letter) for letter in "RGB"]]
    if encoding in _BAYER:
        return _grey(rows[:, :width])
    if encoding in _GREY:
        values = _values(rows, width, np.dtype(_GREY[encoding]), message.is_bigendian)
        return _grey(values if values.dtype == np.uint8 else _stretched(values))
    if encoding == "32FC1":
        return _grey(_stretched(_values(rows, width, np.dtype(np.float32), message.is_bigendian)))
    raise BagError(f"images of encoding '{encoding}' are not drawn")


def _values(rows: Any, width: int, kind: np.dtype[Any], big: int) -> Any:
    size = kind.itemsize
    packed = np.ascontiguousarray(rows[:, : width * size])
    return packed.view(kind.newbyteorder(">" if big else "<"))


def _stretched(values: Any) -> Any:
    values = values.astype(np.float64)
    good = values[np.isfinite(values)]
    low, high = (good.min(), good.max()) if good.size else (0.0, 1.0)
    scaled = (np.nan_to_num(values, nan=high, posinf=high, neginf=low) - low) / max(
        high - low, 1e-9
    )
    return (255 * scaled).astype(np.uint8)


def _grey(values: Any) -> Any:
    return np.repeat(values.astype(np.uint8)[..., None], 3, axis=2)
