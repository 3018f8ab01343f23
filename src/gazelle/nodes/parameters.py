"""Starting a built-in node; reading its parameters by a table, saying what is wrong with them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.announcements import announce_by
from gazelle.diagnostics import Diagnostic, Diagnostics, brief
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Level, Node, TimeJumpError, offer_loggers
from gazelle.graph.console import aside_path, level_of, write_aside
from gazelle.graph.log_output import keep_log, print_ros2
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters, ParameterPolicy
from gazelle.nodes.arguments import NodeArguments, file_params
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterOwner, ParameterReader, TreeSource
from gazelle.parameters.trees import flattened, nested, values_only

if TYPE_CHECKING:
    from gazelle.graph.dynamic_reconfigure import DynamicParameter, ReconfigureServer

__all__ = [
    "OF_EVERY_NODE",
    "log_findings",
    "namespace_parameters",
    "node_parameters",
    "node_reader",
    "number_or_end",
    "offer_dynamic_reconfigure",
    "offer_parameters",
    "parameter_tree",
    "private_parameters",
    "start_node",
    "start_ros2_node",
    "ticks",
    "tree_of_node",
    "use_own_sim_time",
]


_LEVELS = {10: "info", 20: "warn", 30: "error"}
_SIM_TIME = "use_sim_time"
_RECONFIGURE_TYPES = {"number": "double", "integer": "int", "flag": "bool", "text": "str"}

# Nav2's launch files give autostart to all nodes of a container; lifecycle_manager reads it.
OF_EVERY_NODE = frozenset(
    {"use_sim_time", "bond_disable_heartbeat_timeout", "qos_overrides", "autostart"}
)
"""Parameters that every node may be given."""


def log_findings(
    node: Node, diagnostics: Diagnostics, text_of: Callable[[Diagnostic], str] = str
) -> bool:
    """Say what was found; parameters without effect are summed, and listed in the log file.

    So is what works and asks for nothing, which the terminal is spared.
    A node that logs at level debug says all of it.

    Args:
        node: logs it.
        diagnostics: what was found.
        text_of: a finding in words.

    Returns:
        whether there was no error.
    """
    shown, kept = brief(diagnostics, str(aside_path(node)))
    if kept and (node.log_level <= Level.DEBUG or not write_aside(node, map(text_of, kept))):
        shown = tuple(diagnostics)
    for item in shown:
        node.log(_LEVELS[int(item.severity)], text_of(item), depth=2)
    return not diagnostics.errors


def start_node(arguments: NodeArguments, graph: Graph, *, offers_parameters: bool = True) -> Node:
    """Make the graph node of a built-in node, with its names and remaps.

    One of ROS 2 offers the parameters that it was started with; `node_parameters` says more.

    Args:
        arguments: of the command line.
        graph: takes the node.
        offers_parameters: whether it does; not where the node offers them by other means, since
            of two servers of one service any may answer.
    """
    ros2 = arguments.ros_version == 2
    with graph.announcements.together():
        node = graph.create_node(
            arguments.name,
            namespace=arguments.namespace,
            remappings=arguments.remappings,
            is_ros2=ros2,
        )
        # Its own threads may be at work when it is shut down.
        node.outlives = True
        if ros2:
            node.console = print_ros2
            if node.parameters.has(node.name):
                # In ROS 2 parameters end with their node; these are of one that had this name.
                node.parameters.delete(node.name)
            if offers_parameters:
                _offer_given(node, arguments.params)
        keep_log(node, arguments.log_file, arguments.output)
        announce_by(lambda text: node.log("info", text))
        offer_loggers(node)
    if arguments.log_level:
        node.log_level = level_of(arguments.log_level)
    for name, value in arguments.params.items():
        node.parameters.set(node.resolve_name(f"~{name}"), value)
    return node


def start_ros2_node(arguments: NodeArguments, graph: Graph) -> tuple[Node, dict[str, Any]]:
    """Make the graph node; returns it and its parameters, nested, for `offer_parameters`."""
    node = start_node(arguments, graph, offers_parameters=False)
    tree = nested(arguments.params)
    use_own_sim_time(node, tree)
    return node, tree


def use_own_sim_time(node: Node, params: Mapping[str, Any]) -> None:
    """Let ROS 2's parameter ``use_sim_time`` count before a simulator is there to say it for all.

    Who starts before the simulator would stamp its first messages with wall time otherwise.
    """
    if params.get("use_sim_time") in (True, "true", "True"):
        node.clock.use(True)


def node_parameters(
    node: Node,
    values: Mapping[str, Any],
    on_set: Callable[[dict[str, Any]], str] = lambda changes: "",
    *,
    descriptors: Mapping[str, Descriptor] | None = None,
    allow_undeclared: bool = False,
) -> NodeParameters:
    """Offer the parameters of a built-in node to ``ros2 param``.

    Args:
        node: on the graph, started with ``offers_parameters=False``.
        values: by name, with dots.
        on_set: hears changes before they count; returns why they are refused, or nothing.
        descriptors: what is said about them.
        allow_undeclared: setting a name that is not declared declares it.
    """
    return NodeParameters(
        node,
        node.name,
        values,
        on_set,
        descriptors=descriptors,
        policy=ParameterPolicy(allow_undeclared=allow_undeclared),
        now_ns=node.clock.now_ns,
    )


def offer_parameters(
    node: Node,
    tree: Mapping[str, Any],
    changed: Callable[[dict[str, Any]], str] = lambda changes: "",
) -> NodeParameters:
    """Offer a node's parameters to ``ros2 param``; `changed` may refuse with a reason."""
    values = {key: value for key, value in values_only(flattened(tree)) if value is not None}
    return node_parameters(node, values, changed, allow_undeclared=True)


