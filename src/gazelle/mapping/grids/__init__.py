"""Occupancy grids, and the map files of ``map_server`` and ``nav2_map_server``."""

from __future__ import annotations

from gazelle.mapping.grids.map_io import (
    MapWriteError,
    SaveOptions,
    read_map,
    read_map_image,
    write_map,
)
from gazelle.mapping.grids.map_yaml import MapFile, read_map_file
from gazelle.mapping.grids.occupancy_grid import OccupancyGrid
from gazelle.mapping.grids.pixels import MapMode, cells_of_pixels, pixels_of_cells

__all__ = [
    "MapFile",
    "MapMode",
    "MapWriteError",
    "OccupancyGrid",
    "SaveOptions",
    "cells_of_pixels",
    "pixels_of_cells",
    "read_map",
    "read_map_file",
    "read_map_image",
    "write_map",
]
