"""Parameters of bytes, which rospy hands out as ``xmlrpc.client.Binary`` (``<param binfile>``)."""

from __future__ import annotations

import sys
from typing import Any

__all__ = ["as_binary", "as_bytes"]

_XMLRPC = "xmlrpc.client"


def as_binary(value: Any) -> Any:
    """Return a value with ``Binary`` in place of bytes, also within lists and dictionaries."""
    if isinstance(value, bytes):
        # Not above: few programs have such parameters, and the module takes its time.
        from xmlrpc.client import Binary

        return Binary(value)
    if isinstance(value, list):
        return [as_binary(item) for item in value]
    if isinstance(value, dict):
        return {key: as_binary(item) for key, item in value.items()}
    return value


def as_bytes(value: Any) -> Any:
    """Return a value with bytes in place of ``Binary``, also within lists and dictionaries."""
    xmlrpc = sys.modules.get(_XMLRPC)
    if xmlrpc is None:
        return value
    if isinstance(value, xmlrpc.Binary):
        return bytes(value.data)
    if isinstance(value, list | tuple):
        return [as_bytes(item) for item in value]
    if isinstance(value, dict):
        return {key: as_bytes(item) for key, item in value.items()}
    return value
