"""Pictures that a panel's code gives, as the browser takes them."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from gazelle.studio.displays.image_encodings import PictureSettings, encoded_picture
from gazelle.studio.http_answers import Answer

__all__ = ["checked_picture", "picture_answer"]

_SETTINGS = PictureSettings(quality=85)
_FILES = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def checked_picture(value: Any) -> Any:
    """Return a picture that can be shown; an array is copied, its owner goes on drawing.

    Raises:
        TypeError: it is none.
    """
    if hasattr(value, "data") and (hasattr(value, "encoding") or hasattr(value, "format")):
        return value
    if isinstance(value, bytes) and _type_of(value):
        return value
    if isinstance(value, np.ndarray) and value.dtype == np.uint8:
        if value.ndim == 2 or (value.ndim == 3 and value.shape[2] in (1, 3, 4)):
            return value.squeeze(2).copy() if value.shape[2:] == (1,) else value.copy()
        raise TypeError(f"an array of shape {value.shape} is no picture: (H, W), (H, W, 3 or 4)")
    kind = f"an array of {value.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
    raise TypeError(
        f"{kind} is no picture: an Image or CompressedImage message, an array of uint8, "
        "or the bytes of a PNG or JPEG file"
    )


def picture_answer(value: Any) -> Answer:
    """Return the file of a picture.

    Raises:
        StudioError: the message's encoding is not known, or the data do not fit the size.
    """
    if isinstance(value, bytes):
        return Answer(value, _type_of(value), packed=False)
    if isinstance(value, np.ndarray):
        from PIL import Image

        data = io.BytesIO()
        Image.fromarray(value).save(data, "PNG", compress_level=1)
        return Answer(data.getvalue(), "image/png", packed=False)
    return Answer(encoded_picture(value, _SETTINGS).jpeg, "image/jpeg", packed=False)


def _type_of(data: bytes) -> str:
    return next((kind for start, kind in _FILES.items() if data.startswith(start)), "")
