"""Shapes and materials, as collisions and visuals use them.

What a solid that is given by lengths alone says of itself is said once, at its class.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

from gazelle.diagnostics import SourceSpan
from gazelle.geometry import Vector3
from gazelle.geometry.mass_properties import MassProperties
from gazelle.geometry.mesh import MeshPart
from gazelle.geometry.shape_inertia import (
    box_mass_properties,
    capsule_mass_properties,
    cone_mass_properties,
    cylinder_mass_properties,
    ellipsoid_mass_properties,
    sphere_mass_properties,
)
from gazelle.geometry.shape_meshes import (
    box_mesh,
    capsule_mesh,
    cone_mesh,
    cylinder_mesh,
    ellipsoid_mesh,
    sphere_mesh,
)

__all__ = [
    "SOLIDS",
    "Box",
    "Capsule",
    "Cone",
    "Cylinder",
    "Ellipsoid",
    "Heightmap",
    "Length",
    "Material",
    "MeshShape",
    "Plane",
    "Polyline",
    "Rgba",
    "Shape",
    "Solid",
    "Sphere",
    "thickened",
]

Rgba = tuple[float, float, float, float]
# Gazebo takes lengths up to the first one for 0, and the second one in their place.
_NOTHING_M = 1e-6
_THIN_M = 1e-4


class Solid(ABC):
    """A solid; classes of solids are frozen dataclasses whose fields are lengths.

    A length is a number or three of them; its field ends in ``_m``, and without that ending it is
    the child's name in SDF.

    Attributes:
        word: of SDF's ``<geometry>``.
        usual: SDF's defaults of the fields, in their order.
        in_urdf: whether it is a word of URDF too; elsewhere it is written as a mesh there.
        is_convex: whether it is the hull of its surface.
    """

    __slots__ = ()

    word: ClassVar[str]
    usual: ClassVar[tuple[float | Vector3, ...]]
    in_urdf: ClassVar[bool] = False
    is_convex: ClassVar[bool] = True

    @classmethod
    def lengths(cls) -> tuple[Length, ...]:
        """Return the lengths in the order of the fields."""
        names = (field.name for field in fields(cls))  # type: ignore[arg-type]
        return tuple(Length(*row) for row in zip(names, cls.usual, strict=True))

    @classmethod
    def of_lengths(cls, lengths_m: tuple[Any, ...]) -> Solid:
        """Return the solid of these values of its fields."""
        return cls(*lengths_m)

    @abstractmethod
    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly, in its own frame."""

    @abstractmethod
    def mesh(self) -> MeshPart:
        """Return triangles of its surface, closed and facing outwards, for lengths above 0."""


@dataclass(frozen=True, slots=True)
class Box(Solid):
    """A box centred on its frame; edge lengths in metres."""

    word: ClassVar[str] = "box"
    usual: ClassVar = ((1.0, 1.0, 1.0),)
    in_urdf: ClassVar[bool] = True

    size_m: Vector3

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        return box_mass_properties(density_kg_m3 * math.prod(self.size_m), self.size_m)

    def mesh(self) -> MeshPart:
        """Return its sides."""
        return box_mesh(self.size_m)


@dataclass(frozen=True, slots=True)
class Capsule(Solid):
    """A capsule about z, centred on its frame; `length_m` is the cylindrical part's."""

    word: ClassVar[str] = "capsule"
    usual: ClassVar = (0.5, 1.0)
    in_urdf: ClassVar[bool] = True

    radius_m: float
    length_m: float

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        r, length = self.radius_m, self.length_m
        volume = math.pi * r**2 * (length + 4 / 3 * r)
        return capsule_mass_properties(density_kg_m3 * volume, r, length)

    def mesh(self) -> MeshPart:
        """Return its surface."""
        return capsule_mesh(self.radius_m, self.length_m)


@dataclass(frozen=True, slots=True)
class Cone(Solid):
    """A cone about z, apex up, centred on half its height."""

    word: ClassVar[str] = "cone"
    usual: ClassVar = (0.5, 1.0)

    radius_m: float
    length_m: float

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        r, length = self.radius_m, self.length_m
        return cone_mass_properties(density_kg_m3 * math.pi * r**2 * length / 3, r, length)

    def mesh(self) -> MeshPart:
        """Return its side and its base."""
        return cone_mesh(self.radius_m, self.length_m)


@dataclass(frozen=True, slots=True)
class Cylinder(Solid):
    """A cylinder about z, centred on its frame."""

    word: ClassVar[str] = "cylinder"
    usual: ClassVar = (1.0, 1.0)
    in_urdf: ClassVar[bool] = True

    radius_m: float
    length_m: float

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        r, length = self.radius_m, self.length_m
        return cylinder_mass_properties(density_kg_m3 * math.pi * r**2 * length, r, length)

    def mesh(self) -> MeshPart:
        """Return its side and its ends."""
        return cylinder_mesh(self.radius_m, self.length_m)


@dataclass(frozen=True, slots=True)
class Ellipsoid(Solid):
    """An ellipsoid centred on its frame; semi-axes in metres."""

    word: ClassVar[str] = "ellipsoid"
    usual: ClassVar = ((1.0, 1.0, 1.0),)

    radii_m: Vector3

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        volume = 4 / 3 * math.pi * math.prod(self.radii_m)
        return ellipsoid_mass_properties(density_kg_m3 * volume, self.radii_m)

    def mesh(self) -> MeshPart:
        """Return its surface."""
        return ellipsoid_mesh(self.radii_m)


@dataclass(frozen=True, slots=True)
class Sphere(Solid):
    """A sphere centred on its frame."""

    word: ClassVar[str] = "sphere"
    usual: ClassVar = (1.0,)
    in_urdf: ClassVar[bool] = True

    radius_m: float

    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly."""
        r = self.radius_m
        return sphere_mass_properties(density_kg_m3 * 4 / 3 * math.pi * r**3, r)

    def mesh(self) -> MeshPart:
        """Return its surface."""
        return sphere_mesh(self.radius_m)


SOLIDS: tuple[type[Solid], ...] = (Box, Sphere, Cylinder, Capsule, Cone, Ellipsoid)
"""Every solid that descriptions can name; a new one is its class and its row here."""


@dataclass(frozen=True, slots=True)
class Heightmap:
    """A greyscale image as terrain, `size_m` large in x, y and from black to white."""

    uri: str
    path: Path | None
    size_m: Vector3 = (1.0, 1.0, 1.0)
    position_m: Vector3 = (0.0, 0.0, 0.0)
    span: SourceSpan | None = None


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
class Plane:
    """A plane through its frame's origin; infinite for contact, `size_m` for the eye."""

    normal: Vector3 = (0.0, 0.0, 1.0)
    size_m: tuple[float, float] = (1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Polyline:
    """Closed outlines in the xy plane, extruded from z = 0 to `height_m`."""

    outlines_m: tuple[tuple[tuple[float, float], ...], ...]
    height_m: float = 1.0


Shape = Solid | Plane | MeshShape | Heightmap | Polyline


class Length(NamedTuple):
    """One of the lengths that make a solid.

    Attributes:
        field: of the class, in metres.
        usual: what SDF takes where it is not written; one number, or three.
    """

    field: str
    usual: float | Vector3

    @property
    def word(self) -> str:
        """The child in SDF, and the attribute in URDF."""
        return self.field.removesuffix("_m")


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


def thickened(lengths_m: Iterable[float]) -> tuple[float, ...]:
    """Return lengths of a shape with those of 0 as thin as Gazebo makes them; others as given."""
    return tuple(_THIN_M if abs(one) <= _NOTHING_M else one for one in lengths_m)
