"""Times of messages."""

from __future__ import annotations

from typing import Any

__all__ = ["seconds", "stamp_s"]


def seconds(stamp: Any) -> float:
    """Return a time of a message in seconds."""
    return float(stamp.sec + stamp.nanosec * 1e-9)


def stamp_s(message: Any, arrived_s: float) -> float:
    """Return when a message is from: its header's time, else when it came, seconds."""
    header = getattr(message, "header", None)
    stamp = getattr(header, "stamp", None)
    if stamp is not None and (stamp.sec or stamp.nanosec):
        return seconds(stamp)
    return arrived_s
