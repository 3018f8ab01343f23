"""Noise models: statistics, bias, walking bias, quantisation, repeatability."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest

from gazelle.noise import Noise
from gazelle.sensors import noise_stream, picture_noise
from gazelle.sensors.noise_streams import seed_words


def test_gaussian_noise_adds_mean_and_sigma() -> None:
    noisy = noise_stream(Noise("gaussian", mean=0.5, stddev=2.0), 0, "s").apply(
        np.full(40_000, 3.0)
    )
    assert noisy.mean() == pytest.approx(3.5, abs=4 * 2.0 / 200)
    assert noisy.std() == pytest.approx(2.0, rel=0.02)


def test_type_none_changes_nothing() -> None:
    source = noise_stream(Noise("none", mean=1.0, stddev=1.0), 0, "s")
    assert source.is_silent
    assert source.apply(np.array([1.0, 2.0])).tolist() == [1.0, 2.0]


def test_quantised_noise_gives_multiples_of_the_precision() -> None:
    source = noise_stream(Noise("gaussian_quantized", stddev=1.0, precision=0.25), 0, "s")
    steps = source.apply(np.zeros(1000)) / 0.25
    assert np.array_equal(steps, np.round(steps))
    assert len(np.unique(steps)) > 10


def test_bias_is_drawn_once_with_either_sign() -> None:
    noise = Noise("gaussian", bias_mean=0.8, bias_stddev=0.1)
    biases = np.array([noise_stream(noise, seed, "s").bias for seed in range(400)])
    assert np.abs(biases).mean() == pytest.approx(0.8, abs=0.02)
    assert 150 < (biases > 0).sum() < 250
    source = noise_stream(noise, 5, "s")
    assert source.apply(1.0, dt_s=1.0) == source.apply(1.0, dt_s=1.0) == 1.0 + source.bias


def test_walking_bias_keeps_its_stationary_spread_and_correlation() -> None:
    sigma, tau, dt = 0.2, 0.5, 0.1
    noise = Noise("gaussian", dynamic_bias_stddev=sigma, dynamic_bias_correlation_time_s=tau)
    source = noise_stream(noise, 1, "s")
    walk = np.array([float(source.apply(0.0, dt_s=dt)) for _ in range(40_000)])
    # An Ornstein-Uhlenbeck process of diffusion sigma²: variance sigma² tau / 2.
    assert walk.std() == pytest.approx(sigma * math.sqrt(tau / 2), rel=0.05)
    correlation = np.corrcoef(walk[:-1], walk[1:])[0, 1]
    assert correlation == pytest.approx(math.exp(-dt / tau), abs=0.02)


def test_streams_depend_on_seed_and_name_only() -> None:
    noise = Noise("gaussian", stddev=1.0)

    def first(seed: int, name: str) -> float:
        return float(noise_stream(noise, seed, name).apply(0.0))

    assert first(1, "a") == first(1, "a")
    assert len({first(1, "a"), first(2, "a"), first(1, "b")}) == 3


def test_seeds_are_the_same_in_every_process() -> None:
    code = (
        "from gazelle.sensors.noise_streams import seed_words\n"
        "print(seed_words(42, 'robot::laser'))"
    )
    run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert run.stdout.strip() == str(seed_words(42, "robot::laser"))


def test_pictures_have_the_white_noise_of_gaussian_models_alone() -> None:
    rgb = np.full((40, 40, 3), 100, np.uint8)
    assert picture_noise(Noise("none", stddev=0.1), 1, "c") is None
    noise = picture_noise(Noise("gaussian", stddev=0.02, bias_mean=0.5), 1, "c")
    assert noise is not None
    steps = noise.apply(rgb).astype(int) - 100
    assert np.array_equal(steps[..., 0], steps[..., 2])
    assert abs(steps.mean()) < 1.0 and steps.std() == pytest.approx(0.02 * 255, rel=0.1)
