"""Messages as rows of a table: one column for every number and text."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from gazelle.bag.storage import BagMessage, Connection, Encoding
from gazelle.bag.types import message_class
from gazelle.interfaces import Duration, Time, TypeStore, from_cdr, from_ros1
from gazelle.interfaces.stamps import seconds_of

__all__ = ["columns_of", "reader_of", "row_of"]

TIME = "time_s"
_MAX_ARRAY = 64


def reader_of(connection: Connection, types: TypeStore) -> Callable[[bytes], Any]:
    """Return the function that reads a connection's messages.

    Args:
        connection: of a bag.
        types: of the bag.

    Raises:
        NotFoundError: nothing defines the type.
    """
    kind = message_class(connection, types)
    if connection.encoding is Encoding.ROS1:
        return lambda data: from_ros1(kind, data)
    return lambda data: from_cdr(kind, data)


def row_of(stamp_ns: int, message: Any) -> dict[str, Any]:
    """Return the values of a message by column; arrays longer than 64 by their length only."""
    row: dict[str, Any] = {TIME: stamp_ns / 1e9}
    _flatten("", message, row)
    return row


def columns_of(messages: Iterable[BagMessage], read: Callable[[bytes], Any]) -> list[str]:
    """Return the columns that any of the messages has, in the order they come up."""
    columns: dict[str, None] = {TIME: None}
    for one in messages:
        columns.update(dict.fromkeys(row_of(one.stamp_ns, read(one.data))))
    return list(columns)


def _flatten(name: str, value: Any, row: dict[str, Any]) -> None:
    if isinstance(value, Time | Duration):
        row[name] = value.to_sec()
    elif isinstance(value, str | bool | int | float | np.generic):
        row[name] = value.item() if isinstance(value, np.generic) else value
    elif isinstance(value, bytes | bytearray | memoryview | list | tuple | np.ndarray):
        if len(value) > _MAX_ARRAY or isinstance(value, bytes | bytearray | memoryview):
            row[f"{name}.length"] = len(value)
            return
        for place, item in enumerate(value):
            _flatten(f"{name}.{place}", item, row)
    else:
        fields = [item.name for item in type(value).FIELDS]
        if fields == ["sec", "nanosec"]:
            row[name] = seconds_of(value)
            return
        for field in fields:
            own = getattr(value, field, None)
            if own is not None:
                _flatten(f"{name}.{field}" if name else field, own, row)
