"""Collada (DAE) files through pycollada."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from gazelle.documents.files import is_file
from gazelle.geometry.mesh import (
    Mesh,
    MeshError,
    MeshMaterial,
    MeshNote,
    MeshPart,
    Rgba,
    part_from_corners,
)
from gazelle.geometry.vertex_normals import group_points

__all__ = ["read_dae"]

_MAX_NODES = 20_000

Matrix = NDArray[np.float64]


def read_dae(data: bytes, file: Path) -> Mesh:
    """Read a Collada file's bytes.

    The unit's ``meter`` and all node transforms are applied. ``<up_axis>`` is not: Gazebo and
    RViz do not look at it (gazebo-classic#1305, rviz#1045) and robot packages rely on that; a
    file that says other than ``Z_UP`` gets a note.

    Raises:
        MeshError: not Collada, malformed, or without triangles.
    """
    import collada

    if b"<!ENTITY" in data:
        raise MeshError(file, "XML entities are refused")
    if b"COLLADA" not in data[:4096]:
        raise MeshError(file, "cannot be read as Collada: there is no <COLLADA> element")
    try:
        document = collada.Collada(io.BytesIO(data), ignore=[collada.common.DaeError])
    except Exception as error:  # pycollada lets errors of its XML parser and of numpy through
        raise MeshError(file, f"cannot be read as Collada: {_one_line(error)}") from error
    reader = _Reader(document, file)
    scale = float(document.assetInfo.unitmeter or 1.0)
    try:
        parts = tuple(reader.parts(np.diag([scale, scale, scale, 1.0])))
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        # Indices that are out of their source, matrices that are none: looked at only now.
        raise MeshError(file, f"cannot be read as Collada: {_one_line(error)}") from error
    if not parts:
        raise MeshError(file, "the Collada scene has no triangles" + _why_empty(document))
    return Mesh(parts, file, reader.notes())


def _one_line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())


def _why_empty(document: Any) -> str:
    problems = [str(getattr(error, "msg", error)) for error in document.errors]
    if document.scene is None:
        problems.append("there is no <scene> to show")
    return f" ({'; '.join(problems[:3])})" if problems else ""


class _Reader:
    def __init__(self, document: Any, file: Path) -> None:
        self._document = document
        self._file = file
        self._materials: dict[int, MeshMaterial] = {}
        self._notes: dict[MeshNote, None] = {}
        self._nodes_left = _MAX_NODES

    def parts(self, matrix: Matrix) -> Iterator[MeshPart]:
        scene = self._document.scene
        if scene is not None:
            for node in scene.nodes:
                yield from self._node(node, matrix, "")

    def notes(self) -> tuple[MeshNote, ...]:
        notes = dict(self._notes)
        up = str(self._document.assetInfo.upaxis)
        if up != "Z_UP":
            text = f"<up_axis> is {up}; it is not applied, as in Gazebo and RViz"
            notes[MeshNote("mesh.up-axis", text)] = None
        for error in self._document.errors:
            text = f"parts of the Collada file cannot be used: {_one_line(error)}"
            notes[MeshNote("mesh.incomplete", text)] = None
        return tuple(notes)

    def _node(self, node: Any, matrix: Matrix, name: str) -> Iterator[MeshPart]:
        from collada.scene import ControllerNode, GeometryNode, Node, NodeNode

        self._nodes_left -= 1
        if self._nodes_left < 0:
            raise MeshError(self._file, f"the scene has more than {_MAX_NODES} nodes")
        if isinstance(node, GeometryNode):
            yield from self._geometry(node.geometry, node.materials, matrix, name)
        elif isinstance(node, ControllerNode):
            skin = node.controller
            bound = matrix @ np.asarray(getattr(skin, "bind_shape_matrix", np.eye(4)), float)
            if hasattr(skin, "geometry"):
                yield from self._geometry(skin.geometry, node.materials, bound, name)
        elif isinstance(node, NodeNode):
            yield from self._node(node.node, matrix, name)
        elif isinstance(node, Node):
            # Gazebo names a submesh after the node it hangs on.
            own = node.xmlnode.get("name") or node.xmlnode.get("id") or name
            inner = matrix @ np.asarray(node.matrix, np.float64)
            for child in node.children:
                yield from self._node(child, inner, own)

    def _geometry(
        self, geometry: Any, bindings: Any, matrix: Matrix, name: str
    ) -> Iterator[MeshPart]:
        symbols = {binding.symbol: binding.target for binding in bindings}
        for primitive in geometry.primitives:
            triangles = self._triangles(primitive)
            if triangles is None or not len(triangles):
                continue
            target = symbols.get(primitive.material)
            material = None if target is None else self._material(target)
            part = _part(triangles, name or geometry.name or geometry.id or "", material)
            if part is not None:
                yield part.transformed(matrix)

    def _triangles(self, primitive: Any) -> Any:
        from collada.polylist import Polylist
        from collada.triangleset import TriangleSet

        if isinstance(primitive, TriangleSet):
            return primitive
        if not isinstance(primitive, Polylist):
            return None
        counts = np.asarray(primitive.vcounts, np.int64)
        if (counts < 0).any() or counts.sum() > len(primitive.index):
            text = f"<vcount> claims {counts.sum()} corners, <p> has {len(primitive.index)}"
            raise MeshError(self._file, text)
        return primitive.triangleset()

    def _material(self, material: Any) -> MeshMaterial:
        known = self._materials.get(id(material))
        if known is None:
            known = self._materials[id(material)] = self._new_material(material)
        return known

    def _new_material(self, material: Any) -> MeshMaterial:
        effect = material.effect
        if effect is None:
            return MeshMaterial(material.name or material.id or "")
        texture = self._texture(effect.diffuse)
        opacity = _opacity(effect)
        diffuse = (1.0, 1.0, 1.0, 1.0) if texture else _colour(effect.diffuse, (0.0, 0.0, 0.0, 1.0))
        ambient = diffuse if texture else _colour(effect.ambient, diffuse)
        shininess = effect.shininess if isinstance(effect.shininess, int | float) else 0.0
        return MeshMaterial(
            name=material.name or material.id or "",
            ambient=ambient,
            diffuse=(*diffuse[:3], opacity),
            specular=_colour(effect.specular, (0.0, 0.0, 0.0, 1.0)),
            emissive=_colour(effect.emission, (0.0, 0.0, 0.0, 1.0)),
            shininess=float(shininess),
            texture=texture,
        )

    def _texture(self, value: Any) -> Path | None:
        from collada.material import Map

        if not isinstance(value, Map):
            return None
        written = str(value.sampler.surface.image.path)
        plain = unquote(written.removeprefix("file://")).replace("\\", "/")
        folder = self._file.parent
        # Exporters write absolute paths of the artist's machine; Gazebo looks beside the mesh
        # and in the model's materials/textures.
        leaf = Path(plain).name
        candidates = (
            folder / plain,
            folder / leaf,
            folder.parent / "materials" / "textures" / leaf,
        )
        for path in candidates:
            if is_file(path):
                return path
        places = ", ".join(str(path) for path in dict.fromkeys(candidates))
        text = f"texture '{written}' not found, the part is shown plain; looked for {places}"
        self._notes[MeshNote("mesh.missing-texture", text)] = None
        return None


def _part(triangles: Any, name: str, material: MeshMaterial | None) -> MeshPart | None:
    if triangles.vertex is None or triangles.vertex_index is None:
        return None
    positions = np.asarray(triangles.vertex, np.float64)
    vertex = np.asarray(triangles.vertex_index, np.intp).reshape(-1)
    positions = positions[vertex]
    return part_from_corners(
        positions,
        group_points(positions),
        normals=_normals(triangles),
        uv=_uv(triangles),
        name=name,
        material=material,
    )


def _normals(triangles: Any) -> NDArray[np.float64] | None:
    if triangles.normal is None or triangles.normal_index is None or not len(triangles.normal):
        return None
    table = np.asarray(triangles.normal, np.float64)
    lengths = np.linalg.norm(table, axis=1)
    index = np.asarray(triangles.normal_index, np.intp).reshape(-1)
    if not np.isfinite(table).all() or (lengths[index] < 1e-9).any():
        return None
    return (table / np.where(lengths > 0, lengths, 1.0)[:, None])[index]


def _uv(triangles: Any) -> NDArray[np.float64] | None:
    if not triangles.texcoordset or not len(triangles.texcoordset[0]):
        return None
    table = np.asarray(triangles.texcoordset[0], np.float64)[:, :2]
    index = np.asarray(triangles.texcoord_indexset[0], np.intp).reshape(-1)
    return np.ascontiguousarray(table[index])


def _colour(value: Any, default: Rgba) -> Rgba:
    if isinstance(value, tuple | list) and len(value) >= 3:
        alpha = float(value[3]) if len(value) > 3 else 1.0
        return (float(value[0]), float(value[1]), float(value[2]), alpha)
    return default


def _opacity(effect: Any) -> float:
    """COLLADA 1.4.1, "determining transparency": A_ONE by default, RGB_ZERO inverts."""
    factor = effect.transparency
    factor = float(factor) if isinstance(factor, int | float) else 1.0
    colour = effect.transparent
    if not isinstance(colour, tuple | list):
        # Exporters that write only a factor disagree about its sense; 0 would hide the part.
        return factor if factor > 0 else 1.0
    if str(effect.opaque_mode) == "RGB_ZERO":
        luminance = 0.212671 * colour[0] + 0.715160 * colour[1] + 0.072169 * colour[2]
        return 1.0 - factor * float(luminance)
    return factor * float(colour[3] if len(colour) > 3 else 1.0)
