"""Paths on which a link moves straight from pose to pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.motion.constraints import PathConstraint
from gazelle.motion.constraints.kinematic_constraints import (
    Parameterization,
    matrix_of,
    rotation_vector,
)
from gazelle.motion.joint_space import FloatArray, Validity
from gazelle.motion.kinematics import Patience, Solver

__all__ = ["JumpLimits", "straight_path"]

_FINE = 0.02
_SLACK = 1e-5
_MAX_STEPS = 100_000


@dataclass(frozen=True)
class JumpLimits:
    """How far the joints may go in one step; 0 for any.

    Attributes:
        relative: factor of the mean step of the whole path (``jump_threshold``).
        turning: rad, of any turning joint.
        sliding: m, of any sliding joint.
        slides: which of the joints slide.
    """

    relative: float = 0.0
    turning: float = 0.0
    sliding: float = 0.0
    slides: Sequence[bool] = ()


def straight_path(
    solver: Solver,
    start_q: FloatArray,
    poses: Sequence[FloatArray],
    *,
    link: str,
    step_m: float,
    validity: Validity | None = None,
    along: Sequence[PathConstraint] = (),
    jumps: JumpLimits | None = None,
) -> tuple[FloatArray, float, str]:
    """Return configurations along straight lines, the part of the way they follow, and why no more.

    Args:
        solver: kinematics of the group.
        start_q: where the way starts.
        poses: 4×4 poses of the link, in order.
        link: what moves straight.
        step_m: longest way between two configurations, m; turns of the link count 1 m per rad.
        validity: refuses configurations, such as those that collide.
        along: what must hold all along.
        jumps: how far joints may go in one step.
    """
    targets = _targets(solver.fk(start_q, link), poses, step_m)
    rows, why = [start_q], ""
    for target in targets:
        q = solver.ik(target, seed_q=rows[-1], patience=Patience(attempts=1), link=link)
        why = _fault(q, rows[-1], target, validity, along)
        if why or q is None:
            break
        rows.append(q)
    path = np.array(rows)
    kept, jump = _before_jump(path, jumps or JumpLimits())
    fraction = (kept - 1) / max(1, len(targets))
    return path[:kept], fraction, jump or why


def _targets(start: FloatArray, poses: Sequence[FloatArray], step_m: float) -> list[FloatArray]:
    found: list[FloatArray] = []
    here = start
    for pose in poses:
        turn = rotation_vector(here[:3, :3].T @ pose[:3, :3])
        way = pose[:3, 3] - here[:3, 3]
        length = max(float(np.linalg.norm(way)), float(np.linalg.norm(turn)))
        count = min(max(1, int(np.ceil(length / step_m))), _MAX_STEPS)
        for part in np.arange(1, count + 1) / count:
            between = np.eye(4)
            partly = matrix_of(turn * part, Parameterization.ROTATION_VECTOR)
            between[:3, :3] = here[:3, :3] @ partly
            between[:3, 3] = here[:3, 3] + way * part
            found.append(between)
        here = pose
    return found


def _fault(
    q: FloatArray | None,
    before: FloatArray,
    target: FloatArray,
    validity: Validity | None,
    along: Sequence[PathConstraint],
) -> str:
    if q is None:
        x, y, z = target[:3, 3]
        return f"inverse kinematics finds nothing at ({x:.3f}, {y:.3f}, {z:.3f}) m"
    for item in along:
        if (np.abs(item.excess(q)) > _SLACK).any():
            return item.why(q)
    if validity is None or validity.motion_is_valid(before, q, _FINE):
        return ""
    return validity.why(q) or "the motion there collides"


def _before_jump(path: FloatArray, limits: JumpLimits) -> tuple[int, str]:
    """Return how many configurations come before the first jump."""
    steps = np.abs(np.diff(path, axis=0))
    if not len(steps):
        return len(path), ""
    lengths = np.linalg.norm(steps, axis=1)
    most = np.full(path.shape[1], np.inf)
    sliding = np.array(limits.slides, dtype=bool)
    if limits.turning > 0:
        most[~sliding] = limits.turning
    if limits.sliding > 0:
        most[sliding] = limits.sliding
    jumped = (steps > most).any(axis=1)
    if limits.relative > 0:
        jumped |= lengths > limits.relative * lengths.mean()
    if not jumped.any():
        return len(path), ""
    row = int(np.flatnonzero(jumped)[0])
    return row + 1, f"the joints jump by {lengths[row]:.3f} in one step"
