"""What was read of a launch file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.diagnostics import SourceSpan
from gazelle.doctor.report import Section
from gazelle.doctor.script_topics import TopicEnd

__all__ = [
    "Argument",
    "Command",
    "Include",
    "LaunchFile",
    "LaunchReading",
    "LaunchTopics",
    "LaunchedNode",
    "Parameters",
    "RobotSource",
    "UnknownKeyword",
    "Use",
]


@dataclass(frozen=True, slots=True)
class RobotSource:
    """A robot description that a launch file reads or expands.

    Attributes:
        path: URDF, xacro or SDF file.
        mappings: values given to xacro, those only that are known without running anything.
        span: where the launch file names it.
    """

    path: Path
    mappings: Mapping[str, str] = field(default_factory=dict)
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class LaunchTopics:
    """What is known of the topics of a launch.

    Attributes:
        ends: of nodes whose topics are known.
        others: names that nodes may have of which no more is known.
        is_whole: there is nothing else.
    """

    ends: tuple[TopicEnd, ...] = ()
    others: tuple[str, ...] = ()
    is_whole: bool = True


@dataclass(frozen=True, slots=True)
class LaunchReading:
    """The files a launch names, for further checks, and the tables of the report.

    Attributes:
        robots: descriptions, each once.
        worlds: world files that a simulator is started with.
        parameter_files: YAML files that nodes get.
        launch_files: the file itself and every file it includes, of both generations.
        sections: table ``nodes``.
        topics: what is known of its nodes' topics, None where their namespaces are not known.
        simulates: its simulator has the topics that the robots and worlds name.
    """

    robots: tuple[RobotSource, ...] = ()
    worlds: tuple[Path, ...] = ()
    parameter_files: tuple[Path, ...] = ()
    launch_files: tuple[Path, ...] = ()
    sections: tuple[Section, ...] = ()
    topics: LaunchTopics | None = None
    simulates: bool = False


@dataclass(frozen=True, slots=True)
class Use:
    """A name that stands somewhere: of a package, a launch argument, or a path."""

    name: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Argument:
    """A launch argument that a file declares.

    Attributes:
        default: its value, None when it has none or that is known at run time only.
        is_required: it has no default.
    """

    name: str
    default: str | None
    is_required: bool
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Parameters:
    """Parameters of a node.

    Attributes:
        values: those by name; None for a value that is known at run time only.
        files: paths of parameter files.
        is_complete: nothing else is given to the node.
    """

    values: Mapping[str, str | None] = field(default_factory=dict)
    files: tuple[str, ...] = ()
    is_complete: bool = True


@dataclass(frozen=True, slots=True)
class LaunchedNode:
    """A node; None stands for what is known at run time only.

    Attributes:
        places: where each text that it is given stands, as far as that is not its own place.
        remappings: from and to; None where the names of its topics cannot be told, for they or its
            namespace are known at run time only.
    """

    package: str | None
    executable: str | None
    name: str | None
    namespace: str | None
    parameters: Parameters
    arguments: tuple[str | None, ...]
    span: SourceSpan
    places: Mapping[str, SourceSpan] = field(default_factory=dict)
    remappings: tuple[tuple[str, str], ...] | None = ()

    def place_of(self, text: str) -> SourceSpan:
        """Return where a text stands that the node is given, its own place where nobody knows."""
        return self.places.get(text, self.span)


@dataclass(frozen=True, slots=True)
class Include:
    """Another launch file that is started too.

    Attributes:
        path: None when it is known at run time only.
        arguments: values given, None for those known at run time only.
        spans: where each argument is given.
    """

    path: str | None
    arguments: Mapping[str, str | None]
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Command:
    """Words of a process, or the text of a ``Command`` substitution.

    Attributes:
        text: words with blanks between them, up to the first that is not known.
        is_wrapped: its output is marked as a text (``ParameterValue(…, value_type=str)``).
        is_substitution: a ``Command``, not a process.
    """

    text: str
    span: SourceSpan
    is_substitution: bool = False
    is_wrapped: bool = True


@dataclass(frozen=True, slots=True)
class UnknownKeyword:
    """An argument that an action does not take.

    Attributes:
        action: name of its class.
        name: of the argument.
        span: where it is given.
        hint: what it may have been meant for; may be empty.
    """

    action: str
    name: str
    span: SourceSpan
    hint: str


@dataclass(slots=True)
class LaunchFile:
    """One launch file as read.

    Attributes:
        uses: launch arguments that are read, without those that bring a default along.
        packages: packages whose folders are asked for.
        paths: files of packages that are named.
        opened: files that the file itself opens.
        sets_parameters: parameters of all nodes that follow (``SetParameter``).
        unknown_keywords: arguments that actions do not take.
        computes_uses: it may read launch arguments whose names it computes.
        text: the file.
    """

    path: Path
    arguments: list[Argument] = field(default_factory=list)
    uses: list[Use] = field(default_factory=list)
    packages: list[Use] = field(default_factory=list)
    paths: list[Use] = field(default_factory=list)
    nodes: list[LaunchedNode] = field(default_factory=list)
    includes: list[Include] = field(default_factory=list)
    commands: list[Command] = field(default_factory=list)
    opened: set[str] = field(default_factory=set)
    sets_parameters: set[str] = field(default_factory=set)
    unknown_keywords: list[UnknownKeyword] = field(default_factory=list)
    computes_uses: bool = False
    text: str = ""

    def uses_path(self, path: str) -> bool:
        """Tell whether a path goes to something that is started, and not only into a variable."""
        if path in self.opened or any(item.path == path for item in self.includes):
            return True
        if any(path in command.text for command in self.commands):
            return True
        if any(item.default == path for item in self.arguments):
            return True
        if any(path in item.arguments.values() for item in self.includes):
            return True
        return any(path in node.parameters.files or path in node.arguments for node in self.nodes)
