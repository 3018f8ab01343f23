"""Configs and descriptions as nested dictionaries, the form ``dynamic_reconfigure.client`` gives.

Files of ``dynparam dump``, ``rosrun … dynparam get`` and programs with the Python client have it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.graph.reconfigure.description import DynamicGroup
from gazelle.graph.reconfigure.messages import values_from_message

__all__ = ["config_tree", "description_tree", "group_states"]

Tree = dict[str, Any]


def config_tree(config: Any, group: DynamicGroup | None = None, kind: type[Tree] = dict) -> Tree:
    """Return the values of a ``Config`` by name, and below ``groups`` once more by group.

    Args:
        config: the message.
        group: its description; without it, or without groups in the message, there are values
            only.
        kind: class of the dictionaries.
    """
    values = kind(values_from_message(config))
    if group is None or not config.groups:
        return values
    states = {item.id: item for item in config.groups}
    rows = group.numbered()

    def tree(own: int, parent: int, one: DynamicGroup) -> Tree:
        state = states[own].state if own in states else one.state
        found = _group_tree(own, parent, one, state, "", kind)
        for number, above, child in rows:
            if above == own and number:
                found["groups"][child.name] = tree(number, above, child)
        found.update({row.name: values[row.name] for row in one.parameters if row.name in values})
        return found

    values["groups"] = tree(*rows[0])
    return values


def description_tree(group: DynamicGroup, kind: type[Tree] = dict) -> Tree:
    """Return the description of all groups as ``decode_description`` does."""
    rows = group.numbered()

    def tree(own: int, parent: int, one: DynamicGroup) -> Tree:
        found = _group_tree(own, parent, one, True, one.type, kind)
        found["parameters"] = [
            {
                "name": row.name,
                "min": row.minimum,
                "max": row.maximum,
                "default": row.clamped(row.default),
                "type": row.type,
                "level": row.level,
                "description": row.description,
                "edit_method": row.edit_method,
            }
            for row in one.parameters
        ]
        for number, above, child in rows:
            if above == own and number:
                found["groups"][child.name] = tree(number, above, child)
        return found

    return tree(*rows[0])


def group_states(group: DynamicGroup, changes: Any) -> dict[str, bool]:
    """Return the states in what programs write below ``groups``: names and truth values."""
    if not isinstance(changes, Mapping):
        return {}
    names = {one.name for _, _, one in group.numbered()}
    return {name: v for name, v in changes.items() if name in names and isinstance(v, bool)}


def _group_tree(
    own: int, parent: int, group: DynamicGroup, state: bool, type_name: str, kind: type[Tree]
) -> Tree:
    return kind(
        {
            "id": own,
            "parent": parent,
            "name": group.name,
            "type": type_name,
            "state": state,
            "groups": kind(),
            "parameters": kind(),
        }
    )
