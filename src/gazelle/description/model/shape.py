"""Shapes and materials, as collisions and visuals use them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from gazelle.diagnostics import SourceSpan

__all__ = [
    "Box",
    "Capsule",
    "Cone",
    "Cylinder",
    "Ellipsoid",
    "Heightmap",
    "Material",
    "MeshShape",
    "Plane",
    "Polyline",
    "Rgba",
    "Shape",
    "Sphere",
    "thickened",
]

Rgba = tuple[float, float, float, float]
Vector3 = tuple[float, float, float]
# Gazebo takes lengths up to the first one for 0, and the second one in their place.
_NOTHING_M = 1e-6
_THIN_M = 1e-4


def thickened(lengths_m: Iterable[float]) -> tuple[float, ...]:
    """Return lengths of a shape with those of 0 as thin as Gazebo makes them; others as given."""
    return tuple(_THIN_M if abs(one) <= _NOTHING_M else one for one in lengths_m)


@dataclass(frozen=True, slots=True)
class Box:
    """A box centred on its frame; edge lengths in metres."""

    size_m: Vector3


@dataclass(frozen=True, slots=True)
class Sphere:
    """A sphere centred on its frame."""

    radius_m: float


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder about z, centred on its frame."""

    radius_m: float
    length_m: float


@dataclass(frozen=True, slots=True)
class Capsule:
    """A capsule about z, centred on its frame; `length_m` is the cylindrical part's."""

    radius_m: float
    length_m: float


@dataclass(frozen=True, slots=True)
class Cone:
    """A cone about z, apex up, centred on half its height."""

    radius_m: float
    length_m: float


@dataclass(frozen=True, slots=True)
class Ellipsoid:
    """An ellipsoid centred on its frame; semi-axes in metres."""

    radii_m: Vector3


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane through its frame's origin; infinite for contact, `size_m` for the eye."""

    normal: Vector3 = (0.0, 0.0, 1.0)
    size_m: tuple[float, float] = (1.0, 1.0)


@dataclass(frozen=True, slots=True)
class MeshShape:
    """A mesh file.

    Attributes:
        uri: as written, for messages.
        path: the file found, None when it is missing (reported when it was read).
        scale: factors along x, y, z.
        submesh: only this part of the file, by name; empty for the whole.
        center_submesh: move the submesh's bounding box centre to the origin.
        span: place of the reference.
    """

    uri: str
    path: Path | None
    scale: Vector3 = (1.0, 1.0, 1.0)
    submesh: str = ""
    center_submesh: bool = False
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Heightmap:
    """A greyscale image as terrain, `size_m` large in x, y and from black to white."""

    uri: str
    path: Path | None
    size_m: Vector3 = (1.0, 1.0, 1.0)
    position_m: Vector3 = (0.0, 0.0, 0.0)
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Polyline:
    """Closed outlines in the xy plane, extruded from z = 0 to `height_m`."""

    outlines_m: tuple[tuple[tuple[float, float], ...], ...]
    height_m: float = 1.0


Shape = (
    Box | Sphere | Cylinder | Capsule | Cone | Ellipsoid | Plane | MeshShape | Heightmap | Polyline
)


@dataclass(frozen=True, slots=True)
class Material:
    """How a surface looks.

    Attributes:
        name: the material's or Gazebo script's name, such as ``Gazebo/Red``; may be empty.
        ambient: RGBA, each 0…1.
        diffuse: RGBA, each 0…1; alpha is the surface's transparency.
        specular: RGBA, each 0…1.
        emissive: RGBA, each 0…1.
        shininess: specular exponent (OGRE), 0 for none.
        texture: image file multiplied with the diffuse colour, or None.
        texture_scale: how often the texture repeats per unit of u and v.
        lighting: False shows the diffuse colour unshaded.
    """

    name: str = ""
    ambient: Rgba = (0.7, 0.7, 0.7, 1.0)
    diffuse: Rgba = (0.7, 0.7, 0.7, 1.0)
    specular: Rgba = (0.0, 0.0, 0.0, 1.0)
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    shininess: float = 0.0
    texture: Path | None = None
    texture_scale: tuple[float, float] = (1.0, 1.0)
    lighting: bool = True
