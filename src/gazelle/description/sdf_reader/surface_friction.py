"""SDF ``<surface>``: friction, contact and bounce of a collision."""

from __future__ import annotations

import math

from gazelle.description.model import Surface
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    optional_float,
    optional_int,
    optional_vector3,
)
from gazelle.description.xml import Tag, bool_from
from gazelle.geometry import Vector3

__all__ = ["read_surface"]

_USUAL_DEPTH_M = 0.001


def read_surface(tag: Tag | None, context: ReadContext) -> Surface:
    """Return the contact behaviour of a collision, all None where the file says nothing.

    ODE's words come first; where only Bullet's are given (``friction``, ``friction2``,
    ``rolling_friction``, ``bullet`` ``kp`` and ``kd``) they count instead.

    Args:
        tag: the ``<surface>`` element, None for none.
        context: where problems are reported.
    """
    if tag is None:
        return Surface()
    friction, bounce = tag.find("friction"), tag.find("bounce")
    ode, bullet = tag.find("friction", "ode"), tag.find("friction", "bullet")
    contact_mask = optional_int(tag.find("contact"), "collide_bitmask", context)
    torsional_mu, patch_radius_m = _torsional(friction, context)
    return Surface(
        mu1=_first(optional_float(ode, "mu", context), optional_float(bullet, "friction", context)),
        mu2=_first(
            optional_float(ode, "mu2", context), optional_float(bullet, "friction2", context)
        ),
        fdir1=_direction(ode, bullet, context),
        slip1=optional_float(ode, "slip1", context),
        slip2=optional_float(ode, "slip2", context),
        torsional_mu=torsional_mu,
        torsional_patch_radius_m=patch_radius_m,
        rolling_mu=optional_float(bullet, "rolling_friction", context),
        kp=_contact_word(tag, "kp", context),
        kd=_contact_word(tag, "kd", context),
        min_depth_m=optional_float(tag.find("contact", "ode"), "min_depth", context),
        max_vel_m_s=optional_float(tag.find("contact", "ode"), "max_vel", context),
        restitution=optional_float(bounce, "restitution_coefficient", context),
        bounce_threshold_m_s=optional_float(bounce, "threshold", context),
        collide_bitmask=contact_mask,
        collide_without_contact=bool_from(
            tag.find("contact", "collide_without_contact"), False, context.diagnostics
        ),
        soft_cfm=_contact_word(tag, "soft_cfm", context),
        soft_erp=_contact_word(tag, "soft_erp", context),
        span=tag.span,
    )


def _first(*values: float | None) -> float | None:
    return next((value for value in values if value is not None), None)


def _contact_word(tag: Tag, name: str, context: ReadContext) -> float | None:
    """Return a word that ODE and Bullet share."""
    ode, bullet = tag.find("contact", "ode"), tag.find("contact", "bullet")
    return _first(optional_float(ode, name, context), optional_float(bullet, name, context))


def _direction(ode: Tag | None, bullet: Tag | None, context: ReadContext) -> Vector3 | None:
    """Return ``fdir1`` as a unit vector; the null vector means automatic."""
    found = optional_vector3(ode, "fdir1", context) or optional_vector3(bullet, "fdir1", context)
    length = math.hypot(*found) if found else 0.0
    if found is None or length == 0.0:
        return None
    return (found[0] / length, found[1] / length, found[2] / length)


def _torsional(friction: Tag | None, context: ReadContext) -> tuple[float | None, float | None]:
    """Return coefficient and patch radius; SDF 1.6 lets a surface radius stand for the patch.

    The patch radius of a sphere of radius R pressed in by d is sqrt(R·d); without a known depth
    the smallest depth ODE keeps (``min_depth`` of 1 mm is usual) is taken.
    """
    torsional = friction.find("torsional") if friction is not None else None
    if torsional is None:
        return None, None
    coefficient = child_float(torsional, "coefficient", 1.0, context)
    if child_bool(torsional, "use_patch_radius", True, context):
        radius_m = child_float(torsional, "patch_radius", 0.0, context)
    else:
        radius_m = math.sqrt(
            max(0.0, child_float(torsional, "surface_radius", 0.0, context)) * _USUAL_DEPTH_M
        )
    return coefficient, radius_m
