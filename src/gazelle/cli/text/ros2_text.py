"""Messages as the text of ROS 2's commands: YAML, comma-separated values, Python's ``repr``.

The rules are those of rosidl_runtime_py's ``message_to_yaml`` and ``message_to_csv`` and of the
``__repr__`` of generated messages.

``ros2 topic echo`` of a joint state at 1 kHz leaves a millisecond for each message; so YAML blocks
are written here, letter for letter as PyYAML writes them and many times as fast.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from gazelle.interfaces import FieldType, Message
from gazelle.interfaces.definition import FORMATS, NUMPY_NAMES, Array, attribute_name

__all__ = [
    "WHOLE",
    "NotSimpleError",
    "Shortening",
    "message_csv",
    "message_repr",
    "message_yaml",
    "value_text",
    "yaml_blocks",
]

# IDL's names of the basic types, which the notes of --no-arr show.
_IDL = {
    "bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double",
}  # fmt: skip
_CODES = {
    "float32": "f", "float64": "d", "int8": "b", "uint8": "B", "char": "B", "int16": "h",
    "uint16": "H", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q",
}  # fmt: skip


class NotSimpleError(Exception):
    """A text has several lines; how it is written depends on where it stands."""


class Shortening(NamedTuple):
    """What is left out of long values.

    Attributes:
        length: texts and arrays are cut behind so many items; None for whole ones.
        no_arrays: arrays are replaced by a note of type and length.
        no_strings: texts are replaced by a note of their length.
    """

    length: int | None = None
    no_arrays: bool = False
    no_strings: bool = False


WHOLE = Shortening()


def yaml_blocks(fields: dict[str, Any]) -> str:
    """Return fields as ``yaml.dump`` writes them in block style, in their order.

    Args:
        fields: numbers, texts, dictionaries, and lists of one of these.

    Raises:
        NotSimpleError: PyYAML has to write it.
    """
    if not fields:
        return "{}\n"
    return "\n".join(_lines(fields, "")) + "\n"


def message_yaml(message: Message, how: Shortening = WHOLE, *, flow_style: bool = False) -> str:
    """Return a message as YAML, its fields in order."""
    plain = _plain(message, how)
    if not flow_style:
        try:
            return yaml_blocks(plain)
        except NotSimpleError:
            pass
    return _dumped(plain, flow_style=flow_style)


def message_csv(message: Message, how: Shortening = WHOLE) -> str:
    """Return the values of all fields, nested ones too, with commas between them."""
    return _joined(
        [
            _csv(getattr(message, attribute_name(item.name)), item.type, how)
            for item in message.FIELDS
        ]
    )


def message_repr(message: Message) -> str:
    """Return what ``repr`` of the message gives in rclpy."""
    values = (
        f"{attribute_name(item.name)}="
        + _repr(getattr(message, attribute_name(item.name)), item.type)
        for item in message.FIELDS
    )
    return f"{message.TYPE_NAME.replace('/', '.')}({', '.join(values)})"


def value_text(value: Any, kind: FieldType | None) -> str:
    """Return what ``str`` of one field's value gives in rclpy."""
    if kind is None or kind.array is Array.ONE:
        return value if isinstance(value, str) else _repr_item(value, kind)
    if kind.array is Array.FIXED and kind.base in _CODES:
        return str(_numbers(value, kind))
    if kind.array is Array.SEQUENCE and kind.base in _CODES:
        items = _numbers(value, kind).tolist()
        return (
            f"array('{_CODES[kind.base]}', {items})" if items else f"array('{_CODES[kind.base]}')"
        )
    return _repr(value, kind)


def _lines(fields: dict[str, Any], indent: str) -> Iterator[str]:
    for name, value in fields.items():
        key = f"{indent}{_quoted(name)}:"
        if isinstance(value, dict) and value:
            yield key
            yield from _lines(value, indent + "  ")
        elif isinstance(value, list) and value:
            yield key
            for item in value:
                yield from _item(item, indent)
        else:
            yield f"{key} {_scalar(value)}"


def _item(item: Any, indent: str) -> Iterator[str]:
    if isinstance(item, dict) and item:
        lines = _lines(item, indent + "  ")
        yield f"{indent}- {next(lines)[len(indent) + 2 :]}"
        yield from lines
    else:
        yield f"{indent}- {_scalar(item)}"


