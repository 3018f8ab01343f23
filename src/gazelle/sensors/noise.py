"""Noise models: one table, from which every sensor and plug-in makes its streams of noise.

A model is a record of parameters with a `type`; the table says what makes a stream of it. A new
model is a row here, and its word in `gazelle.description.model.NOISE_TYPES` where SDF names it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple, Protocol, overload

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Noise
from gazelle.sensors.drift_noise import DriftModel, DriftNoise
from gazelle.sensors.gaussian_noise import GaussianNoise, NoNoise, PictureNoise
from gazelle.sensors.seeding import random_stream

__all__ = ["NOISE_MODELS", "NoiseModel", "NoiseStream", "noise_stream", "picture_noise"]


class NoiseStream(Protocol):
    """Turns true values into measured ones, call by call."""

    @property
    def is_silent(self) -> bool:
        """Whether `apply` returns its input, so that a sensor need not ask."""

    def apply(self, values: Any, *, dt_s: float = 0.0) -> NDArray[np.float64]:
        """Return values with noise; `dt_s` is the simulated time since the last call."""


class NoiseModel(NamedTuple):
    """A row of the table.

    Attributes:
        type: word of SDF's ``<noise type="…">``, or of a plug-in's own error model.
        stream: makes a stream of the parameters and of random numbers.
        picture: likewise for cameras, None where pictures have no such noise.
    """

    type: str
    stream: Callable[[Any, np.random.Generator], NoiseStream]
    picture: Callable[[Any, np.random.Generator], PictureNoise] | None = None


NOISE_MODELS: Mapping[str, NoiseModel] = {
    row.type: row
    for row in (
        NoiseModel("none", NoNoise),
        NoiseModel("gaussian", GaussianNoise, PictureNoise),
        NoiseModel("gaussian_quantized", partial(GaussianNoise, quantised=True), PictureNoise),
        NoiseModel("hector_drift", DriftNoise),
    )
}


@overload
def noise_stream(model: Noise, seed: int, name: str) -> NoiseStream: ...
@overload
def noise_stream(model: DriftModel, seed: int, name: str) -> DriftNoise: ...
def noise_stream(model: Noise | DriftModel, seed: int, name: str) -> NoiseStream:
    """Return a stream of noise.

    Args:
        model: its parameters.
        seed: of the world.
        name: see `random_stream`.
    """
    return NOISE_MODELS[model.type].stream(model, random_stream(seed, name))


def picture_noise(noise: Noise, seed: int, name: str) -> PictureNoise | None:
    """Return a camera's noise, None where its model leaves pictures as they are."""
    make = NOISE_MODELS[noise.type].picture
    return None if make is None else make(noise, random_stream(seed, name))
