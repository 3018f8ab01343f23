"""roslaunch XML to a `LaunchConfig`: every mistake is reported, none stops the reading."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle.description.xml import Tag, parse_xml, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.files import is_file
from gazelle.launch.environment import ros1_variables
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.ros1.element_attributes import ELEMENTS, Reading, Scope, TagError
from gazelle.launch.ros1.element_loaders import HANDLERS
from gazelle.launch.ros1.substitution_args import REPORTED
from gazelle.workspace import Workspace

__all__ = ["load_launch_files", "load_launch_text"]


def load_launch_files(
    files: Sequence[Path],
    args: Mapping[str, str],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    environ: Mapping[str, str] | None = None,
) -> LaunchConfig:
    """Read launch files one after another into one configuration.

    Args:
        files: top-level files.
        args: values from the command line, ``name:=value``.
        workspace: answers ``$(find …)`` and finds included files.
        diagnostics: receives every problem; the result is usable when it holds no error.
        environ: environment for ``$(env …)``; the process's own when None.
    """
    config = LaunchConfig()
    reading = Reading(config, workspace, diagnostics, _ros1_environment(environ or os.environ))
    for file in files:
        root = read_xml(file, diagnostics)
        if root is not None:
            _load_root(root, Scope(str(file), given=dict(args)), reading, top=True)
    _check_names(reading)
    return config


def load_launch_text(
    text: str,
    args: Mapping[str, str],
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    file: str = "<stdin>",
) -> LaunchConfig:
    """Read launch XML that has no file (``roslaunch -``)."""
    config = LaunchConfig()
    reading = Reading(config, workspace, diagnostics, _ros1_environment(os.environ))
    root = parse_xml(text, file, diagnostics)
    if root is not None:
        _load_root(root, Scope(file, given=dict(args)), reading, top=True)
    _check_names(reading)
    return config


def _ros1_environment(environ: Mapping[str, str]) -> dict[str, str]:
    return {**environ, **ros1_variables(environ)}


def _load_root(root: Tag, scope: Scope, reading: Reading, *, top: bool) -> None:
    reading.config.files.append(scope.file)
    if root.name != "launch":
        message = f"the root element is <{root.name}>, not <launch>"
        reading.diagnostics.report("launch.no-root", message, root.span)
        return
    if "deprecated" in root.attributes:
        message = f"[{scope.file}] DEPRECATED: {root.attributes['deprecated']}"
        reading.diagnostics.report("launch.deprecated", message, root.span)
    _load_children(root, scope, reading)
    _check_given(root, scope, reading, top=top)


def _load_children(parent: Tag, scope: Scope, reading: Reading) -> None:
    for tag in parent.children:
        try:
            _load_element(tag, scope, reading)
        except TagError as error:
            if error.code != REPORTED:
                span = reading.located(error.span or tag.span, scope)
                reading.diagnostics.report(
                    error.code, str(error), span, fix=error.fix, phrase=error.phrase
                )


def _load_element(tag: Tag, scope: Scope, reading: Reading) -> None:
    if tag.name not in ELEMENTS:
        known = (*ELEMENTS, "launch")
        reading.unknown("xml.unknown-tag", f"<{tag.name}>", tag.name, known, tag, scope)
        return
    reading.check_attributes(tag, scope)
    if not reading.condition(tag, scope):
        return
    if tag.name == "group":
        inner = scope.child(reading.namespace(tag, scope))
        reading.clear_params(tag, inner, needs_namespace=True)
        _load_children(tag, inner, reading)
    elif tag.name == "include":
        _include(tag, scope, reading)
    else:
        HANDLERS[tag.name](tag, scope, reading)


def _include(tag: Tag, scope: Scope, reading: Reading) -> None:
    file = reading.text(tag, "file", scope)
    path = Path(file) if Path(file).is_absolute() else Path(scope.file).parent / file
    given = _include_args(tag, scope, reading)
    inner = scope.included(str(path), reading.namespace(tag, scope), given, tag.span)
    named = tag.find_all("arg")
    inner.given_at = {one.attributes.get("name", ""): one.span for one in named}
    inner.pass_all = reading.flag(tag, "pass_all_args", scope)
    for child in tag.find_all("env"):
        HANDLERS["env"](child, inner, reading)
    reading.clear_params(tag, inner, needs_namespace=True)
    if os.path.realpath(path) in map(os.path.realpath, _open_files(scope)):
        chain = " → ".join([*_open_files(scope), str(path)])
        raise TagError("launch.include-cycle", f"include cycle: {chain}")
    if not is_file(path):
        raise TagError("launch.include-missing", *reading.missing_file(path))
    reading.count_include()
    root = read_xml(path, reading.diagnostics)
    if root is not None:
        _load_root(root, inner, reading, top=False)


def _open_files(scope: Scope) -> list[str]:
    return [place.file for place in scope.stack] + [scope.file]


def _include_args(tag: Tag, scope: Scope, reading: Reading) -> dict[str, str]:
    given: dict[str, str] = {}
    if reading.flag(tag, "pass_all_args", scope):
        given.update({key: value for key, value in scope.args.items() if value is not None})
    for child in tag.children:
        if child.name not in {"arg", "env"}:
            reading.unknown(
                "xml.unknown-tag", f"<{child.name}> in <include>", child.name, ("arg", "env"),
                child, scope,
            )  # fmt: skip
        elif child.name == "arg" and reading.condition(child, scope):
            name = reading.required(child, "name", scope)
            attribute = "value" if "value" in child.attributes else "default"
            if attribute not in child.attributes:
                raise TagError(
                    "xml.missing-attribute",
                    f"<arg name='{name}'> in <include> needs value",
                    child.span,
                )
            given[name] = reading.text(child, attribute, scope)
    return given


def _check_given(root: Tag, scope: Scope, reading: Reading, *, top: bool) -> None:
    unused = [name for name in scope.given if name not in scope.args]
    if not unused or scope.pass_all:
        return
    code = "launch.arg-unused-command-line" if top else "launch.arg-unused"
    names = ", ".join(unused)
    declared = ", ".join(sorted(scope.args)) or "none"
    what = f"[{scope.file}]" if top else f"include of [{scope.file}]"
    message = f"unused args [{names}] for {what}; it declares: {declared}"
    given_at = scope.given_at.get(unused[0]) if scope.stack else None
    span = given_at or (scope.stack[-1] if scope.stack else root.span)
    hint = did_you_mean(unused[0], scope.args)
    phrase = "" if top else f"RLException: unused args [{names}] for {what}"
    reading.diagnostics.report(code, message, span, fix=hint, phrase=phrase)


def _check_names(reading: Reading) -> None:
    seen: dict[str, SourceSpan | None] = {}
    for node in reading.config.nodes:
        if node.full_name in seen:
            message = (
                f"roslaunch file contains multiple nodes named [{node.full_name}]; "
                f"the first is at {seen[node.full_name]}"
            )
            phrase = f"RLException: {message.partition(';')[0]}"
            reading.diagnostics.report("launch.duplicate-node", message, node.span, phrase=phrase)
        seen.setdefault(node.full_name, node.span)
