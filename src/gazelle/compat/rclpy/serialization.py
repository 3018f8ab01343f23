"""Messages as bytes (rclpy.serialization): CDR with its header of four bytes."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import from_cdr, to_cdr

__all__ = ["deserialize_message", "serialize_message"]


def serialize_message(message: Any) -> bytes:
    """Return a message's bytes."""
    return bytes(to_cdr(message))


def deserialize_message(serialized_message: bytes, message_type: Any) -> Any:
    """Return the message of some bytes."""
    return from_cdr(message_type, serialized_message)
