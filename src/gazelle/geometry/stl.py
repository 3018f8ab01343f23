"""STL files, binary and ASCII."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry.mesh import Mesh, MeshError, MeshNote, part_from_soup

__all__ = ["read_stl"]

_HEADER_BYTES = 84
_TRIANGLE = np.dtype(
    [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")], align=False
)


def read_stl(data: bytes, file: Path, *, smooth: bool = True) -> Mesh:
    """Read an STL file's bytes; lengths are taken as metres, as ROS and Gazebo do.

    The stored facet normals are not used: many exporters write zeros. They are computed from
    the vertices' order.

    Args:
        data: the file's bytes.
        file: its name, for messages.
        smooth: as in `part_from_soup`.

    Raises:
        MeshError: truncated, malformed or empty.
    """
    corners, notes = _corners_ascii(data, file) if _is_ascii(data) else _corners_binary(data, file)
    if not len(corners):
        raise MeshError(file, "the STL has no triangles")
    if not np.isfinite(corners).all():
        bad = int(np.flatnonzero(~np.isfinite(corners).all(axis=(1, 2)))[0])
        raise MeshError(file, f"triangle {bad} has a coordinate that is not a finite number")
    return Mesh((part_from_soup(corners, smooth=smooth),), file, notes)


def _is_ascii(data: bytes) -> bool:
    """Many binary files start with "solid" too: the triangle count must not fit."""
    if data[:512].lstrip()[:5].lower() != b"solid":
        return False
    if len(data) >= _HEADER_BYTES:
        count = int.from_bytes(data[80:84], "little")
        if len(data) == _HEADER_BYTES + count * _TRIANGLE.itemsize:
            return False
    # A truncated binary file fits no count; its text has bytes no text has.
    return b"\0" not in data[:1024] and (b"facet" in data[:4096] or b"endsolid" in data[:4096])


def _corners_binary(data: bytes, file: Path) -> tuple[NDArray[np.float64], tuple[MeshNote, ...]]:
    if len(data) < _HEADER_BYTES:
        raise MeshError(
            file,
            f"{len(data)} bytes are too few for an STL file: a binary one starts with an 80-byte "
            "header and a 4-byte triangle count, a text one with 'solid'",
        )
    promised = int.from_bytes(data[80:84], "little")
    found = (len(data) - _HEADER_BYTES) // _TRIANGLE.itemsize
    if found < promised:
        raise MeshError(
            file,
            f"truncated binary STL: the header promises {promised} triangles "
            f"({_HEADER_BYTES + promised * _TRIANGLE.itemsize} bytes), the file holds {found} "
            f"({len(data)} bytes)",
        )
    notes: tuple[MeshNote, ...] = ()
    extra = len(data) - _HEADER_BYTES - promised * _TRIANGLE.itemsize
    if extra:
        text = f"{extra} bytes after the last of {promised} triangles are not used"
        notes = (MeshNote("mesh.extra-bytes", text),)
    records = np.frombuffer(data, _TRIANGLE, promised, _HEADER_BYTES)
    return records["corners"].astype(np.float64), notes


def _corners_ascii(data: bytes, file: Path) -> tuple[NDArray[np.float64], tuple[MeshNote, ...]]:
    # The solid's name may be any words, 'vertex' included: lines are what counts.
    lines = [line for line in data.splitlines() if line.lstrip()[:6].lower() == b"vertex"]
    if len(lines) % 3:
        raise MeshError(
            file, f"truncated ASCII STL: {len(lines)} vertices do not make whole triangles"
        )
    if b"endsolid" not in data[-4096:].lower():
        raise MeshError(
            file,
            f"truncated ASCII STL: 'endsolid' is missing after {len(lines) // 3} triangles",
        )
    tokens = [token for line in lines for token in line.split()[1:4]]
    try:
        if len(tokens) != 3 * len(lines):
            raise ValueError("a vertex line has fewer than three numbers")
        values = np.array(tokens, dtype="S").astype(np.float64)
    except ValueError as error:
        raise MeshError(file, f"{_first_bad_line(data)}: {error}") from error
    return values.reshape(-1, 3, 3), ()


def _first_bad_line(data: bytes) -> str:
    for number, line in enumerate(data.splitlines(), start=1):
        tokens = line.split()
        if tokens[:1] and tokens[0].lower() == b"vertex" and not _are_numbers(tokens[1:4]):
            return f"line {number}: '{line.strip().decode('ascii', 'replace')}'"
    return "a vertex"


def _are_numbers(tokens: list[bytes]) -> bool:
    try:
        return len([float(token) for token in tokens]) == 3
    except ValueError:
        return False
