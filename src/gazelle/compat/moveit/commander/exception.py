"""What moveit_commander raises."""

from __future__ import annotations

__all__ = ["MoveItCommanderException"]


class MoveItCommanderException(Exception):  # noqa: N818 - its users' name for it
    """Something was asked that cannot be done."""
