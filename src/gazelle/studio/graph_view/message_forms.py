"""Values of a form → a message; a text may stand for any value, as YAML."""

from __future__ import annotations

from typing import Any

from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.interfaces import Message, RosVersion, definition, fill, time_keys
from gazelle.interfaces.definition import Array, Field
from gazelle.studio.errors import StudioError

__all__ = ["filled"]

_NUMBER_WORDS = {"NaN": float("nan"), "Infinity": float("inf"), "-Infinity": float("-inf")}


def filled(message_class: Any, values: Any, now_ns: int) -> Message:
    """Return a message with the values of a form.

    Args:
        message_class: class of the message, in the form of ROS 2.
        values: field name → value; a text in a place of another type is read as YAML.
        now_ns: what ``now`` and ``auto`` stand for.

    Raises:
        InterfaceError: a field does not exist or a value does not fit.
        StudioError: a text is not YAML.
    """
    message: Message = message_class()
    keys = time_keys(now_ns, RosVersion.ROS2)
    fill(message, _read(message_class.FIELDS, values, keys, ""), keys=keys)
    return message


def _read(fields: tuple[Field, ...], values: Any, keys: Any, prefix: str) -> Any:
    if isinstance(values, str):
        values = _yaml(values, prefix)
    if not isinstance(values, dict):
        return values
    types = {item.name: item for item in fields}
    return {
        name: _value(types[name], value, keys, f"{prefix}{name}") if name in types else value
        for name, value in values.items()
    }


def _value(item: Field, value: Any, keys: Any, path: str) -> Any:
    if item.type.array is not Array.ONE:
        if isinstance(value, str):
            value = _yaml(value, path)
        if not isinstance(value, list):
            return value
        return [_one(item, one, keys, f"{path}[{index}]") for index, one in enumerate(value)]
    return _one(item, value, keys, path)


def _one(item: Field, value: Any, keys: Any, path: str) -> Any:
    if item.type.is_string or (item.type.is_message and isinstance(value, str) and value in keys):
        return value
    if item.type.is_message:
        return _read(definition(item.type.base, RosVersion.ROS2).fields, value, keys, f"{path}.")
    if isinstance(value, str):
        return _NUMBER_WORDS.get(value, _yaml(value, path)) if value.strip() else 0
    return value


def _yaml(text: str, path: str) -> Any:
    try:
        return load_yaml(text)
    except YamlError as error:
        reason = str(error).splitlines()[0]
        raise StudioError(f"field '{path.rstrip('.')}': '{text}' is not YAML: {reason}") from None
