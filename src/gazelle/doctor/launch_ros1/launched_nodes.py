"""A launch as it would be started: nodes with their roles, names and parameters."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Any

from gazelle.diagnostics import SourceSpan
from gazelle.doctor.dry_start import Program
from gazelle.doctor.launch_ros1.parameter_places import parameter_places
from gazelle.graph.names import parse_command_line, remap, resolve
from gazelle.graph.parameter_tree import ParameterTree
from gazelle.launch.config import LaunchConfig, NodeTag
from gazelle.launch.executables import Executable
from gazelle.node_specs.spec import NodeRole

__all__ = ["Launched", "LaunchedNode", "Role", "launched_from"]


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
        places: where each parameter is set, in a YAML file where one is loaded.
    """

    config: LaunchConfig
    nodes: tuple[LaunchedNode, ...]
    parameters: ParameterTree = field(default_factory=ParameterTree)
    name: str = ""
    is_whole: bool = True
    places: Mapping[str, SourceSpan] = field(default_factory=dict)

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
    return Launched(config, nodes, parameters, name, is_whole, parameter_places(config))


def _node(spec: NodeTag, executable: Executable | None) -> LaunchedNode:
    try:
        words = shlex.split(spec.args)
    except ValueError:
        words = spec.args.split()
    line = parse_command_line(words)
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
