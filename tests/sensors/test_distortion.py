"""Brown's lens model."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.description.model import LensDistortion
from gazelle.sensors import distort, is_distorting
from gazelle.sensors.distortion import source_pixels


def _appears_at(lens: LensDistortion, x: float, y: float) -> tuple[float, float]:
    """Brown's formula in fractions of the picture about its middle."""
    r2 = x * x + y * y
    radial = 1 + lens.k1 * r2 + lens.k2 * r2**2 + lens.k3 * r2**3
    return (
        x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x),
        y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y,
    )


def test_no_coefficients_leave_the_picture_alone() -> None:
    image = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    assert not is_distorting(None)
    assert not is_distorting(LensDistortion())
    assert distort(image, LensDistortion()) is image


@pytest.mark.parametrize(
    "lens",
    [
        LensDistortion(k1=0.2),
        LensDistortion(k1=0.1, k2=0.05, k3=-0.02, p1=0.01, p2=-0.015),
        LensDistortion(p1=0.02),
    ],
)
def test_each_pixel_shows_the_point_that_the_model_sends_there(lens) -> None:
    height, width = 60, 80
    x, y = source_pixels(lens, height, width)
    for row, column in ((0, 0), (30, 40), (59, 3), (17, 71)):
        u, v = (x[row, column] + 0.5) / width - 0.5, (y[row, column] + 0.5) / height - 0.5
        there = _appears_at(lens, u, v)
        assert there[0] == pytest.approx((column + 0.5) / width - 0.5, abs=1e-5)
        assert there[1] == pytest.approx((row + 0.5) / height - 0.5, abs=1e-5)


def test_barrel_distortion_is_enlarged_until_no_border_is_empty() -> None:
    lens = LensDistortion(k1=-0.25, k2=0.12, k3=0.0, p1=-0.00028, p2=-0.00005)
    picture = distort(np.full((48, 64, 3), 200, np.uint8), lens)
    assert (picture == 200).all()
    x, y = source_pixels(lens, 48, 64)
    assert x[24, 32] == pytest.approx(32, abs=0.2)
    assert y[24, 32] == pytest.approx(24, abs=0.2)
    assert x[0, 0] == pytest.approx(0, abs=0.5)


@pytest.mark.parametrize("p1", [0.05, 0.6])
def test_what_comes_from_outside_is_black(p1) -> None:
    lens = LensDistortion(p1=p1)
    picture = distort(np.full((48, 64), 200, np.uint8), lens)
    x, y = source_pixels(lens, 48, 64)
    outside = (x <= -1) | (x >= 64) | (y <= -1) | (y >= 48)
    assert 0.01 < outside.mean() < 0.9
    assert (picture[outside] == 0).all()
    assert (picture[~outside] == 200).all()
