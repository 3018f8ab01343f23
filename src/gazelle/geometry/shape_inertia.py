"""Mass properties of the shapes in every textbook's table of moments of inertia.

Frames: the axis of revolution is z and the origin is the middle of the shape's height, as in URDF
and SDF. Half shapes are cut through their axis or equator and keep the side named; their centre of
mass is off the origin. The formulas integrate r² dm over an even density and move the result to
the centre of mass by the parallel axis theorem.
"""

from __future__ import annotations

import math

from gazelle.geometry.mass_properties import MassProperties
from gazelle.geometry.pose import Vector3

__all__ = [
    "box_mass_properties",
    "capsule_mass_properties",
    "cone_mass_properties",
    "cylinder_mass_properties",
    "cylindrical_shell_mass_properties",
    "ellipsoid_mass_properties",
    "half_cylindrical_shell_mass_properties",
    "hemisphere_mass_properties",
    "hemispherical_shell_mass_properties",
    "rod_mass_properties",
    "semicylinder_mass_properties",
    "sphere_mass_properties",
    "spherical_shell_mass_properties",
]


def box_mass_properties(mass_kg: float, size_m: Vector3) -> MassProperties:
    """Solid box with these edge lengths."""
    xx, yy, zz = (length * length for length in size_m)
    factor = mass_kg / 12
    return _diagonal(mass_kg, factor * (yy + zz), factor * (xx + zz), factor * (xx + yy))


def ellipsoid_mass_properties(mass_kg: float, radii_m: Vector3) -> MassProperties:
    """Solid ellipsoid with these semi-axes."""
    xx, yy, zz = (radius * radius for radius in radii_m)
    factor = mass_kg / 5
    return _diagonal(mass_kg, factor * (yy + zz), factor * (xx + zz), factor * (xx + yy))


def sphere_mass_properties(mass_kg: float, radius_m: float) -> MassProperties:
    """Solid sphere: 2/5 m r²."""
    moment = 2 / 5 * mass_kg * radius_m**2
    return _diagonal(mass_kg, moment, moment, moment)


def spherical_shell_mass_properties(mass_kg: float, radius_m: float) -> MassProperties:
    """Thin hollow sphere: 2/3 m r²."""
    moment = 2 / 3 * mass_kg * radius_m**2
    return _diagonal(mass_kg, moment, moment, moment)


def hemisphere_mass_properties(mass_kg: float, radius_m: float) -> MassProperties:
    """Solid half sphere, its flat side at z = 0, the dome at z > 0; centre at 3/8 r."""
    full = 2 / 5 * mass_kg * radius_m**2
    return _off_z(mass_kg, full, full, 3 / 8 * radius_m)


def hemispherical_shell_mass_properties(mass_kg: float, radius_m: float) -> MassProperties:
    """Thin dome without floor, its rim at z = 0, open below; centre at r/2."""
    full = 2 / 3 * mass_kg * radius_m**2
    return _off_z(mass_kg, full, full, radius_m / 2)


def cylinder_mass_properties(mass_kg: float, radius_m: float, length_m: float) -> MassProperties:
    """Solid cylinder about z."""
    side = mass_kg * (3 * radius_m**2 + length_m**2) / 12
    return _diagonal(mass_kg, side, side, mass_kg * radius_m**2 / 2)


def cylindrical_shell_mass_properties(
    mass_kg: float, radius_m: float, length_m: float
) -> MassProperties:
    """Thin tube about z, without caps."""
    side = mass_kg * (6 * radius_m**2 + length_m**2) / 12
    return _diagonal(mass_kg, side, side, mass_kg * radius_m**2)


def semicylinder_mass_properties(
    mass_kg: float, radius_m: float, length_m: float
) -> MassProperties:
    """Solid half cylinder about z, the half with x > 0; centre at x = 4 r / (3 π)."""
    whole = cylinder_mass_properties(mass_kg, radius_m, length_m)
    return _off_x(whole, 4 * radius_m / (3 * math.pi))


def half_cylindrical_shell_mass_properties(
    mass_kg: float, radius_m: float, length_m: float
) -> MassProperties:
    """Thin half tube about z, the half with x > 0, without caps; centre at x = 2 r / π."""
    whole = cylindrical_shell_mass_properties(mass_kg, radius_m, length_m)
    return _off_x(whole, 2 * radius_m / math.pi)


def rod_mass_properties(mass_kg: float, length_m: float) -> MassProperties:
    """Thin rod along z: m l²/12 across, nothing about its own axis."""
    moment = mass_kg * length_m**2 / 12
    return _diagonal(mass_kg, moment, moment, 0.0)


def cone_mass_properties(mass_kg: float, radius_m: float, length_m: float) -> MassProperties:
    """Solid cone about z, apex up, origin at half its height; centre at z = −l/4."""
    side = 3 / 80 * mass_kg * (4 * radius_m**2 + length_m**2)
    axis = 3 / 10 * mass_kg * radius_m**2
    return MassProperties(mass_kg, (0.0, 0.0, -length_m / 4), (side, 0.0, 0.0, side, 0.0, axis))


def capsule_mass_properties(mass_kg: float, radius_m: float, length_m: float) -> MassProperties:
    """Solid capsule about z; `length_m` is the cylindrical part's."""
    tube_volume = math.pi * radius_m**2 * length_m
    ball_volume = 4 / 3 * math.pi * radius_m**3
    tube = mass_kg * tube_volume / (tube_volume + ball_volume)
    ball = mass_kg - tube
    axis = tube * radius_m**2 / 2 + ball * 2 / 5 * radius_m**2
    # Each half ball's centre is length/2 + 3/8 r from the middle.
    ends = 2 / 5 * radius_m**2 + length_m**2 / 4 + 3 / 8 * radius_m * length_m
    side = tube * (3 * radius_m**2 + length_m**2) / 12 + ball * ends
    return _diagonal(mass_kg, side, side, axis)


def _diagonal(mass_kg: float, xx: float, yy: float, zz: float) -> MassProperties:
    return MassProperties(mass_kg, (0.0, 0.0, 0.0), (xx, 0.0, 0.0, yy, 0.0, zz))


def _off_z(mass_kg: float, across: float, axis: float, center: float) -> MassProperties:
    side = across - mass_kg * center**2
    return MassProperties(mass_kg, (0.0, 0.0, center), (side, 0.0, 0.0, side, 0.0, axis))


def _off_x(whole: MassProperties, center: float) -> MassProperties:
    """A half has the whole's moments about the axis the cut goes through."""
    xx, _, _, yy, _, zz = whole.inertia_kg_m2
    shift = whole.mass_kg * center**2
    inertia = (xx, 0.0, 0.0, yy - shift, 0.0, zz - shift)
    return MassProperties(whole.mass_kg, (center, 0.0, 0.0), inertia)
