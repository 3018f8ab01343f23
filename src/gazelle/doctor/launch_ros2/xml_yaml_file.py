"""Launch files in XML and YAML: the same elements in two spellings."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Mapping
from pathlib import Path, PurePath

from gazelle.description.xml import Tag, attribute_span, read_xml
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.launch_file import (
    Argument,
    Command,
    Include,
    LaunchedNode,
    LaunchFile,
    Parameters,
    Use,
)
from gazelle.doctor.launch_ros2.substitutions import Substitutions
from gazelle.documents import yaml
from gazelle.documents.yaml import (
    YamlDocument,
    YamlError,
    YamlMapping,
    YamlNode,
    YamlProblem,
    YamlScalar,
    YamlSequence,
)
from gazelle.workspace import Workspace

__all__ = ["read_xml_file", "read_yaml_file"]

_INNER = re.compile(r"\$\(([\w-]+)((?:\s+(?:[^()$]|\$(?!\())*)?)\)")
_MAX_ROUNDS = 50


def read_xml_file(
    path: Path,
    given: Mapping[str, str | None],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> LaunchFile | None:
    """Read a launch file in XML; None (and an error reported) when it is none."""
    root = read_xml(path, diagnostics)
    if root is None:
        return None
    return _Reader(path, Substitutions(path, given, workspace)).read(root)


def read_yaml_file(
    path: Path,
    given: Mapping[str, str | None],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> LaunchFile | None:
    """Read a launch file in YAML; None (and an error reported) when it is none."""
    document = yaml.read_yaml_file(path)
    problem = _problem(document)
    if problem is not None:
        _report(problem, diagnostics)
        return None
    root = document.root
    if not isinstance(root, YamlMapping):
        return None
    inner = root.pair("launch")
    children = () if inner is None else _children("launch", inner[1])
    tag = Tag("launch", root.span, {}, children)
    return _Reader(path, Substitutions(path, given, workspace)).read(tag)


def _problem(document: YamlDocument) -> YamlProblem | None:
    """Return what keeps a launch from reading a file: its text, or a value that it may not have."""
    try:
        _ = document.value
    except YamlError as error:
        return error.problem
    return None


def _report(problem: YamlProblem, diagnostics: Diagnostics) -> None:
    """Tell what the launch itself would."""
    from gazelle.launch.ros2.error_diagnostics import explain_yaml

    found = explain_yaml(problem)
    message = found.message or f"the launch file cannot be read: {problem.what}"
    diagnostics.report(found.code, message, problem.span, fix=found.fix)


def _children(name: str, node: YamlNode | None) -> tuple[Tag, ...]:
    """Return the elements below a YAML node: ``- node: {pkg: …}`` is ``<node pkg="…"/>``."""
    found: list[Tag] = []
    if isinstance(node, YamlSequence):
        for item in node.items:
            if isinstance(item, YamlMapping) and len(item.pairs) == 1 and name in {
                "launch", "group",
            }:  # fmt: skip
                key, value = item.pairs[0]
                found.append(_element(key.text, key, value))
            else:
                found.append(_element(name, item, item))
    return tuple(found)


def _element(name: str, place: YamlNode, node: YamlNode) -> Tag:
    attributes: dict[str, str] = {}
    children: list[Tag] = []
    if isinstance(node, YamlSequence):
        children += _children("group", node)
    for key, value in node.pairs if isinstance(node, YamlMapping) else ():
        if isinstance(value, YamlScalar):
            attributes[key.text] = value.text
        else:
            children += _children(key.text, value)
    return Tag(name, place.span, attributes, tuple(children))


def _words(text: str) -> list[str]:
    """Return the words of a node's ``args``, those in quotes as one."""
    try:
        return shlex.split(text)
    except ValueError:
        return text.split()


