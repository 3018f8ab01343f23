"""Noise of measurements: what files say of it, and streams of random numbers that are it."""

from __future__ import annotations

from gazelle.noise.drift import DriftModel, DriftNoise
from gazelle.noise.gaussian import GaussianNoise, NoNoise, PictureNoise
from gazelle.noise.models import NOISE_MODELS, NOISE_TYPES, NoiseModel, NoiseStream
from gazelle.noise.record import NO_NOISE, Noise

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
