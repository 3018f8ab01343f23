"""``spawner`` and ``unspawner`` of ROS 2's controller_manager."""

from __future__ import annotations

import threading
from argparse import ArgumentParser, BooleanOptionalAction, Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import is_file
from gazelle.errors import GraphError, LaunchError
from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.controller_manager.client import ManagerClient
from gazelle.nodes.parameters import start_node
from gazelle.ros_arguments import split_arguments

__all__ = [
    "LATE_S",
    "SpawnerParser",
    "manager_teller",
    "run",
    "run_unspawner",
    "spawn",
    "spawner_options",
    "unspawn",
]

LATE_S = 10.0
"""Time after which a manager that is not there is told of."""


class SpawnerParser(ArgumentParser):
    """Reads words; wrong ones end the node with one error."""

    def error(self, message: str) -> NoReturn:
        """Raise what argparse would print."""
        raise LaunchError(f"{self.format_usage()}{self.prog}: error: {message}")


class _FailedError(Exception):
    """The run ends with exit code 1; what went wrong has been said."""


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Load, configure and activate controllers, and end."""
    first = next((word for word in arguments.rest if not word.startswith("-")), "controller")
    if arguments.name in {"spawner", "spawner.py"}:
        arguments = replace(arguments, name=f"spawner_{first.replace('/', '_')}")
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    try:
        return spawn(node, arguments, stop)
    finally:
        node.shutdown()


def run_unspawner(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Deactivate and unload controllers, and end."""
    if arguments.name in {"unspawner", "unspawner.py"}:
        first = next((word for word in arguments.rest if not word.startswith("-")), "controller")
        arguments = replace(arguments, name=f"unspawner_{first.replace('/', '_')}")
    node = start_node(arguments, graph)
    try:
        return unspawn(node, arguments.rest, stop)
    finally:
        node.shutdown()


def spawn(node: Node, arguments: NodeArguments, stop: threading.Event) -> int:
    """Do what ros2_control's spawner does, over a node that is there.

    Raises:
        LaunchError: the arguments are wrong.
    """
    options = spawner_options(arguments.rest)
    # Parameters of the spawner's own node are the controllers', as ros2_control's spawner has it.
    named = [*map(Path, options.param_file), *arguments.parameter_files]
    files = list(dict.fromkeys(named))
    missing = next((str(one) for one in files if not is_file(one)), None)
    if missing is not None:
        raise LaunchError(f"[Errno 2] No such file or directory: '{missing}'")
    spawner = _Spawner(node, options, files, arguments, stop)
    try:
        spawner.run()
    except _FailedError:
        return 1
    except GraphError as error:
        node.log("fatal", str(error))
        return 1
    if options.unload_on_kill:
        node.log("info", "Waiting until interrupt to unload controllers")
        arguments.ready()
        stop.wait()
        spawner.unload()
    return 0


def unspawn(node: Node, argv: Sequence[str], stop: threading.Event) -> int:
    """Do what ros2_control's unspawner does, over a node that is there."""
    parser = SpawnerParser(prog="unspawner")
    parser.add_argument("controller_names", nargs="+")
    parser.add_argument("-c", "--controller-manager", default="controller_manager")
    parser.add_argument("--switch-timeout", type=float, default=5.0)
    options = parser.parse_args(split_arguments(argv).own)
    client = ManagerClient(node, options.controller_manager, stop, ros_version=2)
    late = manager_teller(node, client, "switch_controller")
    if not client.wait("switch_controller", late=late, late_s=LATE_S):
        return 1
    answer = client.switch(
        stop=options.controller_names, asap=True, switch_timeout_s=options.switch_timeout
    )
    # A controller that is not active is unloaded all the same.
    text = "Deactivated controller" if answer.ok else f"Not deactivated: {answer.message}"
    node.log("info" if answer.ok else "warn", text)
    for name in options.controller_names:
        if not client.unload(name):
            node.log("info", f"Failed to unload controller {name}")
            return 1
        node.log("info", f"Unloaded controller {name}")
    return 0


def spawner_options(argv: Sequence[str]) -> Namespace:
    """Read the spawner's arguments; those for ROS itself are left out.

    Raises:
        LaunchError: they are wrong.
    """
    return _spawner_parser().parse_args(split_arguments(argv).own)


def _spawner_parser() -> SpawnerParser:
    parser = SpawnerParser(prog="spawner")
    add = parser.add_argument
    add("controller_names", nargs="+")
    add("-c", "--controller-manager", default="controller_manager")
    add("-p", "--param-file", action="append", default=[])
    add("-n", "--namespace", default="")
    add("-t", "--controller-type", default="")
    add("--load-only", action="store_true")
    add("--inactive", "--stopped", action="store_true")
    add("-u", "--unload-on-kill", action="store_true")
    add("--activate-as-group", action="store_true")
    add("--controller-manager-timeout", type=float, default=0.0)
    add("--switch-timeout", type=float, default=5.0)
    add("--service-call-timeout", type=float, default=10.0)
    add("--switch-asap", action=BooleanOptionalAction, default=False)
    add("--controller-ros-args", action="append", default=[])
    return parser


