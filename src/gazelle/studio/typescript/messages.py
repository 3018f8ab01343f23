"""The messages that the page knows by type; each is declared next to what makes it."""

from __future__ import annotations

from gazelle.studio.displays.display import DisplayRow
from gazelle.studio.displays.finding import AddedDisplays

__all__ = ["MESSAGES"]

MESSAGES: tuple[type, ...] = (DisplayRow, AddedDisplays)
"""`TypedDict` classes, each before those that it is part of."""
