"""Configurations as dictionaries with attributes, from messages and to messages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gazelle.graph.dynamic_reconfigure import DynamicGroup, DynamicParameter
from gazelle.graph.dynamic_reconfigure.messages import config_tree, description_tree

__all__ = [
    "Config",
    "decode_config",
    "decode_description",
    "encode_config",
    "extract_params",
    "group_from_tree",
]

_FIELDS: dict[type, tuple[str, str]] = {
    bool: ("bools", "BoolParameter"),
    int: ("ints", "IntParameter"),
    str: ("strs", "StrParameter"),
    float: ("doubles", "DoubleParameter"),
}


class Config(dict[str, Any]):
    """A dictionary whose items are attributes too: ``config.p`` is ``config["p"]``."""

    __getattr__ = dict.__getitem__
    __setattr__ = dict.__setitem__

    def copy(self) -> Config:
        """Return another one with the same items."""
        return Config(self)

    def __deepcopy__(self, memo: dict[int, Any]) -> Config:
        from copy import deepcopy

        return Config({key: deepcopy(value, memo) for key, value in self.items()})


def extract_params(group: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the parameters of a description and of all groups below."""
    found = list(group["parameters"])
    for child in _children(group):
        found.extend(extract_params(child))
    return found


def decode_config(msg: Any, description: Mapping[str, Any] | None = None) -> Config:
    """Return the values of a ``Config`` message, with a description its groups too."""
    group = None if description is None else group_from_tree(description)
    found = config_tree(msg, group, Config)
    assert isinstance(found, Config)
    return found


def decode_description(msg: Any) -> Config:
    """Return a ``ConfigDescription`` as nested groups."""
    from gazelle.graph.dynamic_reconfigure.messages import group_from_message

    found = description_tree(group_from_message(msg), Config)
    assert isinstance(found, Config)
    return found


def encode_config(config: Mapping[str, Any]) -> Any:
    """Return values, and the states of ``groups``, as a ``Config`` message of ROS 1."""
    from gazelle.interfaces import ros1_message_type

    message: Any = ros1_message_type("dynamic_reconfigure/Config")()
    for name, value in config.items():
        if type(value) in _FIELDS:
            field, kind = _FIELDS[type(value)]
            item = ros1_message_type(f"dynamic_reconfigure/{kind}")
            getattr(message, field).append(item(name, value))
        elif isinstance(value, Mapping):
            state = ros1_message_type("dynamic_reconfigure/GroupState")
            for group in _every_group(value):
                values = [group[key] for key in ("name", "state", "id", "parent")]
                message.groups.append(state(*values))
    return message


def group_from_tree(tree: Mapping[str, Any]) -> DynamicGroup:
    """Return the description in a generated configuration type, or what a client decoded."""
    parameters = tuple(
        DynamicParameter(
            row["name"],
            row["type"],
            row["default"],
            row["description"],
            row["min"],
            row["max"],
            row.get("edit_method", ""),
            row.get("level", 0),
        )
        for row in tree["parameters"]
    )
    groups = tuple(group_from_tree(child) for child in _children(tree))
    return DynamicGroup(
        tree["name"], parameters, groups, tree.get("type", ""), bool(tree.get("state", True))
    )


def _children(group: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    groups = group.get("groups", ())
    return list(groups.values() if isinstance(groups, Mapping) else groups)


def _every_group(group: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    yield group
    for child in _children(group):
        yield from _every_group(child)
