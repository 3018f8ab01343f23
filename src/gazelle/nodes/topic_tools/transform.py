"""``transform`` and ``relay_field`` of topic_tools: Python expressions on a topic or its field."""

from __future__ import annotations

import argparse
import threading
from collections.abc import Callable
from importlib import import_module
from types import CodeType
from typing import Any

from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.errors import GazelleError, LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import (
    Ros1Message,
    RosVersion,
    fill,
    ros1_message_type,
    time_keys,
    to_plain,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.nodes.topic_field import field_getter, find_input

__all__ = ["run_relay_field", "run_transform"]

_LOOK_S = 0.1
_Make = Callable[[Any], Any]


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
