"""Collision meshes as convex pieces, the only solids MuJoCo collides.

They are kept on disk. Scenery one can be inside of becomes thin solids along its surface, and
extruded outlines become prisms over triangles.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import MeshShape, Polyline, Solid
from gazelle.diagnostics import Diagnostics
from gazelle.documents import read_limited
from gazelle.documents.npz_files import keep_arrays, kept_arrays
from gazelle.engine.primitive_fitting import RoundShape, fitted_round_shape
from gazelle.geometry import (
    Mesh,
    MeshError,
    MeshPart,
    Pose,
    convex_hull,
    convex_parts,
    is_closed,
    is_splitting,
    load_mesh,
    mesh_volume_m3,
)
from gazelle.geometry.mesh import part_from_soup
from gazelle.geometry.mesh_files import MAX_MESH_BYTES
from gazelle.user_folders import cache_folder

__all__ = [
    "MIN_VOLUME_M3",
    "Decomposition",
    "MeshKey",
    "Piece",
    "connected_parts",
    "convex_pieces",
    "decomposed",
    "ear_clipped",
    "kept_file",
    "mesh_key",
    "pieces_folder",
    "polyline_pieces",
    "solid_pieces",
    "surface_pieces",
]


Point = tuple[float, float]
Array = NDArray[np.float64]
Faces = NDArray[np.int32]


MIN_VOLUME_M3 = 1e-13
"""Solids below it are left out, cubes of 50 µm: MuJoCo refuses hulls without volume."""


_THICKNESS_RATIO = 0.01
_MAX_THICKNESS_M = 0.02
_SAME_PLANE = 1e-4
_FULL_SHARE = 0.999
_UNSPLIT = "a run splits it into convex pieces"


CONVEX_SHARE = 0.9
"""A moving mesh that fills this share of its hull collides as its hull."""


_MIN_THICKNESS_RATIO = 2e-7
# To be raised with every change of what the pieces of a mesh are.
_KEPT_VERSION = 2
_OF_SEVERAL_FILES = frozenset({".gltf"})


class Piece(NamedTuple):
    """One convex solid: the hull of points, or the round shape it is a tessellation of.

    Attributes:
        points_m: (n, 3), in the collision's frame.
        round_shape: None where it is a hull.
    """

    points_m: Array
    round_shape: RoundShape | None = None


class Decomposition(NamedTuple):
    """The pieces of a mesh, and what is worth telling about them."""

    pieces: tuple[Piece, ...]
    note: str


class MeshKey(NamedTuple):
    """What the pieces of a mesh depend on.

    Attributes:
        path: the file.
        modified_ns: when it was written.
        scale: factors along its axes.
        submesh: the part of it, empty for all.
        center: the part's middle is moved to the origin.
        scenery: it never moves, nor does anything else of its model.
        splitting: see `without_splitting`.
    """

    path: Path
    modified_ns: int
    scale: tuple[float, float, float]
    submesh: str
    center: bool
    scenery: bool
    splitting: bool


def convex_pieces(
    shape: MeshShape, name: str, *, scenery: bool, diagnostics: Diagnostics
) -> tuple[Piece, ...]:
    """Return the convex solids that together stand for a mesh.

    A convex mesh is its hull, or the cylinder or sphere it approximates. A hollow one is split
    by CoACD where it is installed; without it a mesh of a machine is its hull, and scenery is
    made of thin solids along its surface, for the robot is usually inside its hull.

    Args:
        shape: the mesh.
        name: of the collision, for messages.
        scenery: it never moves, nor does anything else of its model.
        diagnostics: takes ``engine.hollow-mesh`` and ``engine.bad-mesh``.
    """
    if shape.path is None:
        return ()
    try:
        result = decomposed(mesh_key(shape, shape.path, scenery=scenery))
    except (MeshError, OSError, ValueError) as error:
        diagnostics.report(
            "engine.bad-mesh",
            f"the mesh '{shape.uri}' of collision '{name}' cannot be used ({error}); it does not"
            " collide",
            shape.span,
        )
        return ()
    if result.note:
        diagnostics.report(
            "engine.hollow-mesh",
            f"the mesh '{shape.uri}' of collision '{name}' is not convex; {result.note}",
            shape.span,
        )
    return result.pieces


def polyline_pieces(shape: Polyline) -> tuple[Piece, ...]:
    """Return the prisms that make up extruded outlines."""
    pieces: list[Piece] = []
    for outline in shape.outlines_m:
        for triangle in ear_clipped(outline):
            base = np.array([[x, y, 0.0] for x, y in triangle])
            pieces.append(Piece(np.vstack([base, base + np.array([0.0, 0.0, shape.height_m])])))
    return tuple(pieces)


def solid_pieces(shape: Solid) -> tuple[Array, ...]:
    """Return the points of convex pieces that make up a solid that MuJoCo does not have.

    They are (n, 3) each, m, in the solid's frame.
    """
    part = shape.mesh()
    if shape.is_convex:
        return (part.vertices_m,)
    return tuple(one.vertices_m for one in convex_parts(Mesh((part,))).parts)


def mesh_key(shape: MeshShape, path: Path, *, scenery: bool) -> MeshKey:
    """Return what the pieces of a mesh depend on.

    Raises:
        OSError: there is no such file.
    """
    part = (shape.submesh, shape.center_submesh)
    modified_ns = path.stat().st_mtime_ns
    return MeshKey(path, modified_ns, shape.scale, *part, scenery, is_splitting())


@lru_cache(maxsize=4096)
def decomposed(key: MeshKey) -> Decomposition:
    """Return the pieces of a mesh, from disk where they were kept there.

    Raises:
        OSError: the file cannot be read.
        MeshError: it is no mesh.
        ValueError: it has no such part, or none that has a hull.
    """
    file = kept_file(key)
    kept = _kept(file) if file is not None else None
    if kept is not None:
        return kept
    found = _computed(key)
    if file is not None and not found.note.endswith(_UNSPLIT):
        _keep(file, found)
    return found


def pieces_folder() -> Path:
    """Return where the pieces of meshes are kept."""
    return cache_folder() / "pieces"


def kept_file(key: MeshKey) -> Path | None:
    """Return the file in which the pieces are kept; None when there can be none.

    It is named after what the mesh's file holds, so a mesh that comes back is known again.
    """
    # A pipe can be read once only.
    if key.path.suffix.lower() in _OF_SEVERAL_FILES or not key.path.is_file():
        return None
    try:
        data = read_limited(key.path, MAX_MESH_BYTES)
    except OSError:
        return None  # who reads the mesh is told
    words = (_KEPT_VERSION, *key[2:6], find_spec("coacd") is not None)
    digest = hashlib.sha256(repr(words).encode())
    digest.update(data)
    return pieces_folder() / f"{digest.hexdigest()}.npz"


def surface_pieces(vertices_m: Array, faces: Faces) -> tuple[Array, ...]:
    """Return prisms that together cover a surface.

    Triangles of one plane that touch and together fill their outline's hull become one prism,
    every other triangle becomes its own. Prisms extend behind the surface, against its normals,
    by 1 % of the mesh's size, at most 2 cm.

    Args:
        vertices_m: (N, 3).
        faces: (M, 3), counter-clockwise seen from outside.
    """
    corners = vertices_m[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(normals, axis=1)
    size = float(np.ptp(vertices_m, axis=0).max())
    thickness = min(_THICKNESS_RATIO * size, _MAX_THICKNESS_M)
    kept = doubled * thickness / 2 > MIN_VOLUME_M3
    if not kept.any():
        return ()
    corners, normals = corners[kept], normals[kept] / doubled[kept, None]
    pieces: list[Array] = []
    for group in _flat_groups(corners, normals, size):
        pieces.extend(_prisms(corners[group], normals[group[0]], thickness))
    return tuple(pieces)


def connected_parts(mesh: Mesh) -> tuple[Mesh, ...]:
    """Return the parts of a mesh that do not share corners, in the order of the file."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    vertices, faces = np.asarray(mesh.vertices_m), np.asarray(mesh.faces)
    ids = _corner_ids(vertices[faces].reshape(-1, 3), float(np.ptp(vertices, axis=0).max()))
    triangles = ids.reshape(-1, 3)
    first, second = triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel()
    size = int(ids.max()) + 1
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(size, size))
    _, labels = connected_components(graph, directed=False)
    of_face = labels[triangles[:, 0]]
    parts = [
        part_from_soup(vertices[faces[of_face == label]], name="part")
        for label in dict.fromkeys(of_face.tolist())
    ]
    return tuple(Mesh((part,), mesh.file) for part in parts)


