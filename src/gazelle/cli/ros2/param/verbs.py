"""The verbs of ``ros2 param``."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.cli.ros2.param.remote import nodes_with_parameters, remote
from gazelle.cli.tool import ToolError, hint, joined
from gazelle.graph.ros2_parameter_values import ParameterType, parameter_type

__all__ = ["run_delete", "run_describe", "run_dump", "run_get", "run_list", "run_load", "run_set"]

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


def run_list(options: argparse.Namespace) -> int:
    """Print the parameters of one node, or of all."""
    with joined() as graph:
        names = [options.node] if options.node else nodes_with_parameters(graph)
        for node in names:
            parameters = remote(graph, node)
            found = parameters.names(options.param_prefixes)
            if options.filter:
                found = [name for name in found if re.search(options.filter, name)]
            if not options.node:
                print(f"{parameters.node}:")
            types = parameters.types(found) if options.param_type else []
            for place, name in enumerate(found):
                kind = f" (type: {_type_word(types[place])})" if types else ""
                print(f"  {name}{kind}")
    return 0


def run_get(options: argparse.Namespace) -> int:
    """Print one value."""
    with joined() as graph:
        parameters = remote(graph, options.node)
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
    with joined() as graph:
        reason = remote(graph, options.node).set({options.name: _from_yaml(options.value)})[0]
    return _told(reason, "Set parameter successful", "Setting parameter failed")


def run_delete(options: argparse.Namespace) -> int:
    """Delete a parameter: set it to nothing."""
    with joined() as graph:
        reason = remote(graph, options.node).set({options.name: None})[0]
    return _told(reason, "Deleted parameter successfully", "Deleting parameter failed")


def run_describe(options: argparse.Namespace) -> int:
    """Print what is said about parameters."""
    with joined() as graph:
        for row in remote(graph, options.node).describe(options.names):
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

    with joined() as graph:
        parameters = remote(graph, options.node)
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
    with joined() as graph:
        parameters = remote(graph, options.node)
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
