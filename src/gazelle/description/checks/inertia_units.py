"""Wrong units of mass, inertia and meshes, found from what does not fit together."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.written_inertials import LinkRecord
from gazelle.geometry import MassProperties, inertia_matrix, is_legal_inertia

__all__ = [
    "DENSITY_RANGE_KG_M3",
    "Fit",
    "UnitGuess",
    "box_fit",
    "equivalent_box_m",
    "guess_units",
    "is_inside",
]

DENSITY_RANGE_KG_M3 = (20.0, 20_000.0)
"""From foam to gold."""
# Of the equivalent box to the bounding box: all mass at the ends of an edge.
_MAX_RATIO = math.sqrt(3.0)
_MIN_RATIO = 0.2
_SLACK_M = 0.002
_USUAL_DENSITY = 1000.0
_USUAL_RATIO = 0.9
_MESH_UNITS = {"millimetres": 1e-3, "centimetres": 1e-2, "inches": 0.0254}
_TENSOR_UNITS = {"g·m²": 1e-3, "kg·cm²": 1e-4, "kg·mm²": 1e-6, "g·cm²": 1e-7, "g·mm²": 1e-9}
# The units lie at least a factor of √10 apart.
_FITTING_RATIOS = (0.35, 1.5)


class Fit(NamedTuple):
    """The equivalent box beside the bounding box along the same axes, metres, and the verdict.

    `would_fit_turned`: with its edges in another order the equivalent box is not too large.
    """

    equivalent_m: tuple[float, float, float]
    bounding_m: tuple[float, float, float]
    is_too_large: bool
    is_too_small: bool
    would_fit_turned: bool


class UnitGuess(NamedTuple):
    """A unit that would explain the numbers.

    Attributes:
        reasons: what is wrong and by which factor, one text per quantity.
        body: mass properties in the right units, link frame; None when they are right as written.
        mesh_scale: factor for the meshes, 1 when they are right.
    """

    reasons: tuple[str, ...]
    body: MassProperties | None
    mesh_scale: float = 1.0


def equivalent_box_m(
    body: MassProperties,
) -> tuple[tuple[float, float, float], NDArray[np.float64]]:
    """Return edges of the even box with this mass and tensor, and its axes as columns (3×3)."""
    moments, axes = np.linalg.eigh(inertia_matrix(body.inertia_kg_m2))
    squares = 6.0 / body.mass_kg * (moments.sum() - 2.0 * moments)
    x, y, z = np.sqrt(np.maximum(squares, 0.0)).tolist()
    return (x, y, z), np.asarray(axes, np.float64)


def box_fit(body: MassProperties, points_m: NDArray[np.float64]) -> Fit:
    """Compare the equivalent box with the extent along its axes of points (n, 3), m."""
    edges, axes = equivalent_box_m(body)
    x, y, z = np.ptp(points_m @ axes, axis=0).tolist()
    bounds = (x, y, z)
    small = max(edges) < _MIN_RATIO * max(bounds)
    turned = not _exceeds(sorted(edges), sorted(bounds))
    return Fit(edges, bounds, _exceeds(edges, bounds), small, turned)


def is_inside(point_m: Iterable[float], points_m: NDArray[np.float64]) -> bool:
    """Return whether a point lies in the bounding box of points (n, 3), with a little slack."""
    low, high = points_m.min(axis=0), points_m.max(axis=0)
    slack = 0.02 * float((high - low).max()) + _SLACK_M
    span = np.asarray(tuple(point_m))
    return bool((span >= low - slack).all() and (span <= high + slack).all())


def guess_units(record: LinkRecord) -> UnitGuess | None:
    """Return the unit that would make mass, tensor, centre and shapes fit, if they do not."""
    if record.written is None or record.points_m is None or record.extent_m <= 0.0:
        return None
    body = record.written.body
    mesh = _mesh_guess(record, body.mass_kg)
    if mesh is not None:
        unit, scale = mesh
        reason = f"its mesh is {record.extent_m:.4g} m long: it is in {unit}, a factor of {scale:g}"
        return UnitGuess((reason,), None, scale)
    reasons = []
    if _is_in_grams(record, body.mass_kg):
        reasons.append(f"{body.mass_kg:.6g} are grams, not kg: a factor of 0.001")
        body = _scaled(body, mass=1e-3)
    unit_factor = _tensor_guess(body, record.points_m)
    if unit_factor is not None:
        unit, factor = unit_factor
        reasons.append(f"its inertia is in {unit}, not kg·m²: a factor of {factor:g}")
        body = _scaled(body, tensor=factor)
    small = tuple(1e-3 * value for value in body.center_m)
    far = max(map(abs, body.center_m)) > 10.0 * record.extent_m
    if far and is_inside(small, record.points_m):
        reasons.append("its centre of mass is in millimetres: a factor of 0.001")
        body = MassProperties(body.mass_kg, (small[0], small[1], small[2]), body.inertia_kg_m2)
    return UnitGuess(tuple(reasons), body) if reasons else None


def _exceeds(edges: Iterable[float], bounds: Iterable[float]) -> bool:
    pairs = zip(edges, bounds, strict=True)
    return any(edge > _MAX_RATIO * bound * 1.02 + _SLACK_M for edge, bound in pairs)


def _mesh_guess(record: LinkRecord, mass_kg: float) -> tuple[str, float] | None:
    low = DENSITY_RANGE_KG_M3[0]
    densities = [mass_kg / volume for volume in record.volumes_m3]
    if not record.unscaled_meshes or not densities or max(densities) >= low:
        return None
    fitting = {
        name: scale
        for name, scale in _MESH_UNITS.items()
        if any(_is_material(value / scale**3) for value in densities)
    }
    return _closest(fitting, lambda scale: max(densities) / scale**3 / _USUAL_DENSITY)


def _is_in_grams(record: LinkRecord, mass_kg: float) -> bool:
    densities = [mass_kg / volume for volume in record.volumes_m3]
    too_dense = bool(densities) and min(densities) > DENSITY_RANGE_KG_M3[1]
    return too_dense and any(_is_material(value * 1e-3) for value in densities)


def _tensor_guess(body: MassProperties, points_m: NDArray[np.float64]) -> tuple[str, float] | None:
    if not is_legal_inertia(body.inertia_kg_m2) or _is_placeholder(body):
        return None
    fit = box_fit(body, points_m)
    if not fit.is_too_large:
        return None
    ratio = max(fit.equivalent_m) / max(*fit.bounding_m, 1e-9)
    low, high = _FITTING_RATIOS
    fitting = {
        name: factor
        for name, factor in _TENSOR_UNITS.items()
        if low <= ratio * math.sqrt(factor) <= high
    }
    return _closest(fitting, lambda factor: ratio * math.sqrt(factor) / _USUAL_RATIO)


def _is_placeholder(body: MassProperties) -> bool:
    """Return whether all moments are the same power of ten: no exporter computed that."""
    xx, _, _, yy, _, zz = body.inertia_kg_m2
    digits = math.log10(xx) if xx > 0.0 else 0.5
    return xx == yy == zz and abs(digits - round(digits)) < 1e-9


def _closest(
    fitting: Mapping[str, float], error: Callable[[float], float]
) -> tuple[str, float] | None:
    """Return the unit whose error is nearest to 1, as a factor."""
    return min(fitting.items(), key=lambda item: abs(math.log(error(item[1]))), default=None)


def _is_material(density_kg_m3: float) -> bool:
    return DENSITY_RANGE_KG_M3[0] <= density_kg_m3 <= DENSITY_RANGE_KG_M3[1]


def _scaled(body: MassProperties, *, mass: float = 1.0, tensor: float = 1.0) -> MassProperties:
    xx, xy, xz, yy, yz, zz = (value * tensor for value in body.inertia_kg_m2)
    return MassProperties(body.mass_kg * mass, body.center_m, (xx, xy, xz, yy, yz, zz))
