"""Mass and inertia of links: can a body have them, and do they fit its shapes?

What is wrong comes with a block of URDF or SDF, ready to be pasted.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from gazelle.description.checks.inertia_units import (
    DENSITY_RANGE_KG_M3,
    Fit,
    UnitGuess,
    box_fit,
    guess_units,
    is_inside,
)
from gazelle.description.checks.written_inertials import JointRecord, LinkRecord
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity, SourceSpan
from gazelle.geometry import MassProperties, inertia_problems, legalised_inertia
from gazelle.geometry.mass_properties import least_principal_moment

__all__ = [
    "SUPERSEDED_CODES",
    "InertiaFinding",
    "check_inertia",
    "check_mass_ratios",
    "inertial_block",
    "repaired",
    "sdf_block",
    "urdf_block",
]

_TENSOR_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_WATER_KG_M3 = 1000.0
_DUMMY_KG = 1e-3
SUPERSEDED_CODES = frozenset(
    {
        "sdf.bad-inertia",
        "urdf.bad-inertia",
        "urdf.negative-mass",
        "urdf.no-inertia",
        "urdf.zero-inertia",
    }
)
"""What the readers say of the same mistakes; a report shows one of the two."""
_MAX_MASS_RATIO = 1000.0


class InertiaFinding(NamedTuple):
    """A finding about a link.

    Attributes:
        diagnostic: what is said.
        record: the link.
        body: the mass properties that would end it; None when nothing would.
        is_placeholder: more inertia than the link can have, which slows it and harms nothing.
    """

    diagnostic: Diagnostic
    record: LinkRecord
    body: MassProperties | None = None
    is_placeholder: bool = False


def urdf_block(body: MassProperties) -> str:
    """Return URDF's ``<inertial>``; the tensor's axes are those of the link."""
    moments = " ".join(
        f'{word}="{_shown(value)}"'
        for word, value in zip(_TENSOR_COMPONENTS, body.inertia_kg_m2, strict=True)
    )
    return (
        "<inertial>\n"
        f'  <origin xyz="{_point(body)}" rpy="0 0 0"/>\n'
        f'  <mass value="{_shown(body.mass_kg)}"/>\n'
        f"  <inertia {moments}/>\n"
        "</inertial>"
    )


def sdf_block(body: MassProperties) -> str:
    """Return SDF's ``<inertial>``; the tensor's axes are those of the link."""
    moments = "\n".join(
        f"    <{word}>{_shown(value)}</{word}>"
        for word, value in zip(_TENSOR_COMPONENTS, body.inertia_kg_m2, strict=True)
    )
    return (
        "<inertial>\n"
        f"  <pose>{_point(body)} 0 0 0</pose>\n"
        f"  <mass>{_shown(body.mass_kg)}</mass>\n"
        f"  <inertia>\n{moments}\n  </inertia>\n"
        "</inertial>"
    )


def inertial_block(body: MassProperties, source_format: str) -> str:
    """Return the block of ``urdf`` or ``sdf``."""
    return urdf_block(body) if source_format == "urdf" else sdf_block(body)


def check_inertia(
    records: Iterable[LinkRecord], *, density_kg_m3: float | None = None
) -> tuple[InertiaFinding, ...]:
    """Return everything that is wrong with the mass properties of links.

    Args:
        records: the links.
        density_kg_m3: density of the blocks to paste; None keeps a link's mass where it has one
            and takes 1000 kg/m³ where not.
    """
    return tuple(finding for record in records for finding in _judged(record, density_kg_m3))


def check_mass_ratios(joints: Iterable[JointRecord]) -> Diagnostics:
    """Return the joints between bodies whose masses differ by more than 1000."""
    diagnostics = Diagnostics()
    for joint in joints:
        light, heavy = sorted((joint.parent_mass_kg, joint.child_mass_kg))
        if heavy > _MAX_MASS_RATIO * light:
            message = (
                f"joint '{joint.name}' joins '{joint.parent}' of {joint.parent_mass_kg:.4g} kg and "
                f"'{joint.child}' of {joint.child_mass_kg:.4g} kg: 1 to {heavy / light:,.0f}"
            )
            thin = joint.child if joint.child_mass_kg == light else joint.parent
            fix = (
                f"give '{thin}' at least {heavy / _MAX_MASS_RATIO:.4g} kg with the inertia "
                "to match, or make the joint fixed"
            )
            diagnostics.report("inertia.mass-ratio", message, joint.span, fix=fix)
    return diagnostics


def repaired(record: LinkRecord, density_kg_m3: float | None = None) -> MassProperties | None:
    """Return mass properties from a link's shapes; without shapes its own tensor made possible.

    Args:
        record: the link.
        density_kg_m3: None keeps the link's mass; without one it is 1000.
    """
    written, shapes = record.written, record.shape_body
    mass = written.mass_kg if written is not None else math.nan
    has_mass = math.isfinite(mass) and mass > 0.0
    if shapes is not None:
        if density_kg_m3 is not None or not has_mass:
            return shapes.with_mass(shapes.mass_kg * (density_kg_m3 or _WATER_KG_M3))
        return shapes.with_mass(mass)
    if written is None or not has_mass:
        return None
    body = written.body
    return MassProperties(mass, body.center_m, legalised_inertia(body.inertia_kg_m2))


def _point(body: MassProperties) -> str:
    return " ".join(_shown(value) for value in body.center_m)


def _shown(value: float) -> str:
    """Nine digits: with fewer, a thin plate's tensor can break the triangle inequality."""
    return f"{value:.9g}" if abs(value) > 1e-15 else "0"


