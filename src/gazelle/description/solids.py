"""Mass properties of shapes that are given by numbers alone."""

from __future__ import annotations

import math
from typing import assert_never

from gazelle.description.model import Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere
from gazelle.geometry.mass import MassProperties
from gazelle.geometry.solids import (
    box_mass_properties,
    capsule_mass_properties,
    cone_mass_properties,
    cylinder_mass_properties,
    ellipsoid_mass_properties,
    sphere_mass_properties,
)

__all__ = ["Solid", "solid_body"]

Solid = Box | Sphere | Cylinder | Cone | Capsule | Ellipsoid


def solid_body(shape: Solid, density_kg_m3: float) -> MassProperties:
    """Return a shape of even density, in its own frame."""
    density = density_kg_m3
    match shape:
        case Box(size_m=size):
            return box_mass_properties(density * math.prod(size), size)
        case Sphere(radius_m=r):
            return sphere_mass_properties(density * 4 / 3 * math.pi * r**3, r)
        case Cylinder(radius_m=r, length_m=length):
            return cylinder_mass_properties(density * math.pi * r**2 * length, r, length)
        case Cone(radius_m=r, length_m=length):
            return cone_mass_properties(density * math.pi * r**2 * length / 3, r, length)
        case Capsule(radius_m=r, length_m=length):
            volume = math.pi * r**2 * (length + 4 / 3 * r)
            return capsule_mass_properties(density * volume, r, length)
        case Ellipsoid(radii_m=radii):
            volume = 4 / 3 * math.pi * math.prod(radii)
            return ellipsoid_mass_properties(density * volume, radii)
        case _:
            assert_never(shape)
