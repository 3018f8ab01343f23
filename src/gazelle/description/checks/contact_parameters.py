"""Values of contacts that let a robot sink, creep or bounce."""

from __future__ import annotations

import math

from gazelle.description.checks.shape_volumes import Outlines
from gazelle.description.model import Collision, Link, Model
from gazelle.diagnostics import Diagnostics

__all__ = ["check_surfaces"]

_G_M_S2 = 9.8
_MAX_M_DEPTH = 0.001
_MIN_ERP = 0.01
_MAX_MIN_DEPTH_M = 0.01
_POINTS = 4
# Higher shapes bear no weight, whatever the joints do that carry wheels and feet.
_STANDING_M = 0.05


def check_surfaces(
    model: Model, outlines: Outlines, diagnostics: Diagnostics, *, step_s: float = 1e-3
) -> None:
    """Report kp, kd, minDepth and maxVel with effects that nobody wants.

    Args:
        model: the robot or thing.
        outlines: of its shapes; the weight rests on those near the lowest point.
        diagnostics: receives the findings.
        step_s: of the physics; ODE makes ERP = h·kp / (h·kp + kd) and CFM of kp and kd.
    """
    mass = sum(link.inertial.mass_kg for link in model.links if link.inertial is not None)
    bearing = _bearing(model, outlines)
    for link in model.links:
        for collision in link.collisions:
            load = mass if link.name in bearing else 0.0
            _check_stiffness(link, collision, load, step_s, diagnostics)
            _check_correction(link, collision, diagnostics)


def _bearing(model: Model, outlines: Outlines) -> frozenset[str]:
    """Return the links a model can stand on: not the fingers of an arm on a pedestal."""
    if any(joint.parent == "world" for joint in model.joints):
        return frozenset()
    lows = [(item.link.name, float(item.low_m[2])) for item in outlines.collisions]
    ground = min((low for _, low in lows), default=0.0)
    return frozenset(name for name, low in lows if low <= ground + _STANDING_M)


def _check_stiffness(
    link: Link, collision: Collision, mass_kg: float, step_s: float, diagnostics: Diagnostics
) -> None:
    surface = collision.surface
    kp, kd = surface.kp, surface.kd
    span = surface.span or collision.span or link.span
    if kp is not None and kp > 0.0 and math.isfinite(mass_kg):
        depth = mass_kg * _G_M_S2 / (_POINTS * kp)
        if depth > _MAX_M_DEPTH:
            text = (
                f"link '{link.name}' has a contact stiffness kp of {kp:g} N/m: with the model's "
                f"{mass_kg:.4g} kg on {_POINTS} such contacts it sinks in by {depth * 1e3:.3g} mm"
            )
            enough = 10 ** math.ceil(math.log10(mass_kg * _G_M_S2 / (_POINTS * 1e-4)))
            fix = f"write kp {enough:.0e}, or leave it out"
            diagnostics.report("robot.soft-contact", text, span, fix=fix)
    if kd is not None and kd > 0.0:
        stiff = step_s * (1e12 if kp is None or kp <= 0.0 else kp)
        if stiff / (stiff + kd) < _MIN_ERP:
            text = (
                f"link '{link.name}' has a contact damping kd of {kd:g} N·s/m beside kp "
                f"{kp or 1e12:g} N/m: in a step of {step_s * 1e3:g} ms ODE corrects only "
                f"{100 * stiff / (stiff + kd):.2g} % of a penetration, the link sinks slowly"
            )
            fix = f"write kd {min(100.0, stiff):g}, or leave it out"
            diagnostics.report("robot.damped-contact", text, span, fix=fix)


def _check_correction(link: Link, collision: Collision, diagnostics: Diagnostics) -> None:
    surface = collision.surface
    span = surface.span or collision.span or link.span
    if surface.min_depth_m is not None and surface.min_depth_m > _MAX_MIN_DEPTH_M:
        text = (
            f"link '{link.name}' has a minDepth of {surface.min_depth_m:g} m: it sinks in that "
            "deep before any contact pushes it out"
        )
        diagnostics.report("robot.contact-depth", text, span, fix="write minDepth 0.001")
    if surface.max_vel_m_s is not None and surface.max_vel_m_s <= 0.0:
        text = (
            f"link '{link.name}' has a maxVel of {surface.max_vel_m_s:g} m/s: contacts never push "
            "it out of what it has sunk into"
        )
        diagnostics.report("robot.contact-depth", text, span, fix="write maxVel 0.01 or more")
