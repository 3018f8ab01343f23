"""Guesses that two places are one, believed once several agree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.loop_detection.settings import AgreementSettings, AmbiguitySettings
from gazelle.mapping.pose_graph.constraints import bounded
from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.scan_matching.scan_matcher import Match
from gazelle.mapping.se2 import Poses, between, compose

__all__ = ["Hypotheses", "Hypothesis", "ambiguous"]


def ambiguous(
    field: Field,
    points_m: NDArray[np.float64],
    found: Match,
    reach_m: float,
    settings: AmbiguitySettings,
) -> NDArray[np.float64]:
    """Return the inverse covariance of a match, (3, 3), other matches nearby being possible too.

    The shape of the best peak does not know of others beside it: along a corridor every door fits
    every door. Shifts along the direction that is known least count by how well they fit (Olson,
    "Real-time correlative scan matching", 2009).
    """
    information = bounded(found.information)
    _, axes = np.linalg.eigh(information[:2, :2])
    along = axes[:, 0]
    shifts = np.arange(-reach_m, reach_m + settings.step_m / 2, settings.step_m)
    scores = np.array(
        [field.mean(points_m, found.pose + np.array([*(along * shift), 0.0])) for shift in shifts]
    )
    weights = np.exp(np.minimum(0.0, scores - found.score) / settings.score_sigma)
    variance = float((weights * shifts**2).sum() / max(1.0, weights.sum()))
    # Sherman and Morrison (1950): the covariance grows by this variance along the axis.
    axis = np.array([*along, 0.0])
    pushed = information @ axis
    return np.asarray(
        information - np.outer(pushed, pushed) * variance / (1 + variance * float(axis @ pushed))
    )


@dataclass(frozen=True, slots=True, eq=False)
class Hypothesis:
    """Keyframe `head` is seen from keyframe `tail`.

    Attributes:
        tail, head: indices, the older one first.
        relative: ``tail⁻¹ ⊕ head``, (3,): x, y (m) and yaw (rad).
        information: its inverse covariance in the frame of the tail, (3, 3).
        score: mean likelihood of the match.
        reach_m: half side of the window it was found in; wide windows find more false ones.
    """

    tail: int
    head: int
    relative: Poses
    information: NDArray[np.float64]
    score: float
    reach_m: float


class Hypotheses:
    """Those that wait for others that agree with them.

    Two agree when going round (from one tail to its head, along the way to the other head, back to
    that one's tail and along that way to the first) ends where it began. False ones of a repetitive
    building agree by chance only over short ways.
    """

    def __init__(self, settings: AgreementSettings) -> None:
        """Start with none."""
        self._settings = settings
        self._waiting: list[Hypothesis] = []

    def agree(self, new: Hypothesis, poses: Poses, ways_m: NDArray[np.float64]) -> list[Hypothesis]:
        """Keep a new one; return the set that is believed now, often empty.

        Args:
            new: the new one.
            poses: of all keyframes, (n, 3).
            ways_m: driven until each keyframe, (n,).
        """
        told, now_m = self._settings, ways_m[new.head]
        self._waiting = [h for h in self._waiting if now_m - ways_m[h.head] < told.forgotten_m]
        party = [new]
        for other in sorted(self._waiting, key=lambda h: -h.score):
            if all(_agree(other, one, poses, ways_m, told) for one in party):
                party.append(other)
        self._waiting.append(new)
        heads = ways_m[[one.head for one in party]]
        span = float(heads.max() - heads.min())
        reach = max(one.reach_m for one in party)
        if len(party) < told.fewest or span < told.span_m + told.span_share * reach:
            return []
        believed = {id(one) for one in party}
        self._waiting = [one for one in self._waiting if id(one) not in believed]
        return party


def _agree(
    a: Hypothesis,
    b: Hypothesis,
    poses: Poses,
    ways_m: NDArray[np.float64],
    settings: AgreementSettings,
) -> bool:
    if a.head == b.head:
        return False
    over = compose(a.relative, between(poses[a.head], poses[b.head]))
    under = compose(between(poses[a.tail], poses[b.tail]), b.relative)
    error = between(over, under)
    length = abs(ways_m[a.head] - ways_m[b.head]) + abs(ways_m[a.tail] - ways_m[b.tail])
    near = np.hypot(error[0], error[1]) < settings.close_m + settings.close_m_per_m * length
    turn = settings.close_rad + settings.close_rad_per_m * length
    return bool(near and abs(error[2]) < turn)
