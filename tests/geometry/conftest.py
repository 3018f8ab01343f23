from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from gazelle.geometry import MeshPart, box_mesh


@pytest.fixture
def box_corners() -> NDArray[np.float64]:
    """The twelve triangles of a box 1 x 2 x 3, (12, 3, 3)."""
    part = box_mesh((1.0, 2.0, 3.0))
    return part.vertices_m[part.faces]


@pytest.fixture
def binary_stl(box_corners) -> Callable[..., bytes]:
    def make(*, header: bytes = b"", promised: int | None = None, corners=box_corners) -> bytes:
        count = len(corners) if promised is None else promised
        data = header.ljust(80, b"\0") + struct.pack("<I", count)
        for triangle in corners:
            data += struct.pack("<12fH", 0, 0, 0, *np.ravel(triangle), 0)
        return data

    return make


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str, bytes | str], Path]:
    def make(name: str, data: bytes | str) -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data.encode() if isinstance(data, str) else data)
        return path

    return make


@pytest.fixture(scope="session")
def assert_well_formed() -> Callable[[MeshPart], None]:
    """Check shapes, types and unit normals that agree with the faces' winding."""

    def check(part: MeshPart) -> None:
        count = len(part.vertices_m)
        assert (part.vertices_m.dtype, part.faces.dtype) == (np.float64, np.int32)
        assert part.normals.shape == (count, 3)
        assert part.uv is None or part.uv.shape == (count, 2)
        assert part.faces.min() >= 0
        assert part.faces.max() < count
        np.testing.assert_allclose(np.linalg.norm(part.normals, axis=1), 1, atol=1e-9)
        corners = part.vertices_m[part.faces]
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        mean = part.normals[part.faces].mean(axis=1)
        assert (np.einsum("ij,ij->i", outward, mean) > 0).all()

    return check
