"""A YAML file with parameters: its outermost mapping, and the files that nobody checks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import (
    ProblemKind,
    YamlError,
    YamlMapping,
    YamlNode,
    YamlProblem,
    YamlScalar,
    YamlSequence,
    problem_of,
    read_yaml_documents,
    value_of,
)

__all__ = ["Document", "plain", "read_document", "scalars"]

_MAX_LENGTH = 5_000_000


@dataclass(frozen=True, slots=True)
class Document:
    """One YAML document.

    Attributes:
        file: its path.
        root: the outermost mapping.
    """

    file: Path
    root: YamlMapping

    def find(self, *keys: str) -> YamlNode | None:
        """Return the value below these keys; None when there is none."""
        node: YamlNode | None = self.root
        for key in keys:
            pair = node.pair(key) if isinstance(node, YamlMapping) else None
            node = None if pair is None else pair[1]
        return node

    @staticmethod
    def keys(node: YamlNode | None) -> tuple[str, ...]:
        """Return the keys of a mapping, none for anything else."""
        if not isinstance(node, YamlMapping):
            return ()
        return tuple(key.text for key, _ in node.pairs if isinstance(key, YamlScalar))

    def key(self, node: YamlNode, name: str) -> YamlNode:
        """Return the node of a key in a mapping; the mapping itself when it has none such."""
        pair = node.pair(name) if isinstance(node, YamlMapping) else None
        return node if pair is None else pair[0]


def read_document(path: Path, diagnostics: Diagnostics) -> Document | None:
    """Read a file; None (and an error reported) when it is no YAML, None for lists and texts."""
    try:
        if path.stat().st_size > _MAX_LENGTH:
            return None
        documents = read_yaml_documents(read_text_limited(path), str(path))
    except (OSError, UnicodeDecodeError) as error:
        _report(problem_of(error, str(path)), diagnostics)
        return None
    problem = documents[-1].problem if documents else None
    if problem is not None:
        _report(problem, diagnostics)
        return None
    root = documents[0].root if len(documents) == 1 else None
    return Document(path, root) if isinstance(root, YamlMapping) else None


def plain(node: YamlNode) -> Any:
    """Return a node as Python values, by YAML 1.1 as roslaunch reads it."""
    if isinstance(node, YamlMapping):
        return {key.text: plain(value) for key, value in node.pairs}
    if isinstance(node, YamlSequence):
        return [plain(item) for item in node.items]
    try:
        return value_of(node)
    except YamlError:
        return node.text


def scalars(node: YamlNode, name: str = "") -> Iterator[tuple[str, YamlScalar, YamlNode]]:
    """Yield every scalar value with the last key above it and the node it stands in."""
    if isinstance(node, YamlMapping):
        inner = [(key.text, value) for key, value in node.pairs]
    else:
        inner = [(name, item) for item in node.items] if isinstance(node, YamlSequence) else []
    for key, value in inner:
        if isinstance(value, YamlScalar):
            yield key, value, node
        else:
            yield from scalars(value, key)


def _report(problem: YamlProblem, diagnostics: Diagnostics) -> None:
    span: SourceSpan | None = problem.span
    match problem.kind:
        case ProblemKind.UNREADABLE:
            message = f"parameter file '{problem.span.file}' cannot be read: {problem.what}"
            span = None
        case ProblemKind.NOT_UTF8:
            message = f"parameter file cannot be read: {problem.text}"
        case ProblemKind.TAB_INDENT:
            message = "parameter file is not YAML: the line is indented with a tab (found "
            message += "character '\\t' that cannot start any token)"
        case _:
            message = f"parameter file is not YAML: {problem.what}"
    diagnostics.report("control.parameter-file", message, span, fix=problem.fix)
