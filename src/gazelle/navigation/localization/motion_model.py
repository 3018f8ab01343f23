"""How particles move along with odometry."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.localization.amcl_parameters import AmclOptions

__all__ = ["MOTION_MODELS", "moved"]

Pose = tuple[float, float, float]

MOTION_MODELS = {
    "diff": ("diff", False),
    "omni": ("omni", False),
    "diff-corrected": ("diff", True),
    "omni-corrected": ("omni", True),
    # Nav2's models take standard deviations, as the corrected ones do.
    "differential": ("diff", True),
    "omnidirectional": ("omni", True),
    "nav2_amcl::DifferentialMotionModel": ("diff", True),
    "nav2_amcl::OmniMotionModel": ("omni", True),
}
"""Names of ``odom_model_type`` and ``robot_model_type``: drive, and whether it is corrected.

The models that are not corrected use variances as standard deviations, as amcl does for robots
whose parameters were tuned before that was found (wiki: amcl).
"""


def moved(
    particles: NDArray[np.float64],
    before: Pose,
    after: Pose,
    options: AmclOptions,
    random: np.random.Generator,
) -> NDArray[np.float64]:
    """Return particles, (n, 3), that drove as odometry says, each with its own noise.

    Args:
        particles: x, y (m) and yaw (rad).
        before: the robot in the odometry's frame at the last update.
        after: where it is now.
        options: model and its noise; `sample_motion_odometry` of Thrun and others 2005, table 5.6,
            with amcl's symmetric treatment of driving backwards.
        random: where noise comes from.

    Raises:
        KeyError: there is no such model.
    """
    drive, corrected = MOTION_MODELS[options.odom_model_type]
    turn = _difference(after[2], before[2])
    dx, dy = after[0] - before[0], after[1] - before[1]
    if drive == "omni":
        return _omni(particles, (dx, dy, turn), before[2], options, corrected, random)
    return _diff(particles, (dx, dy, turn), before[2], options, corrected, random)


def _diff(
    particles: NDArray[np.float64],
    delta: Pose,
    yaw: float,
    o: AmclOptions,
    corrected: bool,
    random: np.random.Generator,
) -> NDArray[np.float64]:
    way = math.hypot(delta[0], delta[1])
    first = 0.0 if way < 0.01 else _difference(math.atan2(delta[1], delta[0]), yaw)
    last = _difference(delta[2], first)
    a, b = (_turning(value) ** 2 for value in (first, last))
    spreads = [
        o.odom_alpha1 * a + o.odom_alpha2 * way * way,
        o.odom_alpha3 * way * way + o.odom_alpha4 * (a + b),
        o.odom_alpha1 * b + o.odom_alpha2 * way * way,
    ]
    noise = _noise(spreads, corrected, len(particles), random)
    heading = particles[:, 2] + first - noise[0]
    length = way - noise[1]
    return np.column_stack(
        [
            particles[:, 0] + length * np.cos(heading),
            particles[:, 1] + length * np.sin(heading),
            heading + last - noise[2],
        ]
    )


def _omni(
    particles: NDArray[np.float64],
    delta: Pose,
    yaw: float,
    o: AmclOptions,
    corrected: bool,
    random: np.random.Generator,
) -> NDArray[np.float64]:
    way2, turn2 = delta[0] ** 2 + delta[1] ** 2, delta[2] ** 2
    if corrected:
        spreads = [
            o.odom_alpha3 * way2 + o.odom_alpha4 * turn2,
            o.odom_alpha1 * turn2 + o.odom_alpha2 * way2,
            o.odom_alpha4 * turn2 + o.odom_alpha5 * way2,
        ]
    else:
        spreads = [
            o.odom_alpha3 * way2 + o.odom_alpha1 * turn2,
            o.odom_alpha4 * turn2 + o.odom_alpha2 * way2,
            o.odom_alpha1 * turn2 + o.odom_alpha5 * way2,
        ]
    along, turned, aside = _noise(spreads, corrected, len(particles), random)
    heading = particles[:, 2] + _difference(math.atan2(delta[1], delta[0]), yaw)
    along = math.sqrt(way2) + along
    return np.column_stack(
        [
            particles[:, 0] + along * np.cos(heading) + aside * np.sin(heading),
            particles[:, 1] + along * np.sin(heading) - aside * np.cos(heading),
            particles[:, 2] + delta[2] + turned,
        ]
    )


def _noise(
    spreads: list[float], corrected: bool, count: int, random: np.random.Generator
) -> NDArray[np.float64]:
    scale = np.sqrt(spreads) if corrected else np.array(spreads)
    return np.asarray(random.standard_normal((3, count)) * scale[:, None])


def _turning(angle: float) -> float:
    """Return an angle from straight ahead or straight back, whichever is nearer."""
    return min(abs(_difference(angle, 0.0)), abs(_difference(angle, math.pi)))


def _difference(a: float, b: float) -> float:
    return math.remainder(a - b, math.tau)