def _judged(record: LinkRecord, density: float | None) -> Iterator[InertiaFinding]:
    written = record.written
    if record.is_computed or record.has_unreadable:
        return
    new = repaired(record, density)
    if written is None:
        if record.needs_mass:
            yield _missing(record, new)
        return
    if not (math.isfinite(written.mass_kg) and written.mass_kg > 0.0):
        # A frame without mass, fixed to a body that has some, is common and harmless.
        if written.mass_kg != 0.0 or record.needs_mass or not record.is_fixed:
            message = f"link '{record.name}' has a mass of {written.mass_kg:g} kg"
            yield _finding("inertia.mass", message, record, written.mass_span, new)
        return
    if record.is_fixed and not any(written.inertia_kg_m2):
        return  # a point mass on another body
    possible = True
    for finding in _impossible(record, new):
        possible = False
        yield finding
    if record.points_m is not None and record.extent_m > 0.0:
        yield from _misfits(record, new, density, possible=possible)


def _missing(record: LinkRecord, new: MassProperties | None) -> InertiaFinding:
    does = (
        f"Gazebo drops it{_lost(record)}"
        if record.source_format == "urdf"
        else "Gazebo gives it 1 kg and moments of 1 kg·m²"
    )
    message = f"link '{record.name}' moves and has no <inertial>: {does}"
    if new is None:
        message += "; it has no shapes to compute one from"
    return _finding("inertia.missing", message, record, record.span, new)


def _lost(record: LinkRecord) -> str:
    if record.is_root:
        return ", and with it the whole robot: nothing appears"
    if not record.below:
        return ", and its joint"
    names = " and ".join(f"'{name}'" for name in record.below)
    rest = record.count_below - len(record.below)
    more = f" and {rest} more" if rest else ""
    return f" with all that hangs on it: {names}{more} vanish{'es' * (record.count_below == 1)}"


def _impossible(record: LinkRecord, new: MassProperties | None) -> Iterator[InertiaFinding]:
    written = record.written
    if written is None:
        return
    # A tensor that is not positive breaks the inequality as well: one block mends both.
    for problem in inertia_problems(written.inertia_kg_m2)[:1]:
        code = "inertia.triangle" if "triangle" in problem else "inertia.not-positive"
        message = f"no body has the inertia of link '{record.name}': {problem}"
        # Many a robot has zeros somewhere, and Gazebo simulates it.
        is_flat = least_principal_moment(written.inertia_kg_m2) >= 0.0
        severity = Severity.WARNING if is_flat else None
        yield _finding(code, message, record, written.inertia_span, new, severity)


