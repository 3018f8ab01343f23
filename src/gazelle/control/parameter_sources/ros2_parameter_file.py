"""ROS 2 parameter files: values and where they stand."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.yaml import (
    RCL,
    ProblemKind,
    YamlDocument,
    YamlError,
    YamlMapping,
    YamlNode,
    YamlProblem,
    YamlScalar,
    YamlSequence,
    duplicates,
    read_yaml,
    read_yaml_file,
    value_of,
)
from gazelle.parameters.trees import flattened, values_only

__all__ = [
    "NodeSection",
    "read_parameter_file",
    "read_parameter_text",
    "read_parameters_of",
]

_MARK = "ros__parameters"


@dataclass(frozen=True, slots=True)
class NodeSection:
    """Parameters of one node name in one file.

    Attributes:
        node: name as the file writes it, absolute; may have the wildcards ``*`` and ``**``.
        values: nested parameters.
        spans: where each leaf stands, by its name with dots.
    """

    node: str
    values: dict[str, Any]
    spans: dict[str, SourceSpan]

    def matches(self, full_name: str) -> bool:
        """Tell whether the section is for a node; ``*`` is one word, ``**`` any number."""
        pattern = re.escape(self.node).replace(r"/\*\*", "(/[^/]+)*").replace(r"\*", "[^/]+")
        return re.fullmatch(pattern, full_name) is not None


def read_parameter_file(path: Path, diagnostics: Diagnostics) -> tuple[NodeSection, ...]:
    """Read a file of ``node: ros__parameters: …`` sections, in the order of the file.

    A file without any ``ros__parameters`` is taken as ROS 1 wrote it, with a warning: its first
    level are nodes. Problems are reported; what can be read is returned.
    """
    return _sections(read_yaml_file(path, RCL), diagnostics)


def read_parameter_text(text: str, file: str, diagnostics: Diagnostics) -> tuple[NodeSection, ...]:
    """Read the text of a parameter file; see `read_parameter_file`.

    Args:
        text: YAML.
        file: name for messages.
        diagnostics: receives what is wrong.
    """
    return _sections(read_yaml(text, file, RCL), diagnostics)


def _sections(document: YamlDocument, diagnostics: Diagnostics) -> tuple[NodeSection, ...]:
    if document.problem is not None:
        _report(document.problem, diagnostics)
    return () if document.root is None else _Reader(diagnostics).sections(document.root)


def _report(problem: YamlProblem, diagnostics: Diagnostics) -> None:
    span: SourceSpan | None = problem.span
    if problem.kind is ProblemKind.UNREADABLE:
        message = f"parameter file '{problem.span.file}' cannot be read: {problem.what}"
        span = None
    elif problem.kind is ProblemKind.NOT_UTF8:
        message = f"parameter file is not UTF-8: {problem.what}"
    else:
        what = "not read" if problem.is_limit else "not YAML"
        message = f"parameter file is {what}: {problem.what}"
    if problem.context_span is not None:
        other = problem.context_span
        where = "begins at" if other < problem.span else "goes on to"
        message += f" ({problem.context}, which {where} {other.line}:{other.column})"
    diagnostics.report("control.parameter-file", message, span)


def read_parameters_of(
    full_name: str, files: Iterable[Path], diagnostics: Diagnostics
) -> dict[str, Any]:
    """Return what files say for one node, by names with dots; later ones count.

    Args:
        full_name: the node's global name.
        files: see `read_parameter_file`.
        diagnostics: receives what is wrong.
    """
    return {
        name: value
        for file in files
        for section in read_parameter_file(file, diagnostics)
        if section.matches(full_name)
        for name, value in values_only(flattened(section.values))
    }


class _Reader:
    def __init__(self, diagnostics: Diagnostics) -> None:
        self._diagnostics = diagnostics
        self._sections: list[NodeSection] = []

    def sections(self, root: YamlNode) -> tuple[NodeSection, ...]:
        if not isinstance(root, YamlMapping):
            text = "a parameter file is a mapping of node names"
            self._diagnostics.report("control.parameter-file", text, root.span)
            return ()
        self._walk(root, "")
        if not self._sections:
            text = "the file has no 'ros__parameters'; it is read as ROS 1 wrote such files, real "
            text += "ROS 2 would refuse it (Cannot have a value before ros__parameters)"
            fix = "write: controller_name: / ros__parameters: / …"
            self._diagnostics.report("control.no-ros-parameters", text, root.span, fix=fix)
            for key, value in self._pairs(root):
                if isinstance(value, YamlMapping):
                    self._add(f"/{key.text}", value)
        return tuple(self._sections)

    def _walk(self, node: YamlMapping, name: str) -> None:
        for key, value in self._pairs(node):
            if not isinstance(value, YamlMapping):
                continue
            if key.text == _MARK:
                self._add(name or "/**", value)
            else:
                self._walk(value, f"{name}/{key.text.strip('/')}")

    def _add(self, node: str, value: YamlMapping) -> None:
        spans: dict[str, SourceSpan] = {}
        values = self._mapping(value, "", spans)
        self._sections.append(NodeSection(node, values, spans))

    def _mapping(
        self, node: YamlMapping, prefix: str, spans: dict[str, SourceSpan]
    ) -> dict[str, Any]:
        found: dict[str, Any] = {}
        doubles = duplicates(node)
        for key, value in self._pairs(node):
            name = f"{prefix}{key.text}"
            spans[name] = key.span
            if key in doubles:
                text = f"key '{name}' is there twice; the last one counts"
                self._diagnostics.report("control.double-parameter", text, key.span)
            if isinstance(value, YamlMapping):
                found[key.text] = self._mapping(value, f"{name}.", spans)
            else:
                found[key.text] = self._value(value)
        return found

    def _pairs(self, node: YamlMapping) -> Iterator[tuple[YamlScalar, YamlNode]]:
        """Yield keys and values; what a parameter's name cannot be is reported."""
        for key, value in node.pairs:
            if isinstance(key, YamlScalar):
                yield key, value
            else:
                text = "a name of a parameter is a word, not a list or a mapping"
                self._diagnostics.report("control.parameter-file", text, key.span)

    def _value(self, node: YamlNode) -> Any:
        if isinstance(node, YamlSequence):
            return [self._value(item) for item in node.items]
        try:
            return value_of(node, RCL)
        except YamlError as error:
            text = f"this value cannot be read: {error}"
            self._diagnostics.report("control.parameter-file", text, node.span)
            return None
