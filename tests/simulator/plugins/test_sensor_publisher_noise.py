"""Noise of plug-ins with a plain sigma."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from gazelle.simulator.plugins.sensor_publisher import gaussian


def _context(plugin: str, seed: int = 1) -> Any:
    resets: list[Any] = []
    return SimpleNamespace(
        host=SimpleNamespace(seed=seed),
        model=SimpleNamespace(name="robot"),
        plugin=SimpleNamespace(name=plugin),
        resources=SimpleNamespace(on_reset=resets.append, resets=resets),
    )


def test_noise_has_its_sigma_and_starts_over_with_the_world() -> None:
    context = _context("range")
    draw = gaussian(context, 0.5)
    first = draw(4000)
    assert abs(first.std() - 0.5) < 0.03 and abs(first.mean()) < 0.03
    assert not np.array_equal(draw(4000), first)
    context.resources.resets[0]()
    assert np.array_equal(draw(4000), first)
    assert gaussian(_context("range"), 0.0)(3).tolist() == [0.0, 0.0, 0.0]


def test_plugins_whose_names_have_one_checksum_have_noises_of_their_own() -> None:
    # zlib.crc32 is the same for both with any words before them.
    one, other = (gaussian(_context(name), 1.0)(5) for name in ("plumless", "buckeroo"))
    assert not np.array_equal(one, other)
    assert not np.array_equal(one, gaussian(_context("plumless", seed=2), 1.0)(5))