def _misfits(
    record: LinkRecord, new: MassProperties | None, density: float | None, *, possible: bool
) -> Iterator[InertiaFinding]:
    written, points = record.written, record.points_m
    if written is None or points is None:
        return
    if record.is_fixed and written.mass_kg <= _DUMMY_KG:
        return  # a gram on another body, there to please Gazebo: nothing feels its tensor
    guess = guess_units(record)
    if guess is not None:
        yield _unit_finding(record, guess)
        return
    yield from _density_finding(record, new, density)
    body = written.body
    if possible:
        fit = box_fit(body, points)
        if fit.is_too_large or fit.is_too_small:
            message = _box_message(record, fit)
            found = _finding("inertia.box", message, record, written.inertia_span, new)
            yield found._replace(is_placeholder=not fit.is_too_small)
    if not is_inside(body.center_m, points):
        low, high = points.min(axis=0), points.max(axis=0)
        message = (
            f"the centre of mass of link '{record.name}', ({_metres(body.center_m, ', ')}) m, lies "
            f"outside its shapes, which reach from ({_metres(low, ', ')}) to "
            f"({_metres(high, ', ')}) m"
        )
        yield _finding("inertia.center", message, record, written.span, new)


def _box_message(record: LinkRecord, fit: Fit) -> str:
    message = (
        f"link '{record.name}' has the inertia of a box of {_metres(fit.equivalent_m)} m, "
        f"too {'large' if fit.is_too_large else 'small'} for its shapes of "
        f"{_metres(fit.bounding_m)} m along the same axes"
    )
    if fit.is_too_large and fit.would_fit_turned:
        message += "; turned it would fit: ixx, iyy and izz seem to be mixed up"
    return message


def _unit_finding(record: LinkRecord, guess: UnitGuess) -> InertiaFinding:
    message = f"link '{record.name}' is in the wrong unit: {'; '.join(guess.reasons)}"
    if guess.body is not None:
        span = record.written.span if record.written else record.span
        return _finding("inertia.units", message, record, span, guess.body)
    scale = " ".join([f"{guess.mesh_scale:g}"] * 3)
    scale_text = f'scale="{scale}"' if record.source_format == "urdf" else f"<scale>{scale}</scale>"
    fix = f"write {scale_text} into every <mesh> of the link"
    diagnostics = Diagnostics()
    diagnostics.report("inertia.units", message, record.unscaled_meshes[0], fix=fix)
    return InertiaFinding(next(iter(diagnostics)), record)


def _density_finding(
    record: LinkRecord, new: MassProperties | None, density: float | None
) -> Iterator[InertiaFinding]:
    written = record.written
    low, high = DENSITY_RANGE_KG_M3
    densities = [written.mass_kg / volume for volume in record.volumes_m3] if written else []
    if written is None or not densities or (max(densities) >= low and min(densities) <= high):
        return
    if max(densities) < low and not record.feels_gravity:
        return  # a balloon
    volume = max(record.volumes_m3) if max(densities) < low else min(record.volumes_m3)
    message = (
        f"link '{record.name}' has {written.mass_kg:.6g} kg in shapes of {volume:.4g} m³: "
        f"{written.mass_kg / volume:.4g} kg/m³, lighter than foam"
        if max(densities) < low
        else f"link '{record.name}' has {written.mass_kg:.6g} kg in shapes of {volume:.4g} m³: "
        f"{written.mass_kg / volume:.4g} kg/m³, denser than gold"
    )
    if density is not None:
        yield _finding("inertia.density", message, record, written.mass_span, new)
        return
    usual = volume * _WATER_KG_M3
    fix = f"correct the mass or the shapes; at {_WATER_KG_M3:g} kg/m³ they have {usual:.4g} kg"
    diagnostics = Diagnostics()
    diagnostics.report("inertia.density", message, written.mass_span, fix=fix)
    yield InertiaFinding(next(iter(diagnostics)), record)


def _finding(
    code: str,
    message: str,
    record: LinkRecord,
    span: SourceSpan | None,
    new: MassProperties | None,
    severity: Severity | None = None,
) -> InertiaFinding:
    diagnostics = Diagnostics()
    name = record.name.rpartition("::")[2]
    fix = f"write an <inertial> for '{name}' by hand: it has no shapes to compute one from"
    if new is not None:
        block = inertial_block(new, record.source_format)
        fix = f'paste into <link name="{name}">\n{block}'
    diagnostics.report(code, message, span, fix=fix, severity=severity)
    return InertiaFinding(next(iter(diagnostics)), record, new)


def _metres(values: Iterable[float], sign: str = " × ") -> str:
    return sign.join(f"{float(value):.3g}" for value in values)
