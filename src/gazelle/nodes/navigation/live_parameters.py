"""dynamic_reconfigure for the rows of a table that are live."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.graph.dynamic_reconfigure import DynamicParameter, ReconfigureServer
from gazelle.parameters import Parameter
from gazelle.parameters.reader import ParameterReader

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["offer"]

_TYPES = {"number": "double", "integer": "int", "flag": "bool", "text": "str"}


def offer(
    node: Node, namespace: str, settings: ParameterReader, changed: Callable[[dict[str, Any]], None]
) -> ReconfigureServer | None:
    """Offer the live parameters; None when there are none.

    Args:
        node: the owner.
        namespace: absolute, such as ``/move_base/local_costmap``.
        settings: present values and their table.
        changed: hears all live values after each change.
    """
    rows = [row for row in settings.table.rows if row.live and row.kind in _TYPES]
    if not rows:
        return None

    def on_change(values: dict[str, Any], _level: int) -> None:
        changed(dict(values))

    group = [_parameter(row, settings.value(row)) for row in rows]
    return ReconfigureServer(node, namespace, group, on_change)


def _parameter(row: Parameter, value: Any) -> DynamicParameter:
    kind = _TYPES[row.kind]
    low, high = (None, None) if kind in ("bool", "str") else (row.low, row.high)
    meaning = f"{row.meaning} [{row.unit}]" if row.unit else row.meaning
    return DynamicParameter(row.key, kind, value, meaning, low, high)