def ear_clipped(outline: Sequence[Point]) -> tuple[tuple[Point, Point, Point], ...]:
    """Cut a closed outline into triangles by clipping ears (Meisters 1975).

    Args:
        outline: corners in order, either direction; a repeated last corner is allowed.
    """
    corners = list(dict.fromkeys((float(x), float(y)) for x, y in outline))
    if _doubled_area(corners) < 0:
        corners.reverse()
    triangles: list[tuple[Point, Point, Point]] = []
    while len(corners) > 3:
        index = next((i for i in range(len(corners)) if _is_ear(corners, i)), 0)
        triangles.append((corners[index - 1], corners[index], corners[(index + 1) % len(corners)]))
        del corners[index]
    if len(corners) == 3:
        triangles.append((corners[0], corners[1], corners[2]))
    return tuple(triangles)


def _doubled_area(corners: Sequence[Point]) -> float:
    return sum(
        a[0] * b[1] - b[0] * a[1]
        for a, b in zip(corners, [*corners[1:], *corners[:1]], strict=True)
    )


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_ear(corners: Sequence[Point], index: int) -> bool:
    a, b, c = corners[index - 1], corners[index], corners[(index + 1) % len(corners)]
    if _turn(a, b, c) <= 0:
        return False
    others = (point for point in corners if point not in (a, b, c))
    return not any(
        _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0 for p in others
    )


