"""The ROS graph: nodes, topics, services, parameters, time, logging and tf, over Zenoh."""

from __future__ import annotations

from gazelle.graph.clock import Clock
from gazelle.graph.console import Level, LogRecord, format_record, offer_loggers, print_record
from gazelle.graph.errors import (
    IllegalNameError,
    NoGraphError,
    PortTakenError,
    ServiceCallError,
    ServiceRefusedError,
    ServiceTimeoutError,
    ServiceUnavailableError,
    TimeJumpError,
)
from gazelle.graph.graph import Graph
from gazelle.graph.graph_info import Endpoint, NodeInfo, ServiceInfo, TopicInfo
from gazelle.graph.key_expressions import ANY_TYPE, Entity, Kind, Qos
from gazelle.graph.node import Node
from gazelle.graph.parameter_server import ParameterStore
from gazelle.graph.publisher import Publisher
from gazelle.graph.service import ServiceClient, ServiceServer
from gazelle.graph.subscription import MessageInfo, RawMessage, Subscription

__all__ = [
    "ANY_TYPE",
    "Clock",
    "Endpoint",
    "Entity",
    "Graph",
    "IllegalNameError",
    "Kind",
    "Level",
    "LogRecord",
    "MessageInfo",
    "NoGraphError",
    "Node",
    "NodeInfo",
    "ParameterStore",
    "PortTakenError",
    "Publisher",
    "Qos",
    "RawMessage",
    "ServiceCallError",
    "ServiceClient",
    "ServiceInfo",
    "ServiceRefusedError",
    "ServiceServer",
    "ServiceTimeoutError",
    "ServiceUnavailableError",
    "Subscription",
    "TimeJumpError",
    "TopicInfo",
    "format_record",
    "offer_loggers",
    "print_record",
]