def offer_dynamic_reconfigure(
    node: Node, namespace: str, settings: ParameterReader, changed: Callable[[dict[str, Any]], None]
) -> ReconfigureServer | None:
    """Offer a table's live parameters to dynamic_reconfigure; None when there are none.

    Args:
        node: the owner.
        namespace: absolute, such as ``/move_base/local_costmap``.
        settings: present values and their table.
        changed: hears all live values after each change.
    """
    from gazelle.graph.dynamic_reconfigure import ReconfigureServer

    rows = [row for row in settings.table.rows if row.live and row.kind in _RECONFIGURE_TYPES]
    if not rows:
        return None

    def on_change(values: dict[str, Any], _level: int) -> None:
        changed(dict(values))

    group = [_dynamic_parameter(row, settings.value(row)) for row in rows]
    return ReconfigureServer(node, namespace, group, on_change)


def tree_of_node(arguments: NodeArguments, full_name: str) -> dict[str, Any]:
    """Return the parameters of another node of the same process, nested."""
    return nested(file_params(arguments.parameter_files, full_name))


def parameter_tree(node: Node, arguments: NodeArguments) -> dict[str, Any]:
    """Return all parameters of a node, nested: the command line's over those of the store.

    A file of ROS 2 that was loaded into a node of ROS 1 counts by what it says, not by its heads.
    """
    stored = node.parameters.get(node.name, {}) or {}
    heads = [key for key, value in stored.items()
             if isinstance(value, dict) and "ros__parameters" in value]  # fmt: skip
    tree = nested({key: value for key, value in stored.items() if key not in heads})
    for key in heads:
        tree = {**nested(stored[key]["ros__parameters"] or {}), **tree}
    # What the command line says of a branch leaves the rest of it.
    return nested({**dict(flattened(tree)), **dict(flattened(nested(arguments.params)))})


def ticks(node: Node, period_ns: int, stop: threading.Event) -> Iterator[int]:
    """Yield the time at every period of the node's clock until told to stop.

    A period that is missed is not made up for; a jump back in time, also while the caller works,
    and a change to simulated time start anew from there.
    """
    jumps = node.clock.jumps
    next_ns = node.clock.now_ns() + period_ns
    while not stop.is_set():
        try:
            if not node.clock.sleep_until(next_ns, stop, since=jumps):
                return
        except TimeJumpError:
            jumps = node.clock.jumps
            next_ns = node.clock.now_ns() + period_ns
            continue
        now_ns = node.clock.now_ns()
        yield now_ns
        next_ns = max(next_ns, now_ns - period_ns) + period_ns


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
    owner = ParameterOwner(name, managed=OF_EVERY_NODE)
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
    owner = ParameterOwner(node.name, managed=OF_EVERY_NODE)
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


def _offer_given(node: Node, given: Mapping[str, Any]) -> None:
    def refused(changes: dict[str, Any]) -> str:
        for name in changes:
            if name != _SIM_TIME:
                return (
                    f"parameter '{name}' is read when {node.name} starts; start it with "
                    f"-p {name}:=… or a file of parameters"
                )
        if _SIM_TIME in changes:
            node.clock.use(bool(changes[_SIM_TIME]))
        return ""

    values = {
        name: value for name, value in values_only(flattened(nested(given))) if value is not None
    }
    node_parameters(node, {_SIM_TIME: False, **values}, refused)


def _dynamic_parameter(row: Parameter, value: Any) -> DynamicParameter:
    from gazelle.graph.dynamic_reconfigure import DynamicParameter

    kind = _RECONFIGURE_TYPES[row.kind]
    low, high = (None, None) if kind in ("bool", "str") else (row.low, row.high)
    meaning = f"{row.meaning} [{row.unit}]" if row.unit else row.meaning
    return DynamicParameter(row.key, kind, value, meaning, low, high)
