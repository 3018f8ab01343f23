# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled step of both refinements towards the pose that fits best.

Written out: numba compiles expressions of whole arrays and `numpy.linalg` for seconds.
"""

from __future__ import annotations

import math

from gazelle.compiling import njit

__all__ = ["emptied", "stepped"]


@njit(cache=True, nogil=True)
def emptied(data, slope):
    """Set the sums, (3, 3) and (3,), to zero."""
    for i in range(3):
        slope[i] = 0.0
        for j in range(3):
            data[i, j] = 0.0


@njit(cache=True, nogil=True)
def stepped(data, slope, weight, information, pose, prior, damping, step):
    """Fill `step` with that of Gauss-Newton (Levenberg-Marquardt) from a pose.

    Args:
        data: its upper half is that of the information of the scan; filled, and times `weight`
            afterwards.
        slope: of the scan.
        weight: of the scan.
        information: of the prior, (3, 3).
        pose: where it is.
        prior: pose that is expected.
        damping: what the diagonal grows by, as a share of it; and by 0.001.
        step: (3,), filled.
    """
    for i in range(3):
        for j in range(i, 3):
            data[i, j] *= weight
            data[j, i] = data[i, j]
    x, y, turn = pose[0] - prior[0], pose[1] - prior[1], pose[2] - prior[2]
    turn = (turn + math.pi) % (2 * math.pi) - math.pi
    for i in range(3):
        step[i] = slope[i] * weight - (
            information[i, 0] * x + information[i, 1] * y + information[i, 2] * turn
        )
    # L D Lᵀ of the damped matrix, which is positive definite, and what is solved by it.
    a, d = data[0, 0] + information[0, 0], data[1, 1] + information[1, 1]
    f = data[2, 2] + information[2, 2]
    a += 1e-3 + damping * a
    d += 1e-3 + damping * d
    f += 1e-3 + damping * f
    b, c = data[0, 1] + information[0, 1], data[0, 2] + information[0, 2]
    e = data[1, 2] + information[1, 2]
    low, last = b / a, c / a
    d -= low * b
    e -= low * c
    between = e / d
    f -= last * c + between * e
    step[1] -= low * step[0]
    step[2] = (step[2] - last * step[0] - between * step[1]) / f
    step[1] = step[1] / d - between * step[2]
    step[0] = step[0] / a - low * step[1] - last * step[2]
