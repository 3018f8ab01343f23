"""``ros2 param``: parameters of running nodes."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.cli.error_text import error_text
from gazelle.cli.ros2.verbs import add_verbs
from gazelle.cli.ros_tool import ToolError, hint, join_graph
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import (
    ParameterType,
    parameter_type,
    value_from_message,
    value_message,
)
from gazelle.interfaces import message_type, service_type

__all__ = [
    "main",
    "run_delete",
    "run_describe",
    "run_dump",
    "run_get",
    "run_list",
    "run_load",
    "run_set",
]

_MARK = "/list_parameters"
_TIMEOUT_S = 10.0
_WORDS = {
    ParameterType.BOOL: "Boolean value is",
    ParameterType.INTEGER: "Integer value is",
    ParameterType.DOUBLE: "Double value is",
    ParameterType.STRING: "String value is",
    ParameterType.BYTE_ARRAY: "Byte values are",
    ParameterType.BOOL_ARRAY: "Boolean values are",
    ParameterType.INTEGER_ARRAY: "Integer values are",
    ParameterType.DOUBLE_ARRAY: "Double values are",
    ParameterType.STRING_ARRAY: "String values are",
}


class _RemoteParameters:
    """Calls the parameter services of one node."""

    def __init__(self, node: Node, name: str) -> None:
        """Use `_remote`."""
        self.node = name
        self._node = node

    def names(self, prefixes: Sequence[str]) -> list[str]:
        """Return the names of the parameters."""
        found = self._call("list_parameters", "ListParameters", prefixes=list(prefixes))
        return sorted(found.result.names)

    def get(self, name: str) -> Any:
        """Return one value, None when it is not set."""
        return self.get_all([name])[0]

    def get_all(self, names: Sequence[str]) -> list[Any]:
        """Return values."""
        found = self._call("get_parameters", "GetParameters", names=list(names))
        return [value_from_message(item) for item in found.values]

    def types(self, names: Sequence[str]) -> list[ParameterType]:
        """Return types."""
        found = self._call("get_parameter_types", "GetParameterTypes", names=list(names))
        return [ParameterType(item) for item in found.types]

    def describe(self, names: Sequence[str]) -> list[Any]:
        """Return ``ParameterDescriptor`` messages."""
        found = self._call("describe_parameters", "DescribeParameters", names=list(names))
        return list(found.descriptors)

    def set(self, values: Mapping[str, Any]) -> list[str]:
        """Set values; return why each is refused, empty when it is not."""
        parameter = message_type("rcl_interfaces/Parameter")
        rows = [parameter(name=name, value=value_message(v)) for name, v in values.items()]
        found = self._call("set_parameters", "SetParameters", parameters=rows)
        return [
            "" if row.successful else (row.reason or "no reason given") for row in found.results
        ]

    def _call(self, name: str, kind: str, **fields: Any) -> Any:
        service = service_type(f"rcl_interfaces/{kind}")
        client = self._node.create_client(f"{self.node}/{name}", service)
        return client.call(service.Request(**fields), timeout_s=_TIMEOUT_S)


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 param``."""
    parser = _parser()
    options = parser.parse_args(argv)
    if not options.verb:
        parser.print_help()
        return 0
    try:
        return _VERBS[options.verb](options)
    except ToolError as error:
        print(error_text(error), file=sys.stderr)
        return 1


def run_list(options: argparse.Namespace) -> int:
    """Print the parameters of one node, or of all."""
    with join_graph() as graph:
        names = [options.node] if options.node else _nodes_with_parameters(graph)
        for node in names:
            parameters = _remote(graph, node)
            found = parameters.names(options.param_prefixes)
            if options.filter:
                found = [name for name in found if re.search(options.filter, name)]
            if not options.node:
                print(f"{parameters.node}:")
            types = parameters.types(found) if options.param_type else []
            for index, name in enumerate(found):
                kind = f" (type: {_type_word(types[index])})" if types else ""
                print(f"  {name}{kind}")
    return 0


def run_get(options: argparse.Namespace) -> int:
    """Print one value."""
    with join_graph() as graph:
        parameters = _remote(graph, options.node)
        value = parameters.get(options.name)
        kind = parameter_type(value)
        if kind is ParameterType.NOT_SET:
            near = hint(options.name, parameters.names([]))
            print(f"Parameter not set.{near}", file=sys.stderr)
            return 1
        print(value if options.hide_type else f"{_WORDS[kind]}: {value}")
    return 0


def run_set(options: argparse.Namespace) -> int:
    """Set one value; YAML tells its type."""
    with join_graph() as graph:
        reason = _remote(graph, options.node).set({options.name: _from_yaml(options.value)})[0]
    return _told(reason, "Set parameter successful", "Setting parameter failed")


def run_delete(options: argparse.Namespace) -> int:
    """Delete a parameter: set it to nothing."""
    with join_graph() as graph:
        reason = _remote(graph, options.node).set({options.name: None})[0]
    return _told(reason, "Deleted parameter successfully", "Deleting parameter failed")


def run_describe(options: argparse.Namespace) -> int:
    """Print what is said about parameters."""
    with join_graph() as graph:
        for row in _remote(graph, options.node).describe(options.names):
            print(f"Parameter name: {row.name}")
            print(f"  Type: {_type_word(ParameterType(row.type))}")
            if row.description:
                print(f"  Description: {row.description}")
            print("  Constraints:")
            for line in _constraints(row):
                print(f"    {line}")
    return 0


