"""YAML files of MoveIt: values, and where each key stands."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import read_text_limited
from gazelle.documents.yaml.loader import LimitedLoader

__all__ = ["read_yaml"]

_ARGUMENT = re.compile(r"\$\(arg\s+([^)\s]+)\s*\)")


def read_yaml(
    file: Path, diagnostics: Diagnostics, arguments: Mapping[str, str] | None = None
) -> tuple[dict[str, Any], dict[tuple[str, ...], SourceSpan]]:
    """Return the mapping in a file and where its keys stand; both empty (reported) if unusable.

    Args:
        file: the file.
        diagnostics: receives ``moveit.bad-yaml`` and what arguments are missing.
        arguments: values of ROS 1's ``$(arg NAME)``, as ``rosparam subst_value`` puts them in.
    """
    try:
        text = read_text_limited(file)
    except (OSError, UnicodeDecodeError) as error:
        message = f"'{file}' cannot be read: {error}"
        diagnostics.report("moveit.bad-yaml", message, SourceSpan(str(file)))
        return {}, {}
    text = _substituted(text, file, arguments or {}, diagnostics)
    try:
        root = yaml.compose(text, Loader=LimitedLoader)
        loader = LimitedLoader("")
        value = None if root is None else loader.construct_document(root)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        span = SourceSpan(str(file), mark.line + 1, mark.column + 1) if mark else None
        message = f"not YAML: {getattr(error, 'problem', None) or error}"
        diagnostics.report("moveit.bad-yaml", message, span or SourceSpan(str(file)))
        return {}, {}
    if root is None or value is None:
        return {}, {}
    if not isinstance(value, dict):
        message = "the file holds no mapping of names to values"
        diagnostics.report("moveit.bad-yaml", message, SourceSpan(str(file), 1, 1))
        return {}, {}
    places: dict[tuple[str, ...], SourceSpan] = {}
    _collect(root, (), places, str(file), diagnostics)
    return value, places


def _substituted(
    text: str, file: Path, arguments: Mapping[str, str], diagnostics: Diagnostics
) -> str:
    def value(match: re.Match[str]) -> str:
        name = match[1]
        if name in arguments:
            return arguments[name]
        line = text.count("\n", 0, match.start()) + 1
        column = match.start() - text.rfind("\n", 0, match.start())
        message = f"$(arg {name}) has no value here; a launch file would give it one"
        span = SourceSpan(str(file), line, column, len(match[0]))
        diagnostics.report("moveit.no-argument", message, span)
        return match[0]

    return _ARGUMENT.sub(value, text)


def _collect(
    node: yaml.Node,
    path: tuple[str, ...],
    places: dict[tuple[str, ...], SourceSpan],
    file: str,
    diagnostics: Diagnostics,
) -> None:
    if isinstance(node, yaml.SequenceNode):
        for index, item in enumerate(node.value):
            places[*path, str(index)] = _span(item, file)
            _collect(item, (*path, str(index)), places, file, diagnostics)
    if not isinstance(node, yaml.MappingNode):
        return
    for key, value in node.value:
        name = (*path, str(key.value))
        if name in places:
            message = f"'{key.value}' is there twice; the last one counts"
            diagnostics.report("moveit.double-key", message, _span(key, file))
        places[name] = _span(key, file)
        _collect(value, name, places, file, diagnostics)


def _span(node: yaml.Node, file: str) -> SourceSpan:
    return SourceSpan(file, node.start_mark.line + 1, node.start_mark.column + 1)
