"""``file.save``: files that the page made, given back to the browser once."""

from __future__ import annotations

import base64
import binascii
import mimetypes
import secrets
import threading
from collections import OrderedDict
from typing import Any

from gazelle.studio.errors import StudioError
from gazelle.studio.http_answers import Answer
from gazelle.studio.request_params import Params

__all__ = ["Downloads", "download", "save_file"]

_MAX_BYTES = 256 << 20
_MAX_NAME = 200


def save_file(downloads: Downloads, params: Params) -> str:
    """``file.save``: the path to fetch it from."""
    name = params.text("name").rpartition("/")[2][:_MAX_NAME] or "file"
    if "base64" in params:
        try:
            data = base64.b64decode(params.text("base64"), validate=True)
        except (binascii.Error, ValueError) as error:
            raise StudioError(f"file.save: 'base64' cannot be read: {error}") from None
    else:
        data = params.text("text").encode()
    return downloads.offer(name, data)


def download(downloads: Downloads, token: str) -> Answer | None:
    """``/file/<token>``."""
    return downloads.take(token)


class Downloads:
    """Files that wait to be fetched; the oldest go when they are too much."""

    def __init__(self) -> None:
        """Hold nothing."""
        self._lock = threading.Lock()
        self._waiting: OrderedDict[str, tuple[str, bytes]] = OrderedDict()

    def offer(self, name: str, data: bytes) -> str:
        """Return the path that a file can be fetched from, once."""
        token = secrets.token_urlsafe(16)
        with self._lock:
            self._waiting[token] = (name, data)
            while sum(len(one) for _, one in self._waiting.values()) > _MAX_BYTES:
                self._waiting.popitem(last=False)
        return f"/file/{token}"

    def take(self, token: str) -> Answer | None:
        """Return a file and forget it."""
        with self._lock:
            found: Any = self._waiting.pop(token, None)
        if found is None:
            return None
        name, data = found
        kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
        return Answer(data, kind, file_name=name, packed=False)
