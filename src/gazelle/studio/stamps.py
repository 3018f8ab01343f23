"""Times of messages."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces.stamps import seconds_of

__all__ = ["stamp_s"]


def stamp_s(message: Any, arrived_s: float) -> float:
    """Return when a message is from: its header's time, else when it came, seconds."""
    header = getattr(message, "header", None)
    stamp = getattr(header, "stamp", None)
    if stamp is not None and (stamp.sec or stamp.nanosec):
        return seconds_of(stamp)
    return arrived_s
