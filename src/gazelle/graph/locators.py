"""Where the sessions of a graph listen: sockets in a folder that only their user can enter.

Everybody on a machine can connect to a port of 127.0.0.1, so a graph there would belong to all of
them. A Unix domain socket belongs to whoever can reach its file: the graphs of two users do not
meet, whatever their port numbers, and nobody else sees or steers anything. A folder that is named
on purpose (`VARIABLE`) is shared by those whom its permissions let in.

Windows has no such links in the transport. There the sockets are ports of 127.0.0.1.
"""

from __future__ import annotations

import os
import secrets
import socket
import stat
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from gazelle.errors import GraphError
from gazelle.user_folders import own_prefix, sweep

__all__ = [
    "VARIABLE",
    "claim_hub",
    "hub_endpoint",
    "is_hub",
    "name_of_hub",
    "own_endpoint",
    "share",
    "somebody_listens",
    "sweep_sockets",
]

VARIABLE = "GAZELLE_GRAPH_FOLDER"
"""Environment variable with the folder of a graph that several users share."""

_HAS_SOCKET_FILES = hasattr(socket, "AF_UNIX") and hasattr(os, "getuid")
_LINK = "unixsock-stream/"
_PEER = "peer-"
# The system's bound on macOS; the transport adds ".lock" for a file beside the socket.
_MAX_PATH = 103 - len(".lock")
_SEPARATORS = {"?", "#"}
_PATIENCE_S = 1.0


def hub_endpoint(port: int) -> str:
    """Return where the hub of a graph listens, as the transport writes it.

    Args:
        port: the graph's number, from `config.port_of`.

    Raises:
        GraphError: the folder of the sockets cannot be used.
    """
    if not _HAS_SOCKET_FILES:
        return f"tcp/127.0.0.1:{port}"
    return f"{_LINK}{_socket(_folder(), f'{port}.sock')}"


def claim_hub(port: int) -> Callable[[], None] | None:
    """Become the only one who may open or close the hub's place; None when somebody else is.

    The transport has a lock of its own, but lets go of it before it removes the files, which may be
    those of the next one by then.

    Returns:
        What ends the claim; to be called when the hub is closed. A process' end ends it, too.

    Raises:
        GraphError: the folder of the sockets cannot be used.
    """
    if not _HAS_SOCKET_FILES:
        return lambda: None
    claim = _socket(_folder(), f"{port}.hub")
    try:
        number = _locked(claim)
    except OSError as error:
        raise _unusable(claim, error) from error
    if number is None:
        return None
    share(f"{_LINK}{claim}")
    try:
        # Of a hub that was killed, perhaps another user's.
        for left in (f"{port}.sock", f"{port}.sock.lock"):
            claim.with_name(left).unlink(missing_ok=True)
    except OSError as error:
        os.close(number)
        raise _unusable(claim, error) from error

    def release() -> None:
        with suppress(OSError):
            claim.unlink(missing_ok=True)
        os.close(number)

    return release


def own_endpoint() -> str:
    """Return where a process with nodes may listen, each time another place.

    Raises:
        GraphError: the folder of the sockets cannot be used.
    """
    if not _HAS_SOCKET_FILES:
        return "tcp/127.0.0.1:0"
    return f"{_LINK}{_socket(_folder(), f'{own_prefix(_PEER)}{secrets.token_hex(4)}.sock')}"


def share(endpoint: str) -> None:
    """Let in whoever may enter the folder, if it was named on purpose."""
    if endpoint.startswith(_LINK) and _named():
        # The folder's own permissions say who may come so far; another user's file is open already.
        with suppress(PermissionError):
            Path(endpoint.removeprefix(_LINK)).chmod(0o666)


def sweep_sockets() -> None:
    """Remove the sockets of this user's processes that were killed."""
    if _HAS_SOCKET_FILES:
        sweep(_folder(), _PEER)


def name_of_hub(port: int) -> str:
    """Return the hub's place for messages, ``/tmp/gazelle-1000/7447.sock``."""
    return hub_endpoint(port).removeprefix(_LINK).removeprefix("tcp/")


def somebody_listens(port: int) -> bool:
    """Whether a hub's place has a listener, of whatever kind."""
    family = socket.AF_UNIX if _HAS_SOCKET_FILES else socket.AF_INET
    with socket.socket(family) as probe:
        probe.settimeout(_PATIENCE_S)
        try:
            probe.connect(_address(port))
        except BlockingIOError:
            # So many wait to be let in that it takes no more.
            return True
        except OSError:
            return False
    return True


def is_hub(peer_name: object, port: int) -> bool:
    """Whether a connection's other end (``getpeername()``) is the hub."""
    return peer_name == _address(port)


def _address(port: int) -> str | tuple[str, int]:
    return name_of_hub(port) if _HAS_SOCKET_FILES else ("127.0.0.1", port)


def _named() -> str:
    return os.environ.get(VARIABLE, "").strip()


def _folder() -> Path:
    """Return the folder of the sockets, which nobody else can enter unless it was named.

    The same in all shells of a user, so neither TMPDIR nor XDG_RUNTIME_DIR counts.
    """
    named = _named()
    # Checked below: it is this user's, and nobody else's business.
    own = f"/tmp/gazelle-{os.getuid()}"  # noqa: S108
    path = Path(named or own).expanduser().absolute()
    try:
        path.mkdir(mode=0o700, exist_ok=True)
        if not named:
            _keep_private(path)
    except OSError as error:
        raise _unusable(path, error) from error
    return path


def _locked(path: Path) -> int | None:
    """Return the descriptor of a file that is locked and in its place, None when another's is."""
    import fcntl

    while True:
        number = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(number)
            return None
        with suppress(FileNotFoundError):
            if os.path.samestat(path.stat(), os.fstat(number)):
                return number
        # Its last owner removed it between our opening and our locking it.
        os.close(number)


def _unusable(path: Path, error: OSError) -> GraphError:
    reason = error.strerror
    if isinstance(error, FileExistsError):
        broken = path.is_symlink() and not path.exists()
        reason = f"it leads to {path.readlink()}, which is not there" if broken else "it is a file"
    return GraphError(
        f"{path}, for the graph's sockets, cannot be used: {reason}\n"
        f"  fix: name a folder of your own: export {VARIABLE}=/path/to/folder"
    )


def _keep_private(path: Path) -> None:
    info = path.lstat()
    if not stat.S_ISDIR(info.st_mode) or info.st_uid != os.getuid():
        raise PermissionError(1, f"it is not a folder of yours (user {info.st_uid} made it)")
    if stat.S_IMODE(info.st_mode) & 0o077:
        path.chmod(0o700)


def _socket(folder: Path, name: str) -> Path:
    path = folder / name
    problem = ""
    if (excess := len(os.fsencode(path)) - _MAX_PATH) > 0:
        problem = f"too long for a socket's name, by {excess} bytes"
    elif found := _SEPARATORS & set(str(path)):
        problem = f"no name of a socket: the transport reads {' and '.join(sorted(found))} itself"
    if problem:
        raise GraphError(
            f"{path} is {problem}\n  fix: name another folder: export {VARIABLE}=/tmp/robot"
        )
    return path
