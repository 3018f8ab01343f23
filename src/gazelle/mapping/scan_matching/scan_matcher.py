"""Finding the pose of a scan in a field."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.scan_matching import matching_kernels
from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.scan_matching.match_arguments import LineTerms, Toward, Window
from gazelle.mapping.scan_matching.settings import MatchSettings
from gazelle.mapping.se2 import Poses, wrap_angle

__all__ = ["Match", "Prior", "match", "refined"]


class Prior(NamedTuple):
    """What is expected of a pose before matching.

    Attributes:
        pose: expected in the field's frame, (3,): x, y (m) and yaw (rad).
        information: inverse covariance in the field's frame, (3, 3).
    """

    pose: Poses
    information: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Match:
    """A pose that fits.

    Attributes:
        pose: in the field's frame, (3,): x, y (m) and yaw (rad).
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
    settings: MatchSettings,
    coarse: Field | None = None,
) -> Match:
    """Search a window around the expected pose, then refine (Olson 2009; Kohlbrecher 2011).

    Args:
        field: what is matched with.
        points_m: of the scan, in the robot's frame, (n, 2).
        prior: centre of the window; a departure from it costs.
        reach_m: half side of the window.
        reach_rad: the same for turns.
        settings: numbers of the search and of the refinement.
        coarse: ``field.pooled()``, if it is at hand.
    """
    coarse = coarse or field.pooled()
    step = coarse.cell_m
    # What a departure of the prior costs against the mean likelihood of the points.
    scale = 1.0 / (settings.point_weight * max(1, len(points_m)))
    weights = np.diagonal(prior.information) * scale
    toward = Toward(*map(float, (*prior.pose, min(weights[0], weights[1]), weights[2])))
    turn = settings.coarse_turn_rad
    wide = Window(reach_m, step, reach_rad, turn)
    guess = _best(coarse, points_m, prior.pose, wide, toward)
    fine = Window(step, field.cell_m, turn, turn / 3)
    guess = _best(field, points_m, guess, fine, toward)
    return refined(field, points_m, guess, prior, settings)


def refined(
    field: Field,
    points_m: NDArray[np.float64],
    guess: Poses,
    prior: Prior,
    settings: MatchSettings,
) -> Match:
    """Refine a pose that is nearly right, within about a cell.

    Args:
        field: what is matched with.
        points_m: (n, 2) in the robot's frame.
        guess: (3,) in the field's frame: x, y (m) and yaw (rad).
        prior: what else is known of the pose.
        settings: of matching.
    """
    pose, information = matching_kernels.refine(
        field.cells, points_m, guess, prior, settings.point_weight, settings.iterations
    )
    pose, information = _on_lines(field, points_m, pose, prior, information, settings)
    pose[2] = float(wrap_angle(pose[2]))
    score = field.mean(points_m, pose)
    return Match(pose, 0.0 if math.isnan(score) else score, information)


def _on_lines(
    field: Field,
    points_m: NDArray[np.float64],
    pose: Poses,
    prior: Prior,
    information: NDArray[np.float64],
    settings: MatchSettings,
) -> tuple[Poses, NDArray[np.float64]]:
    """Move a pose to where its points lie on the lines that the field's points lie along.

    A field's ridges are as wide as walls were seen at different places, and flat on top. The lines
    are the mean of what was seen.
    """
    if field.lines is None:
        return pose, information
    found, told, used = matching_kernels.refine_on_lines(
        field.lines, points_m, pose, prior, _line_terms(settings), settings.iterations
    )
    moved = math.dist(found[:2], pose[:2]), abs(float(wrap_angle(found[2] - pose[2])))
    is_far = moved[0] > settings.most_m or moved[1] > settings.most_rad
    if used < settings.fewest_on_lines or is_far:
        return pose, information
    return found, told


@cache
def _line_terms(settings: MatchSettings) -> LineTerms:
    return LineTerms(
        float(settings.line_sigma_m),
        float(settings.line_reach_m),
        float(settings.line_points),
        float(settings.line_width_m),
    )


def _best(
    field: Field,
    points_m: NDArray[np.float64],
    guess: Poses,
    window: Window,
    toward: Toward,
) -> Poses:
    found = matching_kernels.best_in_window(
        field.cells, points_m, np.asarray(guess), window, toward
    )
    return np.array(found[:3])
