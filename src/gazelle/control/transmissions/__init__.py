"""Transmissions between actuators and joints: simple, differential, four-bar linkage."""

from __future__ import annotations

from gazelle.control.transmissions.transmission import (
    Transmission,
    differential_transmission,
    four_bar_linkage_transmission,
    simple_transmission,
)

__all__ = [
    "Transmission",
    "differential_transmission",
    "four_bar_linkage_transmission",
    "simple_transmission",
]
