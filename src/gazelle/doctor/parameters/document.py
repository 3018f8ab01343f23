"""A YAML file as nodes with places, and as plain values."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.yaml.loader import LimitedLoader

__all__ = ["Document", "plain", "read_document", "scalars"]

_LONGEST = 5_000_000
_DEEPEST = 60


@dataclass(frozen=True, slots=True)
class Document:
    """One YAML document.

    Attributes:
        file: its path.
        root: the outermost mapping.
    """

    file: Path
    root: yaml.MappingNode

    def span(self, node: yaml.Node) -> SourceSpan:
        """Return a node's place."""
        start, end = node.start_mark, node.end_mark
        length = end.column - start.column if end.line == start.line else 0
        return SourceSpan(str(self.file), start.line + 1, start.column + 1, length)

    def find(self, *keys: str) -> yaml.Node | None:
        """Return the value below these keys; None when there is none."""
        node: yaml.Node | None = self.root
        for key in keys:
            if not isinstance(node, yaml.MappingNode):
                return None
            node = next((v for k, v in node.value if k.value == key), None)
        return node

    @staticmethod
    def keys(node: yaml.Node | None) -> tuple[str, ...]:
        """Return the keys of a mapping, none for anything else."""
        if not isinstance(node, yaml.MappingNode):
            return ()
        return tuple(str(key.value) for key, _ in node.value if isinstance(key, yaml.ScalarNode))

    def key(self, node: yaml.Node, name: str) -> yaml.Node:
        """Return the node of a key in a mapping; the mapping itself when it has none such."""
        pairs = node.value if isinstance(node, yaml.MappingNode) else []
        return next((key for key, _ in pairs if key.value == name), node)


def read_document(path: Path, diagnostics: Diagnostics) -> Document | None:
    """Read a file; None (and an error reported) when it is no YAML, None for lists and texts."""
    try:
        if path.stat().st_size > _LONGEST:
            return None
        text = path.read_text(encoding="utf-8")
        documents = list(yaml.compose_all(text, Loader=LimitedLoader))
    except OSError as error:
        message = f"parameter file '{path}' cannot be read: {error.strerror}"
        diagnostics.report("control.parameter-file", message)
        return None
    except (UnicodeDecodeError, RecursionError) as error:
        message = f"parameter file cannot be read: {error}"
        diagnostics.report("control.parameter-file", message, SourceSpan(str(path)))
        return None
    except yaml.YAMLError as error:
        _report_yaml(path, text, error, diagnostics)
        return None
    root = documents[0] if len(documents) == 1 else None
    if not isinstance(root, yaml.MappingNode) or _depth(root, 0) >= _DEEPEST:
        return None
    return Document(path, root)


def plain(node: yaml.Node) -> Any:
    """Return a node as Python values, by YAML 1.1 as roslaunch reads it."""
    if isinstance(node, yaml.MappingNode):
        return {str(key.value): plain(value) for key, value in node.value}
    if isinstance(node, yaml.SequenceNode):
        return [plain(item) for item in node.value]
    try:
        return LimitedLoader("").construct_object(node)
    except yaml.YAMLError:
        return node.value


def scalars(node: yaml.Node, name: str = "") -> Iterator[tuple[str, yaml.ScalarNode, yaml.Node]]:
    """Yield every scalar value with the last key above it and the node it stands in."""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if isinstance(value, yaml.ScalarNode):
                yield str(key.value), value, node
            else:
                yield from scalars(value, str(key.value))
    elif isinstance(node, yaml.SequenceNode):
        for value in node.value:
            if isinstance(value, yaml.ScalarNode):
                yield name, value, node
            else:
                yield from scalars(value, name)


def _depth(node: yaml.Node, above: int) -> int:
    """Return how deep a node goes; a node that holds itself is deeper than any bound."""
    if above >= _DEEPEST or isinstance(node, yaml.ScalarNode):
        return above
    is_mapping = isinstance(node, yaml.MappingNode)
    inner = [item for pair in node.value for item in pair] if is_mapping else node.value
    return max((_depth(item, above + 1) for item in inner), default=above)


def _report_yaml(path: Path, text: str, error: yaml.YAMLError, diagnostics: Diagnostics) -> None:
    mark = getattr(error, "problem_mark", None)
    problem = getattr(error, "problem", None) or str(error)
    span = SourceSpan(str(path), mark.line + 1, mark.column + 1) if mark else SourceSpan(str(path))
    message, fix = f"parameter file is not YAML: {problem}", ""
    lines = text.splitlines()
    line = lines[mark.line] if mark is not None and mark.line < len(lines) else ""
    if "\t" in line[: len(line) - len(line.lstrip())]:
        message = "parameter file is not YAML: the line is indented with a tab (found character "
        message += "'\\t' that cannot start any token)"
        fix = "indent with spaces"
    elif "mapping values are not allowed" in problem:
        fix = "put the value in quotes, or correct the indentation"
    diagnostics.report("control.parameter-file", message, span, fix=fix)
