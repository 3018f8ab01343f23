"""Noise of several values at once, each with a stream of its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Noise
from gazelle.sensors.noise import NoiseSource

__all__ = ["VectorNoise"]


class VectorNoise:
    """As many independent noises as a sensor has axes."""

    def __init__(self, noises: Sequence[Noise], seed: int, name: str) -> None:
        """Seed from the world's seed, the sensor's scoped name and the number of the axis."""
        self._sources = tuple(
            NoiseSource(noise, seed, f"{name}/{place}") for place, noise in enumerate(noises)
        )
        self._is_silent = all(source.is_silent for source in self._sources)

    def apply(self, values: NDArray[np.float64], dt_s: float) -> NDArray[np.float64]:
        """Return the (N,) values with noise; `dt_s` is the time since the last call."""
        if self._is_silent:
            return values
        pairs = zip(self._sources, values, strict=True)
        return np.array([float(source.apply(float(value), dt_s=dt_s)) for source, value in pairs])
