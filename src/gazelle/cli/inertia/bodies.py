"""The bodies of the tables of moments of inertia, by the words people use."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError
from gazelle.geometry import (
    MassProperties,
    box_mass_properties,
    capsule_mass_properties,
    cone_mass_properties,
    cylinder_mass_properties,
    cylindrical_shell_mass_properties,
    ellipsoid_mass_properties,
    half_cylindrical_shell_mass_properties,
    hemisphere_mass_properties,
    hemispherical_shell_mass_properties,
    rod_mass_properties,
    semicylinder_mass_properties,
    sphere_mass_properties,
    spherical_shell_mass_properties,
)

__all__ = ["BODIES", "Body", "BodyError", "Dimensions", "body_named", "solid_of"]


class BodyError(GazelleError):
    """A body that is not known, or dimensions that do not make one."""


class Dimensions(NamedTuple):
    """What was given, metres; None for what was not."""

    radius_m: float | None = None
    length_m: float | None = None
    size_m: tuple[float, float, float] | None = None
    radii_m: tuple[float, float, float] | None = None


class Body(NamedTuple):
    """A body of the table.

    Attributes:
        needs: options it takes, in the order of its function's arguments.
        properties: ``(mass_kg, *dimensions)`` to mass properties.
        amount: ``(*dimensions)`` to what a density is multiplied with: m³, m² or m.
        unit: unit of that density.
        aliases: other words for it.
        note: where its centre lies, for those that have it off the origin.
    """

    needs: tuple[str, ...]
    properties: Callable[..., MassProperties]
    amount: Callable[..., float]
    unit: str = "kg/m³"
    aliases: tuple[str, ...] = ()
    note: str = ""

    @property
    def usage(self) -> str:
        """Options as they are written, and what must be known about the frame."""
        usages = {"--size": "--size X Y Z", "--radii": "--radii X Y Z"}
        text = " ".join(usages.get(name, f"{name} M") for name in self.needs)
        return f"{text}  ({self.note})" if self.note else text


_ROUND = ("--radius", "--length")
_BALL = ("--radius",)
_DOME = "flat side at z = 0, dome towards +z"
_HALF = "the half with x > 0"

BODIES: Mapping[str, Body] = {
    "box": Body(
        ("--size",),
        box_mass_properties,
        math.prod,
        aliases=("block", "cube", "cuboid", "rectangular-parallelepiped", "rectangular-prism"),
    ),
    "cylinder": Body(
        _ROUND,
        cylinder_mass_properties,
        lambda r, length: math.pi * r * r * length,
        aliases=("circular-cylinder", "disc", "disk", "solid-cylinder"),
    ),
    "semicylinder": Body(
        _ROUND,
        semicylinder_mass_properties,
        lambda r, length: math.pi / 2 * r * r * length,
        aliases=("half-cylinder", "semi-cylinder"),
        note=_HALF,
    ),
    "cylindrical-shell": Body(
        _ROUND,
        cylindrical_shell_mass_properties,
        lambda r, length: 2 * math.pi * r * length,
        "kg/m²",
        ("circular-cylindrical-shell", "hollow-cylinder", "pipe", "tube"),
        "no caps",
    ),
    "half-cylindrical-shell": Body(
        _ROUND,
        half_cylindrical_shell_mass_properties,
        lambda r, length: math.pi * r * length,
        "kg/m²",
        ("half-cylinder-shell", "half-pipe", "half-shell", "half-tube"),
        f"{_HALF}, no caps",
    ),
    "sphere": Body(
        _BALL,
        sphere_mass_properties,
        lambda r: 4 / 3 * math.pi * r**3,
        aliases=("ball", "solid-sphere"),
    ),
    "spherical-shell": Body(
        _BALL,
        spherical_shell_mass_properties,
        lambda r: 4 * math.pi * r * r,
        "kg/m²",
        ("hollow-sphere", "sphere-shell"),
    ),
    "hemisphere": Body(
        _BALL,
        hemisphere_mass_properties,
        lambda r: 2 / 3 * math.pi * r**3,
        aliases=("half-sphere", "solid-hemisphere"),
        note=_DOME,
    ),
    "hemispherical-shell": Body(
        _BALL,
        hemispherical_shell_mass_properties,
        lambda r: 2 * math.pi * r * r,
        "kg/m²",
        ("dome", "half-spherical-shell", "hollow-hemisphere"),
        "rim at z = 0, dome towards +z, no floor",
    ),
    "slender-rod": Body(
        ("--length",),
        rod_mass_properties,
        lambda length: length,
        "kg/m",
        ("rod", "thin-rod", "uniform-slender-rod"),
    ),
    "cone": Body(
        _ROUND,
        cone_mass_properties,
        lambda r, length: math.pi / 3 * r * r * length,
        aliases=("circular-cone", "right-circular-cone"),
        note="apex up",
    ),
    "capsule": Body(
        _ROUND,
        capsule_mass_properties,
        lambda r, length: math.pi * r * r * (length + 4 / 3 * r),
        note="the length without the round ends",
    ),
    "ellipsoid": Body(
        ("--radii",),
        ellipsoid_mass_properties,
        lambda radii: 4 / 3 * math.pi * math.prod(radii),
    ),
}


def body_named(text: str) -> tuple[str, Body]:
    """Return the name and the body that text mean; case, spaces, ``_`` and ``-`` do not matter.

    Raises:
        BodyError: no body is called so.
    """
    wanted = "-".join(text.lower().replace("_", " ").replace("-", " ").split())
    names = {name: name for name in BODIES}
    names |= {alias: name for name, body in BODIES.items() for alias in body.aliases}
    name = names.get(wanted)
    if name is None:
        hint = did_you_mean(wanted, names)
        known = ", ".join(item.replace("-", " ") for item in BODIES)
        raise BodyError(f"no body is called '{text}'; {hint or f'known are {known}, mesh'}")
    return name, BODIES[name]


def solid_of(
    name: str, given: Dimensions, *, mass_kg: float | None, density: float | None
) -> MassProperties:
    """Return a body's mass properties in its own frame.

    Args:
        name: key of `BODIES`.
        given: its dimensions.
        mass_kg: its mass; or
        density: its density in `Body.unit`.

    Raises:
        BodyError: a dimension is missing, or one is given that the body does not have.
    """
    body = BODIES[name]
    values = {
        "--radius": given.radius_m,
        "--length": given.length_m,
        "--size": given.size_m,
        "--radii": given.radii_m,
    }
    missing = [option for option in body.needs if values[option] is None]
    extra = [key for key, value in values.items() if value is not None and key not in body.needs]
    if missing or extra:
        problems = [f"needs {' and '.join(missing)}"] if missing else []
        problems += [f"has no {' and '.join(extra)}"] if extra else []
        raise BodyError(f"a {name.replace('-', ' ')} {' and '.join(problems)}: {name} {body.usage}")
    chosen = [values[option] for option in body.needs]
    mass = mass_kg if mass_kg is not None else (density or 0.0) * body.amount(*chosen)
    return body.properties(mass, *chosen)
