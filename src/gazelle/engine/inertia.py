"""Mass properties that MuJoCo can integrate: legal tensors, and no moving body without mass."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Inertial, Link
from gazelle.diagnostics import Diagnostics

__all__ = ["MASSLESS_LEAF_INERTIA_KG_M2", "MASSLESS_LEAF_KG", "BodyInertia", "body_inertia"]

MASSLESS_LEAF_KG = 1e-3
"""Mass given to a moving link that carries none: a gram."""

MASSLESS_LEAF_INERTIA_KG_M2 = 1e-6
"""Moment of inertia that goes with it: a gram with a radius of gyration of about 3 cm."""

_MIN_RATIO = 1e-6
_MARGIN = 1e-9
# MuJoCo takes principal moments below 1e-14 for none.
_MIN_KG_M2 = 1e-13


class BodyInertia(NamedTuple):
    """Mass properties about the centre of mass, axes of the link's frame.

    Attributes:
        mass_kg: mass.
        center_m: centre of mass in the link's frame.
        inertia_kg_m2: (3, 3), symmetric.
    """

    mass_kg: float
    center_m: tuple[float, float, float]
    inertia_kg_m2: NDArray[np.float64]


def body_inertia(link: Link, name: str, diagnostics: Diagnostics) -> BodyInertia | None:
    """Return the mass properties of a link, made legal, or None when it has no mass.

    A tensor is legal when its principal moments are positive and none is larger than the sum of
    the other two (no body can have such moments). An illegal one is replaced by a sphere's of
    the same trace, and reported.

    Args:
        link: the link.
        name: its name for messages, ``model::link``.
        diagnostics: takes ``engine.illegal-inertia``.
    """
    inertial = link.inertial
    if inertial is None or inertial.mass_kg <= 0:
        return None
    rotation = inertial.T_link_com.matrix()[:3, :3]
    tensor = rotation @ _matrix(inertial) @ rotation.T
    moments = np.linalg.eigvalsh(tensor)
    if not _is_legal(moments):
        mean = max(float(np.abs(moments).mean()), 1e-9 * inertial.mass_kg, _MIN_KG_M2)
        diagnostics.report(
            "engine.illegal-inertia",
            f"link '{name}' has an inertia no body can have (principal moments"
            f" {', '.join(f'{value:.3g}' for value in moments)} kg·m²); the engine uses"
            f" {mean:.3g} kg·m² about every axis",
            inertial.span or link.span,
        )
        tensor = np.eye(3) * mean
    else:
        # A thin disc's moments add up exactly, and MuJoCo refuses what rounding makes of that.
        excess = float(moments[2] * (1 + _MARGIN) - moments[0] - moments[1])
        lack = _MIN_KG_M2 - float(moments[0])
        tensor = tensor + np.eye(3) * max(excess, lack, 0.0)
    return BodyInertia(inertial.mass_kg, inertial.T_link_com.position_m, tensor)


def _matrix(inertial: Inertial) -> NDArray[np.float64]:
    ixx, ixy, ixz, iyy, iyz, izz = inertial.inertia_kg_m2
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]], dtype=np.float64)


def _is_legal(moments: NDArray[np.floating[Any]]) -> bool:
    low, middle, high = (float(value) for value in moments)
    if not np.isfinite(moments).all() or low <= 0 or low < _MIN_RATIO * high * 1e-3:
        return False
    return low + middle >= high * (1 - _MIN_RATIO)
