"""How late and how often transforms come, as ``tf_monitor`` counts."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Delays", "FrameDelays", "NetDelay"]

_LOWPASS = 0.01
_MIN_DURATION_S = 1e-8


@dataclass(slots=True)
class Delays:
    """Delays of one frame or one broadcaster, seconds."""

    total_s: float = 0.0
    largest_s: float = 0.0
    count: int = 0
    first_s: float = 0.0
    last_s: float = 0.0

    def add(self, delay_s: float, now_s: float) -> None:
        """Count one."""
        if not self.count:
            self.first_s = now_s
        self.last_s = now_s
        self.count += 1
        self.total_s += delay_s
        self.largest_s = max(self.largest_s, delay_s)

    @property
    def average_s(self) -> float:
        """Mean delay."""
        return self.total_s / self.count

    @property
    def rate_hz(self) -> float:
        """Count over the time from the first to the last; 1e8 for a single one, as tf says."""
        return self.count / max(self.last_s - self.first_s, _MIN_DURATION_S)


@dataclass(slots=True)
class FrameDelays:
    """Delays by frame and by broadcaster; may be filled and read from different threads.

    Attributes:
        authority_of: frame → who publishes it, with ``(static)`` behind static ones.
    """

    frames: dict[str, Delays] = field(default_factory=dict)
    nodes: dict[str, Delays] = field(default_factory=dict)
    authority_of: dict[str, str] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def add(self, message: Any, publisher: str, now_s: float, *, is_static: bool) -> None:
        """Count a ``tf2_msgs/TFMessage``; static transforms are never late."""
        if not message.transforms:
            return
        authority = publisher + ("(static)" if is_static else "")
        sum_s = 0.0
        with self.lock:
            for one in message.transforms:
                stamp = one.header.stamp
                delay_s = 0.0 if is_static else now_s - stamp.sec - stamp.nanosec * 1e-9
                sum_s += delay_s
                name = one.child_frame_id.removeprefix("/")
                self.authority_of[name] = authority
                self.frames.setdefault(name, Delays()).add(delay_s, now_s)
            mean_s = sum_s / len(message.transforms)
            self.nodes.setdefault(authority, Delays()).add(mean_s, now_s)


@dataclass(slots=True)
class NetDelay:
    """How old the newest transform of a chain is, smoothed."""

    average_s: float = 0.0
    largest_s: float = 0.0

    def add(self, delay_s: float) -> None:
        """Count one look."""
        self.average_s = _LOWPASS * delay_s + (1.0 - _LOWPASS) * self.average_s
        self.largest_s = max(self.largest_s, delay_s)
