"""``<param>`` and ``<rosparam>``: values from text, files, commands and YAML."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Any

from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.documents import TEXT_BYTES, LimitError, read_limited, read_text_limited
from gazelle.documents.command_output import run_limited
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.documents.yaml import ROSPARAM, YamlError, YamlProblem, read_yaml
from gazelle.graph.names import resolve
from gazelle.launch.config import ParamDump
from gazelle.launch.environment import node_environment
from gazelle.launch.ros1.element_reader import Reading, TagError
from gazelle.launch.ros1.scope import Scope
from gazelle.launch.ros1.values import param_value
from gazelle.parameters.trees import leaves_at

__all__ = ["param", "rosparam"]

_SOURCES = ("value", "textfile", "binfile", "command")


def param(tag: Tag, scope: Scope, reading: Reading) -> None:
    """Read a ``<param>``; ``~name`` at file level is for the nodes that follow."""
    name = reading.required(tag, "name", scope)
    value = _value(tag, name, scope, reading)
    if name.startswith("~") and not scope.in_node:
        scope.private_params[name] = value
    else:
        full = _absolute(name, scope)
        reading.config.params[full] = value
        reading.config.param_spans[full] = reading.located(tag.span, scope)


def rosparam(tag: Tag, scope: Scope, reading: Reading) -> None:
    """Read a ``<rosparam>``: load (default), dump or delete."""
    command = reading.choice(tag, "command", scope, ("load", "dump", "delete"))
    inner = scope.child(reading.text(tag, "ns", scope))
    name = reading.text(tag, "param", scope)
    target = _absolute(name, inner) if name else inner.namespace.rstrip("/")
    if "file" in tag.attributes and command == "delete":
        message = "error loading <rosparam> tag: 'file' attribute is invalid with 'delete' command"
        raise TagError("launch.bad-attribute", message, tag.span, "remove file=")
    if command == "delete":
        reading.config.deleted_params.append(target or "/")
    elif command == "dump":
        file = reading.required(tag, "file", scope)
        reading.config.dumps.append(ParamDump(file, target or "/"))
    else:
        _load(tag, name, target, scope, reading)


def _load(tag: Tag, name: str, target: str, scope: Scope, reading: Reading) -> None:
    file = reading.text(tag, "file", scope)
    if not file and "file" in tag.attributes:
        message = "error loading <rosparam> tag: file does not exist []: 'file' is empty"
        raise TagError("launch.bad-attribute", message, tag.span, "name a file, or remove file=")
    text = _read_text(Path(file), "file", tag) if file else tag.raw_text
    if reading.flag(tag, "subst_value", scope):
        text = _substitute_lines(text, tag, scope, reading)
    try:
        data = read_yaml(text, file, ROSPARAM).value
    except YamlError as error:
        problem = error.problem
        span = problem.span if file and problem.has_place else tag.span
        raise TagError("launch.bad-yaml", _yaml_text(problem, file), span) from error
    if data is None and not name:
        return
    if not isinstance(data, dict) and not name:
        message = f"<rosparam> without param= needs a mapping, found {type(data).__name__}"
        raise TagError("launch.bad-yaml", message, fix='add param="name"')
    leaves = _absolute_leaves(target, data)
    reading.config.params.update(leaves)
    place = reading.located(tag.span, scope)
    reading.config.param_spans.update(dict.fromkeys(leaves, place))
    if file:
        reading.config.yaml_files[place] = (file, target)


def _absolute_leaves(target: str, data: Any) -> dict[str, Any]:
    """Resolve keys such as ``/global`` and ``a/b`` in the YAML as rosparam does."""
    if not isinstance(data, dict) or not data:
        return {target or "/": data}
    leaves: dict[str, Any] = {}
    for key, value in data.items():
        name = resolve(str(key), target or "/")
        leaves.update(leaves_at(name, value))
    return leaves


def _value(tag: Tag, name: str, scope: Scope, reading: Reading) -> Any:
    given = [source for source in _SOURCES if source in tag.attributes]
    if len(given) != 1:
        found = ", ".join(given) or "none"
        message = f"<param name='{name}'> needs exactly one of {', '.join(_SOURCES)}; found {found}"
        raise TagError("launch.bad-param", message)
    source = reading.text(tag, given[0], scope)
    type_name = reading.text(tag, "type", scope) or "auto"
    if given[0] == "binfile":
        return _read_bytes(Path(source), tag)
    if given[0] == "textfile":
        text = _read_text(Path(source), "textfile", tag)
        reading.config.text_files.append(source)
    elif given[0] == "command":
        text = _run(source, name, scope, reading)
    else:
        text = source
    if given[0] != "value" and type_name == "auto":
        return text
    try:
        return param_value(text, type_name)
    except (ValueError, YamlError) as error:
        raise TagError("launch.bad-param", f"Invalid <param> tag: '{name}': {error}") from error


def _run(command: str, name: str, scope: Scope, reading: Reading) -> str:
    """Run a command and return what it prints; xacro runs in this process, it is Python."""
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise TagError("launch.param-command-failed", f"[{name}]: {error}: {command}") from error
    if words and Path(words[0]).name in {"xacro", "xacro.py"}:
        return _run_xacro(words[1:], name, reading)
    reading.config.text_files += [word for word in words[1:] if is_file(word)]
    environment = {**node_environment(reading.environ, reading.workspace), **scope.env}
    try:
        done = run_limited(words, env=environment)
    except OSError as error:
        message = f"Cannot load command parameter [{name}]: '{command}': {error.strerror}"
        raise TagError("launch.param-command-failed", message) from error
    except LimitError as error:
        message = f"Cannot load command parameter [{name}]: {error}"
        raise TagError("launch.param-command-failed", message) from error
    if done.returncode:
        detail = done.stderr.strip()
        message = (
            f"Cannot load command parameter [{name}]: command [{words}] "
            f"returned with code [{done.returncode}]"
        )
        raise TagError("launch.param-command-failed", f"{message}\n{detail}" if detail else message)
    return done.stdout


def _run_xacro(words: list[str], name: str, reading: Reading) -> str:
    from gazelle.description.source_maps import remember
    from gazelle.description.xacro import expand_xacro, parse_xacro_arguments

    try:
        command = parse_xacro_arguments(words)
    except ValueError as error:
        raise TagError("launch.param-command-failed", f"[{name}]: {error}") from error
    errors_before = len(reading.diagnostics.errors)
    expanded = expand_xacro(
        command.file,
        mappings=command.mappings,
        workspace=reading.workspace,
        diagnostics=reading.diagnostics,
        root_dir=command.root_dir,
    )
    if expanded is None or len(reading.diagnostics.errors) > errors_before:
        message = f"Cannot load command parameter [{name}]: xacro failed on '{command.file}'"
        raise TagError("launch.param-command-failed", message)
    remember(expanded)
    return expanded.text


def _read_text(path: Path, attribute: str, tag: Tag) -> str:
    try:
        return read_text_limited(path)
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        message = f"{attribute} '{path}': {reason}"
        raise TagError("xml.unreadable", message, tag.span, _nearest_file(path)) from error


def _read_bytes(path: Path, tag: Tag) -> bytes:
    try:
        return read_limited(path, TEXT_BYTES)
    except OSError as error:
        message = f"binfile '{path}': {error.strerror}"
        raise TagError("xml.unreadable", message, tag.span, _nearest_file(path)) from error


def _nearest_file(path: Path) -> str:
    """Return what of the same folder may have been meant, empty when nothing is near."""
    if exists(path) or not is_folder(path.parent):
        return ""
    return did_you_mean(path.name, (item.name for item in path.parent.iterdir()))


def _substitute_lines(text: str, tag: Tag, scope: Scope, reading: Reading) -> str:
    return "\n".join(reading.substitute(line, tag, scope) for line in text.split("\n"))


def _absolute(name: str, scope: Scope) -> str:
    bare = name.removeprefix("~").lstrip("/") if name.startswith("~") else name
    return resolve(bare, scope.namespace.rstrip("/") or "/")


def _yaml_text(problem: YamlProblem, file: str) -> str:
    context = f"{problem.context}: " if problem.context else ""
    where = f" of '{file}'" if file else ""
    return f"error loading <rosparam> tag{where}: {context}{problem.what}"
