"""Parameters of nodes of ROS 2 that nothing reads, of launch files and of the files they name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.launch_ros2.launch_file import LaunchedNode
from gazelle.doctor.launch_ros2.launch_tree import Followed, located
from gazelle.doctor.launch_ros2.topics import program_of
from gazelle.doctor.parameters.parameter_file import (
    Document,
    Layout,
    layout_of,
    plain,
    read_document,
)
from gazelle.doctor.parameters.value_checks import check_idle, key_span, nodes_in
from gazelle.doctor.script_parameters import read_script_parameters, report_unread
from gazelle.nodes.parameters import OF_EVERY_NODE
from gazelle.nodes.unsupported_parameters import misspelt_parameters
from gazelle.parameters.trees import flattened
from gazelle.workspace import Workspace

__all__ = ["check_node_parameters"]

# Of rclpy itself, and of those that any node may be given.
_OF_RCLPY = OF_EVERY_NODE | {"start_type_description_service"}


def check_node_parameters(
    files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report parameters that are misspelt, or that a script never declares."""
    named = [one for item in files for node in item.file.nodes for one in node.parameters.files]
    for document in filter(None, map(_document, dict.fromkeys(named))):
        check_idle(document, diagnostics)
    for item in files:
        for node in item.file.nodes:
            found = program_of(node, workspace)
            if found is None:
                continue
            if found.builtin is not None:
                kind = f"{found.builtin.package}/{found.builtin.executable}"
                _check_builtin(node, kind, diagnostics)
            elif found.script is not None:
                _check_script(node, found.script, diagnostics)


def _check_builtin(node: LaunchedNode, kind: str, diagnostics: Diagnostics) -> None:
    """Look at what the launch file itself gives."""
    values = {key: value for key, value in node.parameters.values.items() if value is not None}
    owner = f"'{node.name or node.executable}'"
    for wrong in misspelt_parameters(kind, values, 2):
        text = f"{owner}: parameter '{wrong.key}' is not known; it has no effect"
        diagnostics.report("parameter.unknown", text, node.place_of(wrong.key), fix=wrong.hint)


def _check_script(node: LaunchedNode, script: Path, diagnostics: Diagnostics) -> None:
    known = read_script_parameters(script)
    if not known.is_complete:
        return
    for name, span in _given(node):
        if name.partition(".")[0] not in _OF_RCLPY and not known.reads(name, str):
            owner = node.name or node.executable or ""
            report_unread(owner, name, known, script.name, span, diagnostics)


def _given(node: LaunchedNode) -> Iterator[tuple[str, SourceSpan | None]]:
    """Yield the parameters of a node with their places, those of its own name in files too."""
    for name in node.parameters.values:
        yield name, node.place_of(name)
    for file in node.parameters.files:
        document = _document(file)
        if document is None:
            continue
        for owner, values in nodes_in(document.root):
            # What is for all nodes is not for each of them.
            if node.name is None or owner[-1] != node.name:
                continue
            found: Any = plain(values)
            for name, _ in flattened(found) if isinstance(found, dict) else ():
                yield name, key_span(values, name)


def _document(name: str) -> Document | None:
    """Return a file of parameters of ROS 2; what is wrong with it is told where it is examined."""
    path = located(name)
    document = read_document(path, Diagnostics()) if path is not None else None
    return document if document is not None and layout_of(document) is Layout.ROS2 else None
