"""Mass, centre of mass and inertia tensor, and the laws they follow."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry.pose import IDENTITY_POSE, Pose, Vector3

__all__ = [
    "Inertia6",
    "MassProperties",
    "combined_mass_properties",
    "inertia_from_matrix",
    "inertia_matrix",
    "inertia_problems",
    "is_legal_inertia",
    "least_principal_moment",
    "legalised_inertia",
]

Inertia6 = tuple[float, float, float, float, float, float]

_SLACK = 1e-6
_MIN_RATIO = 1e-3
_FLOOR_KG_M2 = 1e-9


@dataclass(frozen=True, slots=True)
class MassProperties:
    """Mass properties of a rigid body in its own frame.

    Attributes:
        mass_kg: mass.
        center_m: centre of mass.
        inertia_kg_m2: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass, axes as the frame's;
            ixy is the tensor's element (minus the product of inertia), as in URDF and SDF.
    """

    mass_kg: float
    center_m: Vector3 = (0.0, 0.0, 0.0)
    inertia_kg_m2: Inertia6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)

    def transformed(self, T_a_b: Pose) -> MassProperties:
        """Return the properties in frame a, when these are in frame b."""
        rotation = T_a_b.matrix()[:3, :3]
        turned = rotation @ inertia_matrix(self.inertia_kg_m2) @ rotation.T
        center = T_a_b.transform(np.asarray(self.center_m))
        return MassProperties(self.mass_kg, _vector(center), inertia_from_matrix(turned))

    def inertia_about(self, point_m: Vector3) -> Inertia6:
        """Return the tensor about another point (parallel axis theorem)."""
        offset = np.asarray(self.center_m) - np.asarray(point_m)
        tensor = inertia_matrix(self.inertia_kg_m2) + self.mass_kg * _point_tensor(offset)
        return inertia_from_matrix(tensor)

    def with_mass(self, mass_kg: float) -> MassProperties:
        """Return the same body with another mass, evenly denser.

        Raises:
            ValueError: this body has no mass to start from.
        """
        if self.mass_kg <= 0:
            raise ValueError("a body without mass cannot be scaled to another mass")
        factor = mass_kg / self.mass_kg
        xx, xy, xz, yy, yz, zz = (value * factor for value in self.inertia_kg_m2)
        return MassProperties(mass_kg, self.center_m, (xx, xy, xz, yy, yz, zz))

    @property
    def principal_moments_kg_m2(self) -> Vector3:
        """Principal moments of inertia, smallest first."""
        moments = np.linalg.eigvalsh(inertia_matrix(self.inertia_kg_m2))
        return _vector(np.asarray(moments, np.float64))


def combined_mass_properties(
    bodies: Iterable[MassProperties], frame: Pose = IDENTITY_POSE
) -> MassProperties:
    """Return the properties of bodies joined rigidly, all given in one frame.

    Args:
        bodies: the bodies; negative masses cut holes.
        frame: optional ``T_result_bodies``.

    Raises:
        ValueError: the masses add up to nothing.
    """
    given = tuple(bodies)
    mass = sum(body.mass_kg for body in given)
    if mass <= 0:
        raise ValueError(f"the masses add up to {mass:g} kg")
    weighted = [body.mass_kg * np.asarray(body.center_m) for body in given]
    center = _vector(np.sum(weighted, axis=0) / mass)
    tensors = [inertia_matrix(body.inertia_about(center)) for body in given]
    total = inertia_from_matrix(np.sum(tensors, axis=0))
    return MassProperties(mass, center, total).transformed(frame)


def inertia_matrix(inertia: Inertia6) -> NDArray[np.float64]:
    """Return the symmetric 3×3 matrix of ixx, ixy, ixz, iyy, iyz, izz."""
    xx, xy, xz, yy, yz, zz = inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], np.float64)


def inertia_from_matrix(matrix: NDArray[np.float64]) -> Inertia6:
    """Return ixx, ixy, ixz, iyy, iyz, izz of a symmetric 3×3 matrix."""
    m = (matrix / 2 + matrix.T / 2).tolist()
    return (m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2])


def is_legal_inertia(inertia: Inertia6) -> bool:
    """Return whether a real body can have this tensor: see `inertia_problems`."""
    return not inertia_problems(inertia)


def inertia_problems(inertia: Inertia6) -> tuple[str, ...]:
    """Return what no real body's tensor can be, in words; empty when it is fine.

    The principal moments must be positive, and none larger than the sum of the other two
    (the triangle inequality, since each is an integral of two squared distances).
    """
    values = np.asarray(inertia, np.float64)
    if not np.isfinite(values).all():
        return ("it holds a value that is not a finite number",)
    a, b, c = np.linalg.eigvalsh(inertia_matrix(inertia)).tolist()
    problems = []
    shown = f"{a:.4g}, {b:.4g}, {c:.4g} kg m2"
    if a <= 0:
        problems.append(f"it is not positive definite (principal moments {shown})")
    if a + b < c * (1 - _SLACK):
        problems.append(
            f"it breaks the triangle inequality (principal moments {shown}: "
            f"{a:.4g} + {b:.4g} < {c:.4g})"
        )
    return tuple(problems)


def least_principal_moment(inertia: Inertia6) -> float:
    """Return the smallest principal moment in kg m2, 0 where rounding made it a little less.

    NaN when a value is not finite.
    """
    if not np.isfinite(np.asarray(inertia, np.float64)).all():
        return math.nan
    least, _, most = np.linalg.eigvalsh(inertia_matrix(inertia)).tolist()
    return 0.0 if abs(least) <= 1e-9 * abs(most) else float(least)


def legalised_inertia(inertia: Inertia6) -> Inertia6:
    """Return the tensor unchanged when legal, else the nearest one that only adds inertia.

    Principal axes stay. Moments are raised to at least 1/1000 of the largest (and 1e-9 kg m2), then
    the two smaller ones equally, until the triangle inequality holds. Nothing is lowered: a body
    that is harder to turn is stable at the same step, one that is easier may not be.
    Values that are not finite count as 0.
    """
    if is_legal_inertia(inertia):
        return inertia
    matrix = np.nan_to_num(inertia_matrix(inertia), nan=0.0, posinf=0.0, neginf=0.0)
    moments, axes = np.linalg.eigh(matrix)
    least = max(_MIN_RATIO * float(np.abs(moments).max()), _FLOOR_KG_M2)
    moments = np.maximum(moments, least)
    order = np.argsort(moments)
    missing = moments[order[2]] - moments[order[0]] - moments[order[1]]
    if missing > 0:
        moments[order[:2]] += missing / 2
    return inertia_from_matrix(axes @ np.diag(moments) @ axes.T)


def _point_tensor(offset: NDArray[np.float64]) -> NDArray[np.float64]:
    square = float(offset @ offset)
    return np.asarray(square * np.eye(3) - np.outer(offset, offset))


def _vector(values: NDArray[np.float64]) -> Vector3:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
