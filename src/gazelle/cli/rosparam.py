"""``rosparam``: parameters listed, read, set, loaded, dumped and deleted."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from optparse import OptionParser, Values
from pathlib import Path
from typing import Any

from gazelle.cli.ros_tool import (
    Tool,
    ToolError,
    add_flag,
    global_name,
    hint,
    join_graph,
    option_parser,
    run_tool,
)
from gazelle.documents import TEXT_BYTES, read_limited, read_text_limited
from gazelle.documents.yaml import PYTHON_STYLE, ROSPARAM, YamlError, dump_yaml, load_yaml
from gazelle.errors import GraphError
from gazelle.graph import Graph
from gazelle.graph.names import join
from gazelle.parameters.trees import leaves_at, values_only

__all__ = ["delete", "dump", "get", "list_parameters", "load", "main", "set_value"]

_NAMESPACE_KEY = "_ns"
_NEXT_DOCUMENT = re.compile(r"^---(?=\s|$)", re.MULTILINE)
_NUMBER = re.compile(r"-[0-9.]")
_MAX_SIZE = 2**63 - 1
_USAGE = """rosparam is a command-line tool for getting, setting, and deleting parameters from the \
ROS Parameter Server.

Commands:
\trosparam set\tset parameter
\trosparam get\tget parameter
\trosparam load\tload parameters from file
\trosparam dump\tdump parameters to file
\trosparam delete\tdelete parameter
\trosparam list\tlist parameter names
"""


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosparam``."""
    return run_tool(_TOOL, argv)


def list_parameters(argv: list[str]) -> int:
    """Print the names of parameters."""
    parser = option_parser("rosparam", "list [namespace]")
    _, args = parser.parse_args(argv)
    if len(args) > 1:
        parser.error("too many arguments")
    namespace = global_name(args[0], "rosparam") if args else "/"
    start = namespace.rstrip("/") + "/"
    with join_graph() as graph:
        names = graph.parameters.names()
    print("\n".join(sorted(name for name in names if name.startswith(start))))
    return 0


def get(argv: list[str]) -> int:
    """Print a parameter, or all below a namespace, as YAML."""
    parser = option_parser("rosparam", "get [options] parameter")
    add_flag(parser, "-p", dest="pretty", text="pretty print. WARNING: not YAML-safe")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(argv)
    if len(args) != 1:
        parser.error(
            "too many arguments" if args else "invalid arguments. Please specify a parameter name"
        )
    name = global_name(args[0], "rosparam")
    if options.verbose:
        print(f"getting parameter [{name}]")
    with join_graph() as graph:
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


def dump(argv: list[str]) -> int:
    """Write all below a namespace to a YAML file, or to standard output."""
    parser = option_parser("rosparam", "dump [options] file [namespace]")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(argv)
    if len(args) > 2:
        parser.error("too many arguments")
    file, namespace = [*args, "", ""][:2]
    if options.verbose:
        print(f"dumping namespace [{namespace}] to file [{file or None}]")
    name = global_name(namespace, "rosparam")
    with join_graph() as graph:
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


def set_value(argv: list[str]) -> int:
    """Set a parameter to a YAML value, or to what a file holds."""
    parser = option_parser("rosparam", "set [options] parameter value")
    add = parser.add_option
    add("-t", "--textfile", metavar="TEXT_FILE", help="set parameters to contents of text file")
    add("-b", "--binfile", metavar="BINARY_FILE", help="set parameters to contents of binary file")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = _options(parser, argv)
    if options.textfile and options.binfile:
        parser.error("you may only specify one of --textfile or --binfile")
    has_file = bool(options.textfile or options.binfile)
    if not args:
        parser.error("invalid arguments. Please specify a parameter name")
    if len(args) == 1 and not has_file:
        parser.error("invalid arguments. Please specify a parameter value")
    if len(args) > 2:
        parser.error("too many arguments")
    value = _file_value(parser, options) if has_file else _yaml(args[1], "<command line>")
    with join_graph() as graph:
        _set(graph, global_name(args[0], "rosparam"), value, verbose=options.verbose)
    return 0


def load(argv: list[str]) -> int:
    """Set the parameters that a YAML file, or standard input, names."""
    parser = option_parser("rosparam", "load [options] file [namespace]")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("invalid arguments. Please specify a file name or - for stdin")
    if len(args) > 2:
        parser.error("too many arguments")
    namespace = global_name(args[1] if len(args) > 1 else "", "rosparam")
    text = _text(args[0], verbose=options.verbose)
    with join_graph() as graph:
        for values, own_namespace in _trees(text, args[0], namespace):
            if options.verbose:
                if own_namespace != namespace:
                    print(f"reading parameters into namespace [{own_namespace}]")
                print(
                    "\n".join(
                        f"{name}={value}"
                        for name, value in values_only(leaves_at(own_namespace, values))
                    )
                )
            _set(graph, own_namespace, values, verbose=False)
    return 0


