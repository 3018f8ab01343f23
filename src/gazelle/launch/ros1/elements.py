"""The roslaunch elements that set something: arg, env, machine, remap, param, rosparam, node."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, Literal, cast

from gazelle.description.xml import Tag
from gazelle.graph.names import resolve
from gazelle.launch.config import ArgDeclaration, Machine, NodeTag, TestTag
from gazelle.launch.ros1.element_reader import Reading, TagError
from gazelle.launch.ros1.param_elements import param, rosparam
from gazelle.launch.ros1.scope import Scope
from gazelle.launch.ros1.substitution_args import UNREADABLE

__all__ = ["HANDLERS"]

_LEGAL_NODE_NAME = re.compile(r"^[A-Za-z][\w]*$")
# What rosgraph.names.is_legal_name takes.
_LEGAL_NAME = re.compile(r"^[~/A-Za-z](?!.*//)[\w/]*$", re.ASCII)
_MACHINE_OF_OLD = ("ros-root", "ros-package-path", "ros-ip", "ros-hostname", "ros-host-name")
_NOT_OF_TESTS = ("respawn", "respawn_delay", "output")
_NODE_CHILDREN = ("param", "rosparam", "remap", "env")


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
    scope.add_remap(*names)


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
    return NodeTag(
        package=reading.required(tag, "pkg", scope),
        type=reading.required(tag, "type", scope),
        name=name,
        namespace=inner.namespace,
        args=reading.text(tag, "args", scope),
        remaps=inner.remaps,
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
    words = ("ROS_HOME", "ros-root", "ros_home", "node")
    return "node" if reading.choice(tag, "cwd", scope, words) == "node" else "ROS_HOME"


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