def run_dump(options: argparse.Namespace) -> int:
    """Print all parameters as a parameter file, or write one."""
    from gazelle.documents.yaml import dump_yaml

    with join_graph() as graph:
        parameters = _remote(graph, options.node)
        names = parameters.names([])
        values = dict(zip(names, parameters.get_all(names), strict=True))
    tree = {parameters.node: {"ros__parameters": _branches(values)}}
    text = dump_yaml(tree)
    if options.output_dir is None:
        print(text)
        return 0
    path = options.output_dir / f"{parameters.node.strip('/').replace('/', '__')}.yaml"
    path.write_text(text, encoding="utf-8")
    print(f"Saving to:  {path}")
    return 0


def run_load(options: argparse.Namespace) -> int:
    """Set what a parameter file says about a node."""
    from gazelle.control.parameter_sources.ros2_parameter_file import read_parameter_file
    from gazelle.diagnostics import Diagnostics, Severity, render
    from gazelle.parameters.trees import flattened, nested

    found = Diagnostics()
    sections = read_parameter_file(Path(options.file), found)
    render(found)
    if any(item.severity is Severity.ERROR for item in found):
        return 1
    failed = 0
    with join_graph() as graph:
        parameters = _remote(graph, options.node)
        for section in sections:
            if not section.matches(parameters.node):
                continue
            if options.no_use_wildcard and "*" in section.node:
                continue
            values = dict(flattened(nested(section.values)))
            for name, reason in zip(values, parameters.set(values), strict=True):
                good, bad = f"Set parameter {name} successful", f"Set parameter {name} failed"
                failed |= _told(reason, good, bad)
    return failed


def _nodes_with_parameters(graph: Graph) -> list[str]:
    """Return the global names of the nodes that offer parameters."""
    names = {one.name for one in graph.services(include_hidden=True)}
    return sorted(name.removesuffix(_MARK) for name in names if name.endswith(_MARK))


def _remote(graph: Graph, node: str) -> _RemoteParameters:
    """Return access to a node's parameters.

    Raises:
        ToolError: there is no such node, with the nearest names.
    """
    name = "/" + node.strip("/")
    there = _nodes_with_parameters(graph)
    if name not in there:
        raise ToolError(f"Node not found: '{name}' offers no parameters{hint(name, there)}")
    return _RemoteParameters(graph.create_node("ros2cli", anonymous=True, rosout=False), name)


def _type_word(kind: ParameterType) -> str:
    """ros2param's word of a type."""
    return kind.word.replace("bool", "boolean")


def _told(reason: str, good: str, bad: str) -> int:
    if reason:
        print(f"{bad}: {reason}", file=sys.stderr)
        return 1
    print(good)
    return 0


def _from_yaml(text: str) -> Any:
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        value = load_yaml(text)
    except YamlError as error:
        raise ToolError(f"the value is not YAML: {error}") from None
    if isinstance(value, str):
        # YAML 1.1 takes 1e-3 for a text.
        try:
            return float(value)
        except ValueError:
            return value
    return value


def _constraints(row: Any) -> list[str]:
    lines = [f"Read only: {str(row.read_only).lower()}"] if row.read_only else []
    for limits in (*row.floating_point_range, *row.integer_range):
        lines += [f"Min value: {limits.from_value}", f"Max value: {limits.to_value}"]
        lines += [f"Step: {limits.step}"] if limits.step else []
    if row.additional_constraints:
        lines.append(row.additional_constraints)
    return lines


def _branches(values: Mapping[str, Any]) -> dict[str, Any]:
    from gazelle.parameters.trees import nested

    return nested({name: value for name, value in values.items() if value is not None})


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ros2 param",
        description="Various param related sub-commands",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    rows = (
        ("delete", "Delete parameter", ("node", "name")),
        ("describe", "Show descriptive information about declared parameters", ("node", "names")),
        ("dump", "Show all of the parameters of a node in a YAML file format", ("node",)),
        ("get", "Get parameter", ("node", "name")),
        ("list", "Output a list of available parameters", ("node?",)),
        ("load", "Load parameter file for a node", ("node", "file")),
        ("set", "Set parameter", ("node", "name", "value")),
    )
    choices = add_verbs(parser, {name: about for name, about, _ in rows})
    for name, _, arguments in rows:
        for argument in arguments:
            _add(choices[name], argument)
    choices["get"].add_argument("--hide-type", action="store_true", help="Hide the type")
    choices["list"].add_argument("--filter", help="Only list parameters matching this regex")
    choices["list"].add_argument("--param-prefixes", nargs="+", default=[], help="Only with these")
    choices["list"].add_argument("--param-type", action="store_true", help="Print the types")
    choices["dump"].add_argument("--output-dir", type=Path, help="Write <node>.yaml there")
    choices["load"].add_argument("--no-use-wildcard", action="store_true", help="Leave /** out")
    for verb in choices.values():
        verb.add_argument("--spin-time", help=argparse.SUPPRESS)
        verb.add_argument("--no-daemon", action="store_true", help=argparse.SUPPRESS)
        verb.add_argument("--include-hidden-nodes", action="store_true", help=argparse.SUPPRESS)
    return parser


def _add(verb: argparse.ArgumentParser, argument: str) -> None:
    about = {
        "node": "Name of the ROS node",
        "node?": "Name of the ROS node; all nodes when it is not given",
        "name": "Name of the parameter",
        "names": "Names of the parameters",
        "value": "Value of the parameter, in YAML",
        "file": "Parameter file",
    }[argument]
    count = {"names": "+", "node?": "?"}.get(argument)
    verb.add_argument(argument.rstrip("?"), nargs=count, help=about)


_VERBS: dict[str, Callable[[argparse.Namespace], int]] = {
    "delete": run_delete,
    "describe": run_describe,
    "dump": run_dump,
    "get": run_get,
    "list": run_list,
    "load": run_load,
    "set": run_set,
}
