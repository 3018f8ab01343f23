"""What a planner returns: a line of configurations without times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.motion.space import FloatArray

__all__ = ["Path"]


@dataclass(frozen=True)
class Path:
    """Straight motions between waypoints.

    Attributes:
        names: names of the joints.
        waypoints: shape (m, n), rad or m, m ≥ 2. Continuous joints go on past pi.
        planner: the planner that found it, by its MoveIt name.
        planning_time_s: time until there was a path.
        simplification_time_s: time that shortcuts took.
        validation_time_s: time that the fine check took.
        notes: what was done otherwise than asked, one sentence each.
        timed_out: whether the time limit ended an optimising planner; where it did not, the same
            seed gives the same path.
    """

    names: tuple[str, ...]
    waypoints: FloatArray
    planner: str = ""
    planning_time_s: float = 0.0
    simplification_time_s: float = 0.0
    validation_time_s: float = 0.0
    notes: tuple[str, ...] = ()
    timed_out: bool = False

    @property
    def length(self) -> float:
        """The Euclidean length, rad or m."""
        return float(np.linalg.norm(np.diff(self.waypoints, axis=0), axis=1).sum())

    def densified(self, step: float) -> FloatArray:
        """Return the path's states (k, n), no two neighbours further than `step` apart."""
        rows = [self.waypoints[:1]]
        for first, last in zip(self.waypoints[:-1], self.waypoints[1:], strict=True):
            count = max(1, int(np.ceil(np.linalg.norm(last - first) / step)))
            rows.append(first + (last - first) * (np.arange(1, count + 1) / count)[:, None])
        return np.concatenate(rows)
