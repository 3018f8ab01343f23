"""rclpy, on Gazelle's graph."""

import sys as _sys

from gazelle.compat.rclpy import *  # noqa: F403
from gazelle.compat.rclpy import (
    action,
    callback_groups,
    client_library,
    clock,
    context,
    duration,
    endpoints,
    exceptions,
    executors,
    lifecycle,
    logging,
    node,
    parameter,
    qos,
    task,
    time,
    timer,
    utilities,
)
from gazelle.compat.rclpy.action import client as _action_client
from gazelle.compat.rclpy.action import server as _action_server
from gazelle.compat.rclpy.lifecycle import node as _lifecycle_node

for _name, _module in {
    "action": action,
    "action.client": _action_client,
    "action.server": _action_server,
    "callback_groups": callback_groups,
    "client": endpoints,
    "clock": clock,
    "clock_type": time,
    "constants": duration,
    "context": context,
    "duration": duration,
    "exceptions": exceptions,
    "executors": executors,
    "lifecycle": lifecycle,
    "lifecycle.node": _lifecycle_node,
    "logging": logging,
    "node": node,
    "parameter": parameter,
    "publisher": endpoints,
    "qos": qos,
    "service": endpoints,
    "signals": client_library,
    "subscription": endpoints,
    "task": task,
    "time": time,
    "timer": timer,
    "utilities": utilities,
    "wait_for_message": utilities,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    if "." not in _name:
        globals()[_name] = _module
