"""Noise models of SDF's ``<noise>``, seeded per sensor and independent of threads and order."""

from __future__ import annotations

import hashlib
import math

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Noise

__all__ = ["NoiseSource", "seed_words"]

_GAUSSIAN = ("gaussian", "gaussian_quantized")
_SMALLEST_PRECISION = 1e-6


def seed_words(seed: int, name: str) -> list[int]:
    """Return the words that seed a sensor's generator: the same in every process and version.

    Args:
        seed: of the world.
        name: scoped name of the sensor, and of the axis where it has several noises.
    """
    digest = hashlib.blake2b(f"{seed}\0{name}".encode(), digest_size=32).digest()
    return [int(word) for word in np.frombuffer(digest, "<u4")]


class NoiseSource:
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

    def __init__(self, noise: Noise, seed: int, name: str) -> None:
        """Seed from the world's seed and the sensor's scoped name."""
        self.noise = noise
        self._random = np.random.Generator(
            np.random.Philox(np.random.SeedSequence(seed_words(seed, name)))
        )
        bias = self._random.normal(noise.bias_mean, noise.bias_stddev)
        self.bias = -bias if self._random.random() < 0.5 else bias

    @property
    def is_silent(self) -> bool:
        """Whether `apply` returns its input: the type is no Gaussian one."""
        return self.noise.type not in _GAUSSIAN

    def apply(
        self, values: NDArray[np.floating] | float, *, dt_s: float = 0.0
    ) -> NDArray[np.float64]:
        """Return the values with noise.

        Args:
            values: true values, any shape.
            dt_s: simulated time since the last call, for the dynamic bias.
        """
        clean = np.asarray(values, np.float64)
        if self.is_silent:
            return clean
        self._walk(dt_s)
        noisy = clean + self.bias + self.white(clean.shape)
        precision = self.noise.precision
        if self.noise.type == "gaussian_quantized" and precision > _SMALLEST_PRECISION:
            noisy = np.copysign(np.floor(np.abs(noisy) / precision + 0.5) * precision, noisy)
        return noisy

    def white(self, shape: tuple[int, ...]) -> NDArray[np.float64]:
        """Return samples of N(mean, stddev) without bias."""
        return self.noise.mean + self.noise.stddev * self._random.standard_normal(shape)

    def white32(self, shape: tuple[int, ...]) -> NDArray[np.float32]:
        """Return samples of N(mean, stddev) without bias, float32 (for images)."""
        samples = self._random.standard_normal(shape, dtype=np.float32)
        samples *= np.float32(self.noise.stddev)
        samples += np.float32(self.noise.mean)
        return samples

    def _walk(self, dt_s: float) -> None:
        sigma = self.noise.dynamic_bias_stddev
        tau = self.noise.dynamic_bias_correlation_time_s
        if sigma <= 0 or tau <= 0 or dt_s <= 0:
            return
        spread = math.sqrt(-sigma * sigma * tau / 2 * math.expm1(-2 * dt_s / tau))
        self.bias = math.exp(-dt_s / tau) * self.bias + self._random.normal(0.0, spread)
