"""SDF ``<inertial>``: as written, or computed from the collisions (SDF 1.11)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from gazelle.description.context import ReadContext
from gazelle.description.model import Collision, Inertial
from gazelle.description.sdf.automatic_inertia import computed_inertial
from gazelle.description.sdf.poses import pose_of
from gazelle.description.sdf.values import child_float
from gazelle.description.xml import Tag
from gazelle.diagnostics import Severity
from gazelle.geometry.mass import MassProperties, inertia_problems, legalised_inertia

__all__ = ["read_inertial"]

Inertia6 = tuple[float, float, float, float, float, float]
_WORDS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_DEFAULTS: Inertia6 = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
_TRUE = ("1", "true")
_NOT_NUMBERS = frozenset({"inf", "+inf", "-inf", "nan", "-nan"})


def read_inertial(
    link: Tag, collisions: Sequence[Collision], context: ReadContext, *, static: bool
) -> Inertial:
    """Return a link's mass properties; SDF's default is 1 kg with moments of 1 kg·m².

    Args:
        link: the ``<link>``.
        collisions: its collisions, for ``auto="true"``.
        context: where problems are reported.
        static: the model never moves; impossible values do no harm then.
    """
    tag = link.find("inertial")
    if tag is None:
        return Inertial(1.0, span=link.span)
    if tag.attributes.get("auto", "").strip().lower() in _TRUE:
        return computed_inertial(link, tag, collisions, context)
    inertial = Inertial(
        mass_kg=child_float(tag, "mass", 1.0, context),
        T_link_com=pose_of(tag, context),
        inertia_kg_m2=_tensor(tag.find("inertia"), link, context),
        span=tag.span,
    )
    return inertial if static else _checked(inertial, link, tag, context)


def _tensor(tag: Tag | None, link: Tag, context: ReadContext) -> Inertia6:
    if tag is None:
        return _DEFAULTS
    # CAD exporters write nan for shapes without volume; Gazebo goes on with its defaults.
    lost = [child.name for child in tag.children if child.text.strip().lower() in _NOT_NUMBERS]
    if lost:
        name = link.attributes.get("name", "")
        message = (
            f"the inertia of link '{name}' is not finite ({', '.join(lost)}); the default, moments "
            "of 1 kg m2, is used"
        )
        context.diagnostics.report("sdf.bad-inertia", message, tag.span, severity=Severity.WARNING)
        return _DEFAULTS
    ixx, ixy, ixz, iyy, iyz, izz = (
        child_float(tag, word, default, context)
        for word, default in zip(_WORDS, _DEFAULTS, strict=True)
    )
    return ixx, ixy, ixz, iyy, iyz, izz


def _checked(inertial: Inertial, link: Tag, tag: Tag, context: ReadContext) -> Inertial:
    """Report a mass or tensor that no body can have; return one that a body can have."""
    name = link.attributes.get("name", "")
    # Gazebo classic, at home up to SDF 1.6, says nothing and simulates something.
    worst = Severity.WARNING if context.version < (1, 7) else Severity.ERROR
    if inertial.mass_kg <= 0.0:
        place = tag.find("mass") or tag
        message = f"link '{name}' has the mass {inertial.mass_kg:g} kg; 1 kg is used"
        context.diagnostics.report("sdf.bad-inertia", message, place.span, severity=worst)
        inertial = replace(inertial, mass_kg=1.0)
    problems = inertia_problems(inertial.inertia_kg_m2)
    if not problems:
        return inertial
    place = tag.find("inertia") or tag
    message = (
        f"no body has the inertia of link '{name}': {'; '.join(problems)}; "
        "the nearest possible tensor is used"
    )
    positive = min(
        MassProperties(1.0, inertia_kg_m2=inertial.inertia_kg_m2).principal_moments_kg_m2
    )
    severity = Severity.WARNING if positive > 0.0 else worst
    context.diagnostics.report("sdf.bad-inertia", message, place.span, severity=severity)
    return replace(inertial, inertia_kg_m2=legalised_inertia(inertial.inertia_kg_m2))
