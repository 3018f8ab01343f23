"""Numbers of matching: what fields, surfaces and searches of a scan's pose count with.

Those without a source were chosen on the Intel Research Lab's log (`benchmarks/bench_slam.py`), on
the public logs of `benchmarks/soak/slam_logs.py` and on the buildings of tests/mapping.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["FieldSettings", "MatchSettings", "SurfaceSettings"]


@dataclass(frozen=True, slots=True)
class FieldSettings:
    """How likelihood fields are made.

    Attributes:
        parts: a point's bell is centred to one over so many of a cell.
        line_cell_m: side of the cells that gather the lines of surfaces.
    """

    parts: int = 4
    line_cell_m: float = 0.1


@dataclass(frozen=True, slots=True)
class SurfaceSettings:
    """Which neighbouring beams met one surface.

    Attributes:
        same_m: those whose ends are nearer than this.
        straight_gap_m: and up to this where they go on along a straight line.
        straight_m: how far off the line the next end may be.
    """

    same_m: float = 0.3
    straight_gap_m: float = 1.2
    straight_m: float = 0.05


@dataclass(frozen=True, slots=True)
class MatchSettings:
    """How the pose of a scan is found in a field (Olson 2009) and refined (Kohlbrecher 2011).

    Attributes:
        iterations: at most so many steps of a refinement.
        point_weight: of one point against the prior: residuals of good matches scatter by about
            half a field's height, and points of one surface err together.
        coarse_turn_rad: steps of the search in the coarse field; the fine one's are a third.
        line_sigma_m: standard deviation of a point's distance from its line.
        line_reach_m: points farther from a line are not its own.
        line_points: so many points make a line.
        line_width_m: what scatters more across is no line.
        fewest_on_lines: with fewer points on lines their refinement does not count.
        most_m: nor does one that moves farther than this.
        most_rad: nor one that turns by more.
    """

    iterations: int = 15
    point_weight: float = 4.0
    coarse_turn_rad: float = 0.035
    line_sigma_m: float = 0.04
    line_reach_m: float = 0.12
    line_points: float = 8.0
    line_width_m: float = 0.05
    fewest_on_lines: int = 20
    most_m: float = 0.12
    most_rad: float = 0.05
