"""Where compiled things are kept, who may make them, and digests of what they are made of.

Everything lies below one folder of the user's cache. A thing is made in a folder of its own and
gets its name when it is whole, by one rename; so a process that is killed, or a disk that is full,
leaves nothing half made under a name that somebody looks for.
"""

from __future__ import annotations

import atexit
import contextlib
import functools
import hashlib
import os
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from gazelle.announcements import announce
from gazelle.cache_folders import own_cache, own_folder
from gazelle.user_folders import lives

__all__ = [
    "cache_top",
    "digest_of_file",
    "digest_of_text",
    "forget_unused",
    "make_whole",
    "only_one",
    "stat_signature",
    "touch",
]

_VARIABLE = "GAZELLE_CPP_CACHE"
_LOOK_EVERY_S = 0.05
_UNUSED_DAYS = 60
_PATIENCE_S = 1.0
_DIGEST_LENGTH = 16

_digests: dict[str, tuple[int, int, str]] = {}
_inside: dict[str, int] = {}
_locks: dict[str, threading.RLock] = {}
_guard = threading.Lock()


@functools.cache
def cache_top() -> Path:
    """Return the folder below which everything of C++ is kept.

    ``GAZELLE_CPP_CACHE`` names another one. Where no cache can be written, it is a temporary folder
    that ends with this process.
    """
    if (named := os.environ.get(_VARIABLE)) and (given := own_folder(Path(named), _VARIABLE)):
        return given
    folder = own_cache("cpp")
    if folder is None:
        folder = Path(tempfile.mkdtemp(prefix="gazelle-cpp-"))
        # The processes that this one starts use it as well.
        os.environ[_VARIABLE] = str(folder)
        atexit.register(_remove_own, folder, os.getpid())
    return folder


def _remove_own(folder: Path, pid: int) -> None:
    if os.getpid() == pid:
        shutil.rmtree(folder, ignore_errors=True)


def digest_of_text(*texts: str) -> str:
    """Return a short digest of texts, each apart."""
    total = hashlib.sha256()
    for text in texts:
        data = text.encode(errors="surrogateescape")
        total.update(len(data).to_bytes(8, "little") + data)
    return total.hexdigest()[:_DIGEST_LENGTH]


def digest_of_file(path: str | Path) -> str:
    """Return a digest of a file's content, empty where it cannot be read.

    It is read anew only where its size or time has changed.
    """
    name = os.fspath(path)
    try:
        found = os.stat(name)  # noqa: PTH116 - thousands of them
        known = _digests.get(name)
        if known and known[:2] == (found.st_mtime_ns, found.st_size):
            return known[2]
        with open(name, "rb") as file:  # noqa: PTH123
            digest = hashlib.sha256(file.read()).hexdigest()
    except OSError:
        return ""
    _digests[name] = (found.st_mtime_ns, found.st_size, digest)
    return digest


def stat_signature(tops: Iterable[Path]) -> str:
    """Return a digest of the names, times and sizes of all files below folders."""
    total = hashlib.sha256()
    for top in tops:
        for root, folders, names in os.walk(top):
            folders[:] = sorted(name for name in folders if name != "__pycache__")
            for name in sorted(names):
                path = f"{root}/{name}"
                try:
                    found = os.stat(path)  # noqa: PTH116
                except OSError:
                    continue
                line = f"{path}\0{found.st_mtime_ns}\0{found.st_size}\n"
                total.update(line.encode(errors="surrogateescape"))
    return total.hexdigest()[:_DIGEST_LENGTH]


@contextlib.contextmanager
def make_whole(target: Path) -> Iterator[Path]:
    """Give a new folder to fill, beside the target; it gets the target's name at the end.

    Where the block fails nothing is left. Where somebody else was first, theirs stays.
    """
    target.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    _sweep_partial(target.parent)
    made = Path(tempfile.mkdtemp(prefix=f".new-{os.getpid()}-", dir=target.parent))
    try:
        yield made
        try:
            made.rename(target)
        except OSError:
            if not target.is_dir():
                raise
    finally:
        shutil.rmtree(made, ignore_errors=True)


def touch(folder: Path) -> None:
    """Note that something kept was used just now."""
    with contextlib.suppress(OSError):
        os.utime(folder)


def forget_unused(top: Path) -> None:
    """Remove what nobody has used for long.

    What nodes' files name is kept: the programs that they are started by.
    """
    oldest = time.time() - _UNUSED_DAYS * 24 * 3600
    for kind in ("headers", "lib", "messages", "objects", "packages"):
        depth = "*/*" if kind in ("headers", "objects") else "*"
        for folder in (top / kind).glob(depth):
            with contextlib.suppress(OSError):
                if folder.is_dir() and folder.stat().st_mtime < oldest:
                    shutil.rmtree(folder, ignore_errors=True)


def _sweep_partial(folder: Path) -> None:
    """Remove what killed processes left."""
    for left in folder.glob(".new-*"):
        pid = left.name.split("-")[1]
        if not lives(pid):
            shutil.rmtree(left, ignore_errors=True)


@contextlib.contextmanager
def only_one(path: Path, what: str) -> Iterator[None]:
    """Let one process, and one thread of it, do something at a time; who waits says so, once.

    The system lets go of the lock when its process ends, however that happens. Where the file
    system has no locks, nobody waits.

    Args:
        path: a file of the lock's own.
        what: ``compiling talker``.
    """
    name = os.fspath(path)
    with _guard:
        lock = _locks.setdefault(name, threading.RLock())
    with lock, contextlib.ExitStack() as stack:
        if not _inside.get(name):
            with contextlib.suppress(OSError):
                path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
                descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
                stack.callback(os.close, descriptor)
                _wait_for(descriptor, what)
        _inside[name] = _inside.get(name, 0) + 1
        try:
            yield
        finally:
            _inside[name] -= 1


def _wait_for(descriptor: int, what: str) -> None:
    began = time.monotonic()
    while not _lock(descriptor):
        if time.monotonic() - began > _PATIENCE_S:
            announce(f"waiting for another process, which is {what}", key=f"waiting {what}")
        time.sleep(_LOOK_EVERY_S)


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> bool:
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        return True
else:
    import fcntl

    def _lock(descriptor: int) -> bool:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
