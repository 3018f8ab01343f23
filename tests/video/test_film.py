"""Films and pictures of recordings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence
from tests.recorded import rolling

from gazelle.video import (
    FixedCamera,
    FollowCamera,
    SensorCamera,
    Shooting,
    film_frames,
    write_picture,
    write_video,
)

_SIZE = (160, 100)


def _red(frame: np.ndarray) -> np.ndarray:
    """Where the cart is."""
    wide = frame.astype(int)
    return (wide[..., 0] > 90) & (wide[..., 0] > 2 * wide[..., 1])


def _frames(path: Path) -> list[np.ndarray]:
    with Image.open(path) as image:
        return [np.asarray(one.convert("RGB")) for one in ImageSequence.Iterator(image)]


def test_a_film_has_the_frames_the_size_and_the_cart_that_rolls(tmp_path: Path) -> None:
    path = write_video(
        rolling(1.0), tmp_path / "a.webp", camera=FixedCamera(), size_px=_SIZE, fps=10
    )
    frames = _frames(path)
    assert [one.shape for one in frames] == [(100, 160, 3)] * 10
    places = [np.argwhere(_red(one)).mean(axis=0) for one in frames]
    assert np.linalg.norm(places[9] - places[0]) > 30
    # Well lit, and large enough to see.
    assert _red(frames[0]).mean() > 0.01
    assert frames[0].mean() > 90


def test_a_cart_that_is_followed_stays_where_it_is_and_the_grid_goes_by() -> None:
    shooting = Shooting(_SIZE, fps=5)
    first, *_, last = film_frames(rolling(1.0), FollowCamera(), shooting)
    assert _red(first).mean() > 0.05
    assert np.argwhere(_red(first)).mean(axis=0) == pytest.approx(
        np.argwhere(_red(last)).mean(axis=0), abs=2
    )
    ground = ~(_red(first) | _red(last))
    assert (first != last).any(axis=2)[ground].mean() > 0.01


def test_equal_recordings_give_equal_bytes(tmp_path: Path) -> None:
    for name in ("a.webp", "b.webp"):
        write_video(rolling(0.5), tmp_path / name, size_px=_SIZE, fps=8)
    assert (tmp_path / "a.webp").read_bytes() == (tmp_path / "b.webp").read_bytes()


def test_frames_are_at_exact_simulated_times() -> None:
    recording = rolling(2.0)
    ms = 1_000_000
    assert Shooting(fps=10).times_ns(recording) == tuple(range(0, 2000 * ms, 100 * ms))
    faster = Shooting(fps=10, speed=4.0).times_ns(recording)
    assert faster == tuple(range(0, 2000 * ms, 400 * ms))
    part = Shooting(fps=10, start_s=0.5, duration_s=0.3).times_ns(recording)
    assert part == (500 * ms, 600 * ms, 700 * ms)
    assert Shooting(start_s=2.0).times_ns(recording) == (2000 * ms,)


def test_numbers_that_cannot_be_are_told() -> None:
    recording = rolling(1.0)
    with pytest.raises(ValueError, match="a film of 8x9000 pixels is not possible: 16 to 8192"):
        Shooting((8, 9000)).times_ns(recording)
    with pytest.raises(ValueError, match="fps must be a number above 0, not 0"):
        Shooting(fps=0.0).times_ns(recording)
    with pytest.raises(ValueError, match=r"begin 3 s after the recording's start, which holds 1 s"):
        Shooting(start_s=3.0).times_ns(recording)


def test_progress_counts_the_frames(tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    write_video(
        rolling(0.4),
        tmp_path / "a.webp",
        size_px=(32, 24),
        fps=5,
        progress=lambda done, of: told.append((done, of)),
    )
    assert told == [(0, 2), (1, 2), (2, 2)]


def test_ctrl_c_while_drawing_leaves_what_was_drawn(tmp_path: Path) -> None:
    def stop(done: int, _of: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_video(rolling(1.0), tmp_path / "a.webp", size_px=(32, 24), fps=10, progress=stop)
    assert len(_frames(tmp_path / "a.webp")) == 3
    assert [one.name for one in tmp_path.iterdir()] == ["a.webp"]


def test_a_picture_is_one_moment_also_from_on_board(tmp_path: Path) -> None:
    path = write_picture(rolling(1.0), tmp_path / "a.png", time_s=0.5, size_px=_SIZE)
    assert _red(np.asarray(Image.open(path))).mean() > 0.03
    path = write_picture(
        rolling(1.0), tmp_path / "b.png", camera=SensorCamera("eye"), size_px=_SIZE
    )
    on_board = np.asarray(Image.open(path))
    assert not _red(on_board).any()
    # Ground below, sky above.
    assert abs(int(on_board[95, 80].mean()) - int(on_board[5, 80].mean())) > 10
