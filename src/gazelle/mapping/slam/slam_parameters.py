"""What SLAM can be told; the defaults fit buildings, robots that drive, and planar lidars."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.mapping.slam.settings import SlamSettings

__all__ = ["SlamParameters"]


@dataclass(frozen=True, slots=True)
class SlamParameters:
    """Parameters of SLAM.

    Attributes:
        cell_m: cells of likelihood fields.
        sigma_m: how far beams end from their surface, standard deviation.
        max_range_m: beams that are longer are not matched.
        keyframe_m, keyframe_rad: a scan is kept when the robot has moved or turned so far.
        submap_scans: scans are matched with so many kept ones.
        window_m, window_rad: the least half sides of the window around odometry's guess.
        odometry_m_per_m: error of odometry's distance, standard deviation per way.
        odometry_rad_per_rad: of its turn, per turn.
        odometry_rad_per_m: of its heading, per way.
        least_match: mean likelihood below which a match is not believed.
        loop_closing: whether places are recognised.
        least_loop: mean likelihood below which a place is not recognised.
        loop_reach_m: places are looked for within this distance at most.
        loop_gap_m: a place is seen again after at least so long a way.
        polish: whether all scans are matched with their neighbours once more at the end.
        settings: numbers of the algorithms that hardly anybody needs to change.
    """

    cell_m: float = 0.05
    sigma_m: float = 0.07
    max_range_m: float = 20.0
    keyframe_m: float = 0.25
    keyframe_rad: float = 0.2
    submap_scans: int = 25
    window_m: float = 0.4
    window_rad: float = 0.4
    odometry_m_per_m: float = 0.1
    odometry_rad_per_rad: float = 0.15
    odometry_rad_per_m: float = 0.05
    least_match: float = 0.3
    loop_closing: bool = True
    least_loop: float = 0.6
    loop_reach_m: float = 18.0
    loop_gap_m: float = 10.0
    polish: bool = True
    settings: SlamSettings = field(default_factory=SlamSettings)
