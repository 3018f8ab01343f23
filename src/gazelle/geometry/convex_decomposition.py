"""Convex hulls and convex parts of meshes."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.documents.npz_files import keep_arrays, kept_arrays
from gazelle.geometry.mesh import Mesh, MeshPart, part_from_soup
from gazelle.geometry.vertex_normals import group_points
from gazelle.user_folders import cache_folder

__all__ = [
    "ConvexParts",
    "announce",
    "announcing",
    "convex_hull",
    "convex_parts",
    "is_splitting",
    "without_splitting",
]

_Say = Callable[[str], None]
_announce: ContextVar[tuple[_Say, set[str]] | None] = ContextVar("announce", default=None)
_splits: ContextVar[bool] = ContextVar("splits", default=True)

_CONVEX_SHARE = 0.98
_THRESHOLD = 0.08
# Scans and CAD exports of whole bodies: finer pieces take half a minute and slow every contact.
_COARSE_THRESHOLD = 0.15
_MANY_FACES = 4000
_CACHE_VERSION = 3
# A fraction of CoACD's own effort: the pieces fill the same volume within a few percent and a
# robot's body takes seconds instead of half a minute.
_SEARCH_EFFORT = {
    "preprocess_resolution": 30,
    "resolution": 800,
    "mcts_nodes": 10,
    "mcts_iterations": 40,
    "mcts_max_depth": 2,
}


@dataclass(frozen=True, slots=True)
class ConvexParts:
    """Convex pieces that together stand for a mesh in collisions.

    Attributes:
        parts: at least one piece.
        is_exact: the pieces follow the mesh; False when one hull fills its hollows.
        note: what was done, for the user; empty when the mesh is convex already.
    """

    parts: tuple[MeshPart, ...]
    is_exact: bool
    note: str = ""


@contextmanager
def announcing(say: _Say) -> Iterator[None]:
    """Have long work told before it begins, one line a file, within a ``with`` block."""
    token = _announce.set((say, set()))
    try:
        yield
    finally:
        _announce.reset(token)


@contextmanager
def without_splitting() -> Iterator[None]:
    """Have hollow meshes taken as their hulls within a ``with`` block, unless split before.

    Hollow scenery is left out: one would be inside its hull.

    For who wants to know what a world is made of, and not to simulate it: splitting takes seconds.
    """
    token = _splits.set(False)
    try:
        yield
    finally:
        _splits.reset(token)


def is_splitting() -> bool:
    """Tell whether meshes are split here, see `without_splitting`."""
    return _splits.get()


def convex_hull(vertices_m: NDArray[np.float64]) -> MeshPart:
    """Return the convex hull of points, (n, 3), faces outwards.

    Points in one plane or on one line get a hull of a millionth of their size in thickness.

    Raises:
        ValueError: fewer than one finite point.
    """
    from scipy.spatial import ConvexHull

    points = np.unique(np.asarray(vertices_m, np.float64).reshape(-1, 3), axis=0)
    if not len(points) or not np.isfinite(points).all():
        raise ValueError("a convex hull needs at least one point, all of them finite")
    if _is_solid(points):
        return _hull_part(ConvexHull(points))
    thickness = max(1e-6 * float(np.ptp(points, axis=0).max()), 1e-9)
    corners = np.array([[-1, -1, -1], [1, -1, 1], [-1, 1, 1], [1, 1, -1]], np.float64)
    thick = (points[:, None] + corners * thickness).reshape(-1, 3)
    return _hull_part(ConvexHull(thick, qhull_options="QJ Pp"))


def convex_parts(mesh: Mesh, *, threshold: float | None = None) -> ConvexParts:
    """Split a mesh into convex pieces.

    A mesh that fills 98 % of its hull is its hull. Others are split by ``coacd`` where it is
    installed (``pip install gazelle-sim[convex]``) and the result is kept on disk under the hash
    of the triangles; without it the hull stands for the mesh and the note says so.

    Args:
        mesh: closed or not.
        threshold: CoACD's concavity limit, 0.01 (fine) to 1 (coarse); None for 0.08, and 0.15
            above 4000 triangles.
    """
    if threshold is None:
        threshold = _THRESHOLD if len(mesh.faces) <= _MANY_FACES else _COARSE_THRESHOLD
    hull = convex_hull(mesh.vertices_m)
    if _fills(mesh, hull):
        return ConvexParts((hull,), True)
    file = _cache_file(mesh, threshold)
    cached = _load(file)
    if cached:
        return ConvexParts(cached, True, f"{len(cached)} convex pieces, from '{file}'")
    if not is_splitting():
        return ConvexParts((hull,), False, "a run splits the mesh; here the hull stands for it")
    try:
        import coacd
    except ImportError:
        note = (
            "the mesh is hollow and collides as its convex hull; "
            "pip install 'gazelle-sim[convex]' to follow its shape"
        )
        return ConvexParts((hull,), False, note)
    _tell(mesh)
    coacd.set_log_level("error")
    pieces = coacd.run_coacd(
        coacd.Mesh(*_welded(mesh)), threshold=threshold, seed=0, **_SEARCH_EFFORT
    )
    # CoACD's threads hand pieces over in the order in which they have finished them.
    parts = tuple(sorted((convex_hull(np.asarray(vertices)) for vertices, _ in pieces), key=_place))
    if not parts:
        return ConvexParts((hull,), False, "coacd found no pieces; the convex hull is used")
    _save(file, parts)
    return ConvexParts(parts, True, f"{len(parts)} convex pieces")


def announce(text: str) -> None:
    """Tell of work that takes seconds to who listens, see `announcing`."""
    listener = _announce.get()
    if listener is not None:
        listener[0](text)


def _tell(mesh: Mesh) -> None:
    listener = _announce.get()
    name = Path(mesh.file).name if mesh.file else "a mesh"
    if listener is None or name in listener[1]:
        return
    say, said = listener
    # A robot has dozens of meshes: why it takes so long is said of the first.
    why = "" if said else (
        f", which takes some seconds; this is done once and kept in '{cache_folder() / 'convex'}'"
    )  # fmt: skip
    said.add(name)
    say(f"splitting '{name}' into convex pieces{why}")


def _is_solid(points: NDArray[np.float64]) -> bool:
    """Whether the points span a volume: their smallest spread counts against the largest."""
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return len(points) >= 4 and bool(spread[2] > 1e-7 * spread[0])


def _hull_part(hull: object) -> MeshPart:
    points, triangles = hull.points, hull.simplices  # type: ignore[attr-defined]
    corners = points[triangles]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inside = points[hull.vertices].mean(axis=0)  # type: ignore[attr-defined]
    turned = np.einsum("ij,ij->i", outward, corners[:, 0] - inside) < 0
    corners[turned] = corners[turned][:, ::-1]
    return part_from_soup(corners, name="hull")


def _fills(mesh: Mesh, hull: MeshPart) -> bool:
    from gazelle.geometry.mesh_inertia import is_closed, mesh_volume_m3

    return is_closed(mesh) and mesh_volume_m3(mesh) >= _CONVEX_SHARE * mesh_volume_m3(hull)


def _welded(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Vertices without the copies that sharp edges need: CoACD remeshes what has cracks."""
    group = group_points(mesh.vertices_m)
    vertices = np.empty((int(group.max()) + 1, 3))
    vertices[group] = mesh.vertices_m
    faces = group[mesh.faces]
    whole = (
        (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    )
    return vertices, faces[whole]


def _place(part: MeshPart) -> tuple[float, ...]:
    points = part.vertices_m
    return (
        *points.min(axis=0).tolist(),
        *points.max(axis=0).tolist(),
        *points.mean(axis=0).tolist(),
    )


def _cache_file(mesh: Mesh, threshold: float) -> Path:
    digest = hashlib.sha256(f"{_CACHE_VERSION} {threshold!r} ".encode())
    digest.update(np.ascontiguousarray(mesh.vertices_m).tobytes())
    digest.update(np.ascontiguousarray(mesh.faces).tobytes())
    return cache_folder() / "convex" / f"{digest.hexdigest()}.npz"


def _load(file: Path) -> tuple[MeshPart, ...]:
    arrays = kept_arrays(file)
    if arrays is None:
        return ()
    try:
        return tuple(convex_hull(arrays[name]) for name in sorted(arrays))
    except ValueError:
        return ()


def _save(file: Path, parts: tuple[MeshPart, ...]) -> None:
    keep_arrays(file, {f"part{index:05d}": part.vertices_m for index, part in enumerate(parts)})
