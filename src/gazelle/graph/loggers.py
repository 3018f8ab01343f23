"""``~get_loggers`` and ``~set_logger_level``: what every ROS 1 node offers (rqt_logger_level)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.console import Level, level_of

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = ["offer_loggers"]


def offer_loggers(node: Node, logger: str = "ros") -> None:
    """Let others read and change how much a node says.

    A node of ours has one level for all of its loggers, so any name sets it.

    Args:
        node: the node.
        logger: name of its logger: ``ros`` as roscpp's, ``rosout`` as rospy's.
    """
    from gazelle.interfaces import ros1_message_type, ros1_service_type

    entry: Any = ros1_message_type("roscpp/Logger")
    get: Any = ros1_service_type("roscpp/GetLoggers")
    put: Any = ros1_service_type("roscpp/SetLoggerLevel")

    def loggers(_request: Any) -> Any:
        level = Level(node.log_level).name.lower()
        return get._response_class([entry(name=logger, level=level)])

    def set_level(request: Any) -> Any:
        try:
            node.log_level = level_of(request.level)
        except KeyError:
            words = ", ".join(level.name.lower() for level in Level)
            raise GraphError(f"'{request.level}' is no level; there are {words}") from None
        return put._response_class()

    with node.announced_together():
        node.create_service("~get_loggers", get, loggers)
        node.create_service("~set_logger_level", put, set_level)
