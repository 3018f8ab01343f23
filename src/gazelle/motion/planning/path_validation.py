"""The last check of a path before it leaves, ten times finer than the search."""

from __future__ import annotations

import itertools
from collections.abc import Container

import numpy as np

from gazelle.motion.joint_space import FloatArray, JointSpace, Validity

__all__ = ["FINE_STEP", "SWEPT_STEP", "ends_of", "first_fault", "first_faulty_motion", "why_faulty"]

FINE_STEP = 0.005
"""Longest motion between two states of the last check, rad or m."""

SWEPT_STEP = 0.001
"""The same where bounds tell of most motions: what only grazes something is not allowed either."""

_TOLERANCE = 1e-3


def first_fault(
    space: JointSpace, validity: Validity, states: FloatArray, step: float = FINE_STEP
) -> str:
    """Return what is wrong with a line of states, an empty string where nothing is.

    Args:
        space: limits; a thousandth of a rad or m beyond them counts as within.
        validity: collisions and path constraints.
        states: shape (m, n), straight motions between rows.
        step: longest motion that goes unchecked.
    """
    fault = first_faulty_motion(space, validity, states, step)
    return "" if fault is None else why_faulty(space, validity, fault, step)


def ends_of(first: FloatArray, last: FloatArray) -> tuple[bytes, bytes]:
    """Return what a motion between configurations (n,) is known by among others."""
    return first.tobytes(), last.tobytes()


def first_faulty_motion(
    space: JointSpace,
    validity: Validity,
    states: FloatArray,
    step: float = FINE_STEP,
    checked: Container[tuple[bytes, bytes]] = (),
) -> FloatArray | None:
    """Return both ends (2, n) of the first motion that is not allowed; see `first_fault`.

    Both ends are the same where a state itself is not.

    Args:
        space: see `first_fault`.
        validity: likewise.
        states: likewise.
        step: likewise.
        checked: motions that are known to be allowed, as `ends_of` gives them.
    """
    for q in states:
        if space.outside(q, tolerance=_TOLERANCE):
            return np.array([q, q])
    if not validity.is_valid(states[0]):
        return states[[0, 0]]
    for first, last in itertools.pairwise(states):
        known = ends_of(first, last) in checked
        if not known and not validity.motion_is_valid(first, last, step):
            return np.array([first, last])
    return None


def why_faulty(
    space: JointSpace, validity: Validity, motion: FloatArray, step: float = FINE_STEP
) -> str:
    """Return what is wrong with a motion (2, n) that `first_faulty_motion` found."""
    first, last = motion
    if beyond := space.outside(first, tolerance=_TOLERANCE):
        return beyond[0]
    if not validity.is_valid(first):
        return validity.why(first)
    return _reason(validity, first, last, step)


def _reason(validity: Validity, first: FloatArray, last: FloatArray, step: float) -> str:
    count = max(1, int(np.ceil(np.linalg.norm(last - first) / step)))
    for part in np.arange(1, count + 1) / count:
        q = first + (last - first) * part
        if not validity.is_valid(q):
            return validity.why(q)
    place = np.array2string(first, precision=4)
    return f"the motion that starts at {place} is not allowed"
