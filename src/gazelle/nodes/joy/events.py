"""Events of the Linux kernel's joystick devices, and what axes and buttons they come to.

An event is 8 bytes: time in ms, value, type, number (Documentation/input/joydev/joystick-api).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

__all__ = ["EVENT_BYTES", "JoyEvent", "JoyState", "read_event"]

EVENT_BYTES = 8
_LAYOUT = struct.Struct("<IhBB")
_BUTTON, _AXIS, _INIT = 0x01, 0x02, 0x80
_FULL = 32767.0
_T = TypeVar("_T", int, float)


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


def read_event(data: bytes) -> JoyEvent:
    """Read 8 bytes."""
    _time_ms, value, kind, number = _LAYOUT.unpack(data)
    return JoyEvent(number, value, bool(kind & _AXIS), bool(kind & _BUTTON), bool(kind & _INIT))


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


def _grow(values: list[_T], number: int, value: _T) -> None:
    values.extend([value] * (number + 1 - len(values)))
