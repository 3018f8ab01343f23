"""glTF 2.0 files, as JSON with buffers (.gltf) or in one piece (.glb)."""

from __future__ import annotations

import base64
import binascii
import json
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
    part_from_corners,
)
from gazelle.geometry.pose import Pose
from gazelle.geometry.vertex_normals import group_points, unit_rows

__all__ = ["read_gltf"]

_GLB_MAGIC = b"glTF"
_JSON_CHUNK = 0x4E4F534A
_BINARY_CHUNK = 0x004E4942
_COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_MAX_NODE_DEPTH = 100
_MAX_NODES = 20_000
_MAX_ZEROS = 1_000_000

Matrix = NDArray[np.float64]


def read_gltf(data: bytes, file: Path) -> Mesh:
    """Read a glTF file's bytes; node transforms are applied, axes stay as written.

    glTF is y-up by its specification; Gazebo shows its coordinates as they are (gz-common#543), so
    nothing is rotated here.

    Raises:
        MeshError: malformed, without triangles, or it needs an extension (such as Draco or
            meshopt compression) that is not supported.
    """
    try:
        return _Reader(data, file).mesh()
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise MeshError(file, f"malformed glTF: {reason}") from error


class _Reader:
    def __init__(self, data: bytes, file: Path) -> None:
        self._file = file
        text, self._binary = _chunks(data, file)
        self._json: dict[str, Any] = json.loads(text)
        self._notes: dict[MeshNote, None] = {}
        self._buffers: dict[int, bytes] = {}
        self._nodes_left = _MAX_NODES
        needed = self._json.get("extensionsRequired", [])
        plain = {"KHR_materials_unlit", "KHR_texture_transform", "KHR_materials_specular"}
        unknown = [name for name in needed if name not in plain]
        if unknown:
            raise MeshError(file, f"it needs the glTF extension {', '.join(unknown)}")

    def mesh(self) -> Mesh:
        parts = tuple(part for root in self._roots() for part in self._node(root, np.eye(4), 0))
        if not parts:
            raise MeshError(self._file, "the glTF scene has no triangles")
        return Mesh(parts, self._file, tuple(self._notes))

    def _roots(self) -> list[int]:
        scenes = self._json.get("scenes")
        if scenes:
            return list(scenes[self._json.get("scene", 0)].get("nodes", []))
        nodes = self._json.get("nodes", [])
        children = {child for node in nodes for child in node.get("children", [])}
        return [index for index in range(len(nodes)) if index not in children]

    def _node(self, index: int, matrix: Matrix, depth: int) -> Iterator[MeshPart]:
        if depth > _MAX_NODE_DEPTH:
            raise MeshError(self._file, "the nodes are nested in a cycle")
        self._nodes_left -= 1
        if self._nodes_left < 0:
            raise MeshError(self._file, f"the scene has more than {_MAX_NODES} nodes")
        node = self._json["nodes"][index]
        inner = matrix @ _transform(node)
        if "mesh" in node:
            mesh = self._json["meshes"][node["mesh"]]
            name = str(node.get("name") or mesh.get("name") or "")
            for primitive in mesh["primitives"]:
                part = self._primitive(primitive, name)
                if part is not None:
                    yield part.transformed(inner)
        for child in node.get("children", []):
            yield from self._node(child, inner, depth + 1)

    def _primitive(self, primitive: dict[str, Any], name: str) -> MeshPart | None:
        mode = primitive.get("mode", _TRIANGLES)
        attributes = primitive["attributes"]
        if mode not in {_TRIANGLES, _STRIP, _FAN} or "POSITION" not in attributes:
            return None
        positions = self._accessor(attributes["POSITION"])
        if "indices" in primitive:
            flat = self._accessor(primitive["indices"]).astype(np.intp).reshape(-1)
        else:
            flat = np.arange(len(positions))
        index = _triangle_corners(flat, mode)
        if not len(index):
            return None
        vertex = group_points(positions)
        normals, uv = (self._attribute(attributes, key) for key in ("NORMAL", "TEXCOORD_0"))
        material = self._material(primitive.get("material"))
        return part_from_corners(
            positions[index],
            vertex[index],
            normals=None if normals is None else unit_rows(normals[index]),
            # glTF counts v from the picture's top.
            uv=None if uv is None else np.array([0.0, 1.0]) + uv[index] * (1.0, -1.0),
            name=name,
            material=material,
        )

    def _attribute(self, attributes: dict[str, int], key: str) -> Matrix | None:
        return self._accessor(attributes[key]) if key in attributes else None

    def _accessor(self, index: int) -> Matrix:
        accessor = self._json["accessors"][index]
        dtype, width = np.dtype(_COMPONENTS[accessor["componentType"]]), _WIDTHS[accessor["type"]]
        count = int(accessor["count"])
        if "bufferView" in accessor:
            offset = accessor.get("byteOffset", 0)
            values = self._view(accessor["bufferView"], offset, dtype, (count, width))
        else:
            # Zeros for the places that a sparse accessor does not name cost no bytes of the file.
            if count > _MAX_ZEROS:
                raise MeshError(self._file, f"{count} values are claimed that no buffer holds")
            values = np.zeros((count, width), dtype)
        if "sparse" in accessor:
            values = self._sparse(accessor["sparse"], values)
        result = values.astype(np.float64)
        if accessor.get("normalized") and dtype.kind in "iu":
            result = np.maximum(result / np.iinfo(dtype).max, -1.0)
        return result

    def _view(
        self, index: int, offset: int, dtype: np.dtype[Any], shape: tuple[int, int]
    ) -> NDArray[Any]:
        view = self._json["bufferViews"][index]
        data = self._buffer(view["buffer"])
        start = view.get("byteOffset", 0) + offset
        stride = view.get("byteStride", dtype.itemsize * shape[1])
        if stride < dtype.itemsize * shape[1]:
            raise MeshError(self._file, f"byteStride {stride} is less than one value needs")
        needed = start + stride * (shape[0] - 1) + dtype.itemsize * shape[1]
        if shape[0] and needed > len(data):
            raise MeshError(
                self._file, f"a buffer is truncated: {needed} bytes needed, {len(data)} there"
            )
        return np.ndarray(shape, dtype, data, start, (stride, dtype.itemsize))

    def _sparse(self, sparse: dict[str, Any], values: NDArray[Any]) -> NDArray[Any]:
        count, spots, fresh = int(sparse["count"]), sparse["indices"], sparse["values"]
        kind = np.dtype(_COMPONENTS[spots["componentType"]])
        at = self._view(spots["bufferView"], spots.get("byteOffset", 0), kind, (count, 1))
        shape = (count, values.shape[1])
        new = self._view(fresh["bufferView"], fresh.get("byteOffset", 0), values.dtype, shape)
        changed = values.copy()
        changed[at[:, 0]] = new
        return changed

    def _buffer(self, index: int) -> bytes:
        known = self._buffers.get(index)
        if known is None:
            uri = self._json["buffers"][index].get("uri")
            known = self._binary if uri is None else self._read(uri)
            self._buffers[index] = known
        return known

    def _read(self, uri: str) -> bytes:
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2])
            except binascii.Error as error:
                raise MeshError(self._file, f"a data: buffer is broken: {error}") from error
        path = self._file.parent / unquote(uri)
        try:
            return path.read_bytes()
        except OSError as error:
            raise MeshError(self._file, f"its buffer '{path}' cannot be read") from error

    def _material(self, index: int | None) -> MeshMaterial | None:
        if index is None:
            return None
        material = self._json["materials"][index]
        surface = material.get("pbrMetallicRoughness", {})
        red, green, blue, alpha = map(float, surface.get("baseColorFactor", (1, 1, 1, 1)))
        glow = [float(value) for value in material.get("emissiveFactor", (0, 0, 0))]
        opaque = material.get("alphaMode", "OPAQUE") == "OPAQUE"
        texture = surface.get("baseColorTexture")
        return MeshMaterial(
            name=str(material.get("name", "")),
            ambient=(red, green, blue, 1.0),
            diffuse=(red, green, blue, 1.0 if opaque else alpha),
            emissive=(glow[0], glow[1], glow[2], 1.0),
            texture=None if texture is None else self._texture(texture["index"]),
        )

    def _texture(self, index: int) -> Path | bytes | None:
        image = self._json["images"][self._json["textures"][index]["source"]]
        if "bufferView" in image:
            view = self._json["bufferViews"][image["bufferView"]]
            start = view.get("byteOffset", 0)
            return self._buffer(view["buffer"])[start : start + view["byteLength"]]
        uri = str(image["uri"])
        if uri.startswith("data:"):
            return self._read(uri)
        path = self._file.parent / unquote(uri)
        if is_file(path):
            return path
        text = f"texture '{uri}' not found, the part is shown plain; looked for {path}"
        self._notes[MeshNote("mesh.missing-texture", text)] = None
        return None


