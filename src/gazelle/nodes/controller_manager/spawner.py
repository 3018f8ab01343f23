"""``controller_manager/spawner`` and ``unspawner`` of ROS 1; ROS 2's words go to its own."""

from __future__ import annotations

import threading
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NoReturn

from gazelle.documents.files import is_file
from gazelle.documents.yaml import YamlError, load_yaml_file
from gazelle.errors import GraphError, LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.names import anonymous_name
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.controller_manager.client import BEST_EFFORT, STRICT, ManagerClient
from gazelle.nodes.parameters import start_node

__all__ = ["controllers_in_file", "is_ros2", "run", "run_unspawner", "spawner_parser"]

_ROS2_WORDS = frozenset(
    {
        "-c",
        "--controller-manager",
        "-p",
        "--param-file",
        "-n",
        "--load-only",
        "--inactive",
        "-t",
        "--controller-type",
        "-u",
        "--unload-on-kill",
        "--activate-as-group",
        "--switch-timeout",
        "--controller-manager-timeout",
        "--service-call-timeout",
        "--switch-asap",
        "--controller-ros-args",
        "--ros-args",
    }
)
_SHUTDOWN_CALL_S = 1.0
_HEAR_S = 30.0
_LOOK_S = 3.0
_PATIENCE_S = 2.0
_QUIET_TIMES = 3


