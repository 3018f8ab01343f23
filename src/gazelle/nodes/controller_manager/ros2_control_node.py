"""``controller_manager/ros2_control_node``: controllers without a simulation, on mock hardware.

MoveIt's demo launch files start it. Of hardware it has ``mock_components/GenericSystem``; drivers
of real robots are compiled code, whose place it takes where ``GAZELLE_MOCK_HARDWARE`` is 1, and
Gazebo's systems live in a world.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.hardware.gazebo_system import SystemOptions
from gazelle.control.hardware.lifecycle import HardwareState, initial_states
from gazelle.control.hardware.ros2_robot import MOCK_VARIABLE, build_ros2_robot
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.control.resource_manager import Robot
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, Severity, did_you_mean, render
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.link_tree import DESCRIPTION, read_description
from gazelle.nodes.parameters import number_or_end, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.simulator.command_queue import CommandQueue, telling
from gazelle.simulator.controller_node import make_ports, offer_manager
from gazelle.simulator.input_validation import Inputs
from gazelle.simulator.plugins.context import Resources
from gazelle.simulator.world_controller_managers import ControlRegistry
from gazelle.workspace import Workspace

__all__ = ["PARAMETERS", "run"]

_ALLOW_INACTIVE = "defaults.allow_controller_activation_with_inactive_hardware"
_NAMED = "read for the controller before those of the node's own files"

PARAMETERS = ParameterTable(
    "ros2_control_node",
    "Runs controllers on mock hardware, without a simulation. Parameters of the"
    " [controllers](controllers.md) are in the same files, below their own names.",
    ("controller_manager/ros2_control_node",),
    (
        Parameter(
            "update_rate", "number", 100.0, "how often controllers run; none ends the node", "Hz"
        ),
        Parameter(
            "robot_description",
            "text",
            None,
            "the robot; else the topics `robot_description` and `~/robot_description`",
        ),
        Parameter(
            "hardware_components_initial_state.unconfigured",
            "texts",
            (),
            "components that are only loaded",
        ),
        Parameter(
            "hardware_components_initial_state.inactive",
            "texts",
            (),
            "components that are read, not written",
        ),
        Parameter(
            "configure_components_on_start",
            "texts",
            None,
            "components that are read, not written, as in Humble",
        ),
        Parameter(
            "activate_components_on_start",
            "texts",
            None,
            "components that are active, others are only loaded, as in Humble",
        ),
        Parameter(
            _ALLOW_INACTIVE, "flag", False, "controllers claim commands of inactive hardware"
        ),
        Parameter("<controller>.type", "text", None, "class of a controller"),
        Parameter("<controller>.params_file", "texts", (), f"files that are {_NAMED}"),
        Parameter("<controller>.node_options_args", "texts", (), f"`--ros-args` that are {_NAMED}"),
        *refused(
            "a controller that fails is stopped, no other takes its place",
            "<controller>.fallback_controllers",
        ),
        *refused("a controller that fails is stopped, others go on", "handle_exceptions"),
        *refused("`<limits enable>` of the description says it", "enforce_command_limits"),
        *refused(
            "the loop has no priority of its own", "cpu_affinity", "lock_memory", "thread_priority"
        ),
        *refused("updates that are late are left out", "overruns"),
        *refused("times of the loop are not published", "diagnostics"),
        *refused(
            "mock hardware does not fail",
            "defaults.deactivate_controllers_on_hardware_self_deactivate",
            "hardware_components_initial_state.shutdown_on_initial_state_failure",
        ),
        *refused("a switch happens at once, as it was asked for", "defaults.switch_controller"),
    ),
)

_LOOK_S = 0.1


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run a controller manager until told to stop."""
    # The manager offers them, and takes what spawners tell of controllers.
    node = start_node(arguments, graph, offers_parameters=False)
    try:
        text = _description(node, stop)
        if text is None:
            return 0
        return _control(node, arguments, read_description(text), stop)
    except LaunchError as error:
        node.log("fatal", str(error))
        return 1
    finally:
        node.shutdown()


def _description(node: Node, stop: threading.Event) -> str | None:
    """Return the robot's text; None when told to stop before it came."""
    name = node.resolve_name(f"~{DESCRIPTION}")
    if node.parameters.has(name):
        return str(node.parameters.get(name))
    node.log("info", "Waiting for data on 'robot_description' topic to finish initialization")
    found: list[str] = []
    came = threading.Event()

    def take(message: Any) -> None:
        found.append(str(message.data))
        came.set()

    kind = message_type("std_msgs/msg/String")
    topics = (DESCRIPTION, f"~{DESCRIPTION}")
    listening = [node.create_subscription(topic, kind, take) for topic in topics]
    while not stop.is_set() and not came.wait(_LOOK_S):
        continue
    for one in listening:
        one.unregister()
    return found[0] if found else None


