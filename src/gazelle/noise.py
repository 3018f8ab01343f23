"""Noise of measurements: what SDF says of it, and streams of random numbers that are it.

Noise models are one table, from which every sensor and plug-in makes its streams: none, SDF's
Gaussian with a bias, the same rounded, and the error model of hector_gazebo_plugins' sensors. A
model is a record of parameters with a `type`; the table says what makes a stream of it, and which
words SDF knows. A new model is its record, its stream and a row here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import SourceSpan

__all__ = [
    "NOISE_MODELS",
    "NOISE_TYPES",
    "NO_NOISE",
    "DriftModel",
    "DriftNoise",
    "GaussianNoise",
    "NoNoise",
    "Noise",
    "NoiseModel",
    "NoiseStream",
    "PictureNoise",
]

_MIN_PRECISION = 1e-6
Array = NDArray[np.float64]
_HOUR_S = 3600.0


@dataclass(frozen=True, slots=True)
class Noise:
    """SDF ``<noise>``: `type` is one of `gazelle.noise.NOISE_TYPES`."""

    type: str = "none"
    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    dynamic_bias_stddev: float = 0.0
    dynamic_bias_correlation_time_s: float = 0.0
    precision: float = 0.0
    span: SourceSpan | None = None


NO_NOISE = Noise()


@dataclass(frozen=True, slots=True)
class DriftModel:
    """Parameters, one value per axis, in the unit of what is measured.

    Attributes:
        offset: constant error.
        drift: sigma of the slowly moving error.
        drift_frequency_hz: how fast it moves; the default is one over an hour.
        gaussian_noise: sigma of the white noise.
        scale_error: factor on the true value.
    """

    type: ClassVar[str] = "hector_drift"

    offset: tuple[float, ...]
    drift: tuple[float, ...]
    gaussian_noise: tuple[float, ...]
    drift_frequency_hz: tuple[float, ...] = (1.0 / _HOUR_S,) * 3
    scale_error: tuple[float, ...] = (1.0, 1.0, 1.0)

    @property
    def variances(self) -> Array:
        """Drift and noise together, squared, (N,) by axis, as hector's covariances have them."""
        return np.square(self.drift) + np.square(self.gaussian_noise)


class DriftNoise:
    """``scale · value + offset + drift + N(0, noise)``.

    Over dt the drift becomes ``exp(-dt f) · drift + dt · N(0, sqrt(2 f) σ)``; it begins as
    N(0, σ). Source: hector_gazebo_plugins, sensor_model.h.

    Attributes:
        model: its parameters.
        drift: the present drift, (N,).
    """

    is_silent = False

    def __init__(self, model: DriftModel, random: np.random.Generator) -> None:
        """Draw the first drift."""
        self.model = model
        self._random = random
        self.drift: Array = self._random.standard_normal(len(model.drift)) * np.array(model.drift)

    def apply(self, values: Array, *, dt_s: float = 0.0) -> Array:
        """Return the (N,) values with error; `dt_s` is the time since the last call."""
        model, count = self.model, len(self.drift)
        frequency = np.array(model.drift_frequency_hz[:count])
        step = self._random.standard_normal(count) * np.sqrt(2 * frequency) * np.array(model.drift)
        self.drift = np.exp(-dt_s * frequency) * self.drift + dt_s * step
        white = self._random.standard_normal(count) * np.array(model.gaussian_noise)
        scale = np.array(model.scale_error[:count])
        return np.asarray(values * scale + np.array(model.offset) + self.drift + white)


class GaussianNoise:
    """One stream of noise: ``output = input + bias + N(mean, stddev)``.

    The bias is drawn once from N(bias_mean, bias_stddev) and, half of the time, its sign is
    changed (Gazebo Classic's GaussianNoiseModel). With a dynamic bias it walks as a first-order
    Gauss–Markov process (gz-sensors): over dt it decays by ``exp(-dt/τ)`` and gains
    ``N(0, sqrt(σ_b² τ/2 (1 − exp(−2 dt/τ))))``. ``gaussian_quantized`` rounds the result to
    multiples of the precision, half away from zero.

    Attributes:
        noise: the model.
        bias: its present bias.
    """

    is_silent = False

    def __init__(
        self, noise: Noise, random: np.random.Generator, *, quantised: bool = False
    ) -> None:
        """Draw the bias."""
        self.noise = noise
        self.bias = _drawn_bias(noise, random)
        self._random = random
        rounds = quantised and noise.precision > _MIN_PRECISION
        self._step = noise.precision if rounds else 0.0

    def apply(
        self, values: NDArray[np.floating] | float, *, dt_s: float = 0.0
    ) -> NDArray[np.float64]:
        """Return the values with noise.

        Args:
            values: true values, any shape.
            dt_s: simulated time since the last call, for the dynamic bias.
        """
        clean = np.asarray(values, np.float64)
        self._walk(dt_s)
        white = self.noise.mean + self.noise.stddev * self._random.standard_normal(clean.shape)
        noisy: NDArray[np.float64] = clean + self.bias + white
        if self._step > 0.0:
            noisy = np.copysign(np.floor(np.abs(noisy) / self._step + 0.5) * self._step, noisy)
        return noisy

    def _walk(self, dt_s: float) -> None:
        sigma = self.noise.dynamic_bias_stddev
        tau = self.noise.dynamic_bias_correlation_time_s
        if sigma <= 0 or tau <= 0 or dt_s <= 0:
            return
        spread = math.sqrt(-sigma * sigma * tau / 2 * math.expm1(-2 * dt_s / tau))
        self.bias = math.exp(-dt_s / tau) * self.bias + self._random.normal(0.0, spread)


class NoNoise:
    """Leaves values as they are."""

    is_silent = True

    def __init__(self, noise: Noise, random: np.random.Generator) -> None:
        """Take what all models take; there is nothing to draw."""

    def apply(
        self, values: NDArray[np.floating] | float, *, dt_s: float = 0.0
    ) -> NDArray[np.float64]:
        """Return the values, in their shape."""
        return np.asarray(values, np.float64)


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


class PictureNoise:
    """Noise of a camera: one sample of N(mean, stddev) per pixel for all channels.

    As in Gazebo's shaders there is neither bias nor rounding; 1 is the range of a channel.
    """

    def __init__(self, noise: Noise, random: np.random.Generator) -> None:
        """Take a stream of random numbers."""
        self._noise, self._random = noise, random
        # Not used, but drawn: pictures of a seed stay the same.
        _drawn_bias(noise, random)

    def apply(self, rgb: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return a picture, (rows, columns, 3), with noise."""
        samples = self._random.standard_normal(rgb.shape[:2], dtype=np.float32)
        samples *= np.float32(self._noise.stddev)
        samples += np.float32(self._noise.mean)
        samples = samples * np.float32(255.0)
        # Room for the sum without wrapping; a half is added so that truncation rounds.
        steps = np.floor(samples + np.float32(0.5)).astype(np.int16)
        noisy: NDArray[np.int16] = rgb.astype(np.int16) + steps[:, :, None]
        return noisy.clip(0, 255).astype(np.uint8)


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


def _drawn_bias(noise: Noise, random: np.random.Generator) -> float:
    bias = random.normal(noise.bias_mean, noise.bias_stddev)
    return -bias if random.random() < 0.5 else bias
