"""hector's error model, statistically."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.model import Noise
from gazelle.sensors import DriftModel, VectorNoise, noise_stream

QUIET = DriftModel((0.0,), (0.0,), (0.0,))


def test_scale_and_offset_are_exact() -> None:
    model = DriftModel((1.0, 0.0, -1.0), (0.0,) * 3, (0.0,) * 3, scale_error=(2.0, 1.0, 1.0))
    values = noise_stream(model, 1, "a").apply(np.array([3.0, 4.0, 5.0]), dt_s=0.1)
    assert values == pytest.approx([7.0, 4.0, 4.0])
    assert noise_stream(QUIET, 1, "a").apply(np.array([3.0]), dt_s=0.1) == pytest.approx([3.0])


def test_white_noise_has_its_sigma_and_the_drift_starts_with_its_own() -> None:
    white = noise_stream(DriftModel((0.0,), (0.0,), (0.5,)), 1, "w")
    values = [float(white.apply(np.zeros(1), dt_s=0.01)[0]) for _ in range(4000)]
    assert np.std(values) == pytest.approx(0.5, rel=0.05)
    starts = [
        noise_stream(DriftModel((0.0,), (2.0,), (0.0,)), k, "d").drift[0] for k in range(3000)
    ]
    assert np.std(starts) == pytest.approx(2.0, rel=0.05)


def test_drift_dies_away_with_its_frequency() -> None:
    model = DriftModel((0.0,), (1e-9,), (0.0,), drift_frequency_hz=(0.5,))
    noise = noise_stream(model, 1, "d")
    noise.drift = np.array([8.0])
    for _ in range(200):
        noise.apply(np.zeros(1), dt_s=0.01)
    assert noise.drift[0] == pytest.approx(8.0 * math.exp(-1.0), rel=1e-6)


def test_covariances_are_drift_and_noise_squared() -> None:
    model = DriftModel((0.0,) * 3, (3.0, 0.0, 1.0), (4.0, 0.5, 0.0))
    assert model.variances == pytest.approx([25.0, 0.25, 1.0])


def test_same_seed_same_noise_and_axes_are_independent() -> None:
    noises = [Noise("gaussian", 0.0, 1.0)] * 2
    first, again = (VectorNoise(noises, 5, "s").apply(np.zeros(2), dt_s=0.0) for _ in range(2))
    other = VectorNoise(noises, 6, "s").apply(np.zeros(2), dt_s=0.0)
    assert first.tolist() == again.tolist()
    assert first[0] != first[1]
    assert other[0] != first[0]
