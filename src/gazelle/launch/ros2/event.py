"""Events: what happens while a launch runs."""

from __future__ import annotations

__all__ = ["Event"]


class Event:
    """Something that happened; handlers are asked about every one.

    Attributes:
        name: full name of its kind.
    """

    name = "launch.Event"
