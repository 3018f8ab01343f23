"""The roslaunch elements that set something: arg, env, machine, remap, param, rosparam, node."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from difflib import SequenceMatcher
from pathlib import Path
from typing import Any, Literal, cast

from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.documents import TEXT_BYTES, LimitError, read_limited, read_text_limited
from gazelle.documents.command_output import run_limited
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.documents.yaml import ROSPARAM, YamlError, YamlProblem, read_yaml
from gazelle.graph.names import resolve
from gazelle.launch.environment import node_environment
from gazelle.launch.launch_config import ArgDeclaration, Machine, NodeTag, ParamDump, TestTag
from gazelle.launch.ros1.element_attributes import Reading, Scope, TagError, param_value
from gazelle.launch.ros1.substitution_args import UNREADABLE
from gazelle.parameters.trees import leaves_at

__all__ = ["HANDLERS", "param", "rosparam"]

_SOURCES = ("value", "textfile", "binfile", "command")
_LEGAL_NODE_NAME = re.compile(r"^[A-Za-z][\w]*$")
# What rosgraph.names.is_legal_name takes.
_LEGAL_NAME = re.compile(r"^[~/A-Za-z](?!.*//)[\w/]*$", re.ASCII)
_MACHINE_OF_OLD = ("ros-root", "ros-package-path", "ros-ip", "ros-hostname", "ros-host-name")
_NOT_OF_TESTS = ("respawn", "respawn_delay", "output")
_NODE_CHILDREN = ("param", "rosparam", "remap", "env")


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
        argv = shlex.split(command)
    except ValueError as error:
        raise TagError("launch.param-command-failed", f"[{name}]: {error}: {command}") from error
    if argv and Path(argv[0]).name in {"xacro", "xacro.py"}:
        return _run_xacro(argv[1:], name, reading)
    reading.config.text_files += [word for word in argv[1:] if is_file(word)]
    environment = {**node_environment(reading.environ, reading.workspace), **scope.env}
    try:
        done = run_limited(argv, env=environment)
    except OSError as error:
        message = f"Cannot load command parameter [{name}]: '{command}': {error.strerror}"
        raise TagError("launch.param-command-failed", message) from error
    except LimitError as error:
        message = f"Cannot load command parameter [{name}]: {error}"
        raise TagError("launch.param-command-failed", message) from error
    if done.returncode:
        detail = done.stderr.strip()
        message = (
            f"Cannot load command parameter [{name}]: command [{argv}] "
            f"returned with code [{done.returncode}]"
        )
        raise TagError("launch.param-command-failed", f"{message}\n{detail}" if detail else message)
    return done.stdout


def _run_xacro(argv: list[str], name: str, reading: Reading) -> str:
    from gazelle.description.source_maps import remember
    from gazelle.description.xacro import expand_xacro, parse_xacro_arguments

    try:
        command = parse_xacro_arguments(argv)
    except ValueError as error:
        raise TagError("launch.param-command-failed", f"[{name}]: {error}") from error
    if not exists(command.file):
        message = f"Cannot load command parameter [{name}]: xacro: No such file or directory: "
        message += f"'{command.file}'"
        fix = _nearest_file(Path(command.file))
        raise TagError("launch.param-command-failed", message, fix=fix)
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


def _arg(tag: Tag, scope: Scope, reading: Reading) -> None:
    name = reading.required(tag, "name", scope)
    if "default" in tag.attributes and "value" in tag.attributes:
        message = f"Invalid <arg> tag: '{name}' has both default and value"
        raise TagError("launch.bad-attribute", message, fix="keep default to let callers change it")
    if name in scope.args:
        message = f"arg '{name}' has already been declared"
        raise TagError("launch.arg-redeclared", message, phrase=f"RLException: {message}")
    # Until its text turns out to have a value.
    scope.args[name] = UNREADABLE
    default = reading.text(tag, "default", scope) if "default" in tag.attributes else None
    value = reading.text(tag, "value", scope) if "value" in tag.attributes else None
    if not scope.stack:
        doc = reading.text(tag, "doc", scope)
        reading.config.args.append(ArgDeclaration(name, doc, default, value, tag.span))
    if value is not None:
        scope.args[name] = value
        if name in scope.given and not scope.pass_all:
            message = f"cannot override arg '{name}', which has already been set to '{value}'"
            raise TagError("launch.arg-fixed", message, phrase=f"RLException: {message}")
    else:
        scope.args[name] = scope.given.get(name, default)


def _env(tag: Tag, scope: Scope, reading: Reading) -> None:
    if "value" not in tag.attributes:
        message = "<env> tag is missing required name/value attributes: it has no 'value'"
        raise TagError("xml.missing-attribute", message, tag.span)
    scope.env[reading.required(tag, "name", scope)] = reading.text(tag, "value", scope)


def _machine(tag: Tag, scope: Scope, reading: Reading) -> None:
    old = [word for word in _MACHINE_OF_OLD if word in tag.attributes]
    old += ["<env>" for child in tag.children if child.name == "env"]
    if old:
        message = f"<machine>: {old[0]} is not supported since ROS Fuerte"
        fix = "write a script that sets the environment and name it in env-loader"
        raise TagError("launch.bad-attribute", message, tag.span, fix)
    name = reading.required(tag, "name", scope)
    address = reading.required(tag, "address", scope)
    if "timeout" in tag.attributes:
        reading.positive(tag, "timeout", scope, 0.0)
    for child in tag.children:
        what = f"<{child.name}> in <machine>"
        reading.unknown("xml.unknown-tag", what, child.name, (), child, scope)
    default = reading.choice(tag, "default", scope, ("false", "true", "never"))
    reading.config.machines.append(Machine(name, address, default, tag.span))


def _remap(tag: Tag, scope: Scope, reading: Reading) -> None:
    names = [reading.required(tag, word, scope) for word in ("from", "to")]
    for word, name in zip(("from", "to"), names, strict=True):
        if not _LEGAL_NAME.match(name):
            message = f"Invalid <remap> tag: remap {word} [{name}] is not a valid ROS name"
            fix = "write a letter, '/' or '~' first, then letters, digits, '_' and '/'"
            raise TagError("launch.bad-attribute", message, tag.span, fix)
    scope.add_remap(names[0], names[1], reading.located(tag.span, scope))


def _node(tag: Tag, scope: Scope, reading: Reading) -> None:
    spec = _node_spec(tag, scope, reading, reading.required(tag, "name", scope))
    reading.config.nodes.append(spec)
    reading.config.node_files.setdefault(spec.full_name, scope.file)


def _test(tag: Tag, scope: Scope, reading: Reading) -> None:
    for word in _NOT_OF_TESTS:
        if word in tag.attributes:
            message = f"<test> tags cannot have '{word}' attribute"
            raise TagError("launch.bad-attribute", message, tag.span, f"remove {word}=")
    test_name = reading.required(tag, "test-name", scope)
    name = reading.text(tag, "name", scope) or test_name
    spec = _node_spec(tag, scope, reading, name)
    limit = reading.positive(tag, "time-limit", scope, 60.0)
    retry = int(reading.number(tag, "retry", scope, 0))
    reading.config.tests.append(TestTag(spec, test_name, limit, retry))
    reading.config.node_files.setdefault(spec.full_name, scope.file)


def _node_spec(tag: Tag, scope: Scope, reading: Reading, name: str) -> NodeTag:
    inner = scope.child(reading.namespace(tag, scope))
    _check_node_name(name)
    respawn, required = (reading.flag(tag, word, scope) for word in ("respawn", "required"))
    if respawn and required:
        message = f"respawn and required cannot both be set to true, as for node '{name}'"
        fix = "keep respawn to start it again, required to end everything with it"
        raise TagError("launch.bad-attribute", message, tag.span, fix)
    reading.clear_params(tag, inner.child(name))
    _private_params(inner, name, reading)
    _node_children(tag, inner, name, reading)
    package = reading.required(tag, "pkg", scope)
    return NodeTag(
        package=package,
        type=_node_type(tag, package, name, scope, reading),
        name=name,
        namespace=inner.namespace,
        args=reading.text(tag, "args", scope),
        remaps=inner.remaps,
        remap_spans=inner.remap_spans,
        env=tuple(inner.env.items()),
        respawn=respawn,
        respawn_delay_s=reading.number(tag, "respawn_delay", scope, 0.0),
        required=required,
        output=_output(tag, scope, reading),
        cwd=_cwd(tag, scope, reading),
        launch_prefix=reading.text(tag, "launch-prefix", scope),
        machine=reading.text(tag, "machine", scope),
        span=reading.located(tag.span, scope),
    )


def _node_type(tag: Tag, package: str, name: str, scope: Scope, reading: Reading) -> str:
    """Return a node's type; where there is none, say which the package has."""
    try:
        return reading.required(tag, "type", scope)
    except TagError as error:
        from gazelle.launch.node_commands import executables_of

        types = executables_of(package, reading.workspace)
        if error.fix or not types:
            raise
        near = max(types, key=lambda item: SequenceMatcher(None, item, name).ratio())
        fix = f'add type="{near}"'
        fix += f"; the package has: {', '.join(types)}" if len(types) > 1 else ""
        raise TagError(error.code, str(error), error.span, fix) from error