def _corner_ids(corners: Array, size: float) -> NDArray[np.intp]:
    """Number corners; those at one place get one number."""
    keys = np.round(corners / max(1e-6 * size, 1e-12)).astype(np.int64)
    return np.asarray(np.unique(keys, axis=0, return_inverse=True)[1]).ravel()


def _flat_groups(corners: Array, normals: Array, size: float) -> list[NDArray[np.intp]]:
    """Group triangles that lie in one plane and hang together."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    count = len(corners)
    triangles = _corner_ids(corners.reshape(-1, 3), size).reshape(-1, 3)
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = np.flatnonzero((edges[order][1:] == edges[order][:-1]).all(axis=1))
    first, second = order[same] // 3, order[same + 1] // 3
    flat = np.einsum("ij,ij->i", normals[first], normals[second]) > 1 - _SAME_PLANE
    first, second = first[flat], second[flat]
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(count, count))
    number, labels = connected_components(graph, directed=False)
    order = np.argsort(labels, kind="stable")
    return np.split(order, np.searchsorted(labels[order], np.arange(1, number)))


def _prisms(corners: Array, normal: Array, thickness: float) -> list[Array]:
    if len(corners) > 1 and _is_flat(corners, normal) and _fills_outline(corners, normal):
        return [_prism(np.unique(corners.reshape(-1, 3), axis=0), normal, thickness)]
    return [_prism(triangle, normal, thickness) for triangle in corners]


def _prism(points: Array, normal: Array, thickness: float) -> Array:
    return np.vstack([points, points - thickness * normal])


def _is_flat(corners: Array, normal: Array) -> bool:
    heights = corners.reshape(-1, 3) @ normal
    return bool(np.ptp(heights) <= 1e-3 * np.ptp(corners.reshape(-1, 3), axis=0).max())


def _fills_outline(corners: Array, normal: Array) -> bool:
    from scipy.spatial import ConvexHull

    edges = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = float(np.linalg.norm(edges, axis=1).sum()) / 2
    reference = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(reference, normal)
    x /= np.linalg.norm(x)
    plane = np.stack([x, np.cross(normal, x)], axis=1)
    return area >= _FULL_SHARE * float(ConvexHull(corners.reshape(-1, 3) @ plane).volume)


def _kept(file: Path) -> Decomposition | None:
    arrays = kept_arrays(file)
    if arrays is None or arrays.keys() != {"points_m", "counts", "round_shapes", "note"}:
        return None
    ends = np.cumsum(arrays["counts"])
    points = np.split(arrays["points_m"], ends[:-1]) if len(ends) else []
    shapes = [_round_shape(row) for row in arrays["round_shapes"]]
    pieces = tuple(Piece(*both) for both in zip(points, shapes, strict=True))
    return Decomposition(pieces, str(arrays["note"]))


def _keep(file: Path, found: Decomposition) -> None:
    shapes = np.full((len(found.pieces), 9), np.nan)
    for row, piece in zip(shapes, found.pieces, strict=True):
        if piece.round_shape is not None:
            radius, half_length, pose = piece.round_shape
            row[0] = radius
            row[1] = np.nan if half_length is None else half_length
            row[2:5], row[5:9] = pose.position_m, pose.quat_xyzw
    points = [piece.points_m for piece in found.pieces]
    arrays = {
        "points_m": np.concatenate(points) if points else np.empty((0, 3)),
        "counts": np.array([len(one) for one in points], np.int64),
        "round_shapes": shapes,
        "note": np.array(found.note),
    }
    keep_arrays(file, arrays)


def _round_shape(row: Array) -> RoundShape | None:
    radius, half_length, *pose = row.tolist()
    if math.isnan(radius):
        return None
    T_mesh_shape = Pose(tuple(pose[:3]), tuple(pose[3:]))
    return RoundShape(radius, None if math.isnan(half_length) else half_length, T_mesh_shape)


def _computed(key: MeshKey) -> Decomposition:
    mesh = load_mesh(key.path).scaled(key.scale)
    if key.submesh:
        part = mesh.submesh(key.submesh, key.center)
        if part is None:
            raise ValueError(f"it has no part '{key.submesh}'")
        mesh = part
    hull, share = _hull_and_share(mesh)
    if share >= CONVEX_SHARE:
        return Decomposition((_piece(hull),), "")
    filled = f"it fills {100 * share:.0f} % of its hull" if share > 0 else "it is not closed"
    if not is_splitting():
        # A hull for each of a thousand screws takes as long as splitting does, and robots stand
        # inside the hull of scenery.
        is_left_out = key.scenery or not _is_solid(hull)
        return Decomposition(() if is_left_out else (_piece(hull),), f"{filled}; {_UNSPLIT}")
    pieces: list[Piece] = []
    notes: dict[str, None] = {}
    for component in connected_parts(mesh):
        found, note = _component_pieces(component, key.scenery)
        pieces.extend(piece for piece in found if _has_thickness(piece.points_m))
        if note:
            notes.setdefault(note)
    how = f" ({'; '.join(notes)})" if notes else ""
    count = f"{len(pieces)} convex piece{'s' * (len(pieces) != 1)}"
    return Decomposition(tuple(pieces), f"{filled} and collides as {count}{how}")


def _hull_and_share(mesh: Mesh) -> tuple[MeshPart, float]:
    """Return the hull and the share of it that the mesh fills, 0 when it is not closed."""
    hull = convex_hull(mesh.vertices_m)
    volume = mesh_volume_m3(Mesh((hull,)))
    share = mesh_volume_m3(mesh) / volume if is_closed(mesh) and volume > 0 else 0.0
    return hull, share


def _piece(hull: MeshPart) -> Piece:
    points = np.asarray(hull.vertices_m, dtype=np.float64)
    return Piece(points, fitted_round_shape(points, mesh_volume_m3(Mesh((hull,)))))


def _is_solid(hull: MeshPart) -> bool:
    """Tell whether a hull has a volume: CAD drawings have shreds, which MuJoCo refuses."""
    return mesh_volume_m3(Mesh((hull,))) > MIN_VOLUME_M3


def _has_thickness(points_m: Array) -> bool:
    """Tell whether a piece is more than a needle or a film in MuJoCo's single precision.

    The slivers of CAD exports are not: one of them has MuJoCo refuse the whole world.
    """
    points = points_m.astype(np.float32).astype(np.float64)
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[-1] > _MIN_THICKNESS_RATIO * spread[0])


def _component_pieces(mesh: Mesh, scenery: bool) -> tuple[list[Piece], str]:
    """Return the pieces of one connected part, and what is worth telling about them."""
    hull, share = _hull_and_share(mesh)
    if not _is_solid(hull):
        return [], ""
    if share >= CONVEX_SHARE:
        return [_piece(hull)], ""
    if share > 0:
        parts = convex_parts(mesh)
        if parts.is_exact:
            solids = filter(_is_solid, parts.parts)
            return [Piece(np.asarray(part.vertices_m)) for part in solids], ""
    if scenery:
        prisms = surface_pieces(np.asarray(mesh.vertices_m), np.asarray(mesh.faces))
        return [Piece(points) for points in prisms], "its surface as thin solids, for it rests"
    if share == 0:
        return [Piece(np.asarray(hull.vertices_m))], "an open part as its hull: it has no inside"
    note = "a hollow part as its hull: pip install 'gazelle-sim[convex]' splits it"
    return [Piece(np.asarray(hull.vertices_m))], note
