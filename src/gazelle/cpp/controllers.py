"""Controllers of the PR2 in C++, in the control loop of the simulator."""

from __future__ import annotations

import ctypes
import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.cpp.building.runtime import libraries_for
from gazelle.cpp.host.embedded import EmbeddedHost, EmbeddingWorld, embedded_host
from gazelle.cpp.plugins import PluginClass, declared_plugins, library_file
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.parameters import ParameterTable
from gazelle.workspace import Workspace

__all__ = ["CompiledController", "ControllerHost", "find_compiled_controller"]

_PACKAGE = "pr2_controller_interface"
_BASE = "pr2_controller_interface::Controller"
_SINK = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.POINTER(ctypes.c_uint8), ctypes.c_size_t)
_NOTIFY = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_DOUBLES = ctypes.POINTER(ctypes.c_double)


@dataclass(frozen=True, slots=True)
class ControllerHost:
    """What a controller in C++ needs besides its `ControllerContext`.

    Attributes:
        workspace: where its package is.
        diagnostics: is told what keeps it from being compiled.
        world: the node and the thread that C++ becomes a part of.
        post: has a function called in the thread of the control loop, between two steps.
        now_ns: the time of now.
        description: gives the text of the robot's description, empty where there is none.
    """

    workspace: Workspace
    diagnostics: Diagnostics
    world: EmbeddingWorld
    post: Callable[[Callable[[], None]], None]
    now_ns: Callable[[], int]
    description: Callable[[], str]


def find_compiled_controller(type_name: str, host: ControllerHost) -> type[Controller] | None:
    """Return the controller whose plug-in description has a type's name, None when none has.

    Raises:
        ControllerError: several packages declare it, or a description cannot be read.
    """
    declared = declared_plugins(host.workspace, _PACKAGE, _BASE)
    found = [one for one in declared.classes if type_name in (one.name, one.type)]
    if not found:
        if declared.problems:
            raise ControllerError(f"controller type '{type_name}': {declared.problems[0]}")
        return None
    if len({one.package.name for one in found}) > 1:
        places = ", ".join(f"{one.manifest}:{one.line}" for one in found)
        raise ControllerError(f"controller type '{type_name}' is declared twice: {places}")
    return type(
        found[0].type.rpartition("::")[2],
        (CompiledController,),
        {"PLUGIN": found[0], "HOST": host},
    )