class _Reader:
    def __init__(self, path: Path, values: Substitutions) -> None:
        self._values = values
        self._file = LaunchFile(path)
        try:
            self._file.text = path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            self._file.text = ""

    def read(self, root: Tag) -> LaunchFile:
        for tag in root.children:
            self._take(tag)
        return self._file

    def _take(self, tag: Tag) -> None:
        match tag.name:
            case "arg" | "let":
                self._argument(tag)
            case "group":
                self.read(tag)
            case "include":
                pairs = {
                    item.attributes.get("name", ""): self._text(item, "value")
                    for item in (*tag.find_all("arg"), *tag.find_all("let"))
                }
                self._file.includes.append(Include(self._text(tag, "file"), pairs, tag.span))
            case "node":
                self._node(tag)
            case "executable":
                command = self._text(tag, "cmd") or ""
                self._file.commands.append(Command(command, tag.span))
            case "set_parameter":
                self._file.sets_parameters.add(tag.attributes.get("name", ""))

    def _argument(self, tag: Tag) -> None:
        name = tag.attributes.get("name", "")
        key = "default" if tag.name == "arg" else "value"
        has = key in tag.attributes
        default = self._text(tag, key) if has else None
        argument = Argument(name, default, not has, tag.span)
        self._file.arguments.append(argument)
        self._values.declare(argument)

    def _node(self, tag: Tag) -> None:
        values: dict[str, str | None] = {}
        files: list[str] = []
        complete = True
        for item in tag.find_all("param"):
            if "from" in item.attributes:
                text = self._text(item, "from")
                files += [text] if text is not None else []
                complete = complete and text is not None
            else:
                values[item.attributes.get("name", "")] = self._text(item, "value")
        words = _words(self._text(tag, "args") or "")
        self._file.nodes.append(
            LaunchedNode(
                self._text(tag, "pkg"),
                self._text(tag, "exec"),
                self._text(tag, "name"),
                self._text(tag, "namespace"),
                Parameters(values, tuple(files), complete),
                tuple(words),
                tag.span,
                places={
                    name: attribute_span(item.span, "name")
                    for item in tag.find_all("param")
                    if (name := item.attributes.get("name", ""))
                },
                remappings=self._remappings(tag),
            )
        )

    def _remappings(self, tag: Tag) -> tuple[tuple[str, str], ...] | None:
        if "namespace" in tag.attributes and self._text(tag, "namespace") is None:
            return None
        pairs = []
        for item in tag.find_all("remap"):
            source, target = self._text(item, "from"), self._text(item, "to")
            if source is None or target is None:
                return None
            pairs.append((source, target))
        return tuple(pairs)

    def _text(self, tag: Tag, key: str) -> str | None:
        """Return an attribute with its substitutions replaced; None when one is not known."""
        text: str | None = tag.attributes.get(key)
        for _ in range(_MAX_ROUNDS):
            found = _INNER.search(text) if text is not None else None
            if text is None or found is None:
                break
            value = self._substituted(found[1], found[2].strip(), tag)
            text = None if value is None else text[: found.start()] + value + text[found.end() :]
        is_of_package = "$(find-pkg-share" in tag.attributes.get(key, "")
        if text is not None and is_of_package and PurePath(text).suffix and " " not in text:
            self._file.paths.append(Use(text, tag.span))
            self._file.opened.add(text)
        return text

    def _substituted(self, kind: str, words: str, tag: Tag) -> str | None:
        match kind:
            case "var":
                name, _, default = words.partition(" ")
                if not default:
                    self._file.uses.append(Use(name, tag.span))
                return self._values.argument(name) or default or None
            case "find-pkg-share" | "find-pkg-prefix":
                self._file.packages.append(Use(words, tag.span))
                return self._values.share(words)
            case "dirname":
                return str(self._file.path.parent)
            case "filename":
                return str(self._file.path)
            case "env":
                name, _, default = words.partition(" ")
                return os.environ.get(name, default.strip().strip("'\"") or None)
            case "command":
                begin = words.strip("'\"")
                self._file.commands.append(Command(begin, tag.span, True, True))
        return None
