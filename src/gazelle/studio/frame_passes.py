"""Passes for other pages that show this one in a frame: a notebook's, for a view in its cell.

A pass is a path of the server that nobody can guess. What is below it needs no cookie, which
browsers withhold from frames of other sites, and the server's own token stays unknown to the
notebook. Only one page may frame it: the first that does, on this machine.
"""

from __future__ import annotations

import hmac
import secrets
import threading
from typing import NamedTuple
from urllib.parse import urlsplit

from websockets.datastructures import Headers
from websockets.http11 import Response

from gazelle.studio.security import CONTENT_SECURITY_POLICY

__all__ = ["FRAME", "FramePasses", "Framed", "may_frame"]

FRAME = "frame"
"""First part of the paths of passes."""

# A desktop program that shows notebooks has no address, and says no origin.
_PROGRAMS = "vscode-webview: vscode-file:"
_LOCAL = frozenset({"127.0.0.1", "localhost", "::1"})
_NOBODY = "frame-ancestors 'none'"


class Framed(NamedTuple):
    """A request below a pass.

    Attributes:
        token: of the pass.
        path: the rest of the request's path and query.
        refusal: why it gets 403, empty when it may pass.
        ancestors: who may frame the answer, as ``frame-ancestors`` has it.
    """

    token: str
    path: str
    refusal: str = ""
    ancestors: str = "'none'"

    def admit(self, answer: Response) -> Response:
        """Let the page that holds the pass frame an answer; all others stay shut out."""
        policy = CONTENT_SECURITY_POLICY.replace(_NOBODY, f"frame-ancestors {self.ancestors}")
        del answer.headers["Content-Security-Policy"]
        answer.headers["Content-Security-Policy"] = policy
        return answer


class FramePasses:
    """The passes of a server; safe to use from any thread."""

    def __init__(self) -> None:
        """Start with none."""
        self._lock = threading.Lock()
        self._origins: dict[str, str | None] = {}
        self._reached: set[str] = set()

    def issue(self, origin: str | None = None) -> str:
        """Return the token of a new pass.

        Args:
            origin: of the page that may frame, such as ``http://localhost:8888``; the first one
                on this machine when None.
        """
        token = secrets.token_urlsafe(24)
        with self._lock:
            self._origins[token] = origin
        return token

    def withdraw(self, token: str) -> None:
        """End a pass; ending it twice does nothing."""
        with self._lock:
            self._origins.pop(token, None)
            self._reached.discard(token)

    def holds(self, token: str) -> bool:
        """Return whether a pass is still good."""
        with self._lock:
            return token in self._origins

    def is_reached(self, token: str) -> bool:
        """Return whether a browser has ever come with a pass."""
        with self._lock:
            return token in self._reached

    def look(self, path: str, headers: Headers) -> Framed | None:
        """Return what a request is below a pass, None where its path is none of a pass."""
        head, _, rest = path.lstrip("/").partition("/")
        if head != FRAME:
            return None
        given, _, rest = rest.partition("/")
        with self._lock:
            known = [one for one in self._origins if hmac.compare_digest(one, _ascii(given))]
            if not known:
                return Framed("", "/", "this view has ended; run its cell again")
            token = known[0]
            if headers.get("Sec-Fetch-Dest") in ("iframe", "frame", "embed", "object"):
                refusal = self._pinned(token, headers)
                if refusal:
                    return Framed(token, "/", refusal)
            self._reached.add(token)
            origin = self._origins[token]
        return Framed(token, f"/{rest}", ancestors=_PROGRAMS if origin is None else origin)

    def _pinned(self, token: str, headers: Headers) -> str:
        """Bind a pass to the page that frames it first; return why another one may not."""
        asking = _origin_of(headers.get("Referer", ""))
        if not asking:
            # Programs are told by frame-ancestors; no web page is among those.
            return ""
        origin = self._origins[token]
        if origin is None and may_frame(asking):
            self._origins[token] = origin = asking
        if origin != asking:
            return "another page shows this view"
        return ""


def may_frame(origin: str) -> bool:
    """Return whether a page of an origin may take a pass that is not bound yet: one of here."""
    try:
        return urlsplit(origin).hostname in _LOCAL
    except ValueError:
        return False


def _origin_of(referer: str) -> str:
    """Return scheme, host and port of an address; empty where it is no page's."""
    try:
        parts = urlsplit(referer)
    except ValueError:
        return ""
    is_plain = parts.scheme in ("http", "https") and not set(parts.netloc) & set(" ;,@'\"")
    return f"{parts.scheme}://{parts.netloc}" if parts.netloc and is_plain else ""


def _ascii(text: str) -> str:
    """Return a text that can be compared in constant time."""
    return text if text.isascii() else ""
