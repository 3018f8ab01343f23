"""What rays meet for each shape of the description, shared between equal shapes.

A surface is built once per distinct geometry; scale, size and place are the instance's matter.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import assert_never
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Heightmap,
    MeshShape,
    Plane,
    Polyline,
    Shape,
    Solid,
    Sphere,
)
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.images import opened_picture
from gazelle.geometry import Mesh, MeshMaterial, MeshPart, load_mesh_reported
from gazelle.sensors.embree import SubScene, sub_scene
from gazelle.sensors.tessellation import (
    Facets,
    unit_box,
    unit_cone,
    unit_cylinder,
    unit_plane,
    unit_tube,
)

__all__ = ["ENDLESS_M", "Surface", "SurfacePart", "surface_of"]

ENDLESS_M = 20_000.0
"""Side of the square that stands for an infinite plane.

Rays meet it in its own frame, where it is exactly z = 0: ranges stay within 0.1 mm of the plane's
for sensors up to a kilometre from the plane's origin.
"""

_THINNEST_M = 1e-6
_UNIT_SPHERE = np.array([[0.0, 0.0, 0.0, 1.0]], np.float32)


@dataclass(frozen=True, slots=True)
class SurfacePart:
    """One material's worth of a surface; its place in `Surface.parts` is Embree's ``geomID``.

    Attributes:
        facets: None for exact spheres.
        material: the mesh file's own, None where there is none.
    """

    facets: Facets | None
    material: MeshMaterial | None = None


@dataclass(frozen=True, eq=False)
class Surface:
    """A committed sub-scene and what its parts look like."""

    sub_scene: SubScene
    parts: tuple[SurfacePart, ...]


_known: WeakValueDictionary[tuple[object, ...], Surface] = WeakValueDictionary()
_lock = Lock()


def surface_of(
    shape: Shape, diagnostics: Diagnostics, *, endless: bool
) -> tuple[Surface, NDArray[np.float64]] | None:
    """Return a shape's surface and the 4×4 matrix that gives it the shape's size and place.

    Args:
        shape: the shape.
        diagnostics: told about meshes that cannot be used.
        endless: planes are infinite (collisions) instead of their visual size.

    Returns:
        None for a mesh that is missing or cannot be used; that is reported.
    """
    match shape:
        case MeshShape() | Heightmap() | Polyline():
            return _file_surface(shape, diagnostics)
        case Capsule():
            build = _capsule(shape.radius_m, shape.length_m)
            return _shared(("capsule", shape.radius_m, shape.length_m), build), np.eye(4)
        case Plane():
            size = (ENDLESS_M, ENDLESS_M) if endless else shape.size_m
            matrix = _facing(shape.normal) @ _scale(*size, 1.0)
            return _shared(("plane",), _of_facets(unit_plane)), matrix
        case Box() | Sphere() | Cylinder() | Cone() | Ellipsoid():
            return _primitive(shape)
        case Solid():
            part = shape.mesh()
            return _shared((shape,), lambda: _of_parts((part,))), np.eye(4)
        case _:
            assert_never(shape)


def _primitive(
    shape: Box | Sphere | Cylinder | Cone | Ellipsoid,
) -> tuple[Surface, NDArray[np.float64]]:
    match shape:
        case Box(size_m=size):
            return _shared(("box",), _of_facets(unit_box)), _scale(*size)
        case Cylinder(radius_m=radius, length_m=length):
            scale = _scale(radius, radius, length)
            return _shared(("cylinder",), _of_facets(unit_cylinder)), scale
        case Cone(radius_m=radius, length_m=length):
            scale = _scale(radius, radius, length)
            return _shared(("cone",), _of_facets(unit_cone)), scale
        case Sphere(radius_m=radius):
            return _shared(("sphere",), _sphere), _scale(radius, radius, radius)
        case Ellipsoid(radii_m=radii):
            return _shared(("sphere",), _sphere), _scale(*radii)
        case _:
            assert_never(shape)


def _shared(key: tuple[object, ...], build: Callable[[], Surface]) -> Surface:
    with _lock:
        surface = _known.get(key)
        if surface is None:
            surface = _known[key] = build()
        return surface


def _of_facets(make: Callable[[], Facets]) -> Callable[[], Surface]:
    def build() -> Surface:
        facets = make()
        return Surface(sub_scene([(facets.vertices, facets.faces)]), (SurfacePart(facets),))

    return build


def _sphere() -> Surface:
    return Surface(sub_scene(spheres=_UNIT_SPHERE), (SurfacePart(None),))


def _capsule(radius_m: float, length_m: float) -> Callable[[], Surface]:
    def build() -> Surface:
        tube = unit_tube()
        scale = np.array([radius_m, radius_m, length_m], np.float32)
        side = Facets(tube.vertices * scale, tube.faces, tube.normals, tube.uv)
        ends = np.array(
            [[0, 0, end * length_m / 2, radius_m] for end in (-1, 1)],
            np.float32,
        )
        scene = sub_scene([(side.vertices, side.faces)], ends)
        return Surface(scene, (SurfacePart(side), SurfacePart(None)))

    return build


def _file_surface(
    shape: MeshShape | Heightmap | Polyline, diagnostics: Diagnostics
) -> tuple[Surface, NDArray[np.float64]] | None:
    match shape:
        case MeshShape():
            mesh = _loaded(shape, diagnostics)
            if mesh is None:
                return None
            key = ("mesh", str(shape.path), shape.submesh, shape.center_submesh, id(mesh.parts[0]))
            return _shared(key, lambda: _of_parts(mesh.parts)), _scale(*shape.scale)
        case _:
            part = _made_part(shape, diagnostics)
            if part is None:
                return None
            return _shared((shape,), lambda: _of_parts((part,))), np.eye(4)


def _made_part(shape: Heightmap | Polyline, diagnostics: Diagnostics) -> MeshPart | None:
    from gazelle.geometry.shape_meshes import heightmap_mesh, polyline_mesh

    try:
        if isinstance(shape, Polyline):
            return polyline_mesh(shape.outlines_m, shape.height_m)
        if shape.path is None:
            return None
        return heightmap_mesh(_heights(shape.path), shape.size_m, shape.position_m)
    except (OSError, ValueError) as error:
        diagnostics.report(
            "sensors.unusable-shape",
            f"{type(shape).__name__.lower()} cannot be shown: {error}",
            shape.span if isinstance(shape, Heightmap) else None,
        )
        return None


def _heights(path: Path) -> NDArray[np.float64]:
    """Read a picture's brightness as 0…1."""
    with opened_picture(path) as image:
        deep = image.mode.startswith("I")
        pixels = np.asarray(image if deep else image.convert("L"), np.float64)
    return pixels / (65535.0 if deep else 255.0)


