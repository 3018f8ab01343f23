"""Triangle meshes as frozen values."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.geometry.pose import Vector3
from gazelle.geometry.vertex_normals import (
    face_normals,
    group_points,
    group_rows,
    rounded_normals,
    smooth_corners,
    unit_rows,
)

__all__ = [
    "Mesh",
    "MeshError",
    "MeshMaterial",
    "MeshNote",
    "MeshPart",
    "part_from_corners",
    "part_from_soup",
]


Rgba = tuple[float, float, float, float]


class MeshError(GazelleError):
    """A mesh file cannot be used; the message says which, what and where in the file.

    Attributes:
        file: the file.
        reason: what is wrong with it.
    """

    def __init__(self, file: Path, reason: str) -> None:
        self.file = file
        self.reason = reason
        super().__init__(f"mesh '{file}': {reason}")


class MeshNote(NamedTuple):
    """Something about a mesh file the user should know although it was read.

    Attributes:
        code: diagnostic code of ``gazelle.diagnostics.catalogue``.
        message: what was found and what was done about it.
    """

    code: str
    message: str


@dataclass(frozen=True, slots=True)
class MeshMaterial:
    """How a part of a mesh file looks.

    Attributes:
        name: name in the file; may be empty.
        ambient: RGBA, each 0…1.
        diffuse: RGBA, each 0…1; alpha is opacity.
        specular: RGBA, each 0…1.
        emissive: RGBA, each 0…1.
        shininess: specular exponent, 0 for none.
        texture: image file, encoded image bytes of a file that embeds them, or None; it is
            multiplied with the diffuse colour.
    """

    name: str = ""
    ambient: Rgba = (0.7, 0.7, 0.7, 1.0)
    diffuse: Rgba = (0.7, 0.7, 0.7, 1.0)
    specular: Rgba = (0.0, 0.0, 0.0, 1.0)
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    shininess: float = 0.0
    texture: Path | bytes | None = None


@dataclass(frozen=True, slots=True, eq=False)
class MeshPart:
    """Triangles of one material.

    Attributes:
        name: submesh name (Collada: the node's, else the geometry's); may be empty.
        vertices_m: (N, 3) float64, metres.
        faces: (M, 3) int32 indices into the vertices, anticlockwise seen from outside.
        normals: (N, 3) float64 unit normals, one per vertex.
        uv: (N, 2) float64 texture coordinates, (0, 0) is the picture's lower left corner; or None.
        material: None when the file names none.
    """

    name: str
    vertices_m: NDArray[np.float64]
    faces: NDArray[np.int32]
    normals: NDArray[np.float64]
    uv: NDArray[np.float64] | None = None
    material: MeshMaterial | None = None

    def __post_init__(self) -> None:
        # Meshes are cached and shared between all who load the same file.
        for array in (self.vertices_m, self.faces, self.normals, self.uv):
            if array is not None:
                array.flags.writeable = False

    def transformed(self, matrix: NDArray[np.float64]) -> MeshPart:
        """Return the part under a 4×4 affine transform; a mirroring one turns the faces round."""
        linear = matrix[:3, :3]
        vertices = self.vertices_m @ linear.T + matrix[:3, 3]
        faces = self.faces
        # Cofactors instead of the inverse: defined for flattening transforms as well.
        cofactors = np.stack([np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)])
        if np.linalg.det(linear) < 0:
            faces = np.ascontiguousarray(faces[:, ::-1])
            cofactors = -cofactors
        normals = unit_rows(self.normals @ cofactors.T)
        return replace(self, vertices_m=vertices, faces=faces, normals=normals)


@dataclass(frozen=True, eq=False)
class Mesh:
    """A mesh file's content.

    Attributes:
        parts: triangles by submesh and material; not empty.
        file: where it came from, None for made meshes.
        notes: what the user should know about the file.
    """

    parts: tuple[MeshPart, ...]
    file: Path | None = None
    notes: tuple[MeshNote, ...] = ()

    @cached_property
    def vertices_m(self) -> NDArray[np.float64]:
        """All parts' vertices, (N, 3), metres, read-only."""
        merged = np.concatenate([part.vertices_m for part in self.parts])
        merged.flags.writeable = False
        return merged

    @cached_property
    def faces(self) -> NDArray[np.int32]:
        """All parts' faces as indices into `vertices_m`, (M, 3), read-only."""
        starts = np.cumsum([0, *(len(part.vertices_m) for part in self.parts[:-1])])
        shifted = [part.faces + start for part, start in zip(self.parts, starts, strict=True)]
        merged = np.concatenate(shifted).astype(np.int32, copy=False)
        merged.flags.writeable = False
        return merged

    @cached_property
    def bounds_m(self) -> tuple[Vector3, Vector3]:
        """Smallest and largest x, y, z, metres."""
        low, high = self.vertices_m.min(axis=0), self.vertices_m.max(axis=0)
        return (
            (float(low[0]), float(low[1]), float(low[2])),
            (float(high[0]), float(high[1]), float(high[2])),
        )

    def scaled(self, xyz: Vector3) -> Mesh:
        """Return the mesh with its axes multiplied; negative factors mirror it."""
        if tuple(xyz) == (1.0, 1.0, 1.0):
            return self
        matrix = np.diag([*map(float, xyz), 1.0])
        return Mesh(tuple(part.transformed(matrix) for part in self.parts), self.file, self.notes)

    def submesh(self, name: str, center: bool = False) -> Mesh | None:
        """Return the parts of one name, None when there is none.

        Args:
            name: as in SDF's ``<submesh><name>``.
            center: move the middle of their bounding box to the origin (``<center>``).
        """
        parts = tuple(part for part in self.parts if part.name == name)
        if not parts:
            return None
        chosen = Mesh(parts, self.file, self.notes)
        if not center:
            return chosen
        matrix = np.eye(4)
        matrix[:3, 3] = -np.mean(chosen.bounds_m, axis=0)
        return Mesh(tuple(part.transformed(matrix) for part in parts), self.file, self.notes)

    @property
    def submesh_names(self) -> tuple[str, ...]:
        """Names of the parts, each once, in file order."""
        return tuple(dict.fromkeys(part.name for part in self.parts))


