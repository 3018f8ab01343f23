"""What a grey value means in a map, and which grey value a cell becomes.

Two programs read and write these pictures and differ in details: ``map_server`` (ROS 1, noetic)
and ``nav2_map_server`` (ROS 2, humble and jazzy). ``ros_version`` 1 and 2 stand for them.
"""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import NDArray

__all__ = ["MapMode", "cells_of_pixels", "pixels_of_cells"]

_FREE, _OCCUPIED, _UNKNOWN = 0, 100, -1
_GREY_FREE, _GREY_OCCUPIED, _GREY_UNKNOWN = 254, 0, 205


class MapMode(Enum):
    """How grey values and cells go together; the names are those of the YAML."""

    TRINARY = "trinary"
    SCALE = "scale"
    RAW = "raw"


def cells_of_pixels(
    pixels: NDArray[np.uint8],
    mode: MapMode,
    *,
    negate: bool = False,
    occupied_thresh: float = 0.65,
    free_thresh: float = 0.196,
    ros_version: int = 1,
) -> NDArray[np.int8]:
    """Return the cells of a picture.

    Args:
        pixels: (height, width, channels), 1 grey, 3 red green blue, 4 and opacity; row 0 on top.
        mode: of the YAML.
        negate: white means occupied.
        occupied_thresh: above this occupancy (0 … 1) a cell is occupied.
        free_thresh: below this occupancy a cell is free.
        ros_version: 1 as ``map_server``, 2 as ``nav2_map_server``.

    Returns:
        int8, (height, width), row 0 at the bottom.
    """
    # In trinary mode both programs average opacity in with the colours.
    opaque = pixels.shape[2] == 4
    channels = pixels if mode is MapMode.TRINARY or not opaque else pixels[..., :3]
    grey = channels.mean(axis=2) if channels.shape[2] > 1 else channels[..., 0].astype(float)
    if mode is MapMode.RAW:
        return _raw(255 - grey if negate and ros_version == 1 else grey, ros_version)
    occupancy = (grey if negate else 255 - grey) / 255.0
    if mode is MapMode.TRINARY:
        between = np.full(occupancy.shape, _UNKNOWN)
    else:
        between = _scaled(occupancy, occupied_thresh, free_thresh, ros_version)
    cells = np.select(
        [occupancy > occupied_thresh, occupancy < free_thresh], [_OCCUPIED, _FREE], between
    )
    if mode is MapMode.SCALE and opaque:
        cells = _without_transparent(cells, pixels[..., 3], ros_version)
    return np.ascontiguousarray(cells[::-1].astype(np.int8))


def pixels_of_cells(
    cells: NDArray[np.int8],
    mode: MapMode,
    *,
    occupied: int = 65,
    free: int = 25,
) -> NDArray[np.uint8]:
    """Return the picture that the map savers write.

    Args:
        cells: (height, width), row 0 at the bottom.
        mode: trinary is what ``map_saver`` writes, ``nav2_map_server`` all three.
        occupied: percent from which on a cell is black, trinary only.
        free: percent up to which a cell is white, trinary only.

    Returns:
        (height, width, 1), or 4 channels in scale mode, row 0 on top.
    """
    cells = cells[::-1]
    known = (cells >= 0) & (cells <= 100)
    if mode is MapMode.RAW:
        return np.where(known, cells.astype(np.uint8), np.uint8(255))[..., None]
    if mode is MapMode.SCALE:
        share = np.where(known, (100.0 - cells) / 100.0, 0.5)
        # GraphicsMagick keeps 16 bits and rounds when it writes 8.
        level = ((np.floor(share * 65535) + 128) // 257).astype(np.uint8)
        opacity = np.where(known, 255, 0).astype(np.uint8)
        return np.stack((level, level, level, opacity), axis=2)
    grey = np.full(cells.shape, _GREY_UNKNOWN, np.uint8)
    grey[cells >= occupied] = _GREY_OCCUPIED
    grey[known & (cells <= free)] = _GREY_FREE
    return grey[..., None]


def _raw(grey: NDArray[np.float64], ros_version: int) -> NDArray[np.int8]:
    if ros_version == 1:
        # An unsigned char stored as int8: 255 becomes −1, 200 becomes −56.
        cells = np.floor(grey).astype(np.uint8).view(np.int8)
    else:
        level = np.rint(grey)
        cells = np.where(level <= _OCCUPIED, level, _UNKNOWN).astype(np.int8)
    return np.ascontiguousarray(cells[::-1])


def _scaled(
    occupancy: NDArray[np.float64], occupied: float, free: float, ros_version: int
) -> NDArray[np.float64]:
    # Equal thresholds leave at most the threshold itself between them.
    ratio = np.clip((occupancy - free) / max(occupied - free, 1e-9), 0.0, 1.0)
    return np.floor(1 + 98 * ratio) if ros_version == 1 else np.rint(ratio * 100.0)


def _without_transparent(
    cells: NDArray[np.float64], opacity: NDArray[np.uint8], ros_version: int
) -> NDArray[np.float64]:
    if ros_version == 1:
        # map_server looks at opacity only between the thresholds, and only for 0.
        between = (cells != _FREE) & (cells != _OCCUPIED)
        return np.where(between & (opacity < 1), _UNKNOWN, cells)
    return np.where(opacity < 255, _UNKNOWN, cells)
