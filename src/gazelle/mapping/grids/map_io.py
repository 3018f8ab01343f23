"""Reading maps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.documents.images import PictureError, opened_picture
from gazelle.mapping.grids.map_yaml import (
    MapFile,
    read_map_file,
    report_bad_image,
    report_missing_image,
)
from gazelle.mapping.grids.occupancy_grid import OccupancyGrid
from gazelle.mapping.grids.pixels import cells_of_pixels

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["read_map", "read_map_image"]

_DEEP = ("I", "I;16", "I;16B", "I;16L", "I;16N")


def read_map(
    path: Path | str, diagnostics: Diagnostics, *, ros_version: int = 1
) -> OccupancyGrid | None:
    """Read a map's YAML and its picture.

    Args:
        path: of the YAML.
        diagnostics: takes the findings, all at once.
        ros_version: 1 reads grey values and words errors as ``map_server`` does, 2 as
            ``nav2_map_server`` does.

    Returns:
        The grid; None when there is an error.
    """
    described = read_map_file(path, diagnostics, ros_version)
    return None if described is None else read_map_image(described, diagnostics, ros_version)


def read_map_image(
    described: MapFile, diagnostics: Diagnostics, ros_version: int = 1
) -> OccupancyGrid | None:
    """Read the picture that a map's YAML names; None when it cannot be read."""
    pixels = _pixels(described, diagnostics, ros_version)
    if pixels is None:
        return None
    cells = cells_of_pixels(
        pixels,
        described.mode,
        negate=described.negate,
        occupied_thresh=described.occupied_thresh,
        free_thresh=described.free_thresh,
        ros_version=ros_version,
    )
    return OccupancyGrid(cells, described.resolution_m, described.origin)


def _pixels(
    described: MapFile, diagnostics: Diagnostics, ros_version: int
) -> NDArray[np.uint8] | None:
    path, span = described.image, described.image_span
    try:
        # Maps are as large as the buildings are: Pillow's own limit is theirs.
        with opened_picture(path, most_pixels=None) as picture:
            return _channels(picture)
    except FileNotFoundError:
        report_missing_image(path, span, diagnostics, ros_version)
        return None
    except (OSError, PictureError) as error:
        problem = getattr(error, "strerror", None) or str(error)
    report_bad_image(path, problem, span, diagnostics, ros_version)
    return None


def _channels(picture: Image) -> NDArray[np.uint8]:
    """Return (height, width, 1, 3 or 4)."""
    if picture.mode in _DEEP:
        return (np.asarray(picture, np.int64) // 257).clip(0, 255).astype(np.uint8)[..., None]
    transparent = "A" in picture.mode or "transparency" in picture.info
    grey = picture.mode in ("1", "L")
    wanted = "L" if grey else "RGBA" if transparent else "RGB"
    pixels = np.asarray(picture.convert(wanted), np.uint8)
    return pixels[..., None] if pixels.ndim == 2 else pixels
