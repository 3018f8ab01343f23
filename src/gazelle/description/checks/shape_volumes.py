"""Volumes and outer points of a description's shapes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property, lru_cache
from typing import NamedTuple, assert_never

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Collision,
    Heightmap,
    Link,
    MeshShape,
    Model,
    Plane,
    Polyline,
    Shape,
    Solid,
)
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry import (
    MassProperties,
    Mesh,
    MeshPart,
    Pose,
    convex_hull,
    load_mesh_reported,
    mesh_mass_properties,
    polyline_mesh,
)

__all__ = ["Outline", "Outlines", "mesh_body", "shape_body", "shape_points_m"]

Array = NDArray[np.float64]
_KEPT = 64
# Beyond it double precision loses millimetres and qhull its way.
_MAX_DISTANCE_M = 1e9


class Outline(NamedTuple):
    """A shape in the model's frame with all joints at zero.

    Attributes:
        link, collision: what it belongs to; no collision for a visual.
        points_m: (n, 3), their hull holds the shape.
    """

    link: Link
    collision: Collision | None
    points_m: Array

    @property
    def low_m(self) -> Array:
        """Lower corner of the bounding box, (3,)."""
        return np.asarray(self.points_m.min(axis=0))

    @property
    def high_m(self) -> Array:
        """Upper corner of the bounding box, (3,)."""
        return np.asarray(self.points_m.max(axis=0))


class Outlines:
    """All shapes of a model, meshes loaded once; files that cannot be read have no points."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._unheard = Diagnostics()

    @cached_property
    def collisions(self) -> tuple[Outline, ...]:
        """Of all links."""
        return tuple(
            outline
            for link in self._model.links
            for item in link.collisions
            for outline in self._outline(link, item.shape, item.T_link_collision, item)
        )

    @cached_property
    def visuals(self) -> tuple[Outline, ...]:
        """Of all links."""
        return tuple(
            outline
            for link in self._model.links
            for item in link.visuals
            for outline in self._outline(link, item.shape, item.T_link_visual, None)
        )

    def _outline(
        self, link: Link, shape: Shape, T_link_shape: Pose, collision: Collision | None
    ) -> Iterable[Outline]:
        points = shape_points_m(shape, self._unheard)
        pose = link.T_model_link @ T_link_shape
        if len(points):
            placed = np.asarray(pose.transform(points))
            if np.abs(placed).max() < _MAX_DISTANCE_M:  # false for what is no number, too
                yield Outline(link, collision, placed)


def shape_body(
    shape: Shape, density_kg_m3: float, diagnostics: Diagnostics
) -> MassProperties | None:
    """Return a shape of even density in its own frame.

    Args:
        shape: the shape; an open mesh counts as its convex hull.
        density_kg_m3: density.
        diagnostics: receives what is wrong with a mesh file.

    Returns:
        None when the shape encloses no finite volume: planes, terrain, flat meshes.
    """
    try:
        body = _body(shape, density_kg_m3, diagnostics)
    except OverflowError:
        return None  # a radius of 1e200 m
    return body if body is not None and 0.0 < body.mass_kg < math.inf else None


@lru_cache(maxsize=_KEPT)
def mesh_body(mesh: Mesh | MeshPart, density_kg_m3: float) -> MassProperties | None:
    """Return a solid mesh of even density, its convex hull when it is not closed."""
    try:
        return mesh_mass_properties(mesh, density_kg_m3=density_kg_m3)
    except GazelleError:
        try:
            hull = convex_hull(mesh.vertices_m)
            return mesh_mass_properties(hull, density_kg_m3=density_kg_m3)
        except (GazelleError, ValueError):
            return None  # flat: there is no volume


def shape_points_m(shape: Shape, diagnostics: Diagnostics) -> Array:
    """Return points, shape (n, 3), whose bounding box is the shape's; none for the infinite.

    Args:
        shape: the shape.
        diagnostics: receives what is wrong with a mesh file.
    """
    if isinstance(shape, MeshShape):
        mesh = _mesh(shape, diagnostics)
        return np.empty((0, 3)) if mesh is None else mesh.vertices_m
    return _primitive_points_m(shape)


def _body(shape: Shape, density: float, diagnostics: Diagnostics) -> MassProperties | None:
    match shape:
        case Solid():
            return shape.body(density)
        case MeshShape() | Polyline():
            mesh = _mesh(shape, diagnostics)
            return None if mesh is None else mesh_body(mesh, density)
        case Plane() | Heightmap():
            return None
        case _:
            assert_never(shape)


@lru_cache(maxsize=_KEPT)
def _primitive_points_m(shape: Shape) -> Array:
    mesh = _mesh(shape, Diagnostics())
    return np.empty((0, 3)) if mesh is None else mesh.vertices_m


def _mesh(shape: Shape, diagnostics: Diagnostics) -> Mesh | MeshPart | None:
    try:
        match shape:
            case Solid():
                return shape.mesh()
            case Polyline():
                return polyline_mesh(shape.outlines_m, shape.height_m)
            case MeshShape():
                return _loaded(shape, diagnostics)
            case Plane() | Heightmap():
                return None
            case _:
                assert_never(shape)
    except (ValueError, ZeroDivisionError):
        return None  # the reader has reported sizes that make no shape


def _loaded(shape: MeshShape, diagnostics: Diagnostics) -> Mesh | None:
    if shape.path is None:
        return None
    mesh = load_mesh_reported(shape.path, diagnostics, shape.span, smooth=False)
    if mesh is not None and shape.submesh:
        mesh = mesh.submesh(shape.submesh, shape.center_submesh)
    return None if mesh is None else _scaled(mesh, shape.scale)


@lru_cache(maxsize=_KEPT)
def _scaled(mesh: Mesh, scale: tuple[float, float, float]) -> Mesh:
    """Several checks look at the same shapes, and visuals and collisions share meshes."""
    return mesh.scaled(scale)
