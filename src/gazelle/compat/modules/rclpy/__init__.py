"""rclpy, on Gazelle's graph."""

import sys as _sys

from gazelle.compat.rclpy import *  # noqa: F403
from gazelle.compat.rclpy import (
    action,
    callback_groups,
    clock,
    context,
    duration,
    event_handler,
    exceptions,
    executors,
    guard_condition,
    init_shutdown,
    lifecycle,
    logging,
    name_validation,
    node,
    parameter,
    parameter_client,
    parameter_event_handler,
    publisher_subscription_service,
    qos,
    qos_overriding_options,
    serialization,
    task,
    time,
    timer,
    topic_endpoint_info,
    utilities,
)
from gazelle.compat.rclpy.action import client as _action_client
from gazelle.compat.rclpy.action import server as _action_server
from gazelle.compat.rclpy.lifecycle import entities as _lifecycle_entities
from gazelle.compat.rclpy.lifecycle import node as _lifecycle_node

for _name, _module in {
    "action": action,
    "action.client": _action_client,
    "action.server": _action_server,
    "callback_groups": callback_groups,
    "client": publisher_subscription_service,
    "clock": clock,
    "clock_type": time,
    "constants": duration,
    "context": context,
    "duration": duration,
    "event_handler": event_handler,
    "exceptions": exceptions,
    "executors": executors,
    "expand_topic_name": name_validation,
    "guard_condition": guard_condition,
    "impl": logging,
    "impl.logging_severity": logging,
    "lifecycle": lifecycle,
    "lifecycle.node": _lifecycle_node,
    "lifecycle.publisher": _lifecycle_entities,
    "lifecycle.managed_entity": _lifecycle_entities,
    "logging": logging,
    "node": node,
    "parameter": parameter,
    "parameter_client": parameter_client,
    "parameter_event_handler": parameter_event_handler,
    "publisher": publisher_subscription_service,
    "qos": qos,
    "qos_event": event_handler,
    "qos_overriding_options": qos_overriding_options,
    "serialization": serialization,
    "service": publisher_subscription_service,
    "signals": init_shutdown,
    "subscription": publisher_subscription_service,
    "task": task,
    "time": time,
    "timer": timer,
    "topic_endpoint_info": topic_endpoint_info,
    "utilities": utilities,
    "validate_full_topic_name": name_validation,
    "validate_namespace": name_validation,
    "validate_node_name": name_validation,
    "validate_parameter_name": name_validation,
    "validate_topic_name": name_validation,
    "wait_for_message": utilities,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    if "." not in _name:
        globals()[_name] = _module
