"""ROS 2 messages from the YAML of the command line."""

from __future__ import annotations

from typing import Any

import yaml

from gazelle.cli.tool import ToolError
from gazelle.errors import InterfaceError
from gazelle.interfaces import FieldType, Message, fill, message_type, time_keys
from gazelle.interfaces.definition import FORMATS, Array, Generation

__all__ = ["filled", "yaml_values"]

_TIME = "builtin_interfaces/msg/Time"


def yaml_values(text: str) -> dict[str, Any]:
    """Return the fields that a YAML text names.

    Raises:
        ToolError: it is not YAML, or no dictionary.
    """
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ToolError(
            f"the values are not YAML: {error}\n  write them in quotes, with a blank behind each "
            "colon: '{linear: {x: 0.5}}'"
        ) from None
    if not isinstance(found, dict):
        raise ToolError(
            "The passed value needs to be a dictionary in YAML format\n"
            f"  it is: {found!r}; write '{{field: value}}', with a blank behind the colon"
        )
    return found


def filled(message_class: type[Message], values: dict[str, Any], now_ns: int) -> Message:
    """Return a message with these values; ``auto`` is a header of now, ``now`` a time.

    Values become what their fields are where Python can make it of them, as in
    ``set_message_fields``: ``data: 5`` is a text in a String.

    Raises:
        ToolError: a field does not exist, or a value does not fit.
    """
    message = message_class()
    try:
        fill(message, _fitted(message_class, values), keys=time_keys(now_ns, Generation.ROS2))
    except (InterfaceError, ValueError, TypeError) as error:
        raise ToolError(f"Failed to populate field: {error}") from None
    return message


def _fitted(message_class: type[Message], values: Any) -> Any:
    if not isinstance(values, dict):
        return values
    kinds = {item.name: item.type for item in message_class.FIELDS}
    return {
        name: _fitted_value(kinds[name], value) if name in kinds else value
        for name, value in values.items()
    }


def _fitted_value(kind: FieldType, value: Any) -> Any:
    if kind.array is not Array.ONE:
        one = kind._replace(array=Array.ONE)
        return [_fitted_value(one, item) for item in value] if isinstance(value, list) else value
    if kind.is_message:
        return value if isinstance(value, str) else _fitted(message_type(kind.base), value)
    if kind.base in ("string", "wstring"):
        return value if isinstance(value, str) else str(value)
    return _number(FORMATS.get(kind.base, ""), value)


def _number(code: str, value: Any) -> Any:
    if code in ("f", "d"):
        return float(value)
    if code == "?" and isinstance(value, int):
        return bool(value)
    if code and code != "?" and isinstance(value, float | str):
        return int(value)
    return value
