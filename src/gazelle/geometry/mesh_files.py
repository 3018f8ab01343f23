"""Loading mesh files of every supported format, each file once."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import NamedTuple

import numpy as np

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import read_limited
from gazelle.geometry.dae import read_dae
from gazelle.geometry.gltf import read_gltf
from gazelle.geometry.mesh import Mesh, MeshError
from gazelle.geometry.obj import read_obj
from gazelle.geometry.stl import read_stl

__all__ = ["MAX_MESH_BYTES", "MESH_SUFFIXES", "load_mesh", "load_mesh_reported"]

_READERS: dict[str, Callable[[bytes, Path], Mesh]] = {
    ".dae": read_dae,
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".obj": read_obj,
    ".stl": read_stl,
}

MESH_SUFFIXES = tuple(sorted(_READERS))
"""File name endings of the formats that can be loaded, in lower case."""


MAX_MESH_BYTES = 1 << 30
"""Larger files of meshes are not read."""


class _Key(NamedTuple):
    path: str
    mtime_ns: int
    size: int
    is_smooth: bool


_loaded: dict[_Key, Mesh] = {}
_lock = Lock()


def load_mesh(path: str | os.PathLike[str], *, smooth: bool = True) -> Mesh:
    """Load a mesh file; the same unchanged file is read once per process.

    Args:
        path: ``.stl`` (text or binary), ``.dae``, ``.obj`` (with ``.mtl``), ``.gltf`` or ``.glb``;
            upper and lower case alike. A wrong suffix is found out from the content.
        smooth: normals are those of a smooth surface; False saves their computing, most of the
            time of an STL, for those who do not draw.

    Returns:
        the mesh; its arrays are read-only, since it is shared.

    Raises:
        MeshError: the file is missing, unreadable, malformed, empty or of another format.
    """
    file = Path(path)
    try:
        info = file.stat()
        key = _Key(str(file.absolute()), info.st_mtime_ns, info.st_size, smooth)
        with _lock:
            known = _loaded.get(key) or _loaded.get(key._replace(is_smooth=True))
        if known is not None:
            return known
        data = read_limited(file, MAX_MESH_BYTES)
    except OSError as error:
        raise MeshError(file, f"cannot be read: {error.strerror or error}") from error
    mesh = _read(data, file, smooth)
    with _lock:
        return _loaded.setdefault(key, mesh)


def load_mesh_reported(
    path: str | os.PathLike[str],
    diagnostics: Diagnostics,
    span: SourceSpan | None = None,
    *,
    smooth: bool = True,
) -> Mesh | None:
    """Load a mesh file; report what is wrong with it instead of raising.

    Args:
        path: the file.
        diagnostics: receives ``mesh.unreadable`` and the mesh's notes.
        span: where the file is referred to; the mesh file itself when None.
        smooth: as in `load_mesh`.

    Returns:
        None when the file cannot be used.
    """
    place = span or SourceSpan(str(path))
    try:
        mesh = load_mesh(path, smooth=smooth)
    except MeshError as error:
        diagnostics.report("mesh.unreadable", str(error), place)
        return None
    for note in mesh.notes:
        diagnostics.report(note.code, f"mesh '{path}': {note.message}", place)
    return mesh


def _read(data: bytes, file: Path, smooth: bool) -> Mesh:
    try:
        # Numbers that are too large show below; numpy would say so on standard error.
        with np.errstate(all="ignore"):
            reader = _reader(data, file)
            is_flat = reader is read_stl and not smooth
            mesh = read_stl(data, file, smooth=False) if is_flat else reader(data, file)
    except (MemoryError, RecursionError) as error:
        raise MeshError(file, "what it asks for does not fit into the memory") from error
    for part in mesh.parts:
        if not np.isfinite(part.vertices_m).all():
            text = f"a vertex of part '{part.name}' is not of finite numbers"
            raise MeshError(file, text)
    return mesh


def _reader(data: bytes, file: Path) -> Callable[[bytes, Path], Mesh]:
    if not data:
        raise MeshError(file, "the file is empty")
    if data.startswith(b"version https://git-lfs"):
        raise MeshError(
            file,
            "this is a Git LFS pointer, not the mesh; run 'git lfs pull' in the package's folder",
        )
    suffix = _sniffed_suffix(data) or file.suffix.lower()
    reader = _READERS.get(suffix)
    if reader is None:
        known = ", ".join(MESH_SUFFIXES)
        raise MeshError(file, f"'{file.suffix}' is no known mesh format; known are {known}")
    return reader


def _sniffed_suffix(data: bytes) -> str:
    head = data[:1024].lstrip(b"\xef\xbb\xbf \t\r\n")
    if head.startswith(b"glTF"):
        return ".glb"
    if head.startswith(b"<") and b"<COLLADA" in data[:4096]:
        return ".dae"
    return ""
