"""Foxglove and other viewers that speak its WebSocket protocol."""

from __future__ import annotations

from gazelle.bridge.foxglove.bridge import FoxgloveBridge
from gazelle.bridge.foxglove.sdk import SdkViewers
from gazelle.bridge.foxglove.server_interface import Allow

__all__ = ["Allow", "FoxgloveBridge", "SdkViewers"]
