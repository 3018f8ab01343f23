"""The services ``NODE/get_logger_levels`` and ``set_logger_levels`` (rclpy.logging_service)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy import logging
from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = ["offer_logger_levels"]


def offer_logger_levels(node: Node) -> None:
    """Let others get and set the levels of this process's loggers."""
    for name, handler in (("get_logger_levels", _get), ("set_logger_levels", _set)):
        words = "".join(word.capitalize() for word in name.split("_"))
        kind = service_type(f"rcl_interfaces/srv/{words}")
        node.create_service(kind, f"{node.get_name()}/{name}", handler)


def _get(request: Any, response: Any) -> Any:
    make = message_type("rcl_interfaces/msg/LoggerLevel")
    response.levels = [
        make(name=name, level=int(logging.get_logger_level(name))) for name in request.names
    ]
    return response


def _set(request: Any, response: Any) -> Any:
    make = message_type("rcl_interfaces/msg/SetLoggerLevelsResult")
    for one in request.levels:
        try:
            logging.set_logger_level(one.name, one.level)
        except ValueError:
            reason = "Failed reason: Invalid logger level."
            response.results.append(make(successful=False, reason=reason))
        else:
            response.results.append(make(successful=True))
    return response
