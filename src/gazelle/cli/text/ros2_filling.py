"""ROS 2 messages from the YAML of the command line."""

from __future__ import annotations

from typing import Any

from gazelle.cli.tool import ToolError
from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.errors import InterfaceError
from gazelle.interfaces import FieldType, Message, fill, message_type, time_keys
from gazelle.interfaces.definition import FORMATS, Array, RosVersion

__all__ = ["filled", "yaml_values"]

_TIME = "builtin_interfaces/msg/Time"


def yaml_values(text: str) -> dict[str, Any]:
    """Return the fields that a YAML text names.

    Raises:
        ToolError: it is not YAML, or no dictionary.
    """
    try:
        found = load_yaml(text)
    except YamlError as error:
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
        fill(message, _fitted(message_class, values), keys=time_keys(now_ns, RosVersion.ROS2))
    except (InterfaceError, ValueError, TypeError) as error:
        raise ToolError(f"Failed to populate field: {error}") from None
    return message


def _fitted(message_class: type[Message], values: Any, path: str = "") -> Any:
    if not isinstance(values, dict):
        return values
    kinds = {item.name: item.type for item in message_class.FIELDS}
    return {
        name: _fitted_value(kinds[name], value, f"{path}{name}") if name in kinds else value
        for name, value in values.items()
    }


def _fitted_value(kind: FieldType, value: Any, path: str) -> Any:
    if kind.array is not Array.ONE:
        one = kind._replace(array=Array.ONE)
        if not isinstance(value, list):
            return value
        return [_fitted_value(one, item, f"{path}[{n}]") for n, item in enumerate(value)]
    if kind.is_message:
        if isinstance(value, str):
            return value
        return _fitted(message_type(kind.base), value, f"{path}.")
    if kind.base in ("string", "wstring"):
        return value if isinstance(value, str) else str(value)
    try:
        return _number(FORMATS.get(kind.base, ""), value)
    except (TypeError, ValueError) as error:
        raise InterfaceError(f"field '{path}' is a {kind.base}: {error}") from None


def _number(code: str, value: Any) -> Any:
    if code == "?":
        return _truth(value)
    if code in ("f", "d"):
        return float(value)
    return int(value) if code and isinstance(value, float | str) else value


def _truth(value: Any) -> bool:
    if isinstance(value, int):
        return bool(value)
    raise ValueError(f"{value!r} is not true or false (ROS 2 would take it for {bool(value)})")
