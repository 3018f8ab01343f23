"""All checks of a ROS 2 launch file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.launch_ros2.argument_checks import check_arguments
from gazelle.doctor.launch_ros2.launch_file import LaunchReading
from gazelle.doctor.launch_ros2.launch_tree import Followed, follow, located
from gazelle.doctor.launch_ros2.node_checks import (
    check_clocks,
    check_executables,
    check_node_keywords,
    check_programs,
    check_spawners,
    starts_simulator,
)
from gazelle.doctor.launch_ros2.parameter_checks import check_node_parameters
from gazelle.doctor.launch_ros2.reference_checks import (
    check_commands,
    check_packages,
    check_paths,
    paths_of,
    robots_of,
)
from gazelle.doctor.launch_ros2.topics import (
    has_one_namespace,
    may_be_simulated,
    topics_of_launch,
)
from gazelle.doctor.report import Section
from gazelle.documents.files import is_file
from gazelle.workspace import Workspace

__all__ = ["check_launch"]

_COLUMNS = ("node", "package", "executable", "parameters", "started by")
_WORLDS = (".world", ".sdf")
_UNKNOWN = "?"
_SHOWN = 4


def check_launch(
    path: Path,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    arguments: Mapping[str, str] | None = None,
) -> LaunchReading:
    """Read a Python, XML or YAML launch file of ROS 2 without running it, and check what it names.

    Args:
        path: the launch file.
        workspace: finds packages and their files.
        diagnostics: receives the findings.
        arguments: launch arguments by name.

    Returns:
        The files that the launch names, for the checks of robots, worlds and parameters.
    """
    path = path.absolute()
    root = follow(path, arguments or {}, workspace=workspace, diagnostics=diagnostics)
    if root is None:
        return LaunchReading(launch_files=(path,))
    files = root.walk()
    _say_static(files, diagnostics)
    check_packages(files, workspace, diagnostics)
    check_paths(files, workspace, diagnostics)
    check_arguments(root, arguments or {}, diagnostics)
    check_node_keywords(files, diagnostics)
    check_programs(files, diagnostics)
    check_executables(files, workspace, diagnostics)
    parameter_files = _named(files, (".yaml", ".yml"))
    check_spawners(files, parameter_files, workspace, diagnostics)
    check_clocks(files, diagnostics)
    check_node_parameters(files, workspace, diagnostics)
    check_commands(files, workspace, diagnostics)
    return LaunchReading(
        robots=tuple(robots_of(files)),
        worlds=_named(files, _WORLDS),
        parameter_files=parameter_files,
        launch_files=tuple(dict.fromkeys(item.file.path for item in files)),
        sections=_sections(files, path),
        topics=topics_of_launch(files, workspace) if has_one_namespace(files) else None,
        simulates=starts_simulator(files) and may_be_simulated(files),
    )


def _say_static(files: Sequence[Followed], diagnostics: Diagnostics) -> None:
    nodes = [node for item in files for node in item.file.nodes]
    unknown = sum(
        node.package is None or node.executable is None or not node.parameters.is_complete
        for node in nodes
    )
    includes = sum(not item.has_all for item in files)
    text = "the launch file was read, not run: what its Python computes from the outside, and "
    text += "conditions, are not known"
    if unknown or includes:
        text += f" (of {len(nodes)} node(s) {unknown} in part; includes that were not followed in "
        text += f"{includes} file(s))"
    diagnostics.report("launch_ros2.static", text, SourceSpan(str(files[0].file.path)))


def _named(files: Sequence[Followed], endings: tuple[str, ...]) -> tuple[Path, ...]:
    names = (use.name for use in paths_of(files) if use.name.endswith(endings))
    found = dict.fromkeys(located(name) for name in names)
    return tuple(path for path in found if path and is_file(path) and not _is_launch(path))


def _is_launch(path: Path) -> bool:
    return path.stem.endswith((".launch", "_launch"))


def _sections(files: Sequence[Followed], path: Path) -> tuple[Section, ...]:
    rows = tuple(
        (
            node.name or _UNKNOWN if node.name is not None else node.executable or _UNKNOWN,
            node.package or _UNKNOWN,
            node.executable or _UNKNOWN,
            _listed([*node.parameters.values, *(Path(p).name for p in node.parameters.files)]),
            f"{item.file.path.name}:{node.span.line}",
        )
        for item in files
        for node in item.file.nodes
    )
    title = f"nodes of {path.name}"
    return (Section("nodes", title, _COLUMNS, rows),) if rows else ()


def _listed(names: Sequence[str]) -> str:
    rest = len(names) - _SHOWN
    return ", ".join(names[:_SHOWN]) + (f" and {rest} more" if rest > 0 else "")