class _Spawner:
    """One run."""

    def __init__(
        self,
        node: Node,
        options: Namespace,
        files: list[Path],
        arguments: NodeArguments,
        stop: threading.Event,
    ) -> None:
        self._node = node
        self._options = options
        self._files = files
        self._arguments = arguments
        name = options.controller_manager
        if options.namespace and not name.startswith("/"):
            name = f"/{options.namespace.strip('/')}/{name}"
        self._client = ManagerClient(node, name, stop, ros_version=2)

    def run(self) -> None:
        """Load, configure and activate.

        Raises:
            _FailedError: one of them failed.
        """
        options, client = self._options, self._client
        self._wait()
        loaded = {one.name for one in client.controllers()}
        activated: list[str] = []
        for name in options.controller_names:
            self._load(name, loaded)
            if options.load_only:
                continue
            self._check(client.configure(name), f"Failed to configure controller {name}")
            if options.inactive:
                self._say("info", f"Configured {name}")
            elif options.activate_as_group:
                activated.append(name)
            else:
                self._activate([name], f"Failed to activate controller : {name}")
                self._say("info", f"Configured and activated {name}")
        if activated:
            failure = f"Failed to activate the parsed controllers list : {activated}"
            self._activate(activated, failure)
            listed = ", ".join(activated)
            self._say(
                "info", f"Configured and activated all the parsed controllers list : {listed}"
            )

    def unload(self) -> None:
        """Deactivate and unload what was spawned, as ``-u`` asks for."""
        self._say("info", "Interrupt captured! Deactivating and unloading controllers")
        names = self._options.controller_names
        try:
            self._client.switch(stop=names, timeout_s=1.0)
            self._say("info", f"Deactivated controller(s): {', '.join(names)}")
            for name in names:
                self._client.unload(name, timeout_s=1.0)
                self._say("info", f"Unloaded controller {name}")
        except GraphError as error:
            self._say("warn", f"Failed to unload controllers: {error}")

    def _wait(self) -> None:
        service = f"{self._client.name}/list_controllers"
        self._say("info", f"waiting for service {service} to become available...")
        timeout_s = self._options.controller_manager_timeout or None
        late = manager_teller(self._node, self._client, "list_controllers", self._arguments.ready)
        if not self._client.wait("list_controllers", timeout_s, late=late, late_s=LATE_S):
            text = f"Could not contact service {service}; {self._client.other_managers_text()}"
            self._check(False, text, level="fatal")

    def _load(self, name: str, loaded: set[str]) -> None:
        if name in loaded:
            self._say("warn", f"Controller already loaded, skipping load_controller: {name}")
            return
        values = self._parameters(name)
        if values:
            reason = self._client.set_parameters(values)
            self._check(not reason, f"Could not set the parameters of {name}: {reason}")
        self._check(self._client.load(name), f"Failed loading controller {name}", level="fatal")
        self._say("info", f"Loaded {name}")

    def _parameters(self, name: str) -> dict[str, Any]:
        """Return what the manager is to know of a controller before it loads it."""
        values: dict[str, Any] = {}
        argv = [word for text in self._options.controller_ros_args for word in text.split()]
        if argv:
            values[f"{name}.node_options_args"] = argv
        chosen = self._options.controller_type
        if self._files:
            values[f"{name}.params_file"] = [str(one.resolve()) for one in self._files]
            source = FileSource(self._files, self._node.namespace, Diagnostics())
            chosen = chosen or source.controller_type(name) or ""
        if chosen:
            values[f"{name}.type"] = chosen
        return values

    def _activate(self, names: list[str], failure: str) -> None:
        options = self._options
        answer = self._client.switch(
            names, asap=options.switch_asap, switch_timeout_s=options.switch_timeout
        )
        text = getattr(answer, "message", "")
        self._check(answer.ok, f"{failure}: {text}" if text else failure)

    def _check(self, good: bool, text: str, *, level: str = "error") -> None:
        if not good:
            self._say(level, text)
            raise _FailedError

    def _say(self, level: str, text: str) -> None:
        self._node.log(level, text)


def manager_teller(node: Node, client: ManagerClient, service: str, ready: Any = None) -> Any:
    """Return what to do while a manager is not there yet."""

    def tell() -> None:
        text = f"Could not contact service {client.name}/{service}; {client.other_managers_text()}"
        node.log("warn", text)
        if ready is not None:
            # Whoever holds time back for this node must not wait for ever.
            ready()

    return tell
