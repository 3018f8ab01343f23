"""Numbers of recognising places: where to look, what is compared, and when it is believed.

Those without a source were chosen on the Intel Research Lab's log (`benchmarks/bench_slam.py`), on
the public logs of `benchmarks/soak/slam_logs.py` and on the buildings of tests/mapping.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["AgreementSettings", "AmbiguitySettings", "CandidateSettings", "RecognitionSettings"]


@dataclass(frozen=True, slots=True)
class CandidateSettings:
    """Which earlier keyframes are looked at.

    Attributes:
        drift_m_per_m: how far a map drifts per way, standard deviation; also what a jump to a
            place of long ago is explained by.
        drift_m: how far a place is off in any case, standard deviation.
        sigmas: windows are so many standard deviations wide to each side.
        doubts: and so many of those of doubtful relations on the way.
        least_reach_m: the smallest window.
        nearest_m: places are farther than this only by their window.
        most_places: so many are looked at.
        loop_length_m: length of a relation that a loop closure made, on ways through the graph.
        same_pass: keyframes nearer than so many in the row belong to one visit.
        drift_rad: how much a heading is off in any case.
        drift_rad_per_m: and how much more per way.
        most_way_m: ways that are longer turn no more.
        no_doubt: squared deviation of a way, m² or rad², below which it is sure.
    """

    drift_m_per_m: float = 0.02
    drift_m: float = 0.1
    sigmas: float = 3.0
    doubts: float = 1.5
    least_reach_m: float = 0.3
    nearest_m: float = 4.0
    most_places: int = 2
    loop_length_m: float = 0.1
    same_pass: int = 3
    drift_rad: float = 0.1
    drift_rad_per_m: float = 0.003
    most_way_m: float = 150.0
    no_doubt: float = 0.1


@dataclass(frozen=True, slots=True)
class RecognitionSettings:
    """What of the present is compared with what of the past.

    Attributes:
        patch_m: way of the last keyframes that see together.
        patch_scans: so many of them at most.
        patch_cell_m: one point per cell of this side is compared.
        patch_points: and so many at most.
        place_m: way before and behind a place whose keyframes count.
        place_scans: so many to each side at most.
        apart_m: keyframes that count are so far apart.
        fewest_points: fewer say nothing.
        fewest_scans: so many since the last doubtful relation.
        first_reach_m: half side of the first window; each next one is twice as wide.
        least_doubt_m: shifts that are looked at for ambiguity reach so far at least.
        much_better: a match of a wider window must be better by this mean likelihood.
    """

    patch_m: float = 5.0
    patch_scans: int = 10
    patch_cell_m: float = 0.1
    patch_points: int = 300
    place_m: float = 6.0
    place_scans: int = 24
    apart_m: float = 0.45
    fewest_points: int = 40
    fewest_scans: int = 2
    first_reach_m: float = 0.25
    least_doubt_m: float = 1.5
    much_better: float = 0.08


@dataclass(frozen=True, slots=True)
class AmbiguitySettings:
    """How far a place could be shifted (Olson 2009).

    Attributes:
        step_m: between two shifts that are looked at.
        score_sigma: by how much the mean likelihood of equal places differs.
    """

    step_m: float = 0.2
    score_sigma: float = 0.04


@dataclass(frozen=True, slots=True)
class AgreementSettings:
    """When guesses confirm each other.

    Attributes:
        close_m: going round two of them ends so near to where it began.
        close_m_per_m: and so much farther off per way.
        close_rad: the same for the heading.
        close_rad_per_m: and per way.
        fewest: so many have to agree.
        span_m: over so long a way.
        span_share: and so much longer per half side of the widest window.
        forgotten_m: after so long a way a guess waits no more.
    """

    close_m: float = 0.15
    close_m_per_m: float = 0.02
    close_rad: float = 0.04
    close_rad_per_m: float = 0.002
    fewest: int = 3
    span_m: float = 1.0
    span_share: float = 0.2
    forgotten_m: float = 30.0
