"""Joystick devices of the Linux kernel: which there are, their events, axes and buttons."""

from __future__ import annotations

import fcntl
import os
import re
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, TypeVar

__all__ = [
    "EVENT_BYTES",
    "Device",
    "JoyEvent",
    "JoyState",
    "devices",
    "name_of",
    "open_device",
    "read_event",
]


EVENT_BYTES = 8
_LAYOUT = struct.Struct("<IhBB")
_BUTTON, _AXIS, _INIT = 0x01, 0x02, 0x80
_FULL = 32767.0
_T = TypeVar("_T", int, float)
_FOLDER = Path("/dev/input")
_NAME_BYTES = 128

# _IOC(_IOC_READ, 'j', 0x13, len): the name of a joystick.
_JSIOCGNAME = 0x80006A13 + (_NAME_BYTES << 16)


class JoyEvent(NamedTuple):
    """One event.

    Attributes:
        number: of the axis or button.
        value: -32767 to 32767 of an axis, 0 or 1 of a button.
        is_axis, is_button: what moved.
        is_initial: tells the state at the opening.
    """

    number: int
    value: int
    is_axis: bool
    is_button: bool
    is_initial: bool


@dataclass(slots=True)
class JoyState:
    """Axes and buttons; both grow with the numbers that come.

    Attributes:
        deadzone: share of full deflection that counts as none; what is beyond begins at 0.
        sticky_buttons: a press toggles, and letting go does nothing.
        axes: -1 to 1; left and forward are positive.
        buttons: 0 or 1.
    """

    deadzone: float = 0.05
    sticky_buttons: bool = False
    axes: list[float] = field(default_factory=list)
    buttons: list[int] = field(default_factory=list)

    def take(self, event: JoyEvent) -> bool:
        """Take an event; tell whether it is of a kind that is known."""
        if event.is_button:
            _grow(self.buttons, event.number, 0)
            if not self.sticky_buttons:
                self.buttons[event.number] = 1 if event.value else 0
            elif event.value:
                self.buttons[event.number] = 1 - self.buttons[event.number]
        elif event.is_axis:
            _grow(self.axes, event.number, 0.0)
            self.axes[event.number] = self._share(event.value)
        return event.is_axis or event.is_button

    def _share(self, value: int) -> float:
        # The kernel's left and forward are negative, ROS's positive.
        share = max(-1.0, min(1.0, -value / _FULL))
        beyond = abs(share) - self.deadzone
        if beyond <= 0:
            return 0.0
        return (beyond if share > 0 else -beyond) / (1.0 - self.deadzone)


class Device(NamedTuple):
    """A joystick.

    Attributes:
        path: such as ``/dev/input/js0``.
        name: as its maker calls it.
    """

    path: Path
    name: str


def read_event(data: bytes) -> JoyEvent:
    """Read 8 bytes."""
    _time_ms, value, kind, number = _LAYOUT.unpack(data)
    return JoyEvent(number, value, bool(kind & _AXIS), bool(kind & _BUTTON), bool(kind & _INIT))


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


def _grow(values: list[_T], number: int, value: _T) -> None:
    values.extend([value] * (number + 1 - len(values)))
