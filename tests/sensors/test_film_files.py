"""Films as files: what is in them, and what is there when something comes between."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from gazelle.sensors.film_files import FilmError, check_film, open_film


def _frame(column: int, size: tuple[int, int] = (48, 32)) -> np.ndarray:
    """A white square that walks on blue."""
    rgb = np.zeros((size[1], size[0], 3), np.uint8)
    rgb[..., 2] = 90
    rgb[8:16, column : column + 8] = 255
    return rgb


def _write(path: Path, columns: range, rate_hz: float = 20.0) -> Path:
    with open_film(path, (48, 32), rate_hz) as film:
        for column in columns:
            film.add(_frame(column))
    return path


def _frames(path: Path) -> list[np.ndarray]:
    with Image.open(path) as image:
        return [np.asarray(one.convert("RGB")) for one in ImageSequence.Iterator(image)]


def test_a_webp_has_the_frames_their_size_and_what_moves(tmp_path: Path) -> None:
    path = _write(tmp_path / "a.webp", range(0, 40, 4))
    with Image.open(path) as image:
        assert (image.format, image.size, image.info["loop"]) == ("WEBP", (48, 32), 0)
        assert image.n_frames == 10
        durations = []
        for one in ImageSequence.Iterator(image):
            one.load()
            durations.append(one.info["duration"])
    assert durations == [50] * 10
    for column, frame in zip(range(0, 40, 4), _frames(path), strict=True):
        assert frame[12, column + 4].min() > 200
        bright = np.flatnonzero(frame[12].min(axis=1) > 150)
        assert column - 1 <= bright[0] and bright[-1] <= column + 8


def test_frames_that_are_alike_are_one_that_stays_longer(tmp_path: Path) -> None:
    with open_film(tmp_path / "a.webp", (48, 32), 30.0) as film:
        for column in (0, 0, 0, 8, 8):
            film.add(_frame(column))
        assert film.count == 5
    with Image.open(tmp_path / "a.webp") as image:
        assert image.n_frames == 2
        image.load()
        first = image.info["duration"]
        image.seek(1)
        image.load()
    assert (first, image.info["duration"]) == (100, 67)


def test_equal_frames_give_equal_bytes(tmp_path: Path) -> None:
    first = _write(tmp_path / "a.webp", range(0, 40, 8))
    second = _write(tmp_path / "b.webp", range(0, 40, 8))
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize("suffix", [".mp4", ".webm"])
def test_films_of_the_encoder_have_the_frames_and_drop_an_odd_column(
    tmp_path: Path, suffix: str
) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    path = tmp_path / f"a{suffix}"
    with open_film(path, (49, 33), 20.0) as film:
        for column in range(0, 40, 4):
            film.add(_frame(column, (49, 33)))
    frames = ffmpeg.read_frames(str(path))
    about = next(frames)
    assert about["size"] == (48, 32) and about["fps"] == pytest.approx(20.0)
    decoded = [np.frombuffer(one, np.uint8).reshape(32, 48, 3) for one in frames]
    assert len(decoded) == 10
    assert decoded[0][12, 4].min() > 180 and decoded[9][12, 40].min() > 180
    assert decoded[9][12, 4].min() < 60


@pytest.mark.parametrize("suffix", [".webp", ".mp4"])
def test_ctrl_c_ends_a_film_early_and_it_can_be_played(tmp_path: Path, suffix: str) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    path = tmp_path / f"a{suffix}"
    with pytest.raises(KeyboardInterrupt), open_film(path, (48, 32), 20.0) as film:
        for column in range(0, 20, 4):
            film.add(_frame(column))
        raise KeyboardInterrupt
    count = len(_frames(path)) if suffix == ".webp" else ffmpeg.count_frames_and_secs(str(path))[0]
    assert count == 5
    assert [one.name for one in tmp_path.iterdir()] == [path.name]


def test_an_error_leaves_what_had_the_name_before(tmp_path: Path) -> None:
    path = tmp_path / "a.webp"
    path.write_bytes(b"before")
    with pytest.raises(ZeroDivisionError), open_film(path, (48, 32), 20.0) as film:
        film.add(_frame(0))
        raise ZeroDivisionError
    with open_film(path, (48, 32), 20.0):
        """No frame at all."""
    assert path.read_bytes() == b"before"
    assert [one.name for one in tmp_path.iterdir()] == ["a.webp"]


def test_a_missing_library_is_named_with_its_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "imageio_ffmpeg", None)
    words = r"need imageio-ffmpeg; pip install 'gazelle-sim\[bags\]', or write .webp, which needs"
    with pytest.raises(FilmError, match=f"WebM files {words}"):
        check_film(tmp_path / "a.webm")
    with (
        pytest.raises(FilmError, match=f"MP4 files {words}"),
        open_film(tmp_path / "a.mp4", (48, 32), 20.0),
    ):
        """Never begun."""
    check_film(tmp_path / "a.webp")


def test_other_endings_and_sizes_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FilmError, match=r"not written as '.gif'; .* one of .webp, .mp4, .webm"):
        check_film(tmp_path / "a.gif")
    with (
        pytest.raises(FilmError, match="20000x10 pixels do not do for WebP: 16383 at most"),
        open_film(tmp_path / "a.webp", (20_000, 10), 20.0),
    ):
        """Never begun."""
