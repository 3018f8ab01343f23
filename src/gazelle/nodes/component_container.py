"""``rclcpp_components/component_container``: components of C++ and built-in nodes in one process.

A component is a class in a library of C++, which is compiled first where it is source. Where
Gazelle has a node of its own that does a component's work, such as ``robot_state_publisher`` for
``robot_state_publisher::RobotStatePublisher``, that runs instead, in a thread of its own, unless
``GAZELLE_CPP`` asks for the C++.
"""

from __future__ import annotations

import itertools
import json
import os
import threading
import traceback
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cpp.component_libraries import ComponentLibrary, may_register, registered_components
from gazelle.cpp.lookup import prefers_cpp
from gazelle.diagnostics import Diagnostics, render_text
from gazelle.errors import GazelleError
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import value_from_message
from gazelle.interfaces import service_type
from gazelle.node_specs.registry import builtin_executables, executable_of_component, node_spec
from gazelle.node_specs.spec import NodeSpec
from gazelle.nodes.arguments import ABSENT_NODES, NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.workspace import Workspace

if TYPE_CHECKING:
    from gazelle.cpp.component_host import ComponentHost

__all__ = ["builtin_of_component", "run"]

_END_S = 2.0


def builtin_of_component(package: str, plugin: str) -> NodeSpec | None:
    """Return the built-in node that does the work of a component, None when there is none."""
    executable = executable_of_component(package, plugin)
    return node_spec(package, executable) if executable else None


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Offer the services of a container until told to stop."""
    node = start_node(arguments, graph)
    container = _Container(node, graph, arguments.parameter_files, _kind_of(arguments))
    with node.announced_together():
        for name in ("load_node", "unload_node", "list_nodes"):
            argv = "".join(word.capitalize() for word in name.split("_"))
            kind: Any = service_type(f"composition_interfaces/srv/{argv}")
            node.create_service(f"~/_container/{name}", kind, _answering(kind, container, name))
    stop.wait()
    container.end()
    node.shutdown()
    return 0


def _answering(kind: Any, container: _Container, name: str) -> Any:
    handler = getattr(container, name)

    def answer(request: Any) -> Any:
        response = kind.Response()
        handler(request, response)
        return response

    return answer


@dataclass(slots=True)
class _Component:
    """A node that was loaded."""

    full_name: str
    thread: threading.Thread
    stop: threading.Event = field(default_factory=threading.Event)


class _Container:
    def __init__(
        self, node: Node, graph: Graph, parameter_files: Sequence[Path], kind: str
    ) -> None:
        self._node = node
        self._graph = graph
        self._files = parameter_files
        self._kind = kind
        self._lock = threading.Lock()
        self._host: ComponentHost | None = None
        self._compiled: dict[int, str] = {}
        self._numbers = itertools.count(1)
        self._loaded: dict[int, _Component] = {}

    def load_node(self, request: Any, response: Any) -> None:
        """Start the built-in node of a component."""
        package, plugin = request.package_name, request.plugin_name
        builtin = builtin_of_component(package, plugin)
        if builtin is None or prefers_cpp(os.environ):
            self._load_compiled(request, response, builtin)
            if response.success or builtin is None:
                return
        space = request.node_namespace or "/"
        name = request.node_name or builtin.default_name()
        stop = threading.Event()
        target = {
            "node": f"{builtin.package}/{builtin.executable}",
            "argv": [*self._file_words(), *_words(request, name)],
            "namespace": space,
        }
        thread = threading.Thread(target=self._run, args=(target, stop), name=name, daemon=True)
        number = next(self._numbers)
        full = f"{space.rstrip('/')}/{name}"
        self._loaded[number] = _Component(full, thread, stop)
        thread.start()
        self._node.log("info", f"Load Library: none; {target['node']} does the work of {plugin}")
        response.success, response.unique_id, response.full_node_name = True, number, full

    def _load_compiled(self, request: Any, response: Any, builtin: NodeSpec | None) -> None:
        """Make a component of C++; the response says why where there is none."""
        package, plugin = request.package_name, request.plugin_name
        number = next(self._numbers)
        try:
            # One at a time: what compiles uses all cores.
            with self._lock:
                found = self._component(package, plugin)
                if found is None:
                    raise GazelleError(_refusal(package, plugin))
                self._node.log("info", f"Load Library: {found.library}")
                name = self._cpp().load(number, found.library, plugin, request)
                self._compiled[number] = name
        except GazelleError as error:
            response.success, response.error_message = False, str(error)
            if builtin is None:
                self._node.log("error", response.error_message)
                _be_missed(request)
            return
        response.success, response.unique_id, response.full_node_name = True, number, name

    def _component(self, package: str, plugin: str) -> ComponentLibrary | None:
        workspace = Workspace.discover()
        source = workspace.packages.get(package)
        if source is None or not may_register(source):
            return None
        diagnostics = Diagnostics()
        rows = registered_components(source, workspace=workspace, diagnostics=diagnostics)
        if not rows:
            raise GazelleError("\n".join(render_text(one) for one in diagnostics))
        return next((one for one in rows if one.plugin == plugin), None)

    def _cpp(self) -> ComponentHost:
        if self._host is None:
            from gazelle.cpp.component_host import ComponentHost

            self._host = ComponentHost(self._graph, self._kind)
        return self._host

    def unload_node(self, request: Any, response: Any) -> None:
        """End a node."""
        if self._compiled.pop(request.unique_id, None) is not None:
            response.success = self._cpp().unload(request.unique_id)
            return
        found = self._loaded.pop(request.unique_id, None)
        response.success = found is not None
        if found is None:
            response.error_message = f"No node found with unique_id: {request.unique_id}"
            return
        found.stop.set()
        found.thread.join(_END_S)

    def list_nodes(self, _request: Any, response: Any) -> None:
        """Name the nodes that run."""
        running = {key: one.full_name for key, one in self._loaded.items() if one.thread.is_alive()}
        running = dict(sorted({**running, **self._compiled}.items()))
        response.unique_ids = list(running)
        response.full_node_names = list(running.values())

    def end(self) -> None:
        """End all nodes."""
        if self._host is not None:
            self._host.close()
        for one in self._loaded.values():
            one.stop.set()
        for one in self._loaded.values():
            one.thread.join(_END_S)

    def _file_words(self) -> list[str]:
        """Return the container's own files: nodes that components make read them too."""
        argv = [word for file in self._files for word in ("--params-file", str(file))]
        return ["--ros-args", *argv, "--"] if argv else []

    def _run(self, target: dict[str, Any], stop: threading.Event) -> None:
        from gazelle.nodes.host import run_node

        try:
            run_node(target, self._graph, stop)
        except GazelleError as error:
            self._node.log("error", f"[{target['node']}] {error}")
        except Exception:  # noqa: BLE001 - one node's bug must not take the others along
            self._node.log("error", traceback.format_exc())


