"""Whether velocities have stamps."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from gazelle.nodes.parameters import private

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.arguments import NodeArguments

__all__ = ["is_stamped"]

_STAMPED = frozenset({"jazzy", "kilted", "rolling"})


def is_stamped(node: Node, arguments: NodeArguments) -> bool:
    """Tell what ``~use_stamped`` says; from Jazzy on it is true unless told otherwise."""
    newer = arguments.generation == 2 and os.environ.get("ROS_DISTRO", "") in _STAMPED
    return str(private(node, arguments, "use_stamped", newer)).lower() == "true"
