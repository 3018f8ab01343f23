"""A launch as it would be started: nodes with roles and parameters, and what its simulator gets."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import reduce
from pathlib import Path
from typing import Any

from gazelle.description.xml import read_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan
from gazelle.doctor.dry_start import ControllerStart, Program, StartPlan
from gazelle.documents.yaml import entries, read_yaml_file
from gazelle.errors import LaunchError
from gazelle.graph.names import parse_command_line, remap, resolve
from gazelle.graph.parameter_tree import ParameterTree
from gazelle.launch.launch_config import LaunchConfig, NodeTag
from gazelle.launch.node_commands import Executable
from gazelle.node_specs.spec import NodeRole
from gazelle.nodes.controller_manager.spawner import is_ros2, spawner_parser
from gazelle.nodes.controller_manager.spawner_ros2 import spawner_options

__all__ = [
    "Launched",
    "LaunchedNode",
    "Role",
    "at_argument",
    "controller_start",
    "launched_from",
    "parameter_spans",
    "start_plan",
    "with_parameter_span",
]

_MISSING_WORLD = re.compile(r"world '([^'\n]+)' not found")
_NAME = re.compile(r"'(/[^'\s]+)'")


class Role(Enum):
    """What a node is to the doctor."""

    SIMULATOR = "simulator"
    MODEL_SPAWNER = "spawns a model"
    CONTROLLER_SPAWNER = "starts controllers"
    STATE_PUBLISHER = "joint states to tf"
    JOINT_STATES = "joint states"
    STATIC_TRANSFORM = "static transform"
    RELAY = "passes messages on"
    VIEW = "view"
    BUILTIN = "built in"
    COMMAND = "command"
    SCRIPT = "your script"
    NATIVE = "native executable"
    MISSING = "cannot be started"


# What spawns by the words of ROS 2 is not tried before the run.
_BY_ROLE: dict[NodeRole, Role] = {
    role: Role(role.value) for role in NodeRole if role is not NodeRole.ENTITY_SPAWNER
}
_LOADS = frozenset({"load", "spawn", "sp", "start"})


@dataclass(frozen=True, slots=True)
class LaunchedNode:
    """One node of a launch.

    Attributes:
        spec: as the launch file has it.
        executable: what runs it, None when nothing does.
        role: what it is.
        program: its name, its own words and its remappings.
        file: the user's script, None for anything else.
    """

    spec: NodeTag
    executable: Executable | None
    role: Role
    program: Program
    file: Path | None = None

    @property
    def full_name(self) -> str:
        """Global name of the node."""
        return resolve(self.program.name, self.program.namespace)

    def resolve(self, name: str) -> str:
        """Return the global name that a name of the node's code comes to."""
        return resolve(name, self.program.namespace, node=self.full_name, remappings=self.rules)

    @property
    def rules(self) -> dict[str, str]:
        """Remappings with both sides global."""
        return remap(self.program.remappings, self.program.namespace, node=self.full_name)


@dataclass(frozen=True, slots=True)
class Launched:
    """Everything that a launch starts.

    Attributes:
        config: what the launch files came to.
        nodes: in the order of the file, those included that cannot be started.
        parameters: the parameter store before any node has started.
        name: of the launch, for tables.
        is_whole: its files were read without an error.
        spans: where each parameter is set, in a YAML file where one is loaded.
    """

    config: LaunchConfig
    nodes: tuple[LaunchedNode, ...]
    parameters: ParameterTree = field(default_factory=ParameterTree)
    name: str = ""
    is_whole: bool = True
    spans: Mapping[str, SourceSpan] = field(default_factory=dict)

    def of_role(self, *roles: Role) -> tuple[LaunchedNode, ...]:
        """Return the nodes that have one of the roles."""
        return tuple(node for node in self.nodes if node.role in roles)

    def private(self, node: LaunchedNode, name: str, default: Any) -> Any:
        """Return a private parameter of a node."""
        full = resolve(f"~{name}", node.program.namespace, node=node.full_name)
        return self.parameters.get(full) if self.parameters.has(full) else default

    def description_name(self, node: LaunchedNode) -> str:
        """Return where a node finds ``robot_description``: its remap, then upwards."""
        name = node.resolve("robot_description")
        if self.parameters.has(name):
            return name
        return self.parameters.search("robot_description", node.full_name) or name

    def description(self, node: LaunchedNode) -> str | None:
        """Return the robot description a node finds, None when there is none or an empty one."""
        name = self.description_name(node)
        text = str(self.parameters.get(name)) if self.parameters.has(name) else ""
        return text if text.strip() else None


def parameter_spans(config: LaunchConfig) -> dict[str, SourceSpan]:
    """Return where each parameter is set; the line of the YAML file where one is loaded."""
    spans = dict(config.param_spans)
    for element, (file, target) in config.yaml_files.items():
        for name, span in _lines(file, target):
            if config.param_spans.get(name) == element:
                spans[name] = replace(span, via=(element, *element.via))
    return spans


def with_parameter_span(item: Diagnostic, spans: Mapping[str, SourceSpan]) -> Diagnostic:
    """Return a finding that names a parameter at the place where that is set."""
    if item.span is not None:
        return item
    named = (spans[name] for name in _NAME.findall(item.message) if name in spans)
    return replace(item, span=next(named, None))


