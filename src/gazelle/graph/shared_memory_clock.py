"""A page of memory that shows simulated time to all processes of one user on one machine."""

from __future__ import annotations

import contextlib
import mmap
import os
import stat
import struct
from functools import cache
from pathlib import Path

from gazelle.user_folders import own_prefix, runtime_folder, sweep

__all__ = ["ClockPage", "PageView", "Reading", "machine_name"]

_SIZE = 4096
_MAGIC = b"GZclock1"
_HEAD = struct.Struct("8s16s")
# The numbers begin at a cache line of their own.
_BEGIN = 64
_WORDS = 4
_NAME = "gazelle-clock-"
_TRIES = 8
# Which bits the number of jumps changes in the check: not those that nanoseconds change together.
_JUMP_BITS = 40
_OPEN = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
# Its files are made under names that nobody can guess, and only where none is.
_SHARED_MEMORY = Path("/dev/shm")  # noqa: S108
_BOOT = Path("/proc/sys/kernel/random/boot_id")


Reading = tuple[int, int, int]
"""Simulated time in ns, how often it went back so far, and by how many ns the last time (< 0)."""


class ClockPage:
    """The page as its one writer has it.

    Attributes:
        path: the file that others map.
        secret: 16 bytes at its beginning, so that nobody takes another file for it.
    """

    def __init__(self) -> None:
        """Make the file, for this user alone.

        Raises:
            OSError: there is no place for it.
        """
        self.secret = os.urandom(16)
        self.path = ""
        self._shown: Reading = (0, 0, 0)
        for folder in _folders():
            sweep(folder, _NAME)
            path = folder / f"{own_prefix(_NAME)}{os.urandom(8).hex()}"
            with contextlib.suppress(OSError):
                self._integers = _made(path, self.secret)
                self.path = str(path)
                return
        raise OSError("there is no folder for the clock's page")

    def show(self, now_ns: int) -> bool:
        """Show a time; return whether it went backwards. Only one thread may do so."""
        before_ns, jumps, jump_ns = self._shown
        is_jump = now_ns < before_ns
        if is_jump:
            jumps, jump_ns = jumps + 1, now_ns - before_ns
        self._shown = (now_ns, jumps, jump_ns)
        integers = self._integers
        # Each is written at once. Whoever reads in between sees that they do not fit together.
        integers[0] = now_ns
        integers[1] = jumps
        integers[2] = jump_ns
        integers[3] = ~(now_ns ^ (jumps << _JUMP_BITS) ^ jump_ns)
        return is_jump

    def close(self) -> None:
        """Remove the file; who has mapped it keeps its last time."""
        # Windows removes no file that is mapped: the next page's maker does.
        with contextlib.suppress(OSError):
            Path(self.path).unlink()


class PageView:
    """The page as any number of others have it."""

    def __init__(self, path: str, secret: bytes) -> None:
        """Map it.

        Args:
            path: the file.
            secret: what it begins with.

        Raises:
            OSError: there is no such file of this user, or it is no clock's.
        """
        number = os.open(path, os.O_RDONLY | _OPEN | getattr(os, "O_NONBLOCK", 0))
        try:
            found = os.fstat(number)
            is_own = not hasattr(os, "getuid") or found.st_uid == os.getuid()
            if not stat.S_ISREG(found.st_mode) or found.st_size != _SIZE or not is_own:
                raise OSError(f"{path} is not a clock of this user")
            memory = mmap.mmap(number, _SIZE, access=mmap.ACCESS_READ)
        finally:
            os.close(number)
        if _HEAD.unpack_from(memory) != (_MAGIC, secret):
            raise OSError(f"{path} is another clock")
        self._integers = _numbers(memory)
        self._last: Reading = (0, 0, 0)
        self.read()

    @property
    def address(self) -> int:
        """Where the four numbers lie in this process's memory, for as long as this object does."""
        # Only nodes of C++ look there themselves.
        from gazelle.graph.buffer_address import address_of

        return address_of(self._integers)

    def read(self) -> Reading:
        """Return what the page shows; from any thread, in less than a microsecond."""
        for _ in range(_TRIES):
            now_ns, jumps, jump_ns, check = self._integers.tolist()
            if check == ~(now_ns ^ (jumps << _JUMP_BITS) ^ jump_ns):
                self._last = reading = (now_ns, jumps, jump_ns)
                return reading
        # Its writer was interrupted: then nobody has been told of the new time either.
        return self._last


def _made(path: Path, secret: bytes) -> memoryview[int]:
    number = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | _OPEN, 0o600)
    try:
        # Written, not only made long: where there is no room, that is told now and not by a signal.
        os.write(number, _HEAD.pack(_MAGIC, secret).ljust(_SIZE, b"\0"))
        memory = mmap.mmap(number, _SIZE)
    except OSError:
        path.unlink()
        raise
    finally:
        os.close(number)
    return _numbers(memory)


def _numbers(memory: mmap.mmap) -> memoryview[int]:
    """Return the numbers; the memory is given back with them."""
    whole = memoryview(memory)[_BEGIN : _BEGIN + 8 * _WORDS]
    return whole.cast("q")


def _folders() -> list[Path]:
    """Return where to put pages: rather where no disk is written to."""
    # Only who publishes needs it, and all nodes come here.
    import tempfile

    wanted = (runtime_folder(), _SHARED_MEMORY, Path(tempfile.gettempdir()))
    return [one for one in wanted if one is not None and one.is_dir()]


@cache
def machine_name() -> str:
    """Return a name of this machine, until it is started anew; hexadecimal."""
    try:
        return _BOOT.read_text(encoding="ascii").strip().replace("-", "")
    except OSError:
        import hashlib
        import platform
        import uuid

        machine = f"{platform.node()} {uuid.getnode()}"
        return hashlib.blake2b(machine.encode(), digest_size=16).hexdigest()
