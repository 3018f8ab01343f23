"""Reading the parameters of a node, or of a part of one, by its table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.nodes.findings import log_findings
from gazelle.nodes.parameters import parameter_tree
from gazelle.parameters import ParameterTable
from gazelle.parameters.owner import ParameterOwner
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.sources import TreeSource

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.arguments import NodeArguments

__all__ = ["namespace_parameters", "node_reader", "number_or_end", "private_parameters"]

# Nav2's launch files give autostart to all nodes of a container; lifecycle_manager reads it.
_EVERYWHERE = frozenset(
    {"use_sim_time", "bond_disable_heartbeat_timeout", "qos_overrides", "autostart"}
)


def node_reader(
    table: ParameterTable,
    tree: Mapping[str, Any],
    name: str,
    diagnostics: Diagnostics,
    *,
    ros_version: int = 0,
) -> ParameterReader:
    """Return typed access to parameters; what is wrong is reported where it is read.

    Args:
        table: what there is.
        tree: the values that were given.
        name: what messages call the owner, such as ``/move_base/local_costmap``.
        diagnostics: receives what is wrong.
        ros_version: of ROS, whose defaults count; 0 where the table is of one generation.
    """
    owner = ParameterOwner(name, managed=_EVERYWHERE)
    return ParameterReader(table, TreeSource(tree), owner, diagnostics, ros_version=ros_version)


@contextmanager
def private_parameters(
    node: Node, arguments: NodeArguments, table: ParameterTable
) -> Iterator[ParameterReader]:
    """Give typed access to what lies below ``~``; at the end the node logs what is wrong.

    That is what could not be read, what the table lacks and what has no effect.

    Args:
        node: the owner.
        arguments: of the command line; their values count more than those of the store.
        table: what there is.
    """
    found = Diagnostics()
    tree = parameter_tree(node, arguments)
    reader = node_reader(table, tree, node.name, found, ros_version=arguments.ros_version)
    try:
        yield reader
    finally:
        # Also where the node ends: a name that is misspelt is often why.
        reader.report_unknown()
        log_findings(node, found)


@contextmanager
def namespace_parameters(
    node: Node, arguments: NodeArguments, table: ParameterTable
) -> Iterator[ParameterReader]:
    """Give typed access to parameters beside a node, in its namespace, as some of ROS 1 read them.

    At the end the node logs what could not be read, and that what lies below ``~`` has no effect.

    Args:
        node: the owner.
        arguments: of the command line; their values lie below ``~``.
        table: what there is.
    """
    found = Diagnostics()
    store, ros_version = node.parameters, arguments.ros_version
    beside = {row.key: store.get(row.key) for row in table.rows if store.has(row.key)}
    source = TreeSource(beside, full_name=node.resolve_name)
    owner = ParameterOwner(node.name, managed=_EVERYWHERE)
    try:
        yield ParameterReader(table, source, owner, found, ros_version=ros_version)
        places = {row.key: node.resolve_name(row.key) for row in table.rows if ros_version == 1}
        misplaced = {key: f"the node reads {place}" for key, place in places.items()}
        below = TreeSource(parameter_tree(node, arguments))
        owner = replace(owner, refused=misplaced)
        ParameterReader(table, below, owner, found, ros_version=ros_version).report_unknown()
    finally:
        log_findings(node, found)


def number_or_end(own: ParameterReader, key: str, default: float | None = None) -> float:
    """Return a number of a node that ends where it is none; `default` in place of the table's.

    Raises:
        LaunchError: it is none, nor is a text that could be read as one.
    """
    value = own.raw(key)
    if not own.has(key) or (isinstance(value, int | float) and not isinstance(value, bool)):
        return own.number(key, default)
    name = own.full_name(key)
    raise LaunchError(
        f"parameter '{f'{own.name}/{key}' if name == key else name}' is {value!r}, not a number"
    )
