"""What the server answers over HTTP: the page's files, mesh parts, textures, downloads."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
from collections.abc import Callable, Mapping
from functools import lru_cache
from http import HTTPStatus
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from gazelle.studio.security import CONTENT_SECURITY_POLICY, Guard

__all__ = ["Answer", "answer_to", "response"]

_PAGE = Path(__file__).parent / "page"
_METHODS = ("GET", "HEAD")
_FOR_EVER = "public, max-age=31536000, immutable"
_ASK_AGAIN = "no-cache"
_MIN_TO_PACK_BYTES = 1024
_PACKED_TYPES = ("text/", "application/javascript", "application/json", "image/svg", "model/")
_TYPES = {".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm"}


class Answer(NamedTuple):
    """What a path leads to.

    Attributes:
        body: the bytes.
        content_type: of the body.
        lasting: the path's content never changes.
        file_name: saved under this name, shown when empty.
        packed: compress it, where the browser takes that.
    """

    body: bytes
    content_type: str
    lasting: bool = False
    file_name: str = ""
    packed: bool = True


def answer_to(
    routes: Mapping[str, Callable[[str], Answer | None]], request: Request, guard: Guard
) -> Response:
    """Return the response to a plain HTTP request; may read files.

    Args:
        routes: first part of a path → what answers the rest; the page's own files otherwise.
        request: what was asked.
        guard: whose token becomes a cookie.
    """
    if request.method not in _METHODS:
        headers = {"Allow": ", ".join(_METHODS)}
        return response(HTTPStatus.METHOD_NOT_ALLOWED, b"GET and HEAD only\n", headers)
    path = unquote(urlsplit(request.path).path)
    answer = _answer(routes, path)
    if answer is None:
        return response(HTTPStatus.NOT_FOUND, b"there is nothing at this path\n")
    headers = {
        "Content-Type": answer.content_type,
        "Cache-Control": _FOR_EVER if answer.lasting else _ASK_AGAIN,
    }
    if answer.file_name:
        headers["Content-Disposition"] = f'attachment; filename="{_quoted(answer.file_name)}"'
    if guard.has_token(request.path):
        headers["Set-Cookie"] = f"{guard.cookie}={guard.token}; HttpOnly; SameSite=Strict; Path=/"
    return _sent(answer, request, headers)


def response(status: HTTPStatus, body: bytes, extra: dict[str, str] | None = None) -> Response:
    """Return a response with the headers that every one carries."""
    headers = Headers(
        {
            "Content-Type": "text/plain; charset=utf-8",
            "Content-Length": str(len(body)),
            "Content-Security-Policy": CONTENT_SECURITY_POLICY,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Connection": "close",
        }
    )
    for name, value in (extra or {}).items():
        if name in headers:
            del headers[name]
        headers[name] = value
    return Response(status.value, status.phrase, headers, body)


def _answer(routes: Mapping[str, Callable[[str], Answer | None]], path: str) -> Answer | None:
    head, _, rest = path.lstrip("/").partition("/")
    route = routes.get(head)
    if route is not None and rest:
        return route(rest)
    return _page_file(path)


def _sent(answer: Answer, request: Request, headers: dict[str, str]) -> Response:
    tag = f'"{hashlib.sha256(answer.body).hexdigest()[:24]}"'
    if not answer.file_name:
        headers["ETag"] = tag
        if request.headers.get("If-None-Match") == tag:
            return response(HTTPStatus.NOT_MODIFIED, b"", headers)
    body = answer.body
    if _takes_packed(answer, request):
        body = _packed(body)
        headers["Content-Encoding"] = "gzip"
        headers["Vary"] = "Accept-Encoding"
    made = response(HTTPStatus.OK, body, headers)
    if request.method == "HEAD":
        made.body = b""
    return made


def _takes_packed(answer: Answer, request: Request) -> bool:
    return (
        answer.packed
        and len(answer.body) >= _MIN_TO_PACK_BYTES
        and answer.content_type.startswith(_PACKED_TYPES)
        and "gzip" in request.headers.get("Accept-Encoding", "")
    )


@lru_cache(maxsize=64)
def _packed(body: bytes) -> bytes:
    return gzip.compress(body, 6, mtime=0)


def _page_file(path: str) -> Answer | None:
    """A file of the page; nothing outside its folder, whatever the path says."""
    if "\0" in path or "\\" in path:
        return None
    try:
        found = (_PAGE / (path.lstrip("/") or "index.html")).resolve()
        if not found.is_relative_to(_PAGE.resolve()) or not found.is_file():
            return None
        data = found.read_bytes()
    except OSError:
        # The name is too long, or not of this file system.
        return None
    kind = _TYPES.get(found.suffix) or mimetypes.guess_type(found.name)[0]
    kind = kind or "application/octet-stream"
    return Answer(data, f"{kind}; charset=utf-8" if "text/" in kind else kind)


def _quoted(name: str) -> str:
    return "".join(sign if sign.isalnum() or sign in "._- " else "_" for sign in name)
