"""Clouds of points: from above at an angle, coloured by height."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.notebook.cameras import pixels_bundle
from gazelle.rich_display import Bundle
from gazelle.studio.displays.colours import colormap

__all__ = ["cloud_bundle", "cloud_pixels"]

_WIDTH, _HEIGHT = 640, 420
_BACKGROUND = (24, 27, 33)
_MAX_POINTS = 200_000
_TURN_RAD, _TILT_RAD = math.radians(-35.0), math.radians(35.0)


def cloud_bundle(points_m: ArrayLike, caption: str = "") -> Bundle:
    """Return points (N, 3), z upwards, as a notebook shows them."""
    points = np.asarray(points_m, np.float64).reshape(-1, 3)
    words = f"{len(points)} points"
    finite = points[np.isfinite(points).all(axis=1)]
    if len(finite):
        low, high = finite.min(axis=0), finite.max(axis=0)
        names = (f"{n} {a:.2f} … {b:.2f} m" for n, a, b in zip("xyz", low, high, strict=True))
        words += ", " + ", ".join(names)
    caption = f"{caption}, {words}" if caption else words
    return pixels_bundle(cloud_pixels(finite), caption)


def cloud_pixels(points_m: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return points (N, 3), finite, as a picture; of more than 200,000 some are left out."""
    picture = np.empty((_HEIGHT, _WIDTH, 3), np.uint8)
    picture[:] = _BACKGROUND
    if not len(points_m):
        return picture
    points = points_m[:: math.ceil(len(points_m) / _MAX_POINTS)]
    c, s = math.cos(_TURN_RAD), math.sin(_TURN_RAD)
    across = c * points[:, 1] + s * points[:, 0]
    away = c * points[:, 0] - s * points[:, 1]
    up = math.sin(_TILT_RAD) * away + math.cos(_TILT_RAD) * points[:, 2]
    # What is nearer is painted last.
    order = np.argsort(-away, kind="stable")
    flat = np.stack([-across, up], axis=1)[order]
    # A few points far away must not make the rest a speck.
    low, high = np.percentile(flat, (0.5, 99.5), axis=0)
    scale = min(np.array([_WIDTH, _HEIGHT]) * 0.92 / np.maximum(high - low, 1e-6))
    middle = 0.5 * (low + high)
    x = np.round(0.5 * _WIDTH + (flat[:, 0] - middle[0]) * scale).astype(np.int64)
    y = np.round(0.5 * _HEIGHT - (flat[:, 1] - middle[1]) * scale).astype(np.int64)
    colours = colormap("jet")[_levels(points[order, 2])]
    for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)) if len(points) < 40_000 else ((0, 0),):
        inside = (x + dx >= 0) & (x + dx < _WIDTH) & (y + dy >= 0) & (y + dy < _HEIGHT)
        picture[y[inside] + dy, x[inside] + dx] = colours[inside]
    return picture


def _levels(heights: NDArray[np.float64]) -> NDArray[np.uint8]:
    low, high = np.percentile(heights, (1.0, 99.0))
    share = (heights - low) / max(float(high - low), 1e-9)
    return np.asarray(np.clip(share, 0.0, 1.0) * 255.0).astype(np.uint8)
