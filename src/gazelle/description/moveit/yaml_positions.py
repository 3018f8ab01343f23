"""YAML files of MoveIt: values, and where each key stands."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, YamlNode, entries
from gazelle.documents.yaml import read_yaml as read_document

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
    document = read_document(text, str(file))
    try:
        value = document.value
    except YamlError as error:
        problem = error.problem
        diagnostics.report("moveit.bad-yaml", f"not YAML: {problem.what}", problem.span)
        return {}, {}
    if document.root is None or value is None:
        return {}, {}
    if not isinstance(value, dict):
        message = "the file holds no mapping of names to values"
        diagnostics.report("moveit.bad-yaml", message, SourceSpan(str(file), 1, 1))
        return {}, {}
    return value, _places(document.root, diagnostics)


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


def _places(root: YamlNode, diagnostics: Diagnostics) -> dict[tuple[str, ...], SourceSpan]:
    places: dict[tuple[str, ...], SourceSpan] = {}
    for path, key, _, first in entries(root, lists=True):
        if first is not None:
            message = f"'{key.text}' is there twice; the last one counts"
            diagnostics.report("moveit.double-key", message, key.span)
        places[path] = key.span
    return places
