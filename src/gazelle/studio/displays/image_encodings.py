"""Images of every encoding → pictures that Pillow encodes; depth through a colour map."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.studio.displays.colours import COLORMAPS, colormap
from gazelle.studio.errors import StudioError

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = [
    "KIND_JPEG",
    "Encoded",
    "PictureSettings",
    "checked_colormap",
    "encoded_picture",
    "gray_levels",
    "pixels_rgb",
]

KIND_JPEG = 10

_RAW_MODES = {
    "rgb8": ("RGB", "RGB", 3),
    "bgr8": ("RGB", "BGR", 3),
    "8UC3": ("RGB", "BGR", 3),
    "rgba8": ("RGB", "RGBX", 4),
    "bgra8": ("RGB", "BGRX", 4),
    "8UC4": ("RGB", "BGRX", 4),
    "mono8": ("L", "L", 1),
    "8UC1": ("L", "L", 1),
}
_DEPTHS = {
    "mono16": "u2",
    "16UC1": "u2",
    "16SC1": "i2",
    "32SC1": "i4",
    "32FC1": "f4",
    "64FC1": "f8",
}
# Rows and columns of the first red, green (in red's row) and blue pixel.
_BAYER = {"rggb": (0, 0), "bggr": (1, 1), "gbrg": (1, 0), "grbg": (0, 1)}
_YUV = {"yuv422": 1, "uyvy": 1, "yuv422_yuy2": 0, "yuyv": 0}
_PNG_HEADER_BYTES = 12


class PictureSettings(NamedTuple):
    """How a picture is sent.

    Attributes:
        quality: of JPEG, 1…95.
        max_width_px: wider ones are made smaller.
        colormap: of depth, of `COLORMAPS`.
        min_value, max_value: what is black and white of depth; found in the picture when None.
    """

    quality: int = 80
    max_width_px: int = 1280
    colormap: str = "gray"
    min_value: float | None = None
    max_value: float | None = None


class Encoded(NamedTuple):
    """A JPEG and the size of the picture it was made from."""

    jpeg: bytes
    width_px: int
    height_px: int


def encoded_picture(message: Any, settings: PictureSettings) -> Encoded:
    """Return the JPEG of a ``sensor_msgs/Image`` or ``CompressedImage``.

    Raises:
        StudioError: the encoding is not known, or the data do not fit the size.
    """
    if hasattr(message, "format"):
        return _from_compressed(message, settings)
    return _jpeg(_picture(message, settings), settings)


def pixels_rgb(message: Any) -> NDArray[np.uint8]:
    """Return the pixels of a ``sensor_msgs/Image``, (H, W, 3).

    Raises:
        StudioError: as `encoded_picture`.
    """
    return np.asarray(_picture(message, PictureSettings()).convert("RGB"))


def gray_levels(
    values: NDArray[Any], low: float | None = None, high: float | None = None
) -> NDArray[np.uint8]:
    """Return depth as 0…255, 0 also where nothing was measured.

    Args:
        values: (H, W) depths, all in one unit.
        low: what becomes 0, in that unit; the least that was measured if None.
        high: what becomes 255; the greatest that was measured if None.

    Returns:
        (H, W) levels.
    """
    depth = np.asarray(values, np.float32)
    measured = np.isfinite(depth) & (depth > 0) if low is None else np.isfinite(depth)
    if not measured.any():
        return np.zeros(depth.shape, np.uint8)
    least = float(depth[measured].min()) if low is None else low
    most = float(depth[measured].max()) if high is None else high
    factor = 255.0 / (most - least) if most > least else 0.0
    scaled = np.where(measured, (depth - least) * factor, 0.0)
    return np.clip(scaled, 0.0, 255.0).astype(np.uint8)


def _picture(message: Any, settings: PictureSettings) -> Image:
    from PIL import Image

    encoding = message.encoding
    width, height = int(message.width), int(message.height)
    if not width or not height:
        raise StudioError("the picture is empty")
    data = memoryview(message.data)
    if encoding in _RAW_MODES:
        mode, raw, channels = _RAW_MODES[encoding]
        step = _checked_step(message, width * channels, data)
        pixels = np.frombuffer(data, np.uint8)
        return Image.frombuffer(mode, (width, height), pixels, "raw", raw, step, 1)
    return Image.fromarray(_pixels(message, data, settings))


def _pixels(message: Any, data: memoryview, settings: PictureSettings) -> NDArray[np.uint8]:
    encoding = str(message.encoding)
    if encoding in _DEPTHS:
        kind = np.dtype(_DEPTHS[encoding]).newbyteorder(">" if message.is_bigendian else "<")
        values = _rows(message, data, message.width * kind.itemsize).view(kind)
        gray = gray_levels(values, settings.min_value, settings.max_value)
        return gray if settings.colormap == "gray" else colormap(settings.colormap)[gray]
    if encoding in _YUV:
        return _from_yuv(_rows(message, data, message.width * 2), _YUV[encoding])
    family, _, rest = encoding.partition("_")
    if family == "bayer" and rest[:4] in _BAYER and rest[4:] in ("8", "16"):
        deep = rest[4:] == "16"
        rows = _rows(message, data, message.width * (2 if deep else 1))
        mosaic = (rows.view("<u2") >> 8).astype(np.uint8) if deep else rows
        return _from_bayer(mosaic, _BAYER[rest[:4]])
    known = (*_RAW_MODES, *_DEPTHS, *_YUV, *(f"bayer_{order}8" for order in _BAYER))
    raise StudioError(f"pictures of encoding '{encoding}' cannot be shown", known=known)


def _rows(message: Any, data: memoryview, row_bytes: int) -> NDArray[np.uint8]:
    """Return the pixels' bytes without what pads the rows."""
    step = _checked_step(message, row_bytes, data)
    flat = np.frombuffer(data, np.uint8, step * message.height)
    return np.ascontiguousarray(flat.reshape(message.height, step)[:, :row_bytes])


