"""Depth pictures and point clouds from a camera's depth."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.sensors.intrinsics import Intrinsics
from gazelle.sensors.row_threads import default_threads, each_band, row_bands

__all__ = ["POINT_DTYPE", "depth_image", "point_cloud"]

POINT_DTYPE = np.dtype(
    {
        "names": ["x", "y", "z", "rgb"],
        "formats": ["<f4", "<f4", "<f4", "<f4"],
        "offsets": [0, 4, 8, 16],
        "itemsize": 32,
    }
)
"""One point as gazebo_ros lays it out: 32 bytes, colour packed into a FLOAT32."""


def depth_image(
    depth_m: NDArray[np.float32], *, near_m: float = 0.0, far_m: float = math.inf
) -> NDArray[np.float32]:
    """Return (H, W) float32 metres along the viewing axis (``32FC1``), NaN outside (near, far).

    Args:
        depth_m: as rendered, inf for nothing.
        near_m: the plug-in's cut-off (``pointCloudCutoff``), itself excluded.
        far_m: its upper one (``pointCloudCutoffMax``), itself excluded.
    """
    seen = (depth_m > near_m) & (depth_m < far_m)
    return np.where(seen, depth_m, np.float32(np.nan))


def point_cloud(
    depth_m: NDArray[np.float32],
    rgb: NDArray[np.uint8] | None,
    intrinsics: Intrinsics,
    *,
    near_m: float = 0.0,
    far_m: float = math.inf,
    threads: int | None = None,
) -> NDArray[np.void]:
    """Back-project a depth picture into an organised cloud.

    Returns:
        (H, W) of `POINT_DTYPE` in the optical frame: x right, y down, z forward, metres, NaN
        where there is no depth. The bytes of `rgb` are 0x00RRGGBB as a little-endian word, as
        PCL and RViz read them (gazebo_ros writes them the other way round).

    Args:
        depth_m: (H, W) metres along the viewing axis; inf and NaN are nothing.
        rgb: (H, W, 3) uint8, None for no colour; colours are kept where there is no depth.
        intrinsics: of the ``rendering`` convention.
        near_m: see `depth_image`.
        far_m: see `depth_image`.
        threads: None for `default_threads`.
    """
    from gazelle.sensors.pixel_kernels import Cloud, DepthPicture, fill_cloud

    height, width = depth_m.shape
    words = np.zeros((height, width, 8), np.uint32)
    cloud = Cloud(words.view(np.float32), words)
    lens = np.array(
        [intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy, intrinsics.skew], np.float32
    )
    colours = np.zeros((1, 1, 3), np.uint8) if rgb is None else np.ascontiguousarray(rgb)
    depth = np.ascontiguousarray(depth_m, np.float32)
    picture = DepthPicture(depth, colours, rgb is not None)
    limits = np.array([near_m, far_m], np.float32)

    def band(first: int, last: int) -> None:
        fill_cloud(picture, lens, limits, first, last, cloud)

    count = default_threads() if threads is None else threads
    each_band(count, row_bands(height, count), band)
    return words.view(np.uint8).view(POINT_DTYPE).reshape(height, width)
