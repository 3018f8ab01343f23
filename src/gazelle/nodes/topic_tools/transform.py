"""``transform`` and ``relay_field`` of topic_tools: Python expressions on a topic or its field."""

from __future__ import annotations

import argparse
import re
import threading
from collections.abc import Callable
from importlib import import_module
from types import CodeType
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.errors import GazelleError, LaunchError
from gazelle.graph import ANY_TYPE, Graph, Node
from gazelle.graph.graph_info import topics_of
from gazelle.interfaces import (
    Ros1Message,
    RosVersion,
    fill,
    ros1_message_type,
    ros1_type_of,
    time_keys,
    to_plain,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

__all__ = ["field_getter", "find_input", "run_relay_field", "run_transform"]


_STEP = re.compile(r"(\w+)(?:\[(-?\d*)(:(-?\d*))?\])?")
_LOOK_S = 0.1
_Make = Callable[[Any], Any]


def find_input(graph: Graph, word: str, *, wait: Callable[[], bool] | None) -> tuple[str, Any, str]:
    """Return the topic, its class in the form of ROS 1, and the path to the field behind it.

    Args:
        graph: the graph.
        word: global name of a topic, or of a topic and its field.
        wait: called while nothing fits; False ends waiting. None does not wait.

    Raises:
        LaunchError: no such topic is there.
    """
    while True:
        known = {
            one.name: one.type_name for one in topics_of(graph.entities(), include_hidden=True)
        }
        known = {name: kind for name, kind in known.items() if kind != ANY_TYPE}
        starts = [name for name in known if word == name or word.startswith(f"{name}/")]
        if starts:
            topic = max(starts, key=len)
            return topic, ros1_message_type(ros1_type_of(known[topic])), word[len(topic) :]
        if wait is None or not wait():
            near = did_you_mean(word, sorted(known))
            text = f"ERROR: Wrong input topic (or topic field): {word}"
            raise LaunchError(f"{text}\n  {near}" if near else text)


def field_getter(kind: Any, path: str) -> Callable[[Any], Any]:
    """Return the function from a message to the field that a path leads to.

    Raises:
        LaunchError: the type has no such field.
    """
    steps = [_step(part) for part in path.split("/") if part]
    owner, names = kind, []
    for name, index in steps:
        names.append(name)
        if name not in getattr(owner, "_names", ()):
            fields = tuple(getattr(owner, "_names", ()))
            near = did_you_mean(name, fields) or f"its fields: {', '.join(fields) or 'none'}"
            text = f"no field named {name} in {getattr(owner, '_type', owner)}"
            raise LaunchError(f"ERROR: Wrong input topic (or topic field): {text}\n  {near}")
        slot = owner._slot_types[owner._names.index(name)]
        base = slot.partition("[")[0] if index is not None else slot
        owner = ros1_message_type(base) if "/" in base and "[" not in base else base

    def get(message: Any) -> Any:
        for name, index in steps:
            message = getattr(message, name)
            if index is not None:
                message = message[index]
        return message

    return get


def run_transform(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish what an expression of ``m`` gives: ``transform IN OUT TYPE EXPRESSION``."""
    parser = _parser("transform", "Apply a Python operation to a topic, or to a field of it.")
    add = parser.add_argument
    add("-i", "--import", dest="modules", nargs="+", default=["numpy"], help="modules to import")
    add("--latch", action="store_true", help="set the publisher to latched")
    options = parser.parse_args(list(arguments.rest))
    node = start_node(arguments, graph)
    kind, code = _output(options.output_type), _compiled(options.expression)
    names = _imported(node, options.modules)

    def make(value: Any) -> Any:
        # The user's own words on the user's own command line, as in the original.
        result = eval(code, names, {"m": value})  # noqa: S307
        if isinstance(result, kind):
            return result
        return kind(*(result if isinstance(result, list | tuple) else [result]))

    return _run(node, options, stop, make, latch=options.latch)


def run_relay_field(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Fill messages from YAML whose values may be expressions: ``relay_field IN OUT TYPE YAML``."""
    parser = _parser("relay_field", "Relay data of fields from one topic to another.")
    options = parser.parse_args(list(arguments.rest))
    node = start_node(arguments, graph)
    kind = _output(options.output_type)
    try:
        values = load_yaml(options.expression)
    except YamlError as error:
        raise LaunchError(f"'{options.expression}' is not YAML: {error}") from None
    if not isinstance(values, dict):
        text = f"'{options.expression}' names no fields of {options.output_type}"
        raise LaunchError(f"{text}\n  fix: write YAML such as 'frame_id: m.data'")

    def make(value: Any) -> Any:
        message = kind()
        keys = time_keys(node.clock.now_ns(), RosVersion.ROS1)
        fill(message, [_evaluated(values, value)], keys=keys)
        return message

    return _run(node, options, stop, make, latch=False)


def _step(part: str) -> tuple[str, int | slice | None]:
    match = _STEP.fullmatch(part)
    if match is None:
        raise LaunchError(f"ERROR: '{part}' is no field; write name, name[2] or name[0:3]")
    name, first, is_slice, last = match.groups()
    if is_slice is not None:
        return name, slice(int(first) if first else None, int(last) if last else None)
    return name, int(first) if first else None


def _run(
    node: Node, options: argparse.Namespace, stop: threading.Event, make: _Make, *, latch: bool
) -> int:
    def wait() -> bool:
        return not stop.wait(_LOOK_S)

    word = node.resolve_name(options.input)
    topic, source, path = find_input(node.graph, word, wait=wait if options.wait else None)
    get, told = field_getter(source, path), set()
    target = _output(options.output_type)
    publisher = node.create_publisher(options.output_topic, target, latch=latch)

    def take(message: Any) -> None:
        try:
            made = make(get(message))
            publisher.publish(made)
        except Exception as error:  # noqa: BLE001 - an expression may raise anything
            text = f"'{options.expression}' on {word}: {type(error).__name__}: {error}"
            if text not in told:
                told.add(text)
                node.log("error", text)

    node.create_subscription(topic, source, take)
    stop.wait()
    node.shutdown()
    return 0


def _evaluated(values: dict[str, Any], message: Any) -> dict[str, Any]:
    """Words that are no expressions of ``m`` stay words."""
    found: dict[str, Any] = {}
    for key, value in values.items():
        if isinstance(value, dict):
            found[key] = _evaluated(value, message)
        elif isinstance(value, str):
            try:
                result = eval(value, {}, {"m": message})  # noqa: S307 - as in the original
                # A whole message for a field of its type: the original refuses that.
                found[key] = to_plain(result) if isinstance(result, Ros1Message) else result
            except (NameError, SyntaxError):
                found[key] = value
        else:
            found[key] = value
    return found


def _parser(name: str, text: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=name, description=text)
    add = parser.add_argument
    add("input", help="Input topic or topic field.")
    add("output_topic", help="Output topic.")
    add("output_type", help="Output topic type.")
    add("expression", help="Python expression to apply on the input message 'm'.")
    add("--wait-for-start", dest="wait", action="store_true", help="Wait for input messages.")
    text = "accepted: nothing waits for full packets here"
    add("--tcpnodelay", dest="nodelay", action="store_true", help=text)
    return parser


def _output(name: str) -> Any:
    try:
        return ros1_message_type(name)
    except GazelleError as error:
        raise LaunchError(f"ERROR: Wrong output type: {error}") from None


def _compiled(text: str) -> CodeType:
    try:
        return compile(text.strip(), "expression", "eval")
    except SyntaxError as error:
        raise LaunchError(f"Wrong expression: '{text}' is no Python: {error.msg}") from None


def _imported(node: Node, modules: list[str]) -> dict[str, Any]:
    """Return modules by name; a package stands for its modules, as after ``import``."""
    found: dict[str, Any] = {}
    for name in modules:
        try:
            import_module(name)
            found[name.partition(".")[0]] = import_module(name.partition(".")[0])
        except ImportError as error:
            node.log("error", f"Failed to import module: {name} ({error})")
    return found
