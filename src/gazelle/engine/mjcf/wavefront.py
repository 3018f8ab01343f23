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
    lines = ["# metres", *_rows("v", vertices_m)]
    if uv is not None:
        lines += _rows("vt", uv)
    if normals is not None:
        lines += _rows("vn", normals)
    for a, b, c in (np.asarray(faces) + 1).tolist():
        corners = (_corner(index, uv is not None, normals is not None) for index in (a, b, c))
        lines.append(f"f {' '.join(corners)}")
    return ("\n".join(lines) + "\n").encode("ascii")


def _rows(word: str, values: Array) -> list[str]:
    # numpy prints a float32 with the fewest digits that give it back.
    rows = np.asarray(values, dtype=np.float32)
    return [f"{word} {' '.join(str(value) for value in row)}" for row in rows]


def _corner(index: int, has_uv: bool, has_normal: bool) -> str:
    if not has_uv and not has_normal:
        return str(index)
    return f"{index}/{index if has_uv else ''}{f'/{index}' if has_normal else ''}"
