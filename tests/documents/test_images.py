"""Pictures that claim more than there is room for."""

from __future__ import annotations

import io
import struct
import tracemalloc
import zlib
from pathlib import Path

import pytest
from PIL import Image

from gazelle.documents import FileLimitError
from gazelle.documents.images import PictureError, opened_picture

_RAISE = "if the file means it, set the environment variable GAZELLE_LIMITS=10 for ten times"


def _png(width: int, height: int, pixels: bytes = b"") -> bytes:
    """Return a PNG of one channel that says that it is so large, whatever it holds."""
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(pixels)), (b"IEND", b""))
    parts = [
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def _refused(source: bytes | Path) -> str:
    with pytest.raises(PictureError) as refusal, opened_picture(source) as image:
        image.load()
    return str(refusal.value)


@pytest.mark.filterwarnings("ignore::PIL.Image.DecompressionBombWarning")
def test_picture_that_claims_too_many_pixels_is_refused_before_they_are_made() -> None:
    Image.init()
    tracemalloc.start()
    assert _refused(_png(8193, 8192)) == (
        f"it has 8193 × 8192 pixels, at most 67108864 are read; {_RAISE}"
    )
    # Pillow's own limit comes first.
    assert _refused(_png(60_000, 60_000)).startswith(
        "it is damaged: Image size (3600000000 pixels) exceeds limit of "
    )
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 10_000_000


def test_the_limit_of_pixels_follows_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "1e-7")
    assert _refused(_png(3, 3)) == f"it has 3 × 3 pixels, at most 6 are read; {_RAISE}"
    with opened_picture(_png(3, 3, b"\0\1\2\3" * 3), most_pixels=None) as image:
        assert image.getpixel((2, 2)) == 3


def test_picture_that_is_none_or_ends_early_is_refused() -> None:
    assert _refused(b"") == "it is no picture"
    assert _refused(b"GIF89a") == "it is no picture"
    assert _refused(_png(100, 100)).startswith("it is damaged: ")


def test_file_above_the_limit_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    with path.open("wb") as file:
        file.truncate((256 << 20) + 1)
    tracemalloc.start()
    with pytest.raises(FileLimitError) as refusal, opened_picture(path):
        pass
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert refusal.value.reason == "it has 268435457 bytes, the limit is 256 MiB"
    assert most < 10_000_000


def test_picture_of_a_file_is_read(tmp_path: Path) -> None:
    stream = io.BytesIO()
    Image.new("L", (2, 1), 7).save(stream, "PNG")
    (tmp_path / "a.png").write_bytes(stream.getvalue())
    with opened_picture(tmp_path / "a.png") as image:
        assert (image.size, image.getpixel((1, 0))) == ((2, 1), 7)