def at_argument(item: Diagnostic, files: Sequence[str | Path]) -> Diagnostic:
    """Return a missing world where its name is written, not where a node gets it.

    Args:
        item: a finding.
        files: launch files of the launch, those that are included too.
    """
    missing = _MISSING_WORLD.search(item.message) if item.code == "doctor.world-missing" else None
    if missing is None or item.span is None:
        return item
    name = Path(missing[1]).name
    for file in files:
        root = read_xml(Path(file), Diagnostics())
        for tag in root.walk() if root is not None else ():
            written = [tag.attributes.get(key, "") for key in ("value", "default", "args")]
            if any(name in re.split(r"[\s/]", value) for value in written):
                via = () if tag.span.file == item.span.file else (item.span,)
                return replace(item, span=replace(tag.span, via=via))
    return item


def launched_from(
    config: LaunchConfig,
    executables: Sequence[Executable | None],
    *,
    name: str,
    is_whole: bool = True,
) -> Launched:
    """Return the launch of a configuration.

    Args:
        config: with its nodes.
        executables: what runs each of them, in the same order.
        name: of the launch, for tables.
        is_whole: the files were read without an error.
    """
    nodes = tuple(
        _node(spec, executable) for spec, executable in zip(config.nodes, executables, strict=True)
    )
    parameters = ParameterTree()
    for key, value in config.params.items():
        parameters.set(key, value)
    return Launched(config, nodes, parameters, name, is_whole, parameter_spans(config))


def start_plan(launched: Launched, server: LaunchedNode, diagnostics: Diagnostics) -> StartPlan:
    """Return what a simulator of a launch is brought up with.

    Args:
        launched: the launch.
        server: the simulator among its nodes.
        diagnostics: receives spawners whose arguments are wrong.
    """
    starts = [
        controller_start(node, diagnostics) for node in launched.of_role(Role.CONTROLLER_SPAWNER)
    ]
    return StartPlan(
        server=server.program,
        parameters=dict(launched.config.params),
        text_files=tuple(dict.fromkeys(launched.config.text_files)),
        spawners=tuple(node.program for node in launched.of_role(Role.MODEL_SPAWNER)),
        controllers=tuple(start for start in starts if start is not None),
        started_by=1,
    )


def controller_start(node: LaunchedNode, diagnostics: Diagnostics) -> ControllerStart | None:
    """Return what a spawner of controllers would do; None when its arguments are wrong."""
    assert node.executable is not None and node.executable.builtin is not None
    executable = node.executable.builtin.executable
    try:
        if executable == "controller_manager":
            return _of_command(node)
        if executable == "spawner.py" or is_ros2(node.program.argv):
            return _of_ros2(node)
        return _of_ros1(node)
    except LaunchError as error:
        text = f"'{node.full_name}' ends at once: {error}"
        diagnostics.report("doctor.bad-arguments", text, node.spec.span)
        return None


def _lines(file: str, target: str) -> Iterator[tuple[str, SourceSpan]]:
    # Whoever loaded it has told why it cannot be read.
    root = read_yaml_file(file).root
    for path, key, *_ in entries(root) if root is not None else ():
        yield reduce(lambda above, name: resolve(name, above), path, target or "/"), key.span


def _node(spec: NodeTag, executable: Executable | None) -> LaunchedNode:
    try:
        argv = shlex.split(spec.args)
    except ValueError:
        argv = spec.args.split()
    line = parse_command_line(argv)
    remappings: Mapping[str, str] = {**dict(spec.remaps), **line.remappings}
    program = Program(
        line.name or spec.name,
        (line.namespace or spec.namespace).rstrip("/") or "/",
        tuple(line.rest),
        remappings,
        spec.span,
    )
    role = _role(executable)
    file = executable.script if executable is not None else None
    return LaunchedNode(spec, executable, role, program, file)


def _role(executable: Executable | None) -> Role:
    if executable is None:
        return Role.MISSING
    if executable.builtin is not None:
        return _BY_ROLE.get(executable.builtin.role, Role.BUILTIN)
    if executable.script is not None:
        return Role.SCRIPT
    return Role.COMMAND if executable.folder is None else Role.NATIVE


def _of_ros1(node: LaunchedNode) -> ControllerStart:
    options = spawner_parser().parse_args(list(node.program.argv))
    name = f"{options.namespace.rstrip('/')}/controller_manager".lstrip("/")
    if options.namespace.startswith("/"):
        name = f"/{name}"
    return ControllerStart(
        node.resolve(name), tuple(options.controllers), node.program, starts=not options.stopped
    )


def _of_ros2(node: LaunchedNode) -> ControllerStart:
    options = spawner_options(node.program.argv)
    name = options.controller_manager
    if options.namespace and not name.startswith("/"):
        name = f"/{options.namespace.strip('/')}/{name}"
    return ControllerStart(
        node.resolve(name),
        tuple(options.controller_names),
        node.program,
        options.controller_type,
        tuple(options.param_file),
        not (options.inactive or options.load_only),
    )


def _of_command(node: LaunchedNode) -> ControllerStart | None:
    """``controller_manager spawn NAME``: other commands change nothing before the first step."""
    argv = [word for word in node.program.argv if not word.startswith("-")]
    if not argv or argv[0] not in _LOADS:
        return None
    starts = argv[0] != "load"
    return ControllerStart(
        node.resolve("controller_manager"), tuple(argv[1:]), node.program, starts=starts
    )
