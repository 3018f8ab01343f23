"""Seeded noise of plug-ins that have a plain sigma of their own."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import NO_NOISE, Noise
from gazelle.simulator.plugins.context import PluginContext

__all__ = ["gaussian"]


def gaussian(context: PluginContext, sigma: float) -> Callable[[int], NDArray[np.float64]]:
    """Return a source of `count` normal values; seeded from the world's seed and the names.

    A reset of the world starts it over, so that two runs are alike.
    """
    from gazelle.sensors import noise_stream

    noise = Noise("gaussian", stddev=sigma) if sigma > 0 else NO_NOISE
    words = (context.host.seed, f"{context.model.name}::{context.plugin.name}")
    streams = [noise_stream(noise, *words)]

    def restart() -> None:
        streams[0] = noise_stream(noise, *words)

    context.resources.on_reset(restart)
    return lambda count: streams[0].apply(np.zeros(count))
