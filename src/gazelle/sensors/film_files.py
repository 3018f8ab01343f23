"""Moving pictures into files: animated WebP by ourselves, MP4 and WebM by imageio-ffmpeg.

A film is written beside its name and takes the name when it is whole, so what has the name can be
played, also after Ctrl-C: that ends a film early.
"""

from __future__ import annotations

import io
import os
import struct
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.process_lifetime import interrupts_held

__all__ = ["FILM_SUFFIXES", "Film", "FilmError", "check_film", "open_film"]

_EXTRA = "pip install 'gazelle-sim[bags]'"
_QUALITY = 80
_MAX_WEBP_PX = 16383
# Frames of a WebP are told in whole milliseconds, rectangles in pairs of pixels.
_MS = 1000.0

Rgb = NDArray[np.uint8]


class FilmError(GazelleError):
    """A film cannot be written."""


class Film(ABC):
    """A film that is being written.

    Attributes:
        count: frames so far.
    """

    def __init__(self) -> None:
        self.count = 0

    @abstractmethod
    def add(self, rgb: Rgb) -> None:
        """Add a frame, (H, W, 3); all are of one size."""

    @abstractmethod
    def close(self) -> None:
        """Write what is left."""


class _Codec(NamedTuple):
    name: str
    options: tuple[str, ...] = ()


_CODECS = {
    ".mp4": _Codec("libx264"),
    ".webm": _Codec(
        "libvpx-vp9", ("-deadline", "realtime", "-cpu-used", "6", "-row-mt", "1", "-b:v", "0")
    ),
}
FILM_SUFFIXES = (".webp", *_CODECS)
"""What films can be written as."""


def check_film(path: Path) -> None:
    """Raise what `open_film` would for a name, before there is anything to write.

    Raises:
        FilmError: the suffix is not possible, or the library is missing.
    """
    suffix = path.suffix.lower()
    if suffix not in FILM_SUFFIXES:
        known = ", ".join(FILM_SUFFIXES)
        raise FilmError(f"films are not written as '{suffix}'; name the file with one of {known}")
    if suffix in _CODECS:
        _encoder(suffix)


def _encoder(suffix: str) -> Any:
    try:
        import imageio_ffmpeg
    except ImportError:
        kind = {".mp4": "MP4", ".webm": "WebM"}[suffix]
        raise FilmError(
            f"{kind} files need imageio-ffmpeg; {_EXTRA}, or write .webp, which needs nothing more"
        ) from None
    return imageio_ffmpeg


@contextmanager
def open_film(path: Path, size_px: tuple[int, int], rate_hz: float) -> Iterator[Film]:
    """Write a film within a ``with`` block.

    When the block ends, also by Ctrl-C, the file holds the frames up to then; when it ends with
    an error, or without a frame, what had the name before is still there.

    Args:
        path: its suffix, one of `FILM_SUFFIXES`, says what it becomes.
        size_px: width and height; MP4 and WebM drop an odd column or row.
        rate_hz: frames per second.

    Raises:
        FilmError: the suffix or the size is not possible, or the library is missing.
    """
    check_film(path)
    suffix = path.suffix.lower()
    draft = path.with_name(f".{path.stem}.{os.getpid()}{suffix}")
    film = (_FfmpegFilm if suffix in _CODECS else _WebpFilm)(draft, size_px, rate_hz)
    is_whole = False
    try:
        yield film
        is_whole = True
    except KeyboardInterrupt:
        is_whole = True
        raise
    finally:
        try:
            film.close()
            if is_whole and film.count:
                draft.replace(path)
        finally:
            draft.unlink(missing_ok=True)


class _FfmpegFilm(Film):
    def __init__(self, path: Path, size_px: tuple[int, int], rate_hz: float) -> None:
        super().__init__()
        self._size = (size_px[0] // 2 * 2, size_px[1] // 2 * 2)
        codec = _CODECS[path.suffix]
        self._film: Any = _encoder(path.suffix).write_frames(
            str(path),
            self._size,
            fps=rate_hz,
            codec=codec.name,
            output_params=list(codec.options),
            macro_block_size=2,
            ffmpeg_log_level="error",
        )
        # Ctrl-C is for us: the encoder would end with it and leave the last frames out.
        with interrupts_held():
            self._film.send(None)

    def add(self, rgb: Rgb) -> None:
        width, height = self._size
        self._film.send(np.ascontiguousarray(rgb[:height, :width]).tobytes())
        self.count += 1

    def close(self) -> None:
        self._film.close()


class _WebpFilm(Film):
    """Pictures of a WebP file each, put into one by ourselves.

    Pillow's own way holds all frames until the end; here each is written as it comes, and only
    the rectangle that differs from the last one.
    """

    def __init__(self, path: Path, size_px: tuple[int, int], rate_hz: float) -> None:
        super().__init__()
        if not all(1 <= one <= _MAX_WEBP_PX for one in size_px):
            raise FilmError(
                f"{size_px[0]}x{size_px[1]} pixels do not do for WebP: {_MAX_WEBP_PX} at most"
            )
        self._file: BinaryIO = path.open("wb")
        self._rate_hz = rate_hz
        self._last: Rgb | None = None
        self._held: tuple[bytes, int] | None = None
        width, height = size_px
        canvas = bytes((2, 0, 0, 0)) + _uint24(width - 1) + _uint24(height - 1)
        # No background colour, played for ever.
        self._file.write(_riff(0) + _chunk(b"VP8X", canvas) + _chunk(b"ANIM", bytes(6)))

    def add(self, rgb: Rgb) -> None:
        place = _difference(self._last, rgb)
        if place is not None:
            self._write_held(self.count)
            left, top, right, bottom = place
            picture = _webp_chunks(rgb[top:bottom, left:right])
            corner = _uint24(left // 2) + _uint24(top // 2)
            size = _uint24(right - left - 1) + _uint24(bottom - top - 1)
            self._held = (corner + size, self.count)
            self._picture = picture
            self._last = rgb.copy()
        self.count += 1

    def close(self) -> None:
        with self._file as file:
            self._write_held(self.count)
            end = file.tell()
            file.seek(0)
            file.write(_riff(end - 8))

    def _write_held(self, until: int) -> None:
        """Write the last frame, whose time is known now: until the next one that differs."""
        if self._held is None:
            return
        place, first = self._held
        shown_ms = round(until * _MS / self._rate_hz) - round(first * _MS / self._rate_hz)
        # Not blended with what is below.
        self._file.write(_chunk(b"ANMF", place + _uint24(shown_ms) + b"\x02" + self._picture))
        self._held = None


def _difference(before: Rgb | None, now: Rgb) -> tuple[int, int, int, int] | None:
    """Return left, top, right, bottom of what differs, left and top even; None for nothing."""
    height, width = now.shape[:2]
    if before is None:
        return 0, 0, width, height
    changed = (before != now).any(axis=2)
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if not len(rows):
        return None
    left, top = int(columns[0]) // 2 * 2, int(rows[0]) // 2 * 2
    return left, top, int(columns[-1]) + 1, int(rows[-1]) + 1


def _webp_chunks(rgb: Rgb) -> bytes:
    """Return the chunks of a picture: those of a WebP file behind its head."""
    from PIL import Image

    out = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(rgb)).save(out, "WEBP", quality=_QUALITY, method=4)
    return out.getvalue()[12:]


def _riff(size: int) -> bytes:
    return b"RIFF" + struct.pack("<I", size) + b"WEBP"


def _chunk(name: bytes, data: bytes) -> bytes:
    return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)


def _uint24(value: int) -> bytes:
    return struct.pack("<I", value)[:3]
