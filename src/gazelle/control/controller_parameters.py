"""Tables that describe a controller, and reading its parameters by them.

The reader takes its defaults from a table, and `docs/controllers.md` is generated from it, so the
page cannot say anything else than the code does. Keys that nobody asked for are reported.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.parameters import ParameterTable, Topic
from gazelle.parameters.reader import ParameterOwner, ParameterReader, TreeSource

__all__ = ["ControllerTable", "controller_parameters"]


@dataclass(frozen=True, slots=True)
class ControllerTable:
    """Everything the documentation says about one family of controllers.

    Attributes:
        parameters: family, summary and rows; types of both generations, of which ROS 1's have the
            hardware interface in them.
        interfaces: what it claims and reads, in words.
        topics: topics, services and actions.
        behaviour: facts of behaviour, one sentence each, with their source.
    """

    parameters: ParameterTable
    interfaces: str
    topics: tuple[Topic, ...] = ()
    behaviour: tuple[str, ...] = ()


# Keys every controller may have that the controller manager itself reads. Launch files give the
# description to all nodes of the process.
_MANAGED = frozenset(
    {
        "type",
        "use_sim_time",
        "params_file",
        "node_options_args",
        "update_rate",
        "is_async",
        "robot_description",
    }
)

# Keys of every controller's that change nothing here, and why.
_IDLE = {"fallback_controllers": "a controller that fails is stopped, no other takes its place"}


def controller_parameters(
    name: str,
    tree: Mapping[str, Any],
    table: ParameterTable,
    diagnostics: Diagnostics,
    *,
    full_name: Callable[[str], str] = str,
    span: Callable[[str], SourceSpan | None] = lambda key: None,
) -> ParameterReader:
    """Return typed access to one controller's parameters.

    Args:
        name: the controller's name, for messages.
        tree: its parameters, nested or with dots.
        table: known keys with defaults.
        diagnostics: receives what is wrong.
        full_name: the name a user knows a key by, such as ``/mira/roll_controller/pid/p``.
        span: where a key stands, None when unknown.
    """
    owner = ParameterOwner(
        name,
        f"controller '{name}'",
        unknown="parameter '{name}' is not one of this controller; it has no effect",
        idle="parameter '{name}' has no effect: {why}",
        bad_phrase="Could not load parameter",
        managed=_MANAGED,
        refused=_IDLE,
        takes_nan=True,
        missing=ControllerError,
    )
    source = TreeSource(tree, full_name=full_name, span=span)
    return ParameterReader(table, source, owner, diagnostics)
