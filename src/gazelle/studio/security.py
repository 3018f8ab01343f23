"""Who may talk to the server: its own page, on this machine, unless the user said otherwise."""

from __future__ import annotations

import hmac
import ipaddress
import secrets
import socket
from http.cookies import CookieError, SimpleCookie
from typing import NamedTuple
from urllib.parse import parse_qs, urlsplit

from websockets.datastructures import Headers

__all__ = ["CONTENT_SECURITY_POLICY", "COOKIE", "Guard", "guard_for"]

CONTENT_SECURITY_POLICY = (
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; object-src 'none'; frame-ancestors 'none'"
)
COOKIE = "gazelle_studio"
_LOCAL_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
_ANY_ADDRESS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - recognised here, not bound


class Guard(NamedTuple):
    """The rules of one server.

    Attributes:
        bound: the address it listens on.
        port: and its port.
        token: what a page must know when others than this machine can reach it, else empty.
    """

    bound: str
    port: int
    token: str

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
        if self.token and not self._knows_token(path, headers):
            return "open the URL that was printed; it carries a token"
        return ""

    def has_token(self, path: str) -> bool:
        """Return whether the URL itself carries the token, which becomes a cookie then."""
        given = parse_qs(urlsplit(path).query).get("token", [""])[0]
        return bool(self.token) and hmac.compare_digest(given.encode(), self.token.encode())

    def _knows_token(self, path: str, headers: Headers) -> bool:
        if self.has_token(path):
            return True
        for text in headers.get_all("Cookie"):
            try:
                morsel = SimpleCookie(text).get(COOKIE)
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
    """Return the rules for an address; any but this machine's own gets a token."""
    local = host.lower() in _LOCAL_NAMES
    return Guard(host, port, "" if local else secrets.token_urlsafe(24))


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _own_name() -> str:
    return socket.gethostname().lower()
