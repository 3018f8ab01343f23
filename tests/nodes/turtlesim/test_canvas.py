"""Lines, colours and turtles in the picture."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.turtlesim.canvas import BACKGROUND, Canvas, write_png
from gazelle.nodes.turtlesim.turtle import Pen, Stroke, Turtle

_RED = (255, 0, 0)


def _drawn(canvas: Canvas) -> np.ndarray:
    return np.any(canvas.picture() != BACKGROUND, axis=-1)


@pytest.mark.parametrize("width", [1, 3, 10])
def test_line_covers_its_length_and_a_half_width_at_both_ends(width: int) -> None:
    canvas = Canvas()
    canvas.draw([Stroke((100.0, 200.0), (300.0, 200.0), Pen(_RED, width))])
    rows, columns = np.nonzero(_drawn(canvas))
    assert len(set(rows)) == pytest.approx(width, abs=1)
    assert columns.max() - columns.min() == pytest.approx(200 + width, abs=1)


def test_slanted_line_covers_width_times_length() -> None:
    canvas = Canvas()
    canvas.draw([Stroke((100.0, 100.0), (340.0, 280.0), Pen(_RED, 8))])
    assert np.count_nonzero(_drawn(canvas)) == pytest.approx((300 + 8) * 8, rel=0.02)


def test_color_below_is_that_of_the_line_or_the_background() -> None:
    canvas = Canvas()
    canvas.draw([Stroke((100.0, 100.0), (200.0, 100.0), Pen(_RED))])
    assert canvas.color_at((150.2, 99.7)) == _RED
    assert canvas.color_at((150.0, 110.0)) == BACKGROUND
    canvas.paint_background((1, 2, 3))
    assert canvas.color_at((150.0, 110.0)) == (1, 2, 3)
    assert canvas.color_at((150.0, 100.0)) == _RED


def test_clear_leaves_the_background_alone() -> None:
    canvas = Canvas()
    canvas.draw([Stroke((100.0, 100.0), (200.0, 100.0), Pen(_RED))])
    canvas.clear((9, 8, 7))
    assert np.all(canvas.picture() == (9, 8, 7))


def test_line_over_the_edge_is_cut_off() -> None:
    canvas = Canvas()
    canvas.draw([Stroke((-50.0, -50.0), (-20.0, -10.0), Pen(_RED, 5))])
    assert not _drawn(canvas).any()
    canvas.draw([Stroke((490.0, 250.0), (700.0, 250.0), Pen(_RED, 5))])
    assert _drawn(canvas)[250, 499]


@pytest.mark.parametrize("theta", [0.0, math.pi / 2, 2.0])
def test_turtle_is_seen_around_its_place_longer_than_wide(theta: float) -> None:
    turtle = Turtle.at(5.0, 4.0, theta)
    seen = np.any(Canvas().picture([(0, turtle)]) != BACKGROUND, axis=-1)
    rows, columns = np.nonzero(seen)
    x, y = turtle.place_px
    ahead = (columns - x) * math.cos(theta) + (y - rows) * math.sin(theta)
    aside = (y - rows) * math.cos(theta) - (columns - x) * math.sin(theta)
    assert np.ptp(ahead) > np.ptp(aside) > 20
    assert np.abs(ahead).max() < 26


def test_picture_is_written_as_png(tmp_path) -> None:
    from PIL import Image

    path = tmp_path / "new" / "turtles.png"
    write_png(Canvas().picture(), path)
    with Image.open(path) as image:
        assert (image.format, image.size) == ("PNG", (500, 500))
        assert image.getpixel((3, 3)) == BACKGROUND


def test_place_that_cannot_be_written_is_named(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(LaunchError, match=r"the picture cannot be written to '.*file/t\.png'"):
        write_png(Canvas().picture(), tmp_path / "file" / "t.png")
