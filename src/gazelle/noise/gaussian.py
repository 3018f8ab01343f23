"""SDF's noises: none, Gaussian with a bias, the same rounded, and what of it pictures have."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.noise.record import Noise

__all__ = ["GaussianNoise", "NoNoise", "PictureNoise"]

_MIN_PRECISION = 1e-6


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


def _drawn_bias(noise: Noise, random: np.random.Generator) -> float:
    bias = random.normal(noise.bias_mean, noise.bias_stddev)
    return -bias if random.random() < 0.5 else bias
