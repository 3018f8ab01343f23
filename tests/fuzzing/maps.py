"""Maps, pictures, heights and logs of robots."""

from __future__ import annotations

import io
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from tests.fuzzing.kind import Kind

from gazelle.description.model import Heightmap
from gazelle.diagnostics import Diagnostics
from gazelle.engine.collision_geoms import read_terrain
from gazelle.mapping.grids import read_map
from gazelle.mapping.logs import read_log
from gazelle.mapping.slam import SlamParameters, load_graph
from gazelle.sensors.shading_tables import TextureAtlas
from gazelle.workspace import Workspace

__all__ = ["MAPS"]

_MAP = """\
image: %s
mode: trinary
resolution: 0.05
origin: [-1.0, -2.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
_CARMEN = b"""\
# message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp
PARAM robot_front_laser_max 20.0 1.0 host 1.0
ODOM 0.0 0.0 0.0 0.0 0.0 0.0 1.0 host 1.0
FLASER 5 1.0 1.5 2.0 1.5 1.0 0.0 0.0 0.0 0.1 0.2 0.0 1.0 host 1.0
ROBOTLASER1 0 -1.570796 3.141593 0.785398 20.0 0.1 0 5 1.0 1.5 2.0 1.5 1.0 0 \
0.1 0.2 0.0 0.1 0.2 0.0 0 0 0 0 0 2.0 host 2.0
"""


def _map(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    picture = path.with_name("map.pgm")
    if not picture.exists():
        picture.write_bytes(_pgm())
    for ros_version in (1, 2):
        read_map(path, diagnostics, ros_version=ros_version)


def _picture_of_map(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    described = path.with_name("map.yaml")
    described.write_text(_MAP % path.name)
    for ros_version in (1, 2):
        read_map(described, diagnostics, ros_version=ros_version)


def _texture(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    textures = TextureAtlas(diagnostics)
    textures.add(path)
    textures.add(path.read_bytes())
    textures.packed()


def _terrain(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    read_terrain(Heightmap(path=path, uri=path.name), "ground", None, diagnostics)


def _log(path: Path, diagnostics: Diagnostics, _workspace: Workspace) -> None:
    for _ in read_log(path, diagnostics):
        pass


def _graph(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    load_graph(path, SlamParameters())


def _pixels() -> NDArray[np.uint8]:
    return (np.arange(60, dtype=np.uint8) * 4).reshape(6, 10)


def _encoded(kind: str, mode: str = "L") -> bytes:
    data = io.BytesIO()
    Image.fromarray(_pixels()).convert(mode).save(data, kind)
    return data.getvalue()


def _pgm() -> bytes:
    return b"P5\n# a map\n10 6\n255\n" + _pixels().tobytes()


def _ascii_pgm() -> bytes:
    rows = "\n".join(" ".join(map(str, row)) for row in _pixels())
    return f"P2\n# a map\n10 6\n255\n{rows}\n".encode()


def _archive() -> bytes:
    data = io.BytesIO()
    columns: dict[str, Any] = {
        "t": np.arange(2.0), "scans": np.ones((2, 5)), "odo": np.zeros((2, 3)),
        "angle_min": np.float64(-1.0), "lidar": np.zeros(3),
    }  # fmt: skip
    np.savez(data, **columns)
    return data.getvalue()


def _saved_graph() -> bytes:
    """Return what `save_graph` writes of two scans; making them would compile the engine."""
    data = io.BytesIO()
    columns: dict[str, Any] = {
        "format": np.array("gazelle posegraph 1"), "poses": np.zeros((2, 3)),
        "ways_m": np.array([0.0, 0.5]), "ranges_m": np.full(10, 2.0),
        "beams": np.array([5, 5]), "stamps_ns": np.array([0, 10**9]),
        "scans": np.tile([-1.5, 0.75, 0.1, 20.0, 0.1, 0.0, 0.0, 0.0], (2, 1)),
        "edge_tail": np.array([0]), "edge_head": np.array([1]), "edge_relative": np.zeros((1, 3)),
        "edge_information": np.eye(3)[None], "edge_is_loop": np.array([False]),
    }  # fmt: skip
    np.savez(data, **columns)
    return data.getvalue()


MAPS: dict[str, Kind] = {
    "carmen": Kind(lambda: _CARMEN, "a.log", _log),
    "log_archive": Kind(_archive, "a.npz", _log),
    "map": Kind((_MAP % "map.pgm").encode, "map.yaml", _map),
    "map_bmp": Kind(partial(_encoded, "BMP"), "map.bmp", _picture_of_map),
    "map_pgm": Kind(_pgm, "map.pgm", _picture_of_map),
    "map_pgm_ascii": Kind(_ascii_pgm, "map.pgm", _picture_of_map),
    "map_png": Kind(partial(_encoded, "PNG"), "map.png", _picture_of_map),
    "pose_graph": Kind(_saved_graph, "a.posegraph", _graph),
    "terrain": Kind(partial(_encoded, "PNG"), "ground.png", _terrain),
    "texture_jpeg": Kind(partial(_encoded, "JPEG"), "a.jpg", _texture),
    "texture_png": Kind(partial(_encoded, "PNG", "RGB"), "a.png", _texture),
    "texture_tga": Kind(partial(_encoded, "TGA", "RGB"), "a.tga", _texture),
    "texture_tiff": Kind(partial(_encoded, "TIFF", "RGB"), "a.tif", _texture),
}