def delete(argv: list[str]) -> int:
    """Delete a parameter or all below a namespace."""
    parser = option_parser("rosparam", "delete [options] parameter")
    add_flag(parser, "-v", dest="verbose", text="turn on verbose output")
    options, args = parser.parse_args(argv)
    if len(args) != 1:
        parser.error(
            "too many arguments" if args else "invalid arguments. Please specify a parameter name"
        )
    name = global_name(args[0], "rosparam")
    with join_graph() as graph:
        if name == "/":
            graph.parameters.set("/", {})
            done = "deleted ENTIRE parameter server"
        else:
            try:
                graph.parameters.delete(name)
            except KeyError:
                near = hint(name, graph.parameters.names())
                raise ToolError(f"parameter [{name}] is not set{near}") from None
            done = f"deleted parameter [{name}]"
    if options.verbose:
        print(done)
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


def _options(parser: OptionParser, argv: list[str]) -> tuple[Values, list[str]]:
    """Parse options, and leave negative numbers what they are."""
    numbers = {f"\0{index}": word for index, word in enumerate(argv) if _NUMBER.match(word)}
    hidden = [f"\0{index}" if _NUMBER.match(word) else word for index, word in enumerate(argv)]
    options, args = parser.parse_args(hidden)
    return options, [numbers.get(word, word) for word in args]


def _set(graph: Graph, name: str, value: Any, *, verbose: bool) -> None:
    """Set a value; a dictionary updates the namespace and leaves its other parameters."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if not isinstance(key, str):
                raise ToolError(
                    f"YAML dictionaries must have string keys. Invalid dictionary is:\n{value}"
                )
            _set(graph, join(name, key), inner, verbose=verbose)
        return
    if isinstance(value, int) and abs(value) > _MAX_SIZE:
        raise ToolError(f"Overflow: parameters are whole numbers up to {_MAX_SIZE}, not {value}")
    if value is None:
        raise ToolError(f"Parameter [{name}] cannot be null: parameters always have a value")
    try:
        graph.parameters.set(name, value)
    except GraphError as error:
        raise ToolError(f"Parameter [{name}]: {error}") from None
    if verbose:
        print(f"set parameter [{name}] to [{value}]")


def _file_value(parser: OptionParser, options: Values) -> str | bytes:
    path = Path(options.textfile or options.binfile)
    if not path.is_file():
        parser.error(f"file '{path}' does not exist")
    if options.textfile:
        return _file_text(path)
    try:
        return read_limited(path, TEXT_BYTES)
    except OSError as error:
        raise ToolError(f"cannot read [{path}]: {error.strerror}") from None


def _file_text(path: Path) -> str:
    try:
        return read_text_limited(path)
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise ToolError(f"cannot read [{path}]: {reason}") from None


def _text(file: str, *, verbose: bool) -> str:
    if file == "-":
        if verbose:
            print("reading parameters from stdin")
        return sys.stdin.read()
    path = Path(file)
    if not path.is_file():
        raise ToolError(f"file [{file}] does not exist")
    if verbose:
        print(f"reading parameters from [{file}]")
    return _file_text(path)


def _trees(text: str, file: str, namespace: str) -> Iterator[tuple[dict[str, Any], str]]:
    """Yield each document's parameters and the namespace they belong into."""
    for part in _NEXT_DOCUMENT.split(text):
        values = _yaml(part, file) if part.strip() else None
        if values is None or values == "":
            continue
        if not isinstance(values, dict):
            raise ToolError(f"[{file}] must hold 'name: value' pairs, it holds {values!r}")
        own = values.pop(_NAMESPACE_KEY, None)
        yield values, join(namespace, own) if own else namespace


def _yaml(text: str, file: str) -> Any:
    try:
        return load_yaml(text, ROSPARAM) if text else ""
    except YamlError as error:
        raise ToolError(f"[{file}] is not YAML: {error}") from None


_TOOL = Tool(
    "rosparam",
    {
        "delete": delete,
        "dump": dump,
        "get": get,
        "list": list_parameters,
        "load": load,
        "set": set_value,
    },
    _USAGE,
    usage_code=0,
    takes_remappings=False,
)
