"""Wavefront OBJ files and their MTL materials."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.documents.files import is_file
from gazelle.geometry.mesh import (
    Mesh,
    MeshError,
    MeshMaterial,
    MeshNote,
    MeshPart,
    part_from_corners,
)

__all__ = ["read_mtl", "read_obj"]

Corner = tuple[int, int, int]
_IGNORED = frozenset({"s", "l", "p", "vp", "mg", "lod", "shadow_obj", "trace_obj", "bevel"})


def read_mtl(text: str, file: Path) -> tuple[dict[str, MeshMaterial], tuple[MeshNote, ...]]:
    """Read a library's text.

    Returns:
        materials by name; notes about textures that are missing and lines that make no sense.
    """
    materials: dict[str, MeshMaterial] = {}
    notes: list[MeshNote] = []
    current = ""
    for number, line in enumerate(text.splitlines(), start=1):
        tokens = line.split()
        if not tokens or tokens[0].startswith("#"):
            continue
        if tokens[0] == "newmtl":
            current = " ".join(tokens[1:])
            materials[current] = MeshMaterial(current)
        elif current:
            try:
                materials[current] = _with(materials[current], tokens, file, notes)
            except (ValueError, IndexError):
                text_ = f"'{file.name}' line {number}: '{line.strip()}' cannot be understood"
                notes.append(MeshNote("mesh.incomplete", text_))
    return materials, tuple(notes)


def read_obj(data: bytes, file: Path) -> Mesh:
    """Read an OBJ file's bytes; lengths are metres, axes as written, as in Gazebo.

    Faces with more than three corners are split into a fan. Texture coordinates keep OBJ's
    sense (v up), missing normals are computed.

    Raises:
        MeshError: a line cannot be understood (with its number), or there are no faces.
    """
    reader = _Reader(file)
    for number, line in enumerate(data.decode("utf-8", "replace").splitlines(), start=1):
        tokens = line.split()
        if tokens and not tokens[0].startswith("#"):
            reader.line(number, tokens)
    return reader.mesh()


def _with(
    material: MeshMaterial, tokens: list[str], file: Path, notes: list[MeshNote]
) -> MeshMaterial:
    key = tokens[0].lower()
    if key == "ka":
        return replace(material, ambient=(*_rgb(tokens), 1.0))
    if key == "kd":
        return replace(material, diffuse=(*_rgb(tokens), material.diffuse[3]))
    if key == "ks":
        return replace(material, specular=(*_rgb(tokens), 1.0))
    if key == "ke":
        return replace(material, emissive=(*_rgb(tokens), 1.0))
    if key in {"d", "tr"}:
        value = float(tokens[-1])
        opacity = value if key == "d" else 1.0 - value
        return replace(material, diffuse=(*material.diffuse[:3], opacity))
    if key == "ns":
        return replace(material, shininess=float(tokens[1]))
    if key == "map_kd":
        return _textured(material, tokens[-1], file, notes)
    return material


def _rgb(tokens: list[str]) -> tuple[float, float, float]:
    return (float(tokens[1]), float(tokens[2]), float(tokens[3]))


def _textured(material: MeshMaterial, name: str, file: Path, notes: list[MeshNote]) -> MeshMaterial:
    plain = name.replace("\\", "/")
    leaf = Path(plain).name
    folder = file.parent
    for path in (
        folder / plain,
        folder / leaf,
        folder.parent / "materials" / "textures" / leaf,
    ):
        if is_file(path):
            return replace(material, texture=path)
    text = f"texture '{name}' not found beside '{file.name}', the part is shown plain"
    notes.append(MeshNote("mesh.missing-texture", text))
    return material


@dataclass(slots=True)
class _Group:
    name: str
    material: str
    corners: list[Corner] = field(default_factory=list)


class _Reader:
    def __init__(self, file: Path) -> None:
        self._file = file
        self._tables: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
        self._groups: dict[tuple[str, str], _Group] = {}
        self._name = self._material = ""
        self._materials: dict[str, MeshMaterial] = {}
        self._notes: dict[MeshNote, None] = {}

    def line(self, number: int, tokens: list[str]) -> None:
        key = tokens[0]
        try:
            if key in self._tables:
                self._tables[key].append(_numbers(tokens))
            elif key == "f":
                self._face(tokens[1:])
            elif key in {"o", "g"}:
                self._name = " ".join(tokens[1:])
            elif key == "usemtl":
                self._material = " ".join(tokens[1:])
            elif key == "mtllib":
                self._library(" ".join(tokens[1:]))
            elif key not in _IGNORED:
                text = f"'{key}' is not supported and has no effect (line {number})"
                self._notes.setdefault(MeshNote("mesh.incomplete", text))
        except (ValueError, IndexError) as error:
            raise MeshError(self._file, f"line {number}: '{' '.join(tokens)}': {error}") from error

    def _face(self, tokens: list[str]) -> None:
        corners = [self._corner(token) for token in tokens]
        if len(corners) < 3:
            raise ValueError("a face needs at least three corners")
        group = self._groups.setdefault(
            (self._name, self._material), _Group(self._name, self._material)
        )
        for index in range(1, len(corners) - 1):
            group.corners += (corners[0], corners[index], corners[index + 1])

    def _corner(self, token: str) -> Corner:
        parts = token.split("/")
        tables = (self._tables["v"], self._tables["vt"], self._tables["vn"])
        found = [-1, -1, -1]
        for slot, (part, table) in enumerate(zip(parts, tables, strict=False)):
            if part:
                index = int(part)
                found[slot] = index - 1 if index > 0 else len(table) + index
                if not 0 <= found[slot] < len(table):
                    kind = ("vertices", "texture coordinates", "normals")[slot]
                    raise IndexError(f"index {index} is outside the {len(table)} {kind} so far")
        if found[0] < 0:
            raise ValueError("a corner without a vertex index")
        return (found[0], found[1], found[2])

    def _library(self, name: str) -> None:
        path = self._file.parent / name
        try:
            text = path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            note = f"material library '{name}' not found; looked for {path}"
            self._notes[MeshNote("mesh.missing-material", note)] = None
            return
        materials, notes = read_mtl(text, path)
        self._materials.update(materials)
        self._notes.update(dict.fromkeys(notes))

    def mesh(self) -> Mesh:
        parts = tuple(self._part(group) for group in self._groups.values())
        if not parts:
            raise MeshError(self._file, "the OBJ has no faces")
        return Mesh(parts, self._file, tuple(self._notes))

    def _part(self, group: _Group) -> MeshPart:
        index = np.array(group.corners, np.intp)
        material = self._materials.get(group.material)
        if group.material and material is None and self._materials:
            text = f"material '{group.material}' is in no library"
            self._notes[MeshNote("mesh.missing-material", text)] = None
        return part_from_corners(
            self._column("v", index[:, 0], 3),
            index[:, 0],
            normals=self._normals(index[:, 2]),
            uv=None if (index[:, 1] < 0).any() else self._column("vt", index[:, 1], 2),
            name=group.name,
            material=material,
        )

    def _column(self, key: str, index: NDArray[np.intp], width: int) -> NDArray[np.float64]:
        table = np.array([row[:width] for row in self._tables[key]], np.float64)
        chosen: NDArray[np.float64] = table.reshape(-1, width)[index]
        if not np.isfinite(chosen).all():
            raise MeshError(self._file, f"a '{key}' line has a value that is not a finite number")
        return chosen

    def _normals(self, index: NDArray[np.intp]) -> NDArray[np.float64] | None:
        if (index < 0).any():
            return None
        normals = self._column("vn", index, 3)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return None if (lengths < 1e-9).any() else normals / lengths


def _numbers(tokens: list[str]) -> list[float]:
    numbers = [float(token) for token in tokens[1:4]]
    if tokens[0] == "vt":
        return [*numbers, 0.0][:2] if numbers else [0.0, 0.0]
    if len(numbers) < 3:
        raise ValueError("three numbers are needed")
    return numbers