def _kind_of(arguments: NodeArguments) -> str:
    """Return which executors the container's name asks for: ``mt``, ``isolated`` or none."""
    kind = arguments.executable.rpartition("_")[2]
    return kind if kind in ("mt", "isolated") else ""


def _be_missed(request: Any) -> None:
    """Let lifecycle managers of this process not wait for a node that did not come."""
    own = request.node_name
    if own:
        full = f"{(request.node_namespace or '/').rstrip('/')}/{own}"
        os.environ[ABSENT_NODES] = f"{os.environ.get(ABSENT_NODES, '')} {full}".strip()


def _words(request: Any, name: str) -> list[str]:
    """Return a request as the command line of a node."""
    argv = ["--ros-args", "-r", f"__node:={name}"]
    for rule in request.remap_rules:
        argv += ["-r", rule]
    for one in request.parameters:
        # JSON is YAML, and keeps texts that look like numbers.
        argv += ["-p", f"{one.name}:={json.dumps(value_from_message(one.value))}"]
    return argv


def _refusal(package: str, plugin: str) -> str:
    text = f"Failed to find class with the requested plugin name '{plugin}' in the loaded library"
    types = builtin_executables(package)
    known = f"; built-in nodes of package '{package}': {', '.join(types)}" if types else ""
    return f"{text}: no package of the name registers it{known}"
