"""A topic, service or action as a row of a table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["Topic", "TopicKind"]

TopicKind = Literal["publishes", "listens", "service", "action"]


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, service or action of a controller, plug-in or node.

    Attributes:
        name: ``~/command`` lies in the owner's namespace, ``joint_states`` in the one above; words
            in braces are parameters.
        type: ROS type.
        kind: what is done with it.
        rate: how often, in words.
        frame: ``header.frame_id``, in words; empty for none.
        ros_versions: those of ROS that have it.
        ros2: the name in ROS 2, where that is another.
    """

    name: str
    type: str
    kind: TopicKind = "publishes"
    rate: str = ""
    frame: str = ""
    ros_versions: tuple[int, ...] = (1, 2)
    ros2: str = ""
