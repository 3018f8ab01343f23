# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""Compiled loops over the pixels of finished pictures."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.kernels import kernel

__all__ = ["Cloud", "DepthPicture", "fill_cloud", "mark_edges"]


class DepthPicture(NamedTuple):
    """What a depth camera saw.

    Attributes:
        depth_m: (rows, columns) along the viewing axis.
        rgb: (rows, columns, 3).
        has_rgb: whether there are colours.
    """

    depth_m: NDArray[np.float32]
    rgb: NDArray[np.uint8]
    has_rgb: bool


class Cloud(NamedTuple):
    """The memory of an organised cloud, twice.

    Attributes:
        floats: (rows, columns, 8), of which the first three are x, y and z, m.
        words: (rows, columns, 8), the same memory, of which the fifth is the colour.
    """

    floats: NDArray[np.float32]
    words: NDArray[np.uint32]


@kernel
def mark_edges(rgb, tiles, first_row, last_row, threshold):
    """Mark the tiles with a step of colour inside or at their border."""
    height, width = rgb.shape[0], rgb.shape[1]
    for tile_y in range(first_row // 4, (last_row + 3) // 4):
        for tile_x in range(tiles.shape[1]):
            edge = 0
            for y in range(tile_y * 4, min(tile_y * 4 + 4, height)):
                for x in range(tile_x * 4, min(tile_x * 4 + 4, width)):
                    right = min(x + 1, width - 1)
                    below = min(y + 1, height - 1)
                    left = max(x - 1, 0)
                    above = max(y - 1, 0)
                    for c in range(3):
                        # Signed: differences of bytes would wrap.
                        here = np.int32(rgb[y, x, c])
                        step = max(
                            abs(here - np.int32(rgb[y, right, c])),
                            abs(here - np.int32(rgb[y, left, c])),
                            abs(here - np.int32(rgb[below, x, c])),
                            abs(here - np.int32(rgb[above, x, c])),
                        )
                        if step > threshold:
                            edge = 1
            tiles[tile_y, tile_x] = edge


@kernel
def fill_cloud(picture, lens, limits, first_row, last_row, cloud):
    """Write rows of an organised cloud.

    `lens` is fx, fy, cx, cy and skew in pixels, `limits` are the nearest and the farthest depth
    that count, in metres, neither of which does itself.
    """
    depth, rgb, with_rgb = picture.depth_m, picture.rgb, picture.has_rgb
    points, colours = cloud.floats, cloud.words
    width = depth.shape[1]
    nothing = np.float32(np.nan)
    for v in range(first_row, last_row):
        y_over_z = (np.float32(v) - lens[3]) / lens[1]
        for u in range(width):
            z = depth[v, u]
            # A NaN fails both comparisons.
            if z > limits[0] and z < limits[1]:
                points[v, u, 0] = (np.float32(u) - lens[2] - lens[4] * y_over_z) / lens[0] * z
                points[v, u, 1] = y_over_z * z
                points[v, u, 2] = z
            else:
                points[v, u, 0] = nothing
                points[v, u, 1] = nothing
                points[v, u, 2] = nothing
            if with_rgb:
                colours[v, u, 4] = (
                    (np.uint32(rgb[v, u, 0]) << np.uint32(16))
                    | (np.uint32(rgb[v, u, 1]) << np.uint32(8))
                    | np.uint32(rgb[v, u, 2])
                )