@dataclass(slots=True)
class _Clock:
    """What stands for the physics: time that goes by."""

    node: Node
    step_ns: int = 1_000_000

    @property
    def time_ns(self) -> int:
        """The node's time."""
        return self.node.clock.now_ns()


@dataclass(slots=True)
class _Host:
    """What controllers' ports need of a world, without one."""

    engine: Any
    node: Node
    diagnostics: Diagnostics
    workspace: Workspace
    commands: CommandQueue
    inputs: Inputs = field(default_factory=Inputs)
    controls: ControlRegistry = field(default_factory=ControlRegistry)
    lockstep: bool = False

    @property
    def time_ns(self) -> int:
        """The node's time."""
        return int(self.engine.time_ns)


def _control(node: Node, arguments: NodeArguments, model: Model, stop: threading.Event) -> int:
    commands = CommandQueue(telling(node.log))
    host: Any = _Host(_Clock(node), node, Diagnostics(), Workspace.discover(), commands)
    name = node.name.rpartition("/")[2]
    with private_parameters(node, arguments, PARAMETERS) as own:
        rate_hz = number_or_end(own, "update_rate")
        takes_inactive = own.flag(_ALLOW_INACTIVE)
    if not rate_hz > 0:
        raise LaunchError(f"parameter 'update_rate' is {rate_hz:g} Hz; it must be more than 0")
    given = {key.replace("/", "."): value for key, value in arguments.params.items()}
    source = FileSource(
        arguments.parameter_files,
        node.namespace,
        host.diagnostics,
        manager=name,
        overrides={name: given},
    )
    mocks = os.environ.get(MOCK_VARIABLE, "").strip().lower() not in ("", "0", "false")
    options = SystemOptions(False, True, 0.0, rate_hz, has_world=False, mocks_compiled=mocks)
    robot = build_ros2_robot(host, model, options)
    manager = ControllerManager(
        robot,
        namespace=node.namespace,
        make_ports=lambda one: make_ports(
            host, Resources(host), node.namespace, one, 2, source.remappings(one)
        ),
        source=source,
        diagnostics=host.diagnostics,
        update_rate_hz=rate_hz,
        workspace=host.workspace,
        clock=node.clock.now_ns,
    )
    resources = Resources(host)
    robot.lifecycle.takes_inactive = takes_inactive
    _set_initial_states(node, robot, source.manager_tree())
    offer_manager(manager, host, resources, name=name)
    render([one for one in host.diagnostics if one.severity >= Severity.WARNING])
    node.log("info", f"update rate is {rate_hz:g} Hz")
    _loop(manager, host, 1.0 / rate_hz, stop)
    resources.close()
    return 0


def _set_initial_states(node: Node, robot: Robot, tree: Mapping[str, Any]) -> None:
    """Bring the components into the states that the manager's parameters name."""
    for name, state in initial_states(tree, [one.name for one in robot.components]):
        if state is None and name in robot.absent.values():
            # Its class is not here, which is an error of its own.
            continue
        if state is None:
            hint = did_you_mean(name, [one.name for one in robot.components])
            text = f"Hardware component '{name}' is unknown, therefore its state is not set."
            node.log("warn", f"{text} {hint}".rstrip())
            continue
        robot.lifecycle.set(name, state)
        if state is not HardwareState.ACTIVE:
            node.log("info", f"Setting component '{name}' to '{state.label}' state.")


def _loop(manager: ControllerManager, host: Any, period_s: float, stop: threading.Event) -> None:
    """Update the manager at its rate; requests are done between two updates."""
    commands: CommandQueue = host.commands
    last_ns = host.engine.time_ns
    due_s = time.monotonic()
    commands.own()
    try:
        while not stop.is_set():
            left_s = due_s - time.monotonic()
            if left_s > 0 and commands.wait(min(left_s, _LOOK_S)):
                commands.clear_wake()
                commands.apply()
                continue
            if left_s > 0:
                continue
            commands.apply()
            now_ns = host.engine.time_ns
            if now_ns != last_ns:
                manager.update(now_ns, max(0, now_ns - last_ns))
            last_ns = now_ns
            due_s = max(due_s + period_s, time.monotonic())
    finally:
        commands.disown()