def _checked_step(message: Any, row_bytes: int, data: memoryview) -> int:
    step = int(message.step) or row_bytes
    if step < row_bytes or len(data) < step * (message.height - 1) + row_bytes:
        raise StudioError(
            f"the picture says {message.width}×{message.height} of {message.encoding} with a step "
            f"of {message.step} bytes, but brings {len(data)} bytes"
        )
    return step if len(data) >= step * message.height else row_bytes


def _from_bayer(mosaic: NDArray[np.uint8], red: tuple[int, int]) -> NDArray[np.uint8]:
    """One pixel of colour for each two by two of the mosaic."""
    row, column = red
    even = mosaic[: mosaic.shape[0] // 2 * 2, : mosaic.shape[1] // 2 * 2]
    greens = even[row::2, 1 - column :: 2].astype(np.uint16) + even[1 - row :: 2, column::2]
    blues = even[1 - row :: 2, 1 - column :: 2]
    return np.dstack([even[row::2, column::2], (greens // 2).astype(np.uint8), blues])


def _from_yuv(rows: NDArray[np.uint8], luma_at: int) -> NDArray[np.uint8]:
    """BT.601: two pixels share one pair of colours."""
    luma = rows[:, luma_at::2].astype(np.float32)
    pairs = rows[:, 1 - luma_at :: 2].astype(np.float32) - 128.0
    u, v = np.repeat(pairs[:, 0::2], 2, axis=1), np.repeat(pairs[:, 1::2], 2, axis=1)
    red, blue = luma + 1.402 * v, luma + 1.772 * u
    green = luma - 0.344136 * u - 0.714136 * v
    return np.clip(np.dstack([red, green, blue]), 0, 255).astype(np.uint8)


def _from_compressed(message: Any, settings: PictureSettings) -> Encoded:
    from PIL import Image, UnidentifiedImageError

    data = bytes(message.data)
    if "compressedDepth" in message.format:
        data = data[_PNG_HEADER_BYTES:]
    try:
        with Image.open(io.BytesIO(data)) as image:
            width, height = image.size
            if image.format == "JPEG" and width <= settings.max_width_px:
                return Encoded(data, width, height)
            if image.mode.startswith("I"):
                gray = gray_levels(np.asarray(image), settings.min_value, settings.max_value)
                deep = gray if settings.colormap == "gray" else colormap(settings.colormap)[gray]
                return _jpeg(Image.fromarray(deep), settings)
            return _jpeg(image.convert("RGB"), settings)
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError) as error:
        text = f"a picture of format '{message.format}' cannot be read: {error}"
        raise StudioError(text) from None


def _jpeg(image: Image, settings: PictureSettings) -> Encoded:
    from PIL.Image import Resampling

    width, height = image.size
    if width > settings.max_width_px:
        size = (settings.max_width_px, max(1, round(height * settings.max_width_px / width)))
        image = image.resize(size, Resampling.BILINEAR, reducing_gap=2.0)
    out = io.BytesIO()
    image.save(out, "JPEG", quality=settings.quality)
    return Encoded(out.getvalue(), width, height)


def checked_colormap(name: str) -> str:
    """Return a colour map's name if there is such a one.

    Raises:
        StudioError: there is none.
    """
    if name not in COLORMAPS:
        raise StudioError(f"there is no colour map '{name}'", known=COLORMAPS)
    return name
