"""One process at a time compiles a kernel.

Of the processes of a launch several want the same kernel at the same moment. Where nothing is kept
yet each would compile it; here the others wait for the first one and load what it has kept. Who
waits says so, once.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from gazelle.announcements import announce
from gazelle.kernels.areas import area_of
from gazelle.kernels.source import KernelSource

__all__ = ["turn"]

_MAX_WAIT_S = 60.0
"""Whoever compiles for longer was stopped in the middle: nobody waits for that."""

_LOOK_EVERY_S = 0.02
_PATIENCE_S = 1.0

_held: set[Path] = set()


@contextlib.contextmanager
def turn(path: Path, source: KernelSource) -> Iterator[None]:
    """Hold a file locked; without it where that cannot be, or not soon.

    The system lets go of it when a process ends, however that happens.
    """
    if path in _held:
        yield
        return
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
            stack.callback(os.close, descriptor)
            if _locked(descriptor, source):
                stack.callback(_unlock, descriptor)
        _held.add(path)
        stack.callback(_held.discard, path)
        yield


def _locked(descriptor: int, source: KernelSource) -> bool:
    """Wait for a file's lock; tells whether it is ours."""
    began = time.monotonic()
    while not _lock(descriptor):
        waited_s = time.monotonic() - began
        if waited_s > _MAX_WAIT_S:
            return False
        if waited_s > _PATIENCE_S:
            _tell_of_waiting(source)
        time.sleep(_LOOK_EVERY_S)
    return True


def _tell_of_waiting(source: KernelSource) -> None:
    area = area_of(source.function.__module__)
    what = f" of {area.what}" if area else ""
    announce(
        f"waiting for another process, which is compiling the kernels{what} for this machine, once"
    )


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> bool:
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        return True

    def _unlock(descriptor: int) -> None:
        os.lseek(descriptor, 0, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_UNLCK, 1)
else:
    import fcntl

    def _lock(descriptor: int) -> bool:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def _unlock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_UN)
