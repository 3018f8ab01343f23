"""``dynparam``: the parameters of nodes that dynamic_reconfigure can change."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from optparse import OptionParser
from pathlib import Path
from typing import Any

from gazelle.cli.ros_tool import Tool, ToolError, hint, join_graph, run_tool
from gazelle.cli.text.fill_message import yaml_words
from gazelle.graph import (
    Graph,
    Node,
    ServiceCallError,
    ServiceTimeoutError,
    ServiceUnavailableError,
)
from gazelle.graph.dynamic_reconfigure import ReconfigureClient, ReconfigureError, server_names
from gazelle.graph.dynamic_reconfigure.messages import config_tree, group_states
from gazelle.graph.names import CommandLine, parse_command_line

__all__ = ["main"]

_USAGE = """dynparam is a command-line tool for getting, setting, and
deleting parameters of a dynamically configurable node.

Commands:
\tdynparam set                  configure node
\tdynparam set_from_parameters  copy configuration from parameter server
\tdynparam get                  get node configuration
\tdynparam load                 load configuration from file
\tdynparam dump                 dump configuration to file
\tdynparam list                 list configurable nodes

Type dynparam <command> -h for more detailed usage, e.g. 'dynparam get -h'
"""
_TAG = "tag:yaml.org,2002:python/object/new:dynamic_reconfigure.encoding.Config"
_FIRST_S = 1.0
_NO_NODE = "invalid arguments. Please specify a node name"
_NO_VALUES = (
    "invalid arguments. Please specify either a node name, parameter name and parameter value, or"
    " a node name and a YAML dictionary"
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``dynparam``."""
    line = parse_command_line(argv)
    commands: dict[str, str | Callable[[list[str]], int]] = {
        "list": partial(_list, line),
        "get": partial(_get, line),
        "set": partial(_set, line),
        "set_from_parameters": partial(_set_from_parameters, line),
        "dump": partial(_dump, line),
        "load": partial(_load, line),
    }
    return run_tool(Tool("dynparam", commands, _USAGE, usage_code=1), line.rest)


def _list(line: CommandLine, argv: list[str]) -> int:
    del argv
    with _node(line) as (graph, _):
        for name in server_names(graph):
            print(name)
    return 0


def _get(line: CommandLine, argv: list[str]) -> int:
    timeout_s, (name,) = _arguments(argv, "get [options] node", (_NO_NODE,))
    with _node(line) as (graph, node):
        found = _configuration(graph, node, name, timeout_s)
        if found is not None:
            print(found)
    return 0


def _set(line: CommandLine, argv: list[str]) -> int:
    usage = "set [options] node parameter value\n   or: %prog set [options] node values"
    values, argv = _split(argv)
    parser = _parser(usage)
    options, _ = parser.parse_args(argv)
    if len(values) > 3:
        parser.error("too many arguments")
    if len(values) < 2:
        parser.error(_NO_VALUES)
    name = values[0]
    changes: Any = {values[1]: values[2]} if len(values) == 3 else yaml_words([values[1]])[0]
    if not isinstance(changes, dict):
        parser.error(_NO_VALUES)
    with _node(line) as (graph, node):
        try:
            _change(graph, node, name, changes, options.timeout)
        except (ToolError, ServiceCallError, ServiceTimeoutError, ServiceUnavailableError):
            print(f"couldn't set parameters at node {name}")
    return 0


def _set_from_parameters(line: CommandLine, argv: list[str]) -> int:
    timeout_s, (name,) = _arguments(argv, "set_from_parameters [options] node", (_NO_NODE,))
    with _node(line) as (graph, node):
        found = node.parameters.get("~", None)
        if not isinstance(found, dict):
            text = "error updating parameters: no parameters found on parameter server"
            print(text, file=sys.stderr)
            return 0
        _change(graph, node, name, found, timeout_s)
    return 0


def _dump(line: CommandLine, argv: list[str]) -> int:
    problems = (_NO_NODE, "invalid arguments. Please specify an output file")
    timeout_s, (name, path) = _arguments(argv, "dump [options] node file", problems)
    with _node(line) as (graph, node):
        found = _configuration(graph, node, name, timeout_s)
    if found is None:
        print(f"couldn't get parameters from node {name}")
        return 0
    try:
        Path(path).write_text(_as_yaml(found), encoding="utf-8")
    except OSError as error:
        raise ToolError(f"cannot write '{path}': {error.strerror}") from None
    return 0


def _load(line: CommandLine, argv: list[str]) -> int:
    problems = (_NO_NODE, "invalid arguments. Please specify an input file")
    timeout_s, (name, path) = _arguments(argv, "load [options] node file", problems)
    changes = _from_yaml(path)
    with _node(line) as (graph, node):
        _change(graph, node, name, changes, timeout_s)
    return 0


