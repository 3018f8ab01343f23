"""Codes of pictures for people."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "picture.no-inertia-box",
        "warning",
        "A link's inertia is one that no box can have",
        "No box is drawn for the link.",
        "give the link a positive mass and principal moments of which no one exceeds the sum of "
        "the others; a box of mass m and edges a, b, c has ixx = m (b² + c²) / 12",
    ),
)