def _scalar(value: Any) -> str:
    if isinstance(value, float):
        return _float(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if value in ({}, []):
        return str(value)
    raise NotSimpleError


def _float(value: float) -> str:
    """YAML 1.1 wants a point in front of an exponent."""
    if math.isfinite(value):
        text = repr(value)
        return text if "." in text else text.replace("e", ".0e", 1)
    return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"


@lru_cache(maxsize=4096)
def _quoted(text: str) -> str:
    from gazelle.documents.yaml import MESSAGE_STYLE, dump_yaml

    dumped = dump_yaml([text], MESSAGE_STYLE)
    # YAML has more line breaks than the newline; splitlines knows them all.
    if len(dumped.splitlines()) != 1:
        raise NotSimpleError
    return dumped[2:-1]


def _dumped(plain: dict[str, Any], *, flow_style: bool) -> str:
    from gazelle.documents.yaml import MESSAGE_STYLE, Layout, dump_yaml

    # Each field has a line, also where lists are written in one.
    layout = Layout.FLOW_LISTS if flow_style else Layout.BLOCK
    return dump_yaml(plain, MESSAGE_STYLE._replace(layout=layout))


def _plain(message: Message, how: Shortening) -> dict[str, Any]:
    return {
        item.name: _plain_value(getattr(message, attribute_name(item.name)), item.type, how)
        for item in message.FIELDS
    }


def _plain_value(value: Any, kind: FieldType, how: Shortening) -> Any:
    if kind.array is Array.ONE:
        return _plain_item(value, kind, how)
    if how.no_arrays:
        return _note(value, kind)
    shown = value if how.length is None else value[: how.length]
    items = [_plain_item(one, kind, how) for one in _items(shown, kind)]
    return items if len(shown) == len(value) else [*items, "..."]


def _plain_item(value: Any, kind: FieldType, how: Shortening) -> Any:
    if isinstance(value, Message):
        return _plain(value, how)
    if kind.base == "byte":
        return chr(int(value))
    if isinstance(value, str):
        return _text(value, how)
    return value.item() if isinstance(value, np.generic) else value


def _csv(value: Any, kind: FieldType, how: Shortening) -> str:
    if kind.array is Array.ONE:
        return _csv_item(value, kind, how)
    if how.no_arrays:
        return _note(value, kind)
    shown = value if how.length is None else value[: how.length]
    items = [_csv_item(one, kind, how) for one in _items(shown, kind)]
    return _joined(items if len(shown) == len(value) else [*items, "..."])


def _joined(parts: list[str]) -> str:
    """Join with commas; none stands behind nothing, so empty values in front get none."""
    text = ""
    for part in parts:
        text = f"{text},{part}" if text else part
    return text


def _csv_item(value: Any, kind: FieldType, how: Shortening) -> str:
    if isinstance(value, Message):
        return message_csv(value, how)
    if kind.base == "byte":
        return str(bytes([int(value)]))
    return _text(value, how) if isinstance(value, str) else str(value)


def _text(value: str, how: Shortening) -> str:
    if how.no_strings:
        return f"<string length: <{len(value)}>>"
    if how.length is not None and len(value) > how.length:
        return value[: how.length] + "..."
    return value


def _note(value: Any, kind: FieldType) -> str:
    base = _IDL.get(kind.base, kind.base)
    if kind.array is Array.FIXED:
        return f"<array type: {base}[{kind.size}]>"
    bound = f"[{kind.size}]" if kind.size else ""
    return f"<sequence type: {base}{bound}, length: {len(value)}>"


def _repr(value: Any, kind: FieldType) -> str:
    if kind.array is Array.ONE:
        return _repr_item(value, kind)
    if kind.array is Array.FIXED and kind.base in _CODES:
        return repr(_numbers(value, kind))
    return f"[{', '.join(_repr_item(one, kind) for one in _items(value, kind))}]"


def _repr_item(value: Any, kind: FieldType | None) -> str:
    if isinstance(value, Message):
        return message_repr(value)
    if kind is not None and kind.base == "byte":
        return repr(bytes([int(value)]))
    return repr(value.item() if isinstance(value, np.generic) else value)


def _items(value: Any, kind: FieldType) -> list[Any]:
    """The items as Python's own values."""
    return _numbers(value, kind).tolist() if kind.base in FORMATS else list(value)


def _numbers(value: Any, kind: FieldType) -> Any:
    """A numpy array; bytes are numbers too."""
    if isinstance(value, bytes | bytearray | memoryview):
        return np.frombuffer(value, np.uint8)
    return np.asarray(value, NUMPY_NAMES[FORMATS[kind.base]])
