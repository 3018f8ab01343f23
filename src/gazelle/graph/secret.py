"""What only its user knows, on a machine that others use as well: a name and a password in a file.

Everybody on a machine can connect to 127.0.0.1. So the page's address carries a token, made of a
secret in a file that only its user can read.
"""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.errors import GraphError
from gazelle.folders import state_folder

__all__ = ["VARIABLE", "Secret", "secret_of_user"]

VARIABLE = "GAZELLE_SECRET_FILE"
"""Environment variable with the path of a file to use instead of the user's own."""

_USER = "gazelle"
_NAME = "secret"
_BYTES = 32


class Secret(NamedTuple):
    """Name and password of a user.

    Attributes:
        path: the file, one line of ``name:password``.
    """

    path: Path
    user: str
    password: str


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
