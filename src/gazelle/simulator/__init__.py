"""The world server: time loop, plug-ins, services and the `Simulation` API."""

from __future__ import annotations


class Simulation:
    """Replaced by the real one."""


__all__ = ["Simulation"]
