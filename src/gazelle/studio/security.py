"""Who may talk to the server: pages that its user opened, on this machine unless told otherwise.

Everybody on a machine can connect to 127.0.0.1. So the page's address carries a token, made of a
secret in a file that only its user can read.
"""

from __future__ import annotations

import contextlib
import errno
import hmac
import ipaddress
import os
import secrets
import socket
import stat
import tempfile
from collections.abc import Iterator
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from typing import NamedTuple
from urllib.parse import parse_qs, urlsplit

from websockets.datastructures import Headers

from gazelle.errors import GraphError
from gazelle.user_folders import state_folder

__all__ = [
    "CONTENT_SECURITY_POLICY",
    "VARIABLE",
    "Guard",
    "Secret",
    "guard_for",
    "secret_of_user",
    "token_of_user",
]

VARIABLE = "GAZELLE_SECRET_FILE"
"""Environment variable with the path of a file to use instead of the user's own."""

_USER = "gazelle"
_NAME = "secret"
_BYTES = 32
CONTENT_SECURITY_POLICY = (
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; object-src 'none'; frame-ancestors 'none'"
)
_COOKIE = "gazelle_studio"
_TOKEN_CHARACTERS = 32
_LOCAL_NAMES = frozenset({"127.0.0.1", "localhost", "::1"})
_ANY_ADDRESS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - recognised here, not bound


class Secret(NamedTuple):
    """Name and password of a user.

    Attributes:
        path: the file, one line of ``name:password``.
    """

    path: Path
    user: str
    password: str

    def __repr__(self) -> str:
        """Without the password: logs and tracebacks show values."""
        return f"Secret(path={self.path!r}, user={self.user!r}, password='***')"


def secret_of_user() -> Secret:
    """Return the secret that `VARIABLE` names, or the user's own; it is made where there is none.

    Raises:
        GraphError: the file cannot be read or made, is no secret, or everybody can read it.
    """
    named = os.environ.get(VARIABLE, "").strip()
    if named:
        path = Path(named).expanduser()
        try:
            return _read(_made(path))
        except OSError as error:
            raise GraphError(
                f"{VARIABLE}={named}: {error.strerror}\n"
                f"  fix: name a file that you can read, or unset {VARIABLE}"
            ) from error
    problem: OSError | None = None
    for folder in _folders():
        try:
            return _read(_made(folder / _NAME), is_own=True)
        except OSError as error:
            problem = error
    raise GraphError(
        f"there is no place for your secret: {problem}\n"
        f"  fix: make your home writable, or name a file: export {VARIABLE}=/path/to/file"
    )


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

    def __repr__(self) -> str:
        """Without the token: logs and tracebacks show values."""
        return f"Guard(bound={self.bound!r}, port={self.port}, token='***')"

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
        strange = self.strangeness(headers)
        if strange:
            return strange
        if not self._knows_token(path, headers):
            return "open the address that was printed; it carries a token"
        return ""

    def strangeness(self, headers: Headers) -> str:
        """Return why a request gets 403 whatever it knows, empty when it comes from here."""
        host = headers.get_all("Host")
        if len(host) != 1 or not self._is_own_host(host[0]):
            return "this server answers only to its own address"
        origins = headers.get_all("Origin")
        if any(urlsplit(origin).netloc.lower() != host[0].lower() for origin in origins):
            return "pages of other origins may not talk to this server"
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


def _folders() -> Iterator[Path]:
    """Yield where the user's own secret is: the first place that can be written, for all alike."""
    with contextlib.suppress(RuntimeError):
        yield state_folder()
    # Containers run as users without a home.
    yield Path(tempfile.gettempdir()) / f"gazelle-{_user_number()}"


def _made(path: Path) -> Path:
    """Make the file unless it is there; of two who do, one does."""
    if path.exists():
        return path
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}-{os.getpid()}-{secrets.token_hex(4)}")
    number = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with os.fdopen(number, "w", encoding="ascii") as file:
            file.write(f"{_USER}:{secrets.token_hex(_BYTES)}\n")
        with contextlib.suppress(FileExistsError):
            _put(draft, path)
    finally:
        with contextlib.suppress(OSError):
            draft.unlink()
    return path


def _put(draft: Path, path: Path) -> None:
    try:
        os.link(draft, path)
    except FileExistsError:
        raise
    except OSError:
        # A file system without links.
        if not path.exists():
            draft.replace(path)


def _read(path: Path, *, is_own: bool = False) -> Secret:
    info = path.stat()
    if hasattr(os, "getuid"):
        if is_own and info.st_uid != os.getuid():
            raise PermissionError(errno.EPERM, f"it belongs to user {info.st_uid}", str(path))
        if is_own and stat.S_IMODE(info.st_mode) & 0o077:
            path.chmod(0o600)
        elif info.st_mode & stat.S_IROTH:
            raise GraphError(f"everybody can read {path}, your secret\n  fix: chmod o= {path}")
    user, colon, password = (
        path.read_text(encoding="utf-8", errors="replace").strip().partition(":")
    )
    if not (user and colon and password) or "\n" in password:
        raise GraphError(
            f"{path} is no secret, one line of name:password\n  fix: remove it; a new one is made"
        )
    return Secret(path.absolute(), user, password)


def _user_number() -> int | str:
    if hasattr(os, "getuid"):
        return os.getuid()
    import getpass

    return getpass.getuser()


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
