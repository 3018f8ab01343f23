"""Streams of noise, each from the world's seed and the scoped name of who has it."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import overload

import numpy as np
from numpy.typing import NDArray

from gazelle.noise import NOISE_MODELS, DriftModel, DriftNoise, Noise, NoiseStream, PictureNoise

__all__ = ["VectorNoise", "noise_stream", "picture_noise", "random_stream", "seed_words"]


def random_stream(seed: int, name: str) -> np.random.Generator:
    """Return a stream of random numbers that depends on nothing else, threads and order included.

    Args:
        seed: of the world.
        name: scoped name of the sensor or plug-in, and of the axis where it has several noises.
    """
    return np.random.Generator(np.random.Philox(np.random.SeedSequence(seed_words(seed, name))))


def seed_words(seed: int, name: str) -> list[int]:
    """Return the words that seed a stream: the same in every process and version."""
    digest = hashlib.blake2b(f"{seed}\0{name}".encode(), digest_size=32).digest()
    return [int(word) for word in np.frombuffer(digest, "<u4")]


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