def _split(argv: list[str]) -> tuple[list[str], list[str]]:
    """Return values and options of ``set``; negative numbers are values."""
    values, options = [], []
    rest = iter(argv)
    for word in rest:
        if not word.startswith("-") or word[1:2].isdigit():
            values.append(word)
        else:
            options.append(word)
            if word in {"-t", "--timeout"}:
                options += [next(rest)] if len(argv) > len(values) + len(options) else []
    return values, options


def _arguments(
    argv: list[str], usage: str, problems: tuple[str, ...]
) -> tuple[float | None, list[str]]:
    """Return the timeout and the words, as many as there are texts for their absence."""
    parser = _parser(usage)
    options, rest = parser.parse_args(argv)
    if len(rest) < len(problems):
        parser.error(problems[len(rest)])
    if len(rest) > len(problems):
        parser.error("too many arguments")
    return options.timeout, rest


def _parser(usage: str) -> OptionParser:
    parser = OptionParser(usage=f"Usage: %prog {usage}", prog="dynparam")
    parser.add_option(
        "-t", "--timeout", action="store", type="float", default=None, help="timeout in secs"
    )
    return parser


@contextmanager
def _node(line: CommandLine) -> Iterator[tuple[Graph, Node]]:
    """Join the graph as the node that a launch file names, or as an anonymous one."""
    with join_graph() as graph:
        node = graph.create_node(
            line.name or "dynparam",
            namespace=line.namespace,
            remappings=line.remappings,
            anonymous=line.name is None,
        )
        for key, value in line.params.items():
            node.parameters.set(f"~{key}", value)
        yield graph, node


def _client(graph: Graph, node: Node, name: str, timeout_s: float | None) -> ReconfigureClient:
    """Return the client of a server that is there.

    Raises:
        ToolError: it did not come in time.
    """
    client = ReconfigureClient(node, name)
    service = f"{client.name}/set_parameters"
    if timeout_s:
        if not client.wait_for_server(timeout_s):
            near = hint(client.name, server_names(graph))
            raise ToolError(f"timeout exceeded while waiting for service {service}{near}")
    elif not client.wait_for_server(_FIRST_S):
        near = hint(client.name, server_names(graph))
        print(f"Waiting for service {service}...{near}", file=sys.stderr)
        client.wait_for_server()
    return client


def _configuration(
    graph: Graph, node: Node, name: str, timeout_s: float | None
) -> dict[str, Any] | None:
    client = _client(graph, node, name, timeout_s)
    if timeout_s:
        client.wait_for_values(timeout_s)
    elif client.wait_for_values(_FIRST_S) is None:
        print("Waiting for configuration...", file=sys.stderr)
        client.wait_for_values()
    return None if client.config is None else config_tree(client.config, client.description)


def _change(
    graph: Graph, node: Node, name: str, changes: Mapping[str, Any], timeout_s: float | None
) -> None:
    client = _client(graph, node, name, timeout_s)
    group = client.wait_for_description(timeout_s or None)
    states = None if group is None else group_states(group, changes.get("groups"))
    values = {key: value for key, value in changes.items() if key != "groups"}
    try:
        client.set(values, states=states or None, timeout_s=timeout_s or None)
    except ReconfigureError as error:
        print(f"error updating parameters: {error}")


def _as_yaml(found: dict[str, Any]) -> str:
    """Return the file that the original's ``yaml.dump`` writes, with the tags of its class."""
    from gazelle.documents.yaml import TaggedMapping, dump_yaml

    def tagged(tree: dict[str, Any]) -> TaggedMapping:
        items = {key: tagged(one) if isinstance(one, dict) else one for key, one in tree.items()}
        return TaggedMapping(_TAG, {**({"dictitems": items} if items else {}), "state": []})

    return dump_yaml(tagged(found))


def _dict_items(state: dict[Any, Any]) -> Any:
    return state.get("dictitems", {})


def _from_yaml(path: str) -> dict[str, Any]:
    """Return what a file of ``dynparam dump`` or a plain YAML file says; it runs no code.

    Raises:
        ToolError: the file cannot be read, or is no YAML dictionary.
    """
    from gazelle.documents import read_text_limited
    from gazelle.documents.yaml import Dialect, YamlError, load_yaml_documents

    dialect = Dialect(tags=((_TAG, _dict_items),))
    found: dict[str, Any] = {}
    try:
        for document in load_yaml_documents(read_text_limited(path), dialect):
            found.update(document)
    except OSError as error:
        raise ToolError(f"cannot read '{path}': {error.strerror}") from None
    except (YamlError, UnicodeDecodeError, TypeError, ValueError) as error:
        raise ToolError(f"'{path}' is not a YAML dictionary of parameters: {error}") from None
    return found
