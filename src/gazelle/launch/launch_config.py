"""What a launch file comes to: parameters, nodes and their order."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

from gazelle.diagnostics import SourceSpan

__all__ = ["ArgDeclaration", "LaunchConfig", "Machine", "NodeTag", "ParamDump", "TestTag"]


@dataclass(frozen=True, slots=True)
class NodeTag:
    """A ``<node>`` after all substitutions.

    Attributes:
        package, type, name: as written.
        namespace: absolute namespace, ends with ``/``.
        args: command line arguments, one string.
        remaps: pairs (from, to) in the order they apply.
        remap_spans: their places, in the same order.
        env: environment added for this node.
        respawn_delay_s: seconds between its death and its next start.
        output: ``screen`` or ``log``.
        cwd: ``ROS_HOME`` or ``node``.
        span: place of the tag.
    """

    package: str
    type: str
    name: str
    namespace: str = "/"
    args: str = ""
    remaps: tuple[tuple[str, str], ...] = ()
    env: tuple[tuple[str, str], ...] = ()
    respawn: bool = False
    respawn_delay_s: float = 0.0
    required: bool = False
    output: Literal["log", "screen"] = "log"
    cwd: Literal["ROS_HOME", "node"] = "ROS_HOME"
    launch_prefix: str = ""
    machine: str = ""
    span: SourceSpan | None = None
    remap_spans: tuple[SourceSpan, ...] = field(default=(), compare=False)

    @property
    def full_name(self) -> str:
        """Absolute name of the node."""
        return self.namespace + self.name


@dataclass(frozen=True, slots=True)
class TestTag:
    """A ``<test>``: a node that ``rostest`` runs; roslaunch only lists it."""

    node: NodeTag
    test_name: str
    time_limit_s: float = 60.0
    retry: int = 0


@dataclass(frozen=True, slots=True)
class Machine:
    """A ``<machine>``; noted, since everything runs here."""

    name: str
    address: str
    default: str = "false"
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class ArgDeclaration:
    """An ``<arg>`` of the top-level file; both `default` and `value` None means required."""

    name: str
    doc: str = ""
    default: str | None = None
    value: str | None = None
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class ParamDump:
    """A ``<rosparam command="dump">``: write a namespace to a file after loading."""

    file: str
    namespace: str


@dataclass(slots=True)
class LaunchConfig:
    """Everything that one or more launch files ask for.

    Attributes:
        files: files read, in the order they were opened.
        params: values by absolute name, in the order first set.
        param_spans: places of the elements that set them, where known.
        yaml_files: file and namespace of each ``<rosparam>`` that loads one, by its place.
        clear_params: namespaces emptied before the parameters are set.
        deleted_params: names deleted before the parameters are set.
        dumps: namespaces to write to files afterwards.
        nodes: nodes in the order of the file.
        args: arguments of the top-level file.
        node_files: the file that defines each node.
        text_files: files whose text went into parameters.
    """

    files: list[str] = field(default_factory=list)
    params: dict[str, Any] = field(default_factory=dict)
    param_spans: dict[str, SourceSpan] = field(default_factory=dict)
    yaml_files: dict[SourceSpan, tuple[str, str]] = field(default_factory=dict)
    clear_params: list[str] = field(default_factory=list)
    deleted_params: list[str] = field(default_factory=list)
    dumps: list[ParamDump] = field(default_factory=list)
    nodes: list[NodeTag] = field(default_factory=list)
    tests: list[TestTag] = field(default_factory=list)
    machines: list[Machine] = field(default_factory=list)
    args: list[ArgDeclaration] = field(default_factory=list)
    node_files: dict[str, str] = field(default_factory=dict)
    text_files: list[str] = field(default_factory=list)
