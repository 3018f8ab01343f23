"""Spawners of models and of controllers, run against a world in this process."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from gazelle.control.checks import configured_controllers
from gazelle.control.controller_manager import ControllerManager
from gazelle.control.errors import ControllerError
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.doctor.dry_start.plan import ControllerStart, Manager, Program
from gazelle.errors import GazelleError
from gazelle.graph.gazebo_names import world_names
from gazelle.graph.names import is_hidden, remap, resolve
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.simulator.spawn_model import spawn_model

__all__ = ["Spawning", "managers_of", "start_controllers"]

_BOND_FLAGS = frozenset({"-b", "-bond", "--bond"})


_ASKED_PARAMETER = re.compile(r"the parameter is '/?([^']+)'")


class Spawning:
    """One spawner: its own code runs, over a node that answers at once.

    Attributes:
        unpauses: it has asked for time to go on.
    """

    def __init__(
        self, program: Program, world_node: LocalNode, models: Callable[[], list[str]]
    ) -> None:
        """Prepare a spawner.

        Args:
            program: its node and arguments.
            world_node: the simulator's node, whose services are called.
            models: gives the names of the models in the world.
        """
        self.unpauses = False
        self._program = program
        self._world_node = world_node
        self._models = models
        self._node = _SpawnerNode(program, self)
        self._stop = threading.Event()

    def run(self, diagnostics: Diagnostics) -> str:
        """Spawn; report what goes wrong and return the name of the model that came, if one did."""
        before, errors = self._models(), len(diagnostics.errors)
        argv = [word for word in self._program.argv if word not in _BOND_FLAGS]
        code = spawn_model(argv, self._node, self._stop)
        new = [name for name in self._models() if name not in before]
        if code:
            self._report(diagnostics, is_explained=len(diagnostics.errors) > errors)
        elif not new and self._node.waits_for:
            text = f"'{self._node.full_name}' waits for {self._node.waits_for}"
            diagnostics.report("doctor.spawn-waits", text, self._program.span)
        return new[0] if new else ""

    def call(self, name: str, request: Any) -> Any:
        """Call a service of the simulator."""
        if name.endswith("/unpause_physics"):
            # Time shall not go on: what follows is to see the world before its first step.
            self.unpauses = True
            return None
        return self._world_node.call(self._offered(name), request)

    def offers(self, name: str) -> bool:
        """Tell whether the simulator has a service; who waits for another one is stopped."""
        if self._offered(name) in self._world_node.services:
            return True
        near = did_you_mean(name, (one for one in self._world_node.services if not is_hidden(one)))
        self.give_up(f"service {name}, which nobody offers" + (f"; {near}" if near else ""))
        return False

    def _offered(self, name: str) -> str:
        names = world_names(name)
        return next((one for one in names if one in self._world_node.services), name)

    def give_up(self, reason: str) -> None:
        """End a wait that nothing here can end."""
        self._node.waits_for = reason
        self._stop.set()

    def model_states(self, callback: Callable[[Any], None]) -> None:
        """Tell which models there are, for ``-wait``."""
        names, argv = self._models(), self._program.argv
        callback(SimpleNamespace(name=names))
        wanted = argv[argv.index("-wait") + 1]
        if wanted not in names:
            listed = ", ".join(names) or "none"
            text = f"model '{wanted}', which no spawner before it brings; there are: {listed}"
            self.give_up(text)

    def _report(self, diagnostics: Diagnostics, *, is_explained: bool) -> None:
        said = [text for level, text in self._node.said if level in {"error", "fatal"}]
        status = [text for _, text in self._node.said if text.startswith("Spawn status: ")]
        reason = status[-1].removeprefix("Spawn status: ") if status else "; ".join(said)
        if is_explained:
            reason = "SpawnModel: Failure - its description has errors, which are listed too"
        text = f"'{self._node.full_name}' cannot bring its model into the world: {reason}"
        asked = _ASKED_PARAMETER.search(reason)
        near = asked and did_you_mean(asked[1], self._descriptions())
        diagnostics.report("doctor.spawn-fails", text, self._program.span, fix=near or "")

    def _descriptions(self) -> list[str]:
        """Return the names of parameters that hold a robot."""
        values = self._world_node.parameters
        return [
            name.removeprefix("/")
            for name in values.names()
            if str(values.get(name, "")).lstrip().startswith("<")
        ]


def start_controllers(
    start: ControllerStart,
    managers: Mapping[str, ControllerManager],
    robots: Sequence[Model],
    diagnostics: Diagnostics,
) -> None:
    """Load and start what a spawner names; report what a run would fail at.

    Args:
        start: the spawner's wishes.
        managers: by namespace, absolute.
        robots: that spawners have brought into the world.
        diagnostics: receives the findings.
    """
    namespace = start.manager.rpartition("/")[0] or "/"
    manager = managers.get(namespace)
    if manager is None:
        _report_no_manager(start, managers, robots, diagnostics)
        return
    loaded = [name for name in start.names if _load(name, start, manager, diagnostics)]
    if not start.starts or not loaded:
        return
    # ROS 1 starts all at once, ROS 2 one after the other.
    groups = [loaded] if manager.robot.ros_version == 1 else [[name] for name in loaded]
    for names in groups:
        try:
            manager.switch(start=names)
        except ControllerError as error:
            text = f"'{_full_name(start)}' cannot start {', '.join(names)}: {error}"
            diagnostics.report("doctor.controller-fails", text, start.by.span)


def managers_of(managers: Mapping[str, ControllerManager]) -> tuple[Manager, ...]:
    """Return what is known of every manager and its controllers, loaded or only configured."""
    found = []
    for namespace, manager in managers.items():
        rows = {
            item.name: (item.name, item.type, "", item.joints)
            for item in configured_controllers(manager.source)
        }
        for name, record in manager.controllers.items():
            joints = rows[name][3] if name in rows else ()
            rows[name] = (name, record.type, str(record.state.value), joints)
        found.append(Manager(namespace, manager.robot.ros_version, tuple(rows.values())))
    return tuple(found)


def _load(
    name: str, start: ControllerStart, manager: ControllerManager, diagnostics: Diagnostics
) -> bool:
    for file in start.files:
        manager.source.set("", f"{name}.params_file", [str(Path(file).resolve())])
    type_name = start.type or _type_in(start, name)
    try:
        manager.load(name, type_name or None)
        manager.configure(name)
    except ControllerError as error:
        text = f"'{_full_name(start)}' cannot load controller '{name}': {error}"
        known = [item.name for item in configured_controllers(manager.source)]
        near = "" if name in known else did_you_mean(name, known)
        if name not in known:
            text += f"; {manager.namespace} has parameters of: {', '.join(known) or 'none'}"
        diagnostics.report("doctor.controller-fails", text, start.by.span, fix=near)
        return False
    return True


def _type_in(start: ControllerStart, name: str) -> str:
    if not start.files:
        return ""
    files = [Path(file) for file in start.files]
    return FileSource(files, start.by.namespace, Diagnostics()).controller_type(name) or ""


def _report_no_manager(
    start: ControllerStart,
    managers: Mapping[str, ControllerManager],
    robots: Sequence[Model],
    diagnostics: Diagnostics,
) -> None:
    names = [resolve("controller_manager", namespace) for namespace in managers]
    known = f"there is {', '.join(names)}" if names else "no robot of this launch has one"
    text = f"'{_full_name(start)}' waits for {start.manager}, which nobody runs; {known}"
    if names:
        wanted = (names[0].rpartition("/")[0] or "/").rstrip("/") or "/"
        fix = f'start it with ns="{wanted}", or set <robotNamespace> of the plug-in to match'
        diagnostics.report("doctor.no-controller-manager", text, start.by.span, fix=fix)
        return
    # What has to change is the robot, where it is plain which one.
    robot = robots[0].span if len(robots) == 1 else None
    by = start.by.span
    span = by if robot is None or by is None else replace(robot, via=(by, *by.via))
    namespace = start.manager.rpartition("/")[0]
    inner = f"<robotNamespace>{namespace}</robotNamespace>" if namespace else ""
    plugin = '<plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so"'
    plugin += f">{inner}</plugin>" if inner else "/>"
    fix = f"add <gazebo>{plugin}</gazebo> to the robot, or spawn the robot that has it before"
    diagnostics.report("doctor.no-controller-manager", text, span, fix=fix)


def _full_name(start: ControllerStart) -> str:
    return resolve(start.by.name, start.by.namespace)


class _SpawnerNode:
    """What `spawn_model` needs of a node."""

    def __init__(self, program: Program, spawning: Spawning) -> None:
        self._spawning = spawning
        self.namespace = program.namespace
        self.full_name = resolve(program.name, program.namespace)
        self._rules = remap(program.remappings, program.namespace, node=self.full_name)
        self.said: list[tuple[str, str]] = []
        self.waits_for = ""

    @property
    def parameters(self) -> _SpawnerNode:
        return self

    def get(self, name: str, default: Any = "") -> Any:
        return self._spawning._world_node.parameters.get(self.resolve_name(name), default)

    def resolve_name(self, name: str) -> str:
        return resolve(name, self.namespace, node=self.full_name, remappings=self._rules)

    def log(self, level: str, text: str, *, padded: bool = True) -> None:
        self.said.append((level, text))

    def create_client(self, name: str, _kind: Any) -> _Client:
        return _Client(self._spawning, self.resolve_name(name))

    def create_subscription(
        self, topic: str, _kind: Any, callback: Callable[[Any], None]
    ) -> SimpleNamespace:
        if topic.endswith("/model_states"):
            self._spawning.model_states(callback)
        else:
            self._spawning.give_up(f"a description on topic {self.resolve_name(topic)}")
        return SimpleNamespace(unregister=lambda: None)


class _Client:
    def __init__(self, spawning: Spawning, name: str) -> None:
        self._spawning = spawning
        self._name = name

    def wait_for_service(self, _timeout_s: float) -> bool:
        return self._spawning.offers(self._name)

    def call(self, request: Any) -> Any:
        try:
            return self._spawning.call(self._name, request)
        except KeyError as error:
            raise GazelleError(str(error)) from error