def part_from_soup(
    corners_m: NDArray[np.float64],
    *,
    name: str = "",
    material: MeshMaterial | None = None,
    smooth: bool = True,
) -> MeshPart:
    """Make a part of loose triangles (M, 3, 3): equal vertices shared, normals computed.

    Args:
        corners_m: the triangles.
        name: submesh name.
        material: or None.
        smooth: normals of a smooth surface with its edges; False gives each vertex the normal of
            one of its faces, which is soon done and not fit to be drawn.
    """
    flat = np.ascontiguousarray(corners_m, dtype=np.float64).reshape(-1, 3)
    if smooth:
        return part_from_corners(flat, group_points(flat), name=name, material=material)
    vertex_of_corner = group_points(flat)
    first = np.zeros(int(vertex_of_corner.max(initial=0)) + 1, np.intp)
    first[vertex_of_corner[::-1]] = np.arange(len(flat))[::-1]
    normals = unit_rows(face_normals(flat.reshape(-1, 3, 3)))
    return MeshPart(
        name=name,
        vertices_m=np.ascontiguousarray(flat[first]),
        faces=vertex_of_corner.reshape(-1, 3).astype(np.int32),
        normals=np.ascontiguousarray(normals[first // 3]),
        material=material,
    )


def part_from_corners(
    positions_m: NDArray[np.float64],
    vertex_of_corner: NDArray[np.intp],
    *,
    normals: NDArray[np.float64] | None = None,
    uv: NDArray[np.float64] | None = None,
    name: str = "",
    material: MeshMaterial | None = None,
) -> MeshPart:
    """Make a part of triangle corners, merging those alike in vertex, normal and uv.

    Args:
        positions_m: (3 M, 3) position of each corner.
        vertex_of_corner: (3 M,) which corners share a position.
        normals: (3 M, 3) unit normal of each corner; computed when None.
        uv: (3 M, 2) or None.
        name: submesh name.
        material: or None.
    """
    # Corners that share a vertex must lie at the very same place, or the surface has cracks.
    index = np.arange(len(vertex_of_corner))
    first_corner = np.zeros(int(vertex_of_corner.max(initial=0)) + 1, np.intp)
    first_corner[vertex_of_corner[::-1]] = index[::-1]
    positions_m = positions_m[first_corner[vertex_of_corner]]
    if normals is None:
        normals = smooth_corners(positions_m.reshape(-1, 3, 3), vertex_of_corner)
    columns = [vertex_of_corner[:, None].astype(np.float64), rounded_normals(normals)]
    if uv is not None:
        columns.append(uv)
    first, group = group_rows(np.concatenate(columns, axis=1))
    return MeshPart(
        name=name,
        vertices_m=np.ascontiguousarray(positions_m[first]),
        faces=group.reshape(-1, 3).astype(np.int32),
        normals=np.ascontiguousarray(normals[first]),
        uv=None if uv is None else np.ascontiguousarray(uv[first]),
        material=material,
    )
