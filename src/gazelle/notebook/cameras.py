"""Camera pictures and depth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.notebook.html_parts import figure, picture_tag, png_of, png_text
from gazelle.rich_display import Bundle
from gazelle.studio.displays.colours import colormap
from gazelle.studio.displays.image_encodings import gray_levels

if TYPE_CHECKING:
    from gazelle.sensors import CameraRecord
    from gazelle.sensors.view_image import Picture

__all__ = ["camera_bundle", "depth_pixels", "picture_bundle", "pixels_bundle"]

_NOTHING_MET = (40, 40, 48)


def camera_bundle(record: CameraRecord) -> Bundle:
    """Return an exposure: the picture, its depth beside it."""
    parts, words = [], []
    if record.rgb is not None:
        parts.append(record.rgb)
        words.append(_size_text(record.rgb))
    if record.depth_m is not None:
        parts.append(depth_pixels(record.depth_m))
        words.append(_depth_text(record.depth_m))
    if not parts:
        return {}
    return pixels_bundle(np.concatenate(parts, axis=1), ", ".join(words))


def picture_bundle(picture: Picture) -> Bundle:
    """Return a picture of a robot or a world."""
    return pixels_bundle(picture.rgb, _size_text(picture.rgb))


def pixels_bundle(pixels: NDArray[np.uint8], caption: str, *, is_crisp: bool = False) -> Bundle:
    """Return pixels, grey (H, W) or coloured (H, W, 3), as a notebook shows them."""
    data = png_of(pixels, is_crisp=is_crisp)
    return {
        "text/html": figure(picture_tag(data, caption), caption),
        "image/png": png_text(data),
    }


def depth_pixels(depth_m: NDArray[Any]) -> NDArray[np.uint8]:
    """Return depth (H, W) in colours (H, W, 3): near is red, what met nothing dark grey."""
    measured = np.isfinite(depth_m) & (depth_m > 0)
    pixels = colormap("jet")[255 - gray_levels(np.where(measured, depth_m, np.nan))]
    pixels[~measured] = _NOTHING_MET
    return pixels


def _size_text(pixels: NDArray[np.uint8]) -> str:
    return f"{pixels.shape[1]}×{pixels.shape[0]} pixels"


def _depth_text(depth_m: NDArray[Any]) -> str:
    measured = depth_m[np.isfinite(depth_m)]
    if not len(measured):
        return f"depth {depth_m.shape[1]}×{depth_m.shape[0]}: nothing met"
    return f"depth {float(measured.min()):.2f} m (red) to {float(measured.max()):.2f} m (blue)"
