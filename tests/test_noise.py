"""The table of noise models."""

from __future__ import annotations

import numpy as np

from gazelle.noise import NOISE_MODELS, NOISE_TYPES, DriftModel, Noise


def test_every_model_adds_to_values_or_says_that_it_is_silent() -> None:
    drift = DriftModel((0.0,), (0.1,), (0.1,))
    for word, row in NOISE_MODELS.items():
        model = drift if word == DriftModel.type else Noise(word, stddev=0.3)
        stream = row.stream(model, np.random.default_rng(1))
        value = stream.apply(np.array([2.0]), dt_s=0.1)
        assert value.shape == (1,)
        assert (float(value[0]) == 2.0) is stream.is_silent


def test_sdf_knows_its_own_words_and_none_of_plug_ins() -> None:
    assert {"none", "gaussian", "gaussian_quantized"} <= set(NOISE_TYPES)
    assert DriftModel.type not in NOISE_TYPES
