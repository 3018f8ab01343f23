"""Noise models: one table, from which every sensor and plug-in makes its streams of noise.

A model is a record of parameters with a `type`; the table says what makes a stream of it, and
which words SDF knows. A new model is its module and a row here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.noise.drift import DriftModel, DriftNoise
from gazelle.noise.gaussian import GaussianNoise, NoNoise, PictureNoise

__all__ = ["NOISE_MODELS", "NOISE_TYPES", "NoiseModel", "NoiseStream"]


class NoiseStream(Protocol):
    """Turns true values into measured ones, call by call."""

    @property
    def is_silent(self) -> bool:
        """Whether `apply` returns its input, so that a sensor need not ask."""

    def apply(self, values: Any, *, dt_s: float = 0.0) -> NDArray[np.float64]:
        """Return values with noise, in their shape.

        Args:
            values: numbers of the unit of the noise.
            dt_s: simulated time since the last call.
        """


class NoiseModel(NamedTuple):
    """A row of the table.

    Attributes:
        type: word of SDF's ``<noise type="…">``, or of a plug-in's own error model.
        stream: makes a stream of the parameters and of random numbers.
        picture: likewise for cameras, None where pictures have no such noise.
        in_sdf: whether SDF's ``<noise>`` may be of it.
    """

    type: str
    stream: Callable[[Any, np.random.Generator], NoiseStream]
    picture: Callable[[Any, np.random.Generator], PictureNoise] | None = None
    in_sdf: bool = True


NOISE_MODELS: Mapping[str, NoiseModel] = {
    row.type: row
    for row in (
        NoiseModel("none", NoNoise),
        NoiseModel("gaussian", GaussianNoise, PictureNoise),
        NoiseModel("gaussian_quantized", partial(GaussianNoise, quantised=True), PictureNoise),
        NoiseModel(DriftModel.type, DriftNoise, in_sdf=False),
    )
}

NOISE_TYPES = tuple(row.type for row in NOISE_MODELS.values() if row.in_sdf)
"""The words of SDF's ``<noise type="…">``."""
