"""What the kernels that try trajectories are given, as records that they take whole."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "CRITIC_WEIGHTS",
    "Distances",
    "Growth",
    "Limits",
    "Outline",
    "PlanarState",
    "RolloutTerms",
    "SampleTerms",
    "SampleWeights",
    "Timing",
    "Variations",
    "Way",
]

CRITIC_WEIGHTS: np.dtype[Any] = np.dtype(
    [
        (name, np.float64)
        for name in (
            "cost",
            "critical",
            "collision",
            "near_collision",
            "near_goal",
            "goal",
            "goal_within",
            "yaw",
            "yaw_within",
            "align",
            "align_within",
            "align_offset",
            "follow",
            "follow_within",
            "follow_offset",
            "angle",
            "angle_within",
            "angle_offset",
            "angle_most",
            "forward",
            "forward_within",
            "twirl",
            "radius",
            "radius_weight",
        )
    ]
)
"""Parameters of MPPI's critics, see `MppiOptions.CRITICS`.

Not a `NamedTuple`: what is not read from memory lets LLVM add up in another order.
"""


class PlanarState(NamedTuple):
    """Where a robot is in the frame of the costmap, and its velocity in its own frame."""

    x_m: float
    y_m: float
    yaw_rad: float
    vx_m_s: float
    vy_m_s: float
    turn_rad_s: float


class Distances(NamedTuple):
    """How far cells are from the path and from the goal, as `kernels.distance_field` says.

    Attributes:
        path: (height, width), in cells.
        goal: (height, width), likewise.
    """

    path: NDArray[np.float32]
    goal: NDArray[np.float32]


class Timing(NamedTuple):
    """How long a trajectory is.

    Attributes:
        duration_s: of it.
        step_m: between its points, 0 where they are a fixed time apart.
        step_rad: likewise for turns; the time, s, where `step_m` is 0.
    """

    duration_s: float
    step_m: float
    step_rad: float


class Growth(NamedTuple):
    """How the outline grows with speed.

    Attributes:
        from_m_s: speed from which on it does.
        fastest_m_s: the highest speed.
        share: by how much of its size there.
    """

    from_m_s: float
    fastest_m_s: float
    share: float


class SampleWeights(NamedTuple):
    """What distances, obstacles and turning weigh for sampled velocities.

    Attributes:
        path, goal: of the robot's centre.
        nose_goal, nose_path: of its nose.
        obstacles: of costs.
        turning: of rad/s.
    """

    path: float
    goal: float
    nose_goal: float
    nose_path: float
    obstacles: float
    turning: float


class SampleTerms(NamedTuple):
    """How `kernels.score_samples` scores.

    Attributes:
        acceleration: (3,), along x and y (m/s²) and around z (rad/s²).
        weights: what counts.
        timing: of trajectories.
        growth: of the outline.
        nose_m: how far ahead of the centre the nose is.
        is_outlined: the whole outline must be free, else the centre.
        accelerates: velocities change towards the sample; otherwise it holds from the start.
        sums: costs of obstacles are summed, else the highest one counts.
        is_aligned: the nose shall keep to the path.
    """

    acceleration: NDArray[np.float64]
    weights: SampleWeights
    timing: Timing
    growth: Growth
    nose_m: float
    is_outlined: bool
    accelerates: bool
    sums: bool
    is_aligned: bool


class RolloutTerms(NamedTuple):
    """How `trajectory_kernel.roll_out` scores.

    Attributes:
        acceleration: (3,), along x and y (m/s²) and around z (rad/s²).
        timing: of trajectories.
        path, goal, obstacles, heading: weights.
        heading_s: at which time path, goal and heading count; negative for the end, and no heading.
        attracts: the goal's squared distance (m²) counts, and no path.
    """

    acceleration: NDArray[np.float64]
    timing: Timing
    path: float
    goal: float
    obstacles: float
    heading: float
    heading_s: float
    attracts: bool


class Outline(NamedTuple):
    """A robot's outline, with the radii of its circles.

    Attributes:
        corners_m: (n, 2).
        inner_m: of the largest circle within it.
        outer_m: of the smallest circle around it.
        scale: of the corners.
    """

    corners_m: NDArray[np.float64]
    inner_m: float
    outer_m: float
    scale: float


class Way(NamedTuple):
    """The path ahead.

    Attributes:
        points_m: (n, 2).
        along_m: (n,) their distances from the first one.
        goal: (3,) x, y (m) and yaw (rad) of the end of the whole path.
    """

    points_m: NDArray[np.float64]
    along_m: NDArray[np.float64]
    goal: NDArray[np.float64]


class Limits(NamedTuple):
    """What a robot can do.

    Attributes:
        rows: (3, 4), along x and y and around z: lowest and highest velocity, falling and rising
            acceleration.
        step_s: how long each control holds.
    """

    rows: NDArray[np.float64]
    step_s: float


class Variations(NamedTuple):
    """Controls and what is tried instead of them.

    Attributes:
        mean: (T, 3) controls along x and y (m/s) and around z (rad/s).
        noise: (K, T, 3) what is added to them.
        spread: (3,) its standard deviations.
        gamma: what a departure from the mean weighs.
    """

    mean: NDArray[np.float64]
    noise: NDArray[np.float64]
    spread: NDArray[np.float64]
    gamma: float
