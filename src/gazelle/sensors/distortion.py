"""Lens distortion after Brown, as Gazebo applies it to pictures."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import LensDistortion

__all__ = ["distort", "is_distorting", "source_pixels"]

# In fractions of the picture: where to stop, what counts as not found, where to put that.
_CLOSE, _LOST, _FAR = 1e-7, 1e-4, 3.0
_STEPS = 60


def is_distorting(distortion: LensDistortion | None) -> bool:
    """Return whether any coefficient is not zero."""
    return distortion is not None and any(
        (distortion.k1, distortion.k2, distortion.k3, distortion.p1, distortion.p2)
    )


def distort(image: NDArray[np.uint8], distortion: LensDistortion) -> NDArray[np.uint8]:
    """Return the picture a distorting lens gives.

    Brown's model in the units of Gazebo's Distortion: coordinates are fractions of the picture
    about `center`, so that r² is 0.5 in the corners. A point at (x, y) appears at ::

        x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)
        y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y

    With k1 < 0 (barrel) the result is enlarged to the distance of the corners, so that no border
    stays empty; what comes from outside otherwise is black.

    Args:
        image: (H, W, C) or (H, W) uint8.
        distortion: the lens.
    """
    if not is_distorting(distortion):
        return image
    index, weight, outside = _map(distortion, image.shape[0], image.shape[1])
    flat = image.reshape(image.shape[0] * image.shape[1], -1)
    mixed = np.zeros(flat.shape, np.float32)
    for corner in range(4):
        mixed += weight[corner][:, None] * flat[index[corner]]
    mixed[outside] = 0
    return np.round(mixed).astype(np.uint8).reshape(image.shape)


def source_pixels(
    distortion: LensDistortion, height: int, width: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return for each pixel of the distorted picture its x and y in the undistorted one, (H, W).

    The model is inverted by fixed-point iteration. Where a lens folds, so that nothing appears at
    a pixel, the result lies outside the picture.
    """
    cx, cy = distortion.center
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    target_x, target_y = u - cx, v - cy
    if distortion.k1 < 0:
        low_x, low_y = _forward(distortion, np.array(-cx), np.array(-cy))
        high_x, high_y = _forward(distortion, np.array(1 - cx), np.array(1 - cy))
        target_x = low_x + u * (high_x - low_x)
        target_y = low_y + v * (high_y - low_y)
    x, y = _inverse(distortion, target_x, target_y)
    return (x + cx) * width - 0.5, (y + cy) * height - 0.5


def _forward(
    lens: LensDistortion, x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    r2 = x * x + y * y
    radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))
    return (
        x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x),
        y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y,
    )


def _inverse(
    lens: LensDistortion, target_x: NDArray[np.float64], target_y: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    x, y = target_x.copy(), target_y.copy()
    for _ in range(_STEPS):
        got_x, got_y = _forward(lens, x, y)
        step_x, step_y = target_x - got_x, target_y - got_y
        if max(np.abs(step_x).max(), np.abs(step_y).max()) < _CLOSE:
            break
        # Shortened steps converge where the slope of the lens is below 2.8.
        x = np.clip(x + 0.7 * step_x, -_FAR, _FAR)
        y = np.clip(y + 0.7 * step_y, -_FAR, _FAR)
    got_x, got_y = _forward(lens, x, y)
    lost = np.maximum(np.abs(target_x - got_x), np.abs(target_y - got_y)) > _LOST
    return np.where(lost, _FAR, x), np.where(lost, _FAR, y)


@lru_cache(maxsize=8)
def _map(
    distortion: LensDistortion, height: int, width: int
) -> tuple[NDArray[np.int64], NDArray[np.float32], NDArray[np.bool_]]:
    """Return (4, N) pixel numbers, (4, N) bilinear weights and (N,) pixels without a source."""
    x, y = source_pixels(distortion, height, width)
    outside = ~((x > -1) & (x < width) & (y > -1) & (y < height))
    x, y = np.where(outside, 0, x), np.where(outside, 0, y)
    left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    fx, fy = (x - left).astype(np.float32), (y - top).astype(np.float32)
    columns = [np.clip(left + step, 0, width - 1) for step in (0, 1)]
    rows = [np.clip(top + step, 0, height - 1) for step in (0, 1)]
    index = [rows[i] * width + columns[j] for i in (0, 1) for j in (0, 1)]
    weight = [(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy]
    flat = (-1,)
    return (
        np.stack([item.reshape(flat) for item in index]),
        np.stack([item.reshape(flat) for item in weight]),
        outside.reshape(flat),
    )
