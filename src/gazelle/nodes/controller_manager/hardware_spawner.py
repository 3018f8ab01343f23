"""``controller_manager/hardware_spawner``: configures or activates hardware, and ends."""

from __future__ import annotations

import threading
from argparse import Namespace
from collections.abc import Sequence

from gazelle.control.hardware.lifecycle import HardwareState
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GraphError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.controller_manager.client import ManagerClient
from gazelle.nodes.controller_manager.spawner_ros2 import (
    LATE_S,
    SpawnerParser,
    manager_teller,
)
from gazelle.nodes.parameters import start_node
from gazelle.ros_arguments import split_arguments

__all__ = ["run"]


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Set the states of some components."""
    options = _options(arguments.rest)
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    client = ManagerClient(node, options.controller_manager, stop, ros_version=2)
    late = manager_teller(node, client, "list_hardware_components", arguments.ready)
    timeout_s = options.controller_manager_timeout or None
    try:
        if not client.wait("list_hardware_components", timeout_s, late=late, late_s=LATE_S):
            service = f"{client.name}/list_hardware_components"
            node.log(
                "fatal", f"Could not contact service {service}; {client.other_managers_text()}"
            )
            return 1
        _spawn(node, client, options)
    except GraphError as error:
        node.log("fatal", str(error))
        return 1
    finally:
        node.shutdown()
    return 0


def _options(argv: Sequence[str]) -> Namespace:
    parser = SpawnerParser(prog="hardware_spawner")
    parser.add_argument("hardware_component_names", nargs="+")
    parser.add_argument("-c", "--controller-manager", default="controller_manager")
    parser.add_argument("--controller-manager-timeout", type=float, default=0.0)
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--activate", action="store_true")
    group.add_argument("--configure", action="store_true")
    return parser.parse_args(split_arguments(argv).own)


def _spawn(node: Node, client: ManagerClient, options: Namespace) -> None:
    found = client.call("list_hardware_components", "ListHardwareComponents").component
    names = [one.name for one in found]
    wanted = HardwareState.ACTIVE if options.activate else HardwareState.INACTIVE
    action = "activated" if options.activate else "configured"
    for name in options.hardware_component_names:
        if name not in names:
            hint = did_you_mean(name, names) or f"there are: {', '.join(names) or 'none'}"
            text = f"Hardware Component '{name}' is not loaded - state can not be changed."
            node.log("warn", f"{text} {hint}")
            continue
        state = message_type("lifecycle_msgs/State")(id=int(wanted), label=wanted.label)
        answer = client.call(
            "set_hardware_component_state",
            "SetHardwareComponentState",
            name=name,
            target_state=state,
        )
        if answer.ok:
            text = f"{action} component '{name}'. Hardware now in state: {answer.state}."
            node.log("info", text)
        else:
            node.log("warn", f"Could not {action} component '{name}'. Service call failed.")
