"""Seeded noise of plug-ins that have a plain sigma of their own."""

from __future__ import annotations

import zlib
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gazelle.simulator.plugins.context import PluginContext

__all__ = ["gaussian"]


def gaussian(context: PluginContext, sigma: float) -> Callable[[int], NDArray[np.float64]]:
    """Return a source of `count` normal values; seeded from the world's seed and the names.

    A reset of the world starts it over, so that two runs are alike.
    """
    name = f"{context.model.name}::{context.plugin.name}"
    seed = (context.host.seed, zlib.crc32(name.encode()))
    generators = [np.random.default_rng(seed)]

    def restart() -> None:
        generators[0] = np.random.default_rng(seed)

    def draw(count: int) -> NDArray[np.float64]:
        return generators[0].normal(0.0, sigma, count) if sigma > 0 else np.zeros(count)

    context.resources.on_reset(restart)
    return draw
