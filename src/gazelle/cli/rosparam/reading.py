"""``rosparam list``, ``get`` and ``dump``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle.cli.tool import ToolError, add_flag, global_name, hint, joined, option_parser
from gazelle.documents.yaml import PYTHON_STYLE, dump_yaml
from gazelle.graph import Graph
from gazelle.parameters.trees import leaves_at, values_only

__all__ = ["dump", "get", "listing"]


def listing(words: list[str]) -> int:
    """Print the names of parameters."""
    parser = option_parser("rosparam", "list [namespace]")
    _, args = parser.parse_args(words)
    if len(args) > 1:
        parser.error("too many arguments")
    namespace = global_name(args[0], "rosparam") if args else "/"
    start = namespace.rstrip("/") + "/"
    with joined() as graph:
        names = graph.parameters.names()
    print("\n".join(sorted(name for name in names if name.startswith(start))))
    return 0


def get(words: list[str]) -> int:
    """Print a parameter, or all below a namespace, as YAML."""
    parser = option_parser("rosparam", "get [options] parameter")
    add_flag(parser, "-p", dest="pretty", text="pretty print. WARNING: not YAML-safe")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(words)
    if len(args) != 1:
        parser.error(
            "too many arguments" if args else "invalid arguments. Please specify a parameter name"
        )
    name = global_name(args[0], "rosparam")
    if options.verbose:
        print(f"getting parameter [{name}]")
    with joined() as graph:
        value = _value(graph, name)
    if options.pretty and isinstance(value, str):
        print(value)
    elif options.pretty and isinstance(value, dict):
        print("\n".join(_pretty(value)))
    else:
        # A scalar's document is ended by "...", which the original takes off.
        text = dump_yaml(value, PYTHON_STYLE).removesuffix("\n...\n")
        print(text)
    return 0


def dump(words: list[str]) -> int:
    """Write all below a namespace to a YAML file, or to standard output."""
    parser = option_parser("rosparam", "dump [options] file [namespace]")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(words)
    if len(args) > 2:
        parser.error("too many arguments")
    file, namespace = [*args, "", ""][:2]
    if options.verbose:
        print(f"dumping namespace [{namespace}] to file [{file or None}]")
    name = global_name(namespace, "rosparam")
    with joined() as graph:
        value = _value(graph, name)
    if options.verbose:
        print("\n".join(f"{leaf}={item}" for leaf, item in values_only(leaves_at(name, value))))
    text = dump_yaml(value, PYTHON_STYLE)
    if not file:
        sys.stdout.write(text)
        return 0
    try:
        Path(file).write_text(text, encoding="utf-8")
    except OSError as error:
        raise ToolError(f"cannot write [{file}]: {error.strerror}") from None
    return 0


def _value(graph: Graph, name: str) -> Any:
    try:
        return graph.parameters.get(name)
    except KeyError:
        near = hint(name, graph.parameters.names())
        raise ToolError(f"Parameter [{name}] is not set{near}") from None


def _pretty(tree: dict[str, Any], indent: str = "") -> Iterator[str]:
    for key in sorted(tree):
        value = tree[key]
        if isinstance(value, dict):
            yield f"{indent}{key}:"
            yield from _pretty(value, indent + "  ")
        elif isinstance(value, str) and "\n" in value:
            yield f"{indent}{key}: |"
            yield from (f"{indent}  {line}" for line in value.split("\n"))
        elif isinstance(value, str):
            yield f"{indent}{key}: {value}"
        else:
            text = dump_yaml(value, PYTHON_STYLE).removesuffix("\n...\n").rstrip("\n")
            yield f"{indent}{key}: {text}"