class CompiledController(Controller):
    """Runs an object of a C++ class derived from ``pr2_controller_interface::Controller``.

    It is compiled when it is first loaded. The joints that ``init`` asks for by ``getJointState``
    are claimed by effort; they are read before and written after each of its functions, which see
    commands of zero as on the PR2. Callbacks of its node handle run between two steps.

    Attributes:
        PLUGIN: the class as its package declares it.
        HOST: the simulator.
    """

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        ParameterTable("compiled", "A C++ class of the user's own.", ()),
        interfaces="what init() takes",
    )
    has_table: ClassVar[bool] = False
    PLUGIN: ClassVar[PluginClass]
    HOST: ClassVar[ControllerHost]

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._answer = b""
        self._sink = _SINK(self._take)
        self._notify = _NOTIFY(self._wake)
        self._is_woken = False
        self._object: int | None = None
        self._time_ns = self.HOST.now_ns()
        library = self._library()
        self._runtime = _runtime()
        self._functions = self._runtime.functions
        self._enter()
        for path in libraries_for(library):
            ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
        self._check(self._functions.gazelle_control_start(b"gazebo", self._sink, None), "ros::init")
        create = self._functions.gazelle_control_create
        create.restype = ctypes.c_void_p
        self._object = create(
            str(library).encode(),
            self.PLUGIN.type.encode(),
            self._notify,
            None,
            self._sink,
            None,
        )
        if self._object is None:
            raise ControllerError(self._failure("its constructor"))
        asked = self._init()
        values = self.robot.interface_values
        self.commands = tuple(
            f"{name}/effort" for name in asked if f"{name}/effort" in values.command_index
        )
        lacking = [name for name in asked if f"{name}/effort" not in values.command_index]
        if lacking:
            self.close()
            raise ControllerError(
                f"controller '{context.name}' takes joint '{lacking[0]}', which cannot be driven "
                "by effort; PR2's controllers know nothing else"
            )
        self.states = tuple(
            f"{name}/{interface}"
            for name in asked
            for interface in ("position", "velocity")
            if f"{name}/{interface}" in values.state_index
        )

    def start(self, time_ns: int) -> None:
        """Call ``starting``."""
        self._run("starting", time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Call ``update``."""
        self._run("update", time_ns, ctypes.c_int64(period_ns))

    def stop(self, time_ns: int) -> None:
        """Call ``stopping``."""
        self._run("stopping", time_ns)

    def close(self) -> None:
        """Destroy the object; its library stays loaded."""
        made, self._object = self._object, None
        if made is not None:
            destroy = self._functions.gazelle_control_destroy
            self._check(destroy(ctypes.c_void_p(made), self._sink, None), "its destructor")

    def _library(self) -> Path:
        plugin, host = self.PLUGIN, self.HOST
        found = library_file(
            plugin.package,
            plugin.library,
            workspace=host.workspace,
            diagnostics=host.diagnostics,
            span=plugin.span,
        )
        if found is None:
            raise ControllerError(
                f"controller '{self.context.name}': library '{plugin.library}' of package "
                f"'{plugin.package.name}' ({plugin.manifest}:{plugin.line}) could not be compiled, "
                "see above"
            )
        return found

    def _init(self) -> list[str]:
        """Call ``init`` and return the names of the joints that it asked for."""
        values, context = self.robot.interface_values, self.context
        joints: list[dict[str, Any]] = []
        for name in self.robot.joints:
            row: dict[str, Any] = {"name": name, "actuator": f"{name}_motor"}
            for interface in ("position", "velocity", "effort"):
                key = f"{name}/{interface}"
                if key in values.state_index:
                    row[interface] = int(values.state_indices([key])[0])
            row["command"] = values.command_index.get(f"{name}/effort", -1)
            joints.append(row)
        namespace = "/" + "/".join(filter(None, (context.namespace, context.name)))
        setup = {
            "namespace": namespace,
            "description": self.HOST.description(),
            "joints": joints,
        }
        self._enter()
        status = self._functions.gazelle_control_init(
            ctypes.c_void_p(self._object),
            json.dumps(setup).encode(),
            values.states.ctypes.data_as(_DOUBLES),
            values.commands.ctypes.data_as(_DOUBLES),
            ctypes.c_int64(self._time_ns),
            self._sink,
            None,
        )
        if status:
            reason = self._failure("init()")
            self.close()
            raise ControllerError(reason)
        found: list[str] = json.loads(self._answer)
        return found

    def _run(self, name: str, time_ns: int, *more: Any) -> None:
        if self._object is None:
            return
        self._time_ns = time_ns
        self._enter()
        self._spin()
        function = getattr(self._functions, f"gazelle_control_{name}")
        arguments = (ctypes.c_void_p(self._object), ctypes.c_int64(time_ns), *more)
        self._check(function(*arguments, self._sink, None), f"{name}()")

    def _enter(self) -> None:
        self._runtime.host.enter(self.HOST.world, self._time_ns)

    def _spin(self) -> None:
        """Call what waits in the controller's queue."""
        self._is_woken = False
        if self._object is not None:
            spin = self._functions.gazelle_control_spin
            self._check(spin(ctypes.c_void_p(self._object), self._sink, None), "a callback")

    def _wake(self, _context: Any) -> None:
        # Runs in whatever thread brings a message or a request.
        if not self._is_woken:
            self._is_woken = True
            self.HOST.post(self._spin)

    def _take(self, _context: Any, data: Any, size: int) -> None:
        self._answer = ctypes.string_at(data, size) if size else b""

    def _check(self, status: int, place: str) -> None:
        if status:
            raise ControllerError(self._failure(place))

    def _failure(self, place: str) -> str:
        reason = self._answer.decode("utf-8", "replace")
        self._answer = b""
        if not reason and place == "init()":
            text = f"Initializing controller '{self.context.name}' failed: init() of class "
            return f"{text}'{self.PLUGIN.type}' returned false"
        return f"{place} of controller class '{self.PLUGIN.type}' failed: {reason}"


class _Runtime(NamedTuple):
    host: EmbeddedHost
    functions: ctypes.CDLL


@cache
def _runtime() -> _Runtime:
    """Return the runtime with controllers in it, loaded for good.

    Raises:
        ControllerError: it cannot be compiled.
    """
    try:
        host = embedded_host("control")
    except GazelleError as error:
        raise ControllerError(f"controllers of C++ cannot be run here: {error}") from error
    for name, path in host.libraries.items():
        loaded = ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
        if name == "control":
            functions = loaded
    sink = _SINK(lambda _context, data, size: said.append(ctypes.string_at(data, size)))
    said: list[bytes] = []

    def spin() -> None:
        if functions.gazelle_control_spin_all(sink, None):
            raise ControllerError(said.pop().decode("utf-8", "replace"))

    host.spin = spin
    return _Runtime(host, functions)
