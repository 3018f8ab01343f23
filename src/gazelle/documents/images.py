"""Reading pictures that may be damaged, no pictures at all, or larger than there is room for."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.documents.files import HOW_TO_RAISE, read_limited, scaled

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["PictureError", "opened_picture"]

_MAX_BYTES = 256 << 20
_MAX_PIXELS = 1 << 26


class PictureError(ValueError):
    """The bytes are no picture, or one that is not read; the text says why, without the name."""


@contextmanager
def opened_picture(
    source: Path | bytes, *, most_pixels: int | None = _MAX_PIXELS
) -> Iterator[Image]:
    """Open a picture, for a block in which its pixels are read.

    Args:
        source: a file, or its bytes.
        most_pixels: a few bytes can stand for any number; None leaves the limit to Pillow.

    Raises:
        OSError: the file cannot be read.
        PictureError: it is damaged, no picture, or too large.
    """
    from PIL import Image, UnidentifiedImageError

    data = source if isinstance(source, bytes) else read_limited(source, _MAX_BYTES)
    try:
        with Image.open(io.BytesIO(data)) as image:
            _check_size(image, most_pixels)
            yield image
    except (PictureError, UnidentifiedImageError) as error:
        raise PictureError(
            str(error) if isinstance(error, PictureError) else "it is no picture"
        ) from None
    except MemoryError:
        raise PictureError("there is no memory for its pixels") from None
    except Exception as error:
        # Each of Pillow's decoders has errors of its own.
        raise PictureError(f"it is damaged: {error}") from error


def _check_size(image: Image, most: int | None) -> None:
    width, height = image.size
    if most is not None and width * height > scaled(most):
        raise PictureError(
            f"it has {width} × {height} pixels, at most {scaled(most)} are read; {HOW_TO_RAISE}"
        )
