"""Parameters of nodes that send goals: typed as ``rclpy`` has them, and goals by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.findings import log_findings
from gazelle.nodes.nav2.starting import offer_parameters
from gazelle.nodes.parameters import parameter_tree, start_node
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = ["GoalParameters", "are_numbers", "start"]

_SECOND_NS = 1_000_000_000
_EVERYWHERE = ("use_sim_time", "qos_overrides")
_TYPES = {bool: "BOOL", int: "INTEGER", float: "DOUBLE", str: "STRING", list: "STRING_ARRAY"}


class GoalParameters:
    """The parameters of one node.

    Attributes:
        tree: the values, nested: those given over the defaults.
        goal_names: goals, in the order they are sent.
        period_ns: time between two of them, and before the first.

    Raises:
        LaunchError: a value has another type than its default, or there is no goal.
    """

    def __init__(self, given: Mapping[str, Any], defaults: Mapping[str, Any]) -> None:
        """Put what was given over the defaults."""
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

    def unknown(self, known: Mapping[str, Any], *groups: str) -> Iterator[tuple[str, str]]:
        """Yield parameters that nobody reads, with a hint.

        Args:
            known: names that are read.
            *groups: the same, of subtrees.
        """
        heads = {name.partition(".")[0] for name in (*self.goal_names, *groups, *_EVERYWHERE)}
        for name in dict(values_only(flattened(self.tree))):
            head = name.partition(".")[0]
            if name not in known and head not in heads:
                hint = did_you_mean(head, (*known, *self.goal_names))
                yield name, hint or "add it to 'goal_names' where it is a goal"


def start(
    arguments: NodeArguments, graph: Graph, defaults: Mapping[str, Any], *groups: str
) -> tuple[Node, GoalParameters]:
    """Make the graph node and read its parameters.

    Args:
        arguments: of the node.
        graph: where it lives.
        defaults: names and default values.
        *groups: subtrees that are read as well.

    Raises:
        LaunchError: see `GoalParameters`.
    """
    node = start_node(arguments, graph, offers_parameters=False)
    parameters = GoalParameters(parameter_tree(node, arguments), defaults)
    if parameters.value("use_sim_time") in (True, "true", "True"):
        node.clock.use(True)
    found = Diagnostics()
    for name, hint in parameters.unknown(defaults, *groups):
        text = f"{node.name}: parameter '{name}' is not read; it has no effect"
        found.report("parameter.unknown", text, fix=hint)
    log_findings(node, found)
    if arguments.generation != 1:
        offer_parameters(node, parameters.tree)
    return node, parameters


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
