"""Finding the pose of a scan in a field."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.matching import kernels, line_kernels
from gazelle.mapping.matching.field import Field
from gazelle.mapping.poses import Poses, wrap_angle

__all__ = ["Match", "Prior", "match", "refined"]

_ITERATIONS = 15
# Weight of one point: residuals of good matches scatter by about half a field's height, and
# points of one surface err together.
_POINT_WEIGHT = 4.0
_COARSE_TURN_RAD = 0.035
# Of a distance: standard deviation and farthest, m; of a line: fewest points, width, m.
_LINES = np.array([0.04, 0.12, 8.0, 0.05])
_FEWEST_ON_LINES = 20
_MOST_M = 0.12
_MOST_RAD = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """What is expected of a pose before matching.

    Attributes:
        pose: expected.
        information: inverse covariance in the field's frame, (3, 3).
    """

    pose: Poses
    information: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """A pose that fits.

    Attributes:
        pose: in the field's frame.
        score: mean likelihood of the points, within [0, 1].
        information: inverse covariance of what the scan alone says, in the field's frame, (3, 3).
        is_doubtful: another pose is about as likely.
    """

    pose: Poses
    score: float
    information: NDArray[np.float64]
    is_doubtful: bool = False


def match(
    field: Field,
    points_m: NDArray[np.float64],
    prior: Prior,
    *,
    reach_m: float,
    reach_rad: float,
    coarse: Field | None = None,
) -> Match:
    """Search a window around the expected pose, then refine (Olson 2009; Kohlbrecher 2011).

    Args:
        field: what is matched with.
        points_m: of the scan, in the robot's frame, (n, 2).
        prior: centre of the window; a departure from it costs.
        reach_m: half side of the window.
        reach_rad: the same for turns.
        coarse: ``field.pooled()``, if it is at hand.
    """
    coarse = coarse or field.pooled()
    step = coarse.cell_m
    # What a departure of the prior costs against the mean likelihood of the points.
    scale = 1.0 / (_POINT_WEIGHT * max(1, len(points_m)))
    weights = np.diagonal(prior.information) * scale
    toward = (*prior.pose, min(weights[0], weights[1]), weights[2])
    guess = _best(
        coarse, points_m, prior.pose, (reach_m, step, reach_rad, _COARSE_TURN_RAD), toward
    )
    fine = (step, field.cell_m, _COARSE_TURN_RAD, _COARSE_TURN_RAD / 3)
    return refined(field, points_m, _best(field, points_m, guess, fine, toward), prior)


def refined(field: Field, points_m: NDArray[np.float64], guess: Poses, prior: Prior) -> Match:
    """Refine a pose that is nearly right, within about a cell."""
    corner = (field.x_m, field.y_m, field.cell_m)
    pose, information = kernels.refine(
        field.values, *corner, points_m, guess, prior.pose, prior.information, _POINT_WEIGHT,
        _ITERATIONS,
    )  # fmt: skip
    pose, information = _on_lines(field, points_m, pose, prior, information)
    pose[2] = float(wrap_angle(pose[2]))
    score = field.mean(points_m, pose)
    return Match(pose, 0.0 if math.isnan(score) else score, information)


def _on_lines(
    field: Field,
    points_m: NDArray[np.float64],
    pose: Poses,
    prior: Prior,
    information: NDArray[np.float64],
) -> tuple[Poses, NDArray[np.float64]]:
    """Move a pose to where its points lie on the lines that the field's points lie along.

    A field's ridges are as wide as walls were seen at different places, and flat on top. The lines
    are the mean of what was seen.
    """
    if field.lines is None:
        return pose, information
    corner = (field.x_m, field.y_m, field.lines.cell_m)
    found, told, used = line_kernels.refine_on_lines(
        field.lines.places, field.lines.sums, *corner, points_m, pose, prior.pose,
        prior.information, _LINES, _ITERATIONS,
    )  # fmt: skip
    moved = math.dist(found[:2], pose[:2]), abs(float(wrap_angle(found[2] - pose[2])))
    if used < _FEWEST_ON_LINES or moved[0] > _MOST_M or moved[1] > _MOST_RAD:
        return pose, information
    return found, told


def _best(
    field: Field,
    points_m: NDArray[np.float64],
    guess: Poses,
    window: tuple[float, float, float, float],
    toward: tuple[float, ...],
) -> Poses:
    corner = (field.x_m, field.y_m, field.cell_m)
    found = kernels.best_in_window(
        field.values, *corner, points_m, np.asarray(guess), *window, np.array(toward)
    )
    return np.array(found[:3])
