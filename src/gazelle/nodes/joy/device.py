"""Joystick devices of the Linux kernel: which there are, and opening one."""

from __future__ import annotations

import fcntl
import os
import re
from pathlib import Path
from typing import NamedTuple

__all__ = ["Device", "devices", "name_of", "open_device"]

_FOLDER = Path("/dev/input")
_NAME_BYTES = 128
# _IOC(_IOC_READ, 'j', 0x13, len): the name of a joystick.
_JSIOCGNAME = 0x80006A13 + (_NAME_BYTES << 16)


class Device(NamedTuple):
    """A joystick.

    Attributes:
        path: such as ``/dev/input/js0``.
        name: as its maker calls it.
    """

    path: Path
    name: str


def devices(folder: Path = _FOLDER) -> tuple[Device, ...]:
    """Return the joysticks that can be opened, by number."""
    if not folder.is_dir():
        return ()
    numbered = [
        (int(found[1]), path)
        for path in folder.iterdir()
        if (found := re.fullmatch(r"js(\d+)", path.name))
    ]
    listed = []
    for _number, path in sorted(numbered):
        try:
            descriptor = open_device(path)
        except OSError:
            continue
        listed.append(Device(path, name_of(descriptor)))
        os.close(descriptor)
    return tuple(listed)


def open_device(path: Path) -> int:
    """Open a joystick, or a pipe with a joystick's events; returns its descriptor.

    Raises:
        OSError: it cannot be opened.
    """
    return os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)


def name_of(descriptor: int) -> str:
    """Return a joystick's name, ``Unknown`` for what has none, such as a pipe."""
    buffer = bytearray(_NAME_BYTES)
    try:
        fcntl.ioctl(descriptor, _JSIOCGNAME, buffer)
    except OSError:
        return "Unknown"
    return bytes(buffer).split(b"\0", 1)[0].decode("utf-8", "replace") or "Unknown"
