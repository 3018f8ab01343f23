"""Whether velocities have stamps."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from gazelle.parameters import Parameter

if TYPE_CHECKING:
    from gazelle.parameters.reader import ParameterReader

__all__ = ["USE_STAMPED", "is_stamped"]

USE_STAMPED = Parameter(
    "use_stamped", "flag", None, "velocities have stamps; from Jazzy on they have by default"
)

_STAMPED = frozenset({"jazzy", "kilted", "rolling"})


def is_stamped(own: ParameterReader) -> bool:
    """Tell what ``~use_stamped`` says; from Jazzy on it is true unless told otherwise."""
    newer = own.ros_version == 2 and os.environ.get("ROS_DISTRO", "") in _STAMPED
    return own.flag("use_stamped", newer)
