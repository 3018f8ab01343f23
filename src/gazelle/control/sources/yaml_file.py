"""ROS 2 parameter files: values and where they stand."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents import read_text_limited
from gazelle.documents.yaml.loader import LimitedLoader, YamlLimitError

__all__ = ["NodeSection", "read_parameter_file", "read_parameter_text"]

_MARK = "ros__parameters"
# rcl reads these with strtod; YAML 1.1, as PyYAML has it, wants a dot and a sign.
_FLOAT = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


@dataclass(frozen=True, slots=True)
class NodeSection:
    """Parameters of one node name in one file.

    Attributes:
        node: name as the file writes it, absolute; may have the wildcards ``*`` and ``**``.
        values: nested parameters.
        places: where each leaf stands, by its name with dots.
    """

    node: str
    values: dict[str, Any]
    places: dict[str, SourceSpan]

    def matches(self, full_name: str) -> bool:
        """Tell whether the section is for a node; ``*`` is one word, ``**`` any number."""
        pattern = re.escape(self.node).replace(r"/\*\*", "(/[^/]+)*").replace(r"\*", "[^/]+")
        return re.fullmatch(pattern, full_name) is not None


def read_parameter_file(path: Path, diagnostics: Diagnostics) -> tuple[NodeSection, ...]:
    """Read a file of ``node: ros__parameters: …`` sections, in the order of the file.

    A file without any ``ros__parameters`` is taken as ROS 1 wrote it, with a warning: its first
    level are nodes. Problems are reported; what can be read is returned.
    """
    try:
        text = read_text_limited(path)
    except OSError as error:
        message = f"parameter file '{path}' cannot be read: {error.strerror}"
        diagnostics.report("control.parameter-file", message)
        return ()
    except UnicodeDecodeError as error:
        message = f"parameter file is not UTF-8: {error.reason} at byte {error.start}"
        diagnostics.report("control.parameter-file", message, SourceSpan(str(path)))
        return ()
    return read_parameter_text(text, str(path), diagnostics)


def read_parameter_text(text: str, file: str, diagnostics: Diagnostics) -> tuple[NodeSection, ...]:
    """Read the text of a parameter file; see `read_parameter_file`.

    Args:
        text: YAML.
        file: name for messages.
        diagnostics: receives what is wrong.
    """
    try:
        root = yaml.compose(text, Loader=LimitedLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        span = SourceSpan(file, mark.line + 1, mark.column + 1) if mark else SourceSpan(file)
        what = "not read" if isinstance(error, YamlLimitError) else "not YAML"
        message = f"parameter file is {what}: {getattr(error, 'problem', None) or error}"
        begin = getattr(error, "context_mark", None)
        if begin is not None and begin is not mark:
            context = getattr(error, "context", "")
            message += f" ({context}, which begins at {begin.line + 1}:{begin.column + 1})"
        diagnostics.report("control.parameter-file", message, span)
        return ()
    return () if root is None else _Reader(file, diagnostics).sections(root)


class _Reader:
    def __init__(self, file: str, diagnostics: Diagnostics) -> None:
        self._file = file
        self._diagnostics = diagnostics
        self._sections: list[NodeSection] = []

    def sections(self, root: yaml.Node) -> tuple[NodeSection, ...]:
        if not isinstance(root, yaml.MappingNode):
            text = "a parameter file is a mapping of node names"
            self._diagnostics.report("control.parameter-file", text, self._span(root))
            return ()
        self._walk(root, "")
        if not self._sections:
            text = "the file has no 'ros__parameters'; it is read as ROS 1 wrote such files, real "
            text += "ROS 2 would refuse it (Cannot have a value before ros__parameters)"
            fix = "write: controller_name: / ros__parameters: / …"
            self._diagnostics.report("control.no-ros-parameters", text, self._span(root), fix=fix)
            for key, value in self._pairs(root):
                if isinstance(value, yaml.MappingNode):
                    self._add(f"/{key.value}", value)
        return tuple(self._sections)

    def _walk(self, node: yaml.MappingNode, name: str) -> None:
        for key, value in self._pairs(node):
            if not isinstance(value, yaml.MappingNode):
                continue
            if key.value == _MARK:
                self._add(name or "/**", value)
            else:
                self._walk(value, f"{name}/{str(key.value).strip('/')}")

    def _add(self, node: str, value: yaml.MappingNode) -> None:
        places: dict[str, SourceSpan] = {}
        values = self._mapping(value, "", places)
        self._sections.append(NodeSection(node, values, places))

    def _mapping(
        self, node: yaml.MappingNode, prefix: str, places: dict[str, SourceSpan]
    ) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for key, value in self._pairs(node):
            name = f"{prefix}{key.value}"
            places[name] = self._span(key)
            if key.value in found:
                text = f"key '{name}' is there twice; the last one counts"
                self._diagnostics.report("control.double-parameter", text, self._span(key))
            if isinstance(value, yaml.MappingNode):
                found[str(key.value)] = self._mapping(value, f"{name}.", places)
            else:
                found[str(key.value)] = self._value(value)
        return found

    def _pairs(self, node: yaml.MappingNode) -> Iterator[tuple[yaml.ScalarNode, yaml.Node]]:
        """Yield keys and values; what a parameter's name cannot be is reported."""
        for key, value in node.value:
            if isinstance(key, yaml.ScalarNode):
                yield key, value
            else:
                text = "a name of a parameter is a word, not a list or a mapping"
                self._diagnostics.report("control.parameter-file", text, self._span(key))

    def _value(self, node: yaml.Node) -> Any:
        if isinstance(node, yaml.SequenceNode):
            return [self._value(item) for item in node.value]
        if isinstance(node, yaml.ScalarNode) and node.style is None and _is_float(node):
            return float(node.value)
        constructor = LimitedLoader("")
        try:
            return constructor.construct_object(node, deep=True)
        except yaml.YAMLError as error:
            text = f"this value cannot be read: {error}"
            self._diagnostics.report("control.parameter-file", text, self._span(node))
            return None

    def _span(self, node: yaml.Node) -> SourceSpan:
        return SourceSpan(self._file, node.start_mark.line + 1, node.start_mark.column + 1)


def _is_float(node: yaml.ScalarNode) -> bool:
    return node.tag == "tag:yaml.org,2002:str" and _FLOAT.fullmatch(node.value) is not None
