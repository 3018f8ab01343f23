"""Reading maps, and writing them byte for byte as the map savers do.

Two programs read and write these pictures and differ in details: ``map_server`` (ROS 1, noetic)
and ``nav2_map_server`` (ROS 2, humble and jazzy). ``ros_version`` 1 and 2 stand for them.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.documents.images import PictureError, opened_picture
from gazelle.errors import GazelleError
from gazelle.mapping.grids.map_yaml import (
    MapFile,
    read_map_file,
    report_bad_image,
    report_missing_image,
)
from gazelle.mapping.grids.occupancy_grid import OccupancyGrid
from gazelle.mapping.grids.pixels import MapMode, cells_of_pixels, pixels_of_cells

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["MapWriteError", "SaveOptions", "read_map", "read_map_image", "write_map"]


_FORMATS = ("bmp", "pgm", "png")


class MapWriteError(GazelleError):
    """A map cannot be written as asked."""


@dataclass(frozen=True, slots=True)
class SaveOptions:
    """How a map is written.

    Attributes:
        ros_version: 1 as ``map_saver`` of ``map_server``, 2 as that of ``nav2_map_server``.
        mode: ``map_saver`` of generation 1 knows trinary only.
        image_format: ``pgm``, ``png`` or ``bmp``; empty for png in scale mode, else pgm.
        occupied_thresh: occupancy 0 … 1 from which on a cell is black.
        free_thresh: occupancy 0 … 1 up to which a cell is white.
    """

    ros_version: int = 1
    mode: MapMode = MapMode.TRINARY
    image_format: str = ""
    occupied_thresh: float = 0.65
    free_thresh: float = 0.25


def write_map(
    grid: OccupancyGrid, stem: Path | str, options: SaveOptions = SaveOptions()
) -> tuple[Path, Path]:
    """Write ``STEM.pgm`` (or png, bmp) and ``STEM.yaml``; returns both paths.

    The YAML of generation 1 names the picture as `stem` was given, as ``map_saver`` does: a
    relative name counts from where the YAML is read. PNG and BMP hold the same pixels as the
    original's; their bytes depend on the library that packs them.

    Raises:
        MapWriteError: the options contradict each other, or a file cannot be written.
    """
    _check(options)
    kind = options.image_format.lower() or ("png" if options.mode is MapMode.SCALE else "pgm")
    image, described = Path(f"{stem}.{kind}"), Path(f"{stem}.yaml")
    occupied, free = round(options.occupied_thresh * 100), round(options.free_thresh * 100)
    pixels = pixels_of_cells(grid.cells, options.mode, occupied=occupied, free=free)
    text = _yaml_ros1(grid, image) if options.ros_version == 1 else _yaml_ros2(grid, image, options)
    try:
        image.write_bytes(_picture(pixels, kind, grid.resolution_m, options.ros_version))
        described.write_text(text, encoding="utf-8")
    except OSError as error:
        raise MapWriteError(
            f"Couldn't save map file to {error.filename or image}: {error.strerror}"
        ) from None
    return image, described


def _check(options: SaveOptions) -> None:
    if options.image_format and options.image_format.lower() not in _FORMATS:
        hint = did_you_mean(options.image_format, _FORMATS) or f"there are {', '.join(_FORMATS)}"
        raise MapWriteError(f"image format '{options.image_format}' is not written; {hint}")
    if options.ros_version == 1 and options.mode is not MapMode.TRINARY:
        raise MapWriteError(
            f"map_saver of map_server writes trinary maps only, not {options.mode.value}; "
            "nav2_map_server's map_saver_cli writes the others"
        )
    if options.occupied_thresh > 1:
        raise MapWriteError("Threshold_occupied must be 1.0 or less")
    if options.free_thresh < 0:
        raise MapWriteError("Free threshold must be 0.0 or greater")
    if options.occupied_thresh <= options.free_thresh:
        raise MapWriteError("Threshold_free must be smaller than threshold_occupied")


def _picture(pixels: NDArray[np.uint8], kind: str, resolution_m: float, ros_version: int) -> bytes:
    if kind == "pgm":
        height, width = pixels.shape[:2]
        creator = f"# CREATOR: map_saver.cpp {resolution_m:.3f} m/pix\n" if ros_version == 1 else ""
        return f"P5\n{creator}{width} {height}\n255\n".encode() + pixels[..., 0].tobytes()
    import io

    from PIL import Image

    held = io.BytesIO()
    whole = pixels[..., 0] if pixels.shape[2] == 1 else pixels
    Image.fromarray(np.ascontiguousarray(whole)).save(held, kind.upper())
    return held.getvalue()


def _yaml_ros1(grid: OccupancyGrid, image: Path) -> str:
    x, y, yaw = grid.origin
    return (
        f"image: {image}\nresolution: {grid.resolution_m:.6f}\n"
        f"origin: [{x:.6f}, {y:.6f}, {yaw:.6f}]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n"
    )


def _yaml_ros2(grid: OccupancyGrid, image: Path, options: SaveOptions) -> str:
    """What the emitter of yaml-cpp prints with 7 digits: no line end at the end."""
    thresholds = (0.65, 0.196)
    if options.mode is not MapMode.TRINARY:
        thresholds = (options.occupied_thresh, options.free_thresh)
    x, y, yaw = (_digits(value) for value in grid.origin)
    return (
        f"image: {image.name}\nmode: {options.mode.value}\n"
        f"resolution: {_digits(grid.resolution_m)}\norigin: [{x}, {y}, {yaw}]\nnegate: 0\n"
        f"occupied_thresh: {_digits(thresholds[0])}\nfree_thresh: {_digits(thresholds[1])}"
    )


def _digits(value: float) -> str:
    return f"{value:.7g}"


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
