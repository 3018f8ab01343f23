"""Single vectors."""

from __future__ import annotations

import numpy as np

from gazelle.geometry import cross


def test_cross_product_is_numpys() -> None:
    rng = np.random.default_rng(1)
    for a, b in rng.normal(size=(20, 2, 3)):
        assert np.array_equal(cross(a, b), np.cross(a, b))
    assert cross((1, 0, 0), (0, 1, 0)).tolist() == [0.0, 0.0, 1.0]
