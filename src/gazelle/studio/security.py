"""Who may talk to the server: pages that its user opened, on this machine unless told otherwise.

Everybody on a machine reaches 127.0.0.1, so the address carries a token there, too.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
import socket
from http.cookies import CookieError, SimpleCookie
from typing import NamedTuple
from urllib.parse import parse_qs, urlsplit

from websockets.datastructures import Headers

from gazelle.graph.secret import secret_of_user

__all__ = ["CONTENT_SECURITY_POLICY", "Guard", "guard_for", "token_of_user"]

CONTENT_SECURITY_POLICY = (
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; object-src 'none'; frame-ancestors 'none'"
)
_COOKIE = "gazelle_studio"
_TOKEN_CHARACTERS = 32
_LOCAL_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
_ANY_ADDRESS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - recognised here, not bound


class Guard(NamedTuple):
    """The rules of one server.

    Attributes:
        bound: the address it listens on.
        port: and its port.
        token: what a page must know.
    """

    bound: str
    port: int
    token: str

    @property
    def is_local(self) -> bool:
        """Whether only this machine can reach it."""
        return _is_local(self.bound)

    @property
    def cookie(self) -> str:
        """Name of the cookie with the token; browsers send all of a host's to each of its ports."""
        return f"{_COOKIE}_{self.port}"

    def refusal(self, path: str, headers: Headers) -> str:
        """Return why a request gets 403, empty when it may pass.

        A ``Host`` of another name is DNS rebinding, an ``Origin`` of another one is a foreign
        page; browsers write both themselves.
        """
        host = headers.get_all("Host")
        if len(host) != 1 or not self._is_own_host(host[0]):
            return "this server answers only to its own address"
        origins = headers.get_all("Origin")
        if any(urlsplit(origin).netloc.lower() != host[0].lower() for origin in origins):
            return "pages of other origins may not talk to this server"
        if not self._knows_token(path, headers):
            return "open the address that was printed; it carries a token"
        return ""

    def has_token(self, path: str) -> bool:
        """Return whether the URL itself carries the token, which becomes a cookie then."""
        given = parse_qs(urlsplit(path).query).get("token", [""])[0]
        return hmac.compare_digest(given.encode(), self.token.encode())

    def _knows_token(self, path: str, headers: Headers) -> bool:
        if self.has_token(path):
            return True
        for text in headers.get_all("Cookie"):
            try:
                morsel = SimpleCookie(text).get(self.cookie)
            except CookieError:
                continue
            if morsel and hmac.compare_digest(morsel.value.encode(), self.token.encode()):
                return True
        return False

    def _is_own_host(self, text: str) -> bool:
        try:
            parts = urlsplit(f"//{text}")
            name, port = (parts.hostname or "").lower(), parts.port or 80
        except ValueError:
            return False
        if port != self.port:
            return False
        if name in _LOCAL_NAMES or name == self.bound.lower():
            return True
        return self.bound in _ANY_ADDRESS and (_is_address(name) or name == _own_name())


def guard_for(host: str, port: int) -> Guard:
    """Return the rules for an address; where others reach it the token is a new one each time."""
    token = token_of_user() if _is_local(host) else secrets.token_urlsafe(24)
    return Guard(host, port, token)


def token_of_user() -> str:
    """Return what lets a user's pages in on this machine: the same each time, for bookmarks.

    Raises:
        GraphError: the user's secret cannot be read.
    """
    key = secret_of_user().password.encode()
    return hmac.new(key, b"studio", "sha256").hexdigest()[:_TOKEN_CHARACTERS]


def _is_local(host: str) -> bool:
    return host.lower() in _LOCAL_NAMES


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _own_name() -> str:
    return socket.gethostname().lower()