def _check_node_name(name: str) -> None:
    if "/" in name:
        message = f"node name cannot contain a namespace: '{name}'"
        raise TagError("launch.bad-node-name", message)
    if not _LEGAL_NODE_NAME.match(name):
        message = f"'{name}' is not a legal node name"
        fix = "start with a letter, then letters, digits and underscores"
        raise TagError("launch.bad-node-name", message, fix=fix)


def _output(tag: Tag, scope: Scope, reading: Reading) -> Literal["log", "screen"]:
    return cast(Literal["log", "screen"], reading.choice(tag, "output", scope, ("log", "screen")))


def _cwd(tag: Tag, scope: Scope, reading: Reading) -> Literal["ROS_HOME", "node"]:
    choices = ("ROS_HOME", "ros-root", "ros_home", "node")
    return "node" if reading.choice(tag, "cwd", scope, choices) == "node" else "ROS_HOME"


def _private_params(scope: Scope, name: str, reading: Reading) -> None:
    """Apply the ``~name`` parameters that stood above the node."""
    for key, value in scope.private_params.items():
        reading.config.params[resolve(key, f"{scope.namespace}{name}")] = value


def _node_children(tag: Tag, inner: Scope, name: str, reading: Reading) -> None:
    private = inner.child(name)
    private.in_node = True
    for child in tag.children:
        if child.name not in _NODE_CHILDREN:
            what = f"<{child.name}> in <{tag.name}>"
            reading.unknown("xml.unknown-tag", what, child.name, _NODE_CHILDREN, child, inner)
            continue
        reading.check_attributes(child, inner)
        if reading.condition(child, inner):
            scope = private if child.name in {"param", "rosparam"} else inner
            HANDLERS[child.name](child, scope, reading)


HANDLERS: dict[str, Callable[[Tag, Scope, Reading], Any]] = {
    "arg": _arg,
    "env": _env,
    "machine": _machine,
    "node": _node,
    "param": param,
    "remap": _remap,
    "rosparam": rosparam,
    "test": _test,
}
