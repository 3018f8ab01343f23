"""Reading the parameters of a node, or of a part of one, by its table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.parameters import ParameterTable
from gazelle.parameters.owner import ParameterOwner
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.sources import TreeSource

__all__ = ["node_reader"]

# Nav2's launch files give autostart to all nodes of a container; lifecycle_manager reads it.
_EVERYWHERE = frozenset(
    {"use_sim_time", "bond_disable_heartbeat_timeout", "qos_overrides", "autostart"}
)


def node_reader(
    table: ParameterTable, tree: Mapping[str, Any], name: str, diagnostics: Diagnostics
) -> ParameterReader:
    """Return typed access to parameters; what is wrong is reported where it is read.

    Args:
        table: what there is.
        tree: the values that were given.
        name: what messages call the owner, such as ``/move_base/local_costmap``.
        diagnostics: receives what is wrong.
    """
    owner = ParameterOwner(name, managed=_EVERYWHERE)
    return ParameterReader(table, TreeSource(tree), owner, diagnostics)
