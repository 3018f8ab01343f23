"""``node.*`` and ``logger.*``: what one node is, says and can be told."""

from __future__ import annotations

from typing import TypedDict

from gazelle.graph import Endpoint, Node
from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.graph_view.services import request_response, services_by_type
from gazelle.studio.request_params import Params

__all__ = [
    "EndpointRow",
    "LoggerNode",
    "LoggerRow",
    "NodeInfo",
    "NodeKill",
    "get_node",
    "kill_node",
    "list_loggers",
    "set_logger",
]

_ROS1_GET, _ROS1_SET = "roscpp/srv/GetLoggers", "roscpp/srv/SetLoggerLevel"
_ROS2_GET, _ROS2_SET = "rcl_interfaces/srv/GetLoggerLevels", "rcl_interfaces/srv/SetLoggerLevels"
_ROS2_LEVELS = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}


class EndpointRow(TypedDict):
    """A topic, service or action of a node."""

    name: str
    type: str


class NodeInfo(TypedDict):
    """What a node is.

    Attributes:
        pid: null where nobody knows.
    """

    name: str
    publications: list[EndpointRow]
    subscriptions: list[EndpointRow]
    services: list[EndpointRow]
    clients: list[EndpointRow]
    action_servers: list[EndpointRow]
    action_clients: list[EndpointRow]
    pid: int | None
    host: str


class NodeKill(TypedDict):
    """Whether a node that was asked to shut down has answered."""

    answered: bool


class LoggerNode(TypedDict):
    """A node that lets the levels of its loggers be set."""

    node: str


class LoggerRow(TypedDict):
    """A logger of a node; its level in a small word, `debug` to `fatal`."""

    name: str
    level: str


def get_node(node: Node, params: Params) -> NodeInfo:
    """``node.info``."""
    info = node.graph.node_info(params.text("node"))
    actions = node.graph.actions()
    return {
        "name": info.name,
        "publications": _ends(info.publications),
        "subscriptions": _ends(info.subscriptions),
        "services": _ends(info.services),
        "clients": _ends(info.clients),
        "action_servers": [
            {"name": one.name, "type": one.type_name} for one in actions if info.name in one.servers
        ],
        "action_clients": [
            {"name": one.name, "type": one.type_name} for one in actions if info.name in one.clients
        ],
        "pid": info.pid or None,
        "host": info.host,
    }


def kill_node(node: Node, params: Params) -> NodeKill:
    """``node.kill``: asks it to shut down."""
    name = params.text("node")
    if node.resolve_name(name) == node.name:
        raise StudioError("this is Studio's own node; end `gazelle studio` itself")
    return {"answered": node.graph.kill_node(name)}


def list_loggers(node: Node, params: Params) -> list[LoggerNode] | list[LoggerRow]:
    """``logger.list``: the loggers of one node, or all nodes that have some."""
    if "node" in params:
        return _loggers(node, node.resolve_name(params.text("node")))
    nodes: list[LoggerNode] = [{"node": name} for name in sorted(_offering(node))]
    return nodes


def set_logger(node: Node, params: Params) -> dict[str, str]:
    """``logger.set``."""
    target = node.resolve_name(params.text("node"))
    logger, level = params.text("logger"), params.text("level").lower()
    if level not in _ROS2_LEVELS:
        raise StudioError(f"there is no level '{level}'", known=_ROS2_LEVELS)
    if _ros_version(node, target) == 1:
        name = f"{target}/set_logger_level"
        request_response(node, name, _ROS1_SET, logger=logger, level=level)
        return {}
    row = message_type("rcl_interfaces/msg/LoggerLevel")(name=logger, level=_ROS2_LEVELS[level])
    name = f"{target}/set_logger_levels"
    results = request_response(node, name, _ROS2_SET, levels=[row]).results
    refused = next((one.reason for one in results if not one.successful), "")
    if refused:
        raise StudioError(f"{target}: {refused}")
    return {}


def _loggers(node: Node, target: str) -> list[LoggerRow]:
    if _ros_version(node, target) == 1:
        found = request_response(node, f"{target}/get_loggers", _ROS1_GET).loggers
        return [{"name": one.name, "level": one.level.lower()} for one in found]
    own = target.strip("/").replace("/", ".")
    answer = request_response(node, f"{target}/get_logger_levels", _ROS2_GET, names=[own])
    names = {number: word for word, number in _ROS2_LEVELS.items()}
    return [{"name": one.name, "level": names.get(one.level, "info")} for one in answer.levels]


def _ends(endpoints: tuple[Endpoint, ...]) -> list[EndpointRow]:
    return [{"name": one.name, "type": one.type_name} for one in endpoints]


def _offering(node: Node) -> dict[str, int]:
    """Nodes that let their loggers be set, with the generation of the services."""
    found = {
        name.removesuffix("/get_logger_levels"): 2
        for name in services_by_type(node.graph, _ROS2_GET)
    }
    return found | {
        name.removesuffix("/get_loggers"): 1 for name in services_by_type(node.graph, _ROS1_GET)
    }


def _ros_version(node: Node, target: str) -> int:
    offering = _offering(node)
    if target not in offering:
        raise unknown("node with loggers", target, offering)
    return offering[target]
