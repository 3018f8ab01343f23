"""What entering a cell costs each planner, by the cell's cost in the costmap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.costmap.cost_grid import INSCRIBED, UNKNOWN
from gazelle.navigation.planners.planner_options import (
    GlobalPlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
)

__all__ = ["global_planner_table", "navfn_table", "smac_table", "theta_table"]

_FORBIDDEN = np.float32(1e9)
_COSTS: NDArray[np.float64] = np.arange(256, dtype=float)


def navfn_table(allow_unknown: bool) -> NDArray[np.float32]:
    """Return 50 + 0.8 · cost, at most 253, (256,) by cost, as ``NavFn::setCostmap``."""
    table: NDArray[np.float32] = np.minimum(np.floor(50 + 0.8 * _COSTS), 253).astype(np.float32)
    table[INSCRIBED:] = _FORBIDDEN
    if allow_unknown:
        table[UNKNOWN] = 253
    return table


def global_planner_table(options: GlobalPlannerOptions) -> NDArray[np.float32]:
    """Return neutral_cost + cost_factor · cost below lethal_cost, (256,), by ``getCost``."""
    lethal = options.lethal_cost
    steps = np.minimum(options.neutral_cost + options.cost_factor * _COSTS, lethal - 1)
    table: NDArray[np.float32] = steps.astype(np.float32)
    table[max(lethal - 1, 0) :] = _FORBIDDEN
    if options.allow_unknown:
        table[UNKNOWN] = lethal - 1
    elif lethal > UNKNOWN:
        table[UNKNOWN] = _FORBIDDEN
    return table


def smac_table(options: Smac2DOptions) -> NDArray[np.float32]:
    """Return 1 + cost_travel_multiplier · cost / 252, (256,), by ``getTraversalCost``."""
    return _relative(1 + options.cost_travel_multiplier * _COSTS / 252, options.allow_unknown)


def theta_table(options: ThetaStarOptions) -> NDArray[np.float32]:
    """Return w_traversal_cost · (cost / 252)², (256,), by ``ThetaStar::getTraversalCost``."""
    # Cheap cells count as 50 there, so that paths do not hug walls for a few millimetres.
    costs = np.maximum(_COSTS, 50) / 252
    return _relative(options.w_traversal_cost * costs * costs, options.allow_unknown)


def _relative(steps: NDArray[np.float64], allow_unknown: bool) -> NDArray[np.float32]:
    table: NDArray[np.float32] = steps.astype(np.float32)
    table[INSCRIBED:] = _FORBIDDEN
    if allow_unknown:
        table[UNKNOWN] = table[INSCRIBED - 1]
    return table
