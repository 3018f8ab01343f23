"""Streams of noise, seeded by the world and by who has them."""

from __future__ import annotations

from typing import overload

from gazelle.noise import NOISE_MODELS, DriftModel, DriftNoise, Noise, NoiseStream, PictureNoise
from gazelle.sensors.seeding import random_stream

__all__ = ["noise_stream", "picture_noise"]


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
