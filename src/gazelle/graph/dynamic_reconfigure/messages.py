"""Messages of dynamic_reconfigure: written from values and descriptions, and read again.

Files of ``dynparam dump``, ``rosrun … dynparam get`` and programs with the Python client have it.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gazelle.graph import type_support
from gazelle.graph.dynamic_reconfigure.description import DynamicGroup, DynamicParameter, Value
from gazelle.graph.graph import Graph

__all__ = [
    "config_message",
    "config_tree",
    "description_message",
    "description_tree",
    "enum_values",
    "group_from_message",
    "group_states",
    "message_class",
    "server_names",
    "values_from_message",
]


_FIELDS = {"bool": "bools", "int": "ints", "str": "strs", "double": "doubles"}


def message_class(name: str) -> Any:
    """Return the class of ``dynamic_reconfigure/<name>``."""
    return type_support.resolve_type(f"dynamic_reconfigure/msg/{name}")


def config_message(
    group: DynamicGroup, values: Mapping[str, Value], states: Mapping[str, bool] | None = None
) -> Any:
    """Return a ``Config`` of those values that are given, with the groups' states."""
    config = message_class("Config")()
    for row in group.every_parameter():
        if row.name in values:
            item = message_class(f"{row.type.capitalize()}Parameter")
            getattr(config, _FIELDS[row.type]).append(item(name=row.name, value=values[row.name]))
    state = message_class("GroupState")
    known = states or {}
    config.groups = [
        state(name=one.name, state=known.get(one.name, one.state), id=own, parent=parent)
        for own, parent, one in group.numbered()
    ]
    return config


def description_message(group: DynamicGroup) -> Any:
    """Return the ``ConfigDescription``."""
    groups = [
        message_class("Group")(
            name=one.name,
            type=one.type,
            parameters=[_parameter_message(row) for row in one.parameters],
            parent=parent,
            id=own,
        )
        for own, parent, one in group.numbered()
    ]

    def all_of(pick: Callable[[DynamicParameter], Value]) -> Any:
        return config_message(group, {row.name: pick(row) for row in group.every_parameter()})

    return message_class("ConfigDescription")(
        groups=groups,
        max=all_of(lambda row: row.maximum),
        min=all_of(lambda row: row.minimum),
        dflt=all_of(lambda row: row.clamped(row.default)),
    )


def values_from_message(config: Any) -> dict[str, Value]:
    """Return the values of a ``Config`` by name: bools, ints, strs, doubles."""
    return {item.name: item.value for field in _FIELDS.values() for item in getattr(config, field)}


def group_from_message(description: Any) -> DynamicGroup:
    """Return what a ``ConfigDescription`` describes."""
    lowest, highest, default = (
        values_from_message(part) for part in (description.min, description.max, description.dflt)
    )
    states = {item.id: item.state for item in description.dflt.groups}

    def parameter(row: Any) -> DynamicParameter:
        limits = (lowest.get(row.name), highest.get(row.name))
        value, more = default[row.name], (row.edit_method, row.level)
        return DynamicParameter(row.name, row.type, value, row.description, *limits, *more)

    def group(message: Any) -> DynamicGroup:
        children = [one for one in description.groups if one.id and one.parent == message.id]
        return DynamicGroup(
            message.name,
            tuple(parameter(row) for row in message.parameters),
            tuple(group(one) for one in children),
            message.type,
            states.get(message.id, True),
        )

    return group(next(one for one in description.groups if one.id == 0))


def enum_values(row: DynamicParameter) -> dict[str, Value]:
    """Return the named values of a parameter, empty when it has none.

    The edit method comes from another program and is read as a literal, never run.
    """
    try:
        rows: Iterable[Any] = ast.literal_eval(row.edit_method)["enum"] if row.edit_method else ()
        return {str(one["name"]): one["value"] for one in rows}
    except (ValueError, SyntaxError, KeyError, TypeError):
        return {}


def _parameter_message(row: DynamicParameter) -> Any:
    return message_class("ParamDescription")(
        name=row.name,
        type=row.type,
        level=row.level,
        description=row.description,
        edit_method=row.edit_method,
    )


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


_SUFFIX = "/set_parameters"


def server_names(graph: Graph) -> list[str]:
    """Return the names of all reconfigurable nodes and node handles.

    ROS 2's parameter services have the same name and another type; they are left out.
    """
    return sorted(
        service.name.removesuffix(_SUFFIX)
        for service in graph.services()
        if service.name.endswith(_SUFFIX) and "dynamic_reconfigure" in service.type_name
    )
