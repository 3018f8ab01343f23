"""Unique names of goals."""

from __future__ import annotations

import itertools
from typing import Any

from gazelle.compat.actionlib.spec import GoalID
from gazelle.compat.rospy.client import get_name
from gazelle.compat.rospy.rostime import get_rostime

__all__ = ["GoalIDGenerator"]

_NUMBERS = itertools.count(1)


class GoalIDGenerator:
    """Makes ids out of a name, a count and the time.

    Args:
        name: the node's own by default.
    """

    def __init__(self, name: str | None = None) -> None:
        self.name = get_name() if name is None else name

    def set_name(self, name: str) -> None:
        """Set what ids begin with."""
        self.name = name

    def generate_ID(self) -> Any:
        """Return a new id, stamped with the time now."""
        now = get_rostime()
        text = f"{self.name}-{next(_NUMBERS)}-{now.secs}.{now.nsecs}"
        return GoalID(stamp=now, id=text)
