"""Meshes as OBJ files, which MuJoCo, Gazebo and RViz all read."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["obj_bytes"]

Array = NDArray[Any]


def obj_bytes(
    vertices_m: Array, faces: Array, normals: Array | None = None, uv: Array | None = None
) -> bytes:
    """Return an OBJ file; numbers have the digits that single precision needs.

    Args:
        vertices_m: (N, 3), kept in their order.
        faces: (M, 3) indices from 0.
        normals: (N, 3), one per vertex.
        uv: (N, 2), (0, 0) is the picture's lower left corner.
    """
    text = "# metres\n" + _rows("v", vertices_m)
    if uv is not None:
        text += _rows("vt", uv)
    if normals is not None:
        text += _rows("vn", normals)
    corner = "%d"
    if uv is not None or normals is not None:
        corner = f"%d/{'%d' if uv is not None else ''}{'/%d' if normals is not None else ''}"
    indices = np.asarray(faces, dtype=np.int64) + 1
    line = f"f {corner} {corner} {corner}\n"
    numbers = np.repeat(indices.ravel(), corner.count("%d")).tolist()
    return (text + line * len(indices) % tuple(numbers)).encode("ascii")


def _rows(word: str, values: Array) -> str:
    # Nine digits give every single-precision number back.
    rows = np.asarray(values, dtype=np.float32)
    line = f"{word} {' '.join(['%.9g'] * rows.shape[1])}\n"
    return line * len(rows) % tuple(rows.ravel().tolist())
