"""Numbers of the least squares over the graph of poses."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["GraphSettings"]


@dataclass(frozen=True, slots=True)
class GraphSettings:
    """How poses are fitted to what is known of them.

    Attributes:
        anchor: weight that holds the first pose where it is.
        damping: added to all diagonals, so that a pose that nothing holds can be solved for.
        converged: steps smaller than this, m and rad, end the iterations.
        settled: from the second half of at least so many iterations on, loop closures that are
            still far off lose their influence.
        torn_squared: far off, in squared standard deviations: Φ of dynamic covariance scaling
            (Agarwal et al., 2013).
        doubt_squared: the same of relations of the drive that are doubtful.
    """

    anchor: float = 1e6
    damping: float = 1e-6
    converged: float = 1e-4
    settled: int = 10
    torn_squared: float = 30.0
    doubt_squared: float = 2.0