def _loaded(shape: MeshShape, diagnostics: Diagnostics) -> Mesh | None:
    if shape.path is None:
        return None
    mesh = load_mesh_reported(shape.path, diagnostics, shape.span)
    if mesh is None or not shape.submesh:
        return mesh
    chosen = mesh.submesh(shape.submesh, shape.center_submesh)
    if chosen is None:
        names = mesh.submesh_names
        diagnostics.report(
            "sensors.unknown-submesh",
            f"mesh '{shape.uri}' has no submesh '{shape.submesh}'"
            f"{did_you_mean(shape.submesh, names)}; it has: {', '.join(names)}",
            shape.span or SourceSpan(str(shape.path)),
        )
    return chosen


def _of_parts(parts: tuple[MeshPart, ...]) -> Surface:
    made = tuple(SurfacePart(_facets_of(part), part.material) for part in parts)
    triangles = [(part.facets.vertices, part.facets.faces) for part in made if part.facets]
    return Surface(sub_scene(triangles), made)


def _facets_of(part: MeshPart) -> Facets:
    uv = np.zeros((len(part.vertices_m), 2)) if part.uv is None else part.uv
    return Facets(
        np.ascontiguousarray(part.vertices_m, np.float32),
        np.ascontiguousarray(part.faces, np.int32),
        np.ascontiguousarray(part.normals, np.float32),
        np.ascontiguousarray(uv, np.float32),
    )


def _scale(x: float, y: float, z: float) -> NDArray[np.float64]:
    """Return a scaling matrix; nothing is made so flat that rays could not be taken into it."""
    factors = [math.copysign(max(abs(factor), _THINNEST_M), factor) for factor in (x, y, z)]
    return np.diag([*factors, 1.0])


def _facing(normal: tuple[float, float, float]) -> NDArray[np.float64]:
    """Return a rotation that takes +z to the normal."""
    z = np.asarray(normal, float)
    length = math.sqrt(float(z @ z))
    z = z / length if length > 0 else np.array([0.0, 0.0, 1.0])
    x = np.cross([0.0, 1.0, 0.0], z)
    if float(x @ x) < 1e-12:
        x = np.array([1.0, 0.0, 0.0])
    x /= math.sqrt(float(x @ x))
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return matrix
