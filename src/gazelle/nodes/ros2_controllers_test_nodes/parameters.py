"""Parameters of nodes that send goals: typed as ``rclpy`` has them, and goals by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import log_findings, offer_parameters, parameter_tree, start_node
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterOwner, ParameterReader, TreeSource
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = ["GOAL", "GoalParameters", "are_numbers", "reader_of", "start"]

GOAL = "<goal>"
"""Stands in a table for the names of goals, which are parameters themselves."""

_SECOND_NS = 1_000_000_000
_EVERYWHERE = frozenset({"use_sim_time", "qos_overrides"})
_UNKNOWN = "parameter '{name}' is not one of {family}, nor among its goal_names; it has no effect"
_TYPES = {bool: "BOOL", int: "INTEGER", float: "DOUBLE", str: "STRING", list: "STRING_ARRAY"}


class GoalParameters:
    """The parameters of one node.

    Args:
        given: the values, nested.
        table: what there is; exact rows have defaults, whose types count.

    Attributes:
        tree: the values, nested: those given over the defaults.
        goal_names: goals, in the order they are sent.
        period_ns: time between two of them, and before the first.

    Raises:
        LaunchError: a value has another type than its default, or there is no goal.
    """

    def __init__(self, given: Mapping[str, Any], table: ParameterTable) -> None:
        """Put what was given over the defaults."""
        defaults = {row.key: row.default for row in table.rows if row.is_exact}
        values = dict(values_only(flattened(given)))
        for name, default in defaults.items():
            _check_type(name, values.get(name, default), type(default))
        self.tree = nested({**defaults, **values})
        self.goal_names = tuple(str(name) for name in self.tree["goal_names"])
        self.period_ns = self.tree["wait_sec_between_publish"] * _SECOND_NS
        if not self.goal_names:
            raise LaunchError("parameter 'goal_names' is empty: there is nothing to publish")
        if self.period_ns <= 0:
            raise LaunchError("parameter 'wait_sec_between_publish' must be greater than 0 s")

    def value(self, name: str) -> Any:
        """Return a value by its name with dots, None when it was not given."""
        branch: Any = self.tree
        for word in name.split("."):
            branch = branch.get(word) if isinstance(branch, Mapping) else None
        return branch


def start(
    arguments: NodeArguments, graph: Graph, table: ParameterTable
) -> tuple[Node, GoalParameters]:
    """Make the graph node and read its parameters.

    Args:
        arguments: of the node.
        graph: where it lives.
        table: what there is.

    Raises:
        LaunchError: see `GoalParameters`.
    """
    node = start_node(arguments, graph, offers_parameters=False)
    given = parameter_tree(node, arguments)
    parameters = GoalParameters(given, table)
    if parameters.value("use_sim_time") in (True, "true", "True"):
        node.clock.use(True)
    found = Diagnostics()
    reader_of(table, given, node.name, parameters.goal_names, found).report_unknown()
    log_findings(node, found)
    if arguments.ros_version != 1:
        offer_parameters(node, parameters.tree)
    return node, parameters


def reader_of(
    table: ParameterTable,
    given: Mapping[str, Any],
    name: str,
    goals: Iterable[str],
    found: Diagnostics,
) -> ParameterReader:
    """Return a reader whose table has rows for each goal in the place of those of `GOAL`."""
    patterns = [row for row in table.rows if row.key.startswith(GOAL)]
    named = (replace(row, key=row.key.replace(GOAL, goal)) for goal in goals for row in patterns)
    rows = (*(row for row in table.rows if row not in patterns), *named)
    owner = ParameterOwner(name, managed=_EVERYWHERE, unknown=_UNKNOWN)
    return ParameterReader(replace(table, rows=rows), TreeSource(given), owner, found)


def are_numbers(value: Any) -> bool:
    """Tell whether a value is a list of numbers."""
    return isinstance(value, list) and all(
        isinstance(one, int | float) and not isinstance(one, bool) for one in value
    )


def _check_type(name: str, value: Any, wanted: type) -> None:
    if type(value) is not wanted:
        given = _TYPES.get(type(value), type(value).__name__)
        raise LaunchError(
            f"Trying to set parameter '{name}' to '{value}' of type '{given}', expecting type "
            f"'{_TYPES[wanted]}'"
        )
