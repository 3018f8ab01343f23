"""Reading the parameters of a node, or of a part of one, by its table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.findings import log_findings
from gazelle.nodes.parameters import parameter_tree
from gazelle.parameters import ParameterTable
from gazelle.parameters.owner import ParameterOwner
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.sources import TreeSource

if TYPE_CHECKING:
    from gazelle.graph import Node
    from gazelle.nodes.arguments import NodeArguments

__all__ = ["node_reader", "private_parameters"]

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
    generation: int = 0,
) -> ParameterReader:
    """Return typed access to parameters; what is wrong is reported where it is read.

    Args:
        table: what there is.
        tree: the values that were given.
        name: what messages call the owner, such as ``/move_base/local_costmap``.
        diagnostics: receives what is wrong.
        generation: of ROS, whose defaults count; 0 where the table is of one generation.
    """
    owner = ParameterOwner(name, managed=_EVERYWHERE)
    return ParameterReader(table, TreeSource(tree), owner, diagnostics, generation=generation)


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
    generation = 2 if arguments.generation == 2 else 1
    reader = node_reader(table, tree, node.name, found, generation=generation)
    try:
        yield reader
        reader.report_unknown()
    finally:
        log_findings(node, found)