class _Parser(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise LaunchError(f"{self.format_usage()}{self.prog}: error: {message}")


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Load and start controllers; ROS 1's stays and unloads them at the end.

    The generation is told from the launch or command behind it, from the arguments, or from what
    the manager offers.
    """
    if arguments.ros_version == 2 or is_ros2(arguments.rest):
        from gazelle.nodes.controller_manager.spawner_ros2 import run as run_ros2

        return run_ros2(arguments, graph, stop)
    options = spawner_parser().parse_args(list(arguments.rest))
    node = _start(arguments, graph, stop, "spawner")
    try:
        return _Spawner(node, options, arguments, stop).run()
    finally:
        node.shutdown()


def run_unspawner(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """ROS 1: stop controllers until told to stop, then start them again; ROS 2: unload them."""
    from gazelle.nodes.controller_manager.spawner_ros2 import unspawn

    node = _start(arguments, graph, stop, "unspawner")
    try:
        client = ManagerClient(node, "controller_manager", stop)
        if arguments.ros_version == 2 or is_ros2(arguments.rest):
            return unspawn(node, arguments.rest, stop)
        if not arguments.rest:
            raise LaunchError("usage: unspawner controller [controller ...]")
        if not client.wait("switch_controller"):
            return 0
        if client.ros_version == 2:
            return unspawn(node, arguments.rest, stop)
        return _inhibit(node, client, set(arguments.rest), stop)
    finally:
        node.shutdown()


def is_ros2(argv: Sequence[str]) -> bool:
    """Tell whether these are the arguments of ROS 2's spawner."""
    return any(word.partition("=")[0] in _ROS2_WORDS for word in argv if word.startswith("-"))


def _start(arguments: NodeArguments, graph: Graph, stop: threading.Event, default: str) -> Node:
    """Start the node, under a name of its own when nobody named it; its end ends the run."""
    if arguments.name == default:
        arguments = replace(arguments, name=anonymous_name(default))
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    return node


def spawner_parser() -> ArgumentParser:
    """Return the parser of ROS 1's arguments; it raises `LaunchError` for wrong ones."""
    parser = _Parser(prog="spawner", description="Controller spawner")
    add = parser.add_argument
    add("controllers", nargs="+", metavar="controller")
    add("--stopped", action="store_true")
    add("--wait-for", metavar="topic", default="")
    add("--namespace", metavar="ns", default="")
    add("--timeout", metavar="T", type=float, default=30.0)
    add("--no-timeout", action="store_true")
    add("--shutdown-timeout")
    return parser


def controllers_in_file(path: str) -> dict[str, Any]:
    """Return the parameters in a file by the controllers' names.

    Raises:
        LaunchError: it cannot be read, or holds no names with parameters.
    """
    try:
        found = load_yaml_file(path)
    except YamlError as error:
        raise LaunchError(f"cannot read controllers from '{path}': {error}") from error
    if found is not None and not isinstance(found, dict):
        kind = type(found).__name__
        text = f"cannot read controllers from '{path}': it holds a {kind}, not names with values"
        raise LaunchError(text)
    return {str(name): values for name, values in (found or {}).items()}


class _Spawner:
    """One run of ROS 1's spawner."""

    def __init__(
        self,
        node: Node,
        options: Namespace,
        arguments: NodeArguments,
        stop: threading.Event,
    ) -> None:
        self._node = node
        self._options = options
        self._arguments = arguments
        self._stop = stop
        self._manager = "/".join(
            filter(None, (options.namespace.rstrip("/"), "controller_manager"))
        )
        self._client = ManagerClient(node, self._manager, stop)
        self._loaded: list[str] = []
        self._late = 0

    def run(self) -> int:
        if self._options.shutdown_timeout is not None:
            self._say("warn", "DEPRECATION warning: --shutdown-timeout has no effect.")
        if not self._find_services():
            return 0
        if self._client.ros_version == 2:
            from gazelle.nodes.controller_manager.spawner_ros2 import spawn

            return spawn(self._node, self._arguments, self._stop)
        if self._options.wait_for and not self._wait_for_topic(self._options.wait_for):
            return 0
        try:
            self._spawn(self._controllers())
        except GraphError as error:
            self._say("error", f"Controller Spawner: {error}")
            return 1
        self._arguments.ready()
        self._stop.wait()
        self._take_down()
        return 0

    def _find_services(self) -> bool:
        options = self._options
        timeout_s = None if options.no_timeout or options.timeout <= 0 else options.timeout
        for service in ("load_controller", "switch_controller", "unload_controller"):
            name = f"{self._manager}/{service}"
            self._say("info", f"Controller Spawner: Waiting for service {name}")
            found = self._client.wait(service, timeout_s, late=self._say_late, late_s=_PATIENCE_S)
            if not found:
                if not self._stop.is_set():
                    text = "Controller Spawner couldn't find the expected controller_manager ROS "
                    text += f"interface ({self._client.name}/{service}); "
                    self._say("warn", text + self._client.other_managers_text())
                return False
        return True

    def _say_late(self) -> None:
        # Whoever holds time back for this node must not wait for ever.
        self._arguments.ready()
        self._late += 1
        if self._late % _QUIET_TIMES != 0:
            return
        clock = self._node.clock
        if clock.use_sim_time and clock.now_ns() == 0:
            self._say("info", "Waiting for /clock to be available...")
        text = f"{self._client.name} is not there yet; {self._client.other_managers_text()}"
        self._node.log("warn" if clock.now_ns() else "info", f"Controller Spawner: {text}")

    def _wait_for_topic(self, topic: str) -> bool:
        """Wait until a topic says True; False when told to stop before."""
        self._arguments.ready()
        said = threading.Event()
        heard = threading.Event()

        def take(message: object) -> None:
            heard.set()
            if getattr(message, "data", False):
                said.set()

        kind = message_type("std_msgs/Bool")
        subscription = self._node.create_subscription(topic, kind, take)
        clock = self._node.clock
        start_ns, told = clock.now_ns(), False
        while not said.wait(0.05) and not self._stop.is_set():
            if not told and not heard.is_set() and clock.now_ns() - start_ns > _HEAR_S * 1e9:
                told = True
                text = 'Controller Spawner hasn\'t heard anything from its "wait for" topic '
                self._say("warn", f"{text}({topic})")
        subscription.unregister()
        return said.is_set()

    def _controllers(self) -> list[str]:
        """Return names; a file's parameters are set, and its controllers are meant."""
        names: list[str] = []
        for word in self._options.controllers:
            if not is_file(Path(word)):
                names.append(word)
                continue
            for name, values in controllers_in_file(word).items():
                self._node.parameters.set(self._node.resolve_name(name), values)
                names.append(name)
        return names

    def _spawn(self, names: list[str]) -> None:
        for name in names:
            self._say("info", f"Loading controller: {name}")
            if self._client.load(name):
                self._loaded.append(name)
            else:
                self._say("error", f"Failed to load {name}")
        listed = ", ".join(self._loaded)
        self._say("info", f"Controller Spawner: Loaded controllers: {listed}")
        if self._options.stopped or self._stop.is_set():
            return
        if self._client.switch(start=self._loaded).ok:
            self._say("info", f"Started controllers: {listed}")
        else:
            self._say("error", f"Failed to start controllers: {listed}")

    def _take_down(self) -> None:
        """Stop and unload what was loaded; at the end of a launch the simulator may be faster."""
        self._say("info", "Shutting down spawner. Stopping and unloading controllers...")
        graph = self._node.graph
        try:
            # After `rosnode kill` the node itself cannot call any more.
            caller = graph.create_node("spawner", anonymous=True, rosout=False)
            self._unload(ManagerClient(caller, self._client.name))
            caller.shutdown()
        except GraphError as error:
            if not graph.has_service(f"{self._client.name}/switch_controller"):
                self._say("info", "the controller manager has ended, and its controllers with it")
                return
            text = "Controller Spawner error while taking down controllers"
            self._say("warn", f"{text}: {error}")

    def _unload(self, client: ManagerClient) -> None:
        limit = _SHUTDOWN_CALL_S
        self._say("info", "Stopping all controllers...")
        running = {one.name for one in client.controllers() if one.state == "running"}
        stopping = [name for name in self._loaded if name in running]
        client.switch(stop=stopping, strictness=STRICT, timeout_s=limit)
        self._say("info", "Unloading all loaded controllers...")
        for name in reversed(self._loaded):
            self._say("info", f"Trying to unload {name}")
            client.unload(name, timeout_s=limit)
            self._say("info", f"Succeeded in unloading {name}")

    def _say(self, level: str, text: str) -> None:
        self._node.log(level, text, padded=False)


def _inhibit(node: Node, client: ManagerClient, names: set[str], stop: threading.Event) -> int:
    """Keep controllers stopped, as ROS 1's unspawner does, and start them again at the end."""
    inhibited: set[str] = set()

    def stop_them() -> None:
        running = [one.name for one in client.controllers() if one.state == "running"]
        found = [name for name in running if name in names]
        if found:
            node.log("info", f"Inhibiting controllers: {', '.join(found)}", padded=False)
            client.switch(stop=found, strictness=BEST_EFFORT)
            inhibited.update(found)

    stop_them()
    while not stop.wait(_LOOK_S):
        stop_them()
    client.switch(start=sorted(inhibited), strictness=BEST_EFFORT, timeout_s=_SHUTDOWN_CALL_S)
    return 0