def _chunks(data: bytes, file: Path) -> tuple[bytes, bytes]:
    if not data.startswith(_GLB_MAGIC):
        return data, b""
    length = int.from_bytes(data[8:12], "little")
    if length > len(data):
        raise MeshError(file, f"truncated GLB: {length} bytes promised, {len(data)} found")
    found = {_JSON_CHUNK: b"{}", _BINARY_CHUNK: b""}
    at = 12
    while at + 8 <= length:
        size = int.from_bytes(data[at : at + 4], "little")
        kind = int.from_bytes(data[at + 4 : at + 8], "little")
        found[kind] = data[at + 8 : at + 8 + size]
        at += 8 + size
    return found[_JSON_CHUNK], found[_BINARY_CHUNK]


def _transform(node: dict[str, Any]) -> Matrix:
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    x, y, z, w = map(float, node.get("rotation", (0, 0, 0, 1)))
    px, py, pz = map(float, node.get("translation", (0, 0, 0)))
    turned = Pose((px, py, pz), (x, y, z, w)).matrix()
    return np.asarray(turned @ np.diag([*map(float, node.get("scale", (1, 1, 1))), 1.0]))


def _triangle_corners(flat: NDArray[np.intp], mode: int) -> NDArray[np.intp]:
    if mode == _TRIANGLES:
        return flat[: len(flat) // 3 * 3]
    if len(flat) < 3:
        return flat[:0]
    if mode == _FAN:
        first = np.full(len(flat) - 2, flat[0])
        return np.stack([first, flat[1:-1], flat[2:]], axis=1).reshape(-1)
    triangles = np.stack([flat[:-2], flat[1:-1], flat[2:]], axis=1)
    triangles[1::2] = triangles[1::2, [1, 0, 2]]
    return triangles.reshape(-1)
