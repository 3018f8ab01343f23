"""Noise of several values at once, each with a stream of its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Noise
from gazelle.sensors.noise import noise_stream

__all__ = ["VectorNoise"]


class VectorNoise:
    """As many independent noises as a sensor has axes.

    Attributes:
        is_silent: whether all of them are.
    """

    def __init__(
        self, noises: Sequence[Noise], seed: int, name: str, *, axes: Sequence[str] = ()
    ) -> None:
        """Begin a stream for each axis.

        Args:
            noises: of the axes.
            seed: of the world.
            name: scoped name of the sensor.
            axes: their names, which their streams depend on; 0, 1 … when there are none.
        """
        parts = axes or [str(place) for place in range(len(noises))]
        self._streams = tuple(
            noise_stream(noise, seed, f"{name}/{part}")
            for noise, part in zip(noises, parts, strict=True)
        )
        self.is_silent = all(stream.is_silent for stream in self._streams)

    def apply(self, values: NDArray[np.float64], *, dt_s: float = 0.0) -> NDArray[np.float64]:
        """Return the (N,) values with noise; `dt_s` is the time since the last call."""
        if self.is_silent:
            return values
        pairs = zip(self._streams, values, strict=True)
        return np.array([float(stream.apply(float(value), dt_s=dt_s)) for stream, value in pairs])
