"""What a wheeled robot stands on: the plane its weight rests on, found without physics."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.shape_volumes import Outline, Outlines
from gazelle.description.checks.wheels import Wheel, wheels_of
from gazelle.description.forward_kinematics import fixed_groups
from gazelle.description.model import JointType, Link, Model
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry import convex_hull

__all__ = ["SupportPlane", "check_support_plane", "support_plane_of"]

# Hulls of round shapes are polygons; their lowest corner may miss the lowest point.
_TOUCHING_M = 0.0015
_ROUNDING_M = 1e-6
_ANGLES_RAD = np.linspace(0.0, math.tau, 128, endpoint=False)
_DIRECTIONS = np.stack([np.cos(_ANGLES_RAD), np.sin(_ANGLES_RAD)])
_MIN_GRIP = 0.2
_DEFAULT_MU = 1.0

Array = NDArray[np.float64]


class SupportPlane(NamedTuple):
    """How a model rests on level ground.

    Attributes:
        gaps_m: distance of every collision to the ground then, in the order of the outlines.
        tilt_deg: how far it leans over to get there.
    """

    gaps_m: tuple[float, ...]
    tilt_deg: float


def support_plane_of(model: Model, outlines: Outlines) -> SupportPlane | None:
    """Return how the model rests; None without shapes, mass or a plane under the centre of mass."""
    center = _center_m(model)
    items = outlines.collisions
    if center is None or not items:
        return None
    try:
        hull = convex_hull(np.concatenate([item.points_m for item in items]))
    except (GazelleError, RuntimeError, ValueError):
        return None  # qhull gives up where sizes differ by more than digits hold
    corners = hull.vertices_m[hull.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    kept = lengths > 1e-12
    corners, normals = corners[kept], normals[kept] / lengths[kept, None]
    for triangle, normal in zip(corners, normals, strict=True):
        if normal[2] < -0.1 and _is_below(center, triangle):
            gaps = tuple(float((-(item.points_m - triangle[0]) @ normal).min()) for item in items)
            return SupportPlane(gaps, math.degrees(math.acos(min(1.0, -float(normal[2])))))
    return None


def check_support_plane(model: Model, outlines: Outlines, diagnostics: Diagnostics) -> None:
    """Report drive wheels that hang in the air and parts that drag along."""
    wheels = wheels_of(model)
    driven = [wheel for wheel in wheels if not wheel.is_caster]
    if len(driven) < 2 or any(joint.parent == "world" for joint in model.joints):
        return
    touchable = {item.link.name for item in outlines.collisions}
    groups = fixed_groups(model)
    if not all(touchable.intersection(groups[wheel.link.name]) for wheel in driven):
        return  # said of the wheel
    plane = _level_plane(model, outlines)
    if plane is None or _hanging(driven, groups, outlines, plane):
        plane = support_plane_of(model, outlines)
    if plane is None:
        return
    rolling = {name for wheel in wheels for name in groups[wheel.link.name]}
    on_ground = [
        item
        for item, gap in zip(outlines.collisions, plane.gaps_m, strict=True)
        if gap < _TOUCHING_M
    ]
    dragging = [item for item in on_ground if item.link.name not in rolling]
    hanging = _hanging(driven, groups, outlines, plane)
    if hanging:
        _report_hanging(hanging, on_ground, plane, diagnostics)
    else:
        _check_drag(dragging, model, diagnostics)


def _hanging(
    driven: list[Wheel],
    groups: Mapping[str, tuple[str, ...]],
    outlines: Outlines,
    plane: SupportPlane,
) -> list[tuple[Wheel, float]]:
    lowest: dict[str, float] = {}
    for item, gap in zip(outlines.collisions, plane.gaps_m, strict=True):
        lowest[item.link.name] = min(gap, lowest.get(item.link.name, math.inf))
    found = []
    for wheel in driven:
        gap = min(lowest[name] for name in groups[wheel.link.name] if name in lowest)
        if gap > _TOUCHING_M:
            found.append((wheel, gap))
    # Of three axles one may hang: six wheels never touch a plane all at once.
    return found if len(driven) - len(found) < 2 else []


def _report_hanging(
    hanging: list[tuple[Wheel, float]],
    on_ground: list[Outline],
    plane: SupportPlane,
    diagnostics: Diagnostics,
) -> None:
    names = " and ".join(
        f"'{wheel.link.name}' ({gap * 1e3:.3g} mm above)" for wheel, gap in hanging
    )
    does = "do" if len(hanging) > 1 else "does"
    others = ", ".join(sorted({f"'{item.link.name}'" for item in on_ground}))
    text = f"on level ground the robot rests on {others}; drive wheel {names} {does} not touch it"
    if plane.tilt_deg > 3.0:
        text += f" (it leans over by {plane.tilt_deg:.0f}°)"
    fix = (
        "let the wheels be the lowest collisions, casters as low as they are, and the centre of "
        "mass between all of them"
    )
    diagnostics.report("robot.wheel-in-the-air", text, hanging[0][0].link.span, fix=fix)


def _check_drag(dragging: list[Outline], model: Model, diagnostics: Diagnostics) -> None:
    for item in dragging:
        if item.collision is None or _swings(item.link, model):
            continue
        surface = item.collision.surface
        grips = [mu for mu in (surface.mu1, surface.mu2) if mu is not None]
        mu = max(grips) if grips else _DEFAULT_MU
        if mu <= _MIN_GRIP:
            continue
        said = f"a friction of {mu:g}" if grips else "Gazebo's friction of 1 (none is given)"
        text = (
            f"'{item.link.name}' slides on the ground and has {said}: it brakes like a "
            "locked wheel, the robot drives slower and turns less than commanded"
        )
        fix = f'<gazebo reference="{item.link.name}"><mu1>0.01</mu1><mu2>0.01</mu2></gazebo>'
        if model.source_format == "sdf":
            ode = "<ode><mu>0.01</mu><mu2>0.01</mu2></ode>"
            fix = f"<surface><friction>{ode}</friction></surface> in the collision"
        span = surface.span or item.collision.span or item.link.span
        diagnostics.report("robot.caster-friction", text, span, fix=fix)


def _swings(link: Link, model: Model) -> bool:
    """Tell whether a ball or roller: a joint lets it turn instead of sliding."""
    joint = next((item for item in model.joints if item.child == link.name), None)
    return joint is not None and joint.type not in (JointType.FIXED, JointType.PRISMATIC)


def _level_plane(model: Model, outlines: Outlines) -> SupportPlane | None:
    """Return how a model rests that surely stands level and touches clearly; None for others.

    For a hull qhull is imported, which takes longer than all checks of a robot. It is not asked
    where points that are the lowest but for rounding surround the centre of mass so widely that the
    plane through any of them is this one, within what no gap is near to.
    """
    center = _center_m(model)
    if center is None or not outlines.collisions:
        return None
    points = np.concatenate([item.points_m for item in outlines.collisions])
    if not np.isfinite(points).all():
        return None
    points = points - center
    ground = float(points[:, 2].min())
    lowest = points[points[:, 2] <= ground + _ROUNDING_M, :2]
    widths = (lowest @ _DIRECTIONS).max(axis=0)
    # Between two directions that are looked at, the width changes by no more than this.
    width = float(widths.min()) - float(np.hypot(*lowest.T).max()) * math.tau / len(widths)
    reach = float(np.hypot(*points[:, :2].T).max())
    if width <= 0.0 or _ROUNDING_M * (1.0 + reach / width) > _TOUCHING_M / 4.0:
        return None
    gaps = tuple(float(item.points_m[:, 2].min() - center[2]) - ground
                 for item in outlines.collisions)  # fmt: skip
    is_clear = all(not _TOUCHING_M / 2.0 < gap < _TOUCHING_M * 2.0 for gap in gaps)
    return SupportPlane(gaps, 0.0) if is_clear else None


def _center_m(model: Model) -> Array | None:
    total, moment = 0.0, np.zeros(3)
    for link in model.links:
        if link.inertial is not None and 0.0 < link.inertial.mass_kg < math.inf:
            pose = link.T_model_link @ link.inertial.T_link_com
            total += link.inertial.mass_kg
            moment += link.inertial.mass_kg * np.asarray(pose.position_m)
    return moment / total if total > 0.0 else None


def _is_below(center: Array, triangle: Array) -> bool:
    """Tell whether a point lies over a triangle, both seen from above."""
    a, b, c = triangle[:, :2]
    p = center[:2]

    def side(first: Array, second: Array) -> float:
        edge, arm = second - first, p - first
        return float(edge[0] * arm[1] - edge[1] * arm[0])

    sides = (side(a, b), side(b, c), side(c, a))
    return all(value >= -1e-9 for value in sides) or all(value <= 1e-9 for value in sides)
