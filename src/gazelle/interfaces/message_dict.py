"""Messages ↔ plain Python values (dicts, lists, numbers, text), as YAML gives and shows them.

The rules are those of the ROS YAML command line, http://wiki.ros.org/ROS/YAMLCommandLine.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from gazelle.errors import InterfaceError
from gazelle.interfaces.codec_runtime import is_array, is_array_item
from gazelle.interfaces.definition import (
    FORMATS,
    NUMPY_NAMES,
    Array,
    Field,
    RosVersion,
    attribute_name,
)
from gazelle.interfaces.field_check import find_problem
from gazelle.interfaces.message_base import MessageBase, Types
from gazelle.interfaces.ros1_time import Duration, Time, TVal

__all__ = ["fill", "time_keys", "to_plain"]

_TIMES: dict[str, type[TVal]] = {"time": Time, "duration": Duration}
_TIME_MESSAGES = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")
_NANO = 1_000_000_000


def to_plain(value: Any) -> Any:
    """Return a message as nested dicts, its arrays as lists, its times as dicts too."""
    if isinstance(value, MessageBase):
        return {
            item.name: to_plain(getattr(value, attribute_name(item.name))) for item in value.FIELDS
        }
    if isinstance(value, TVal):
        return {"secs": value.secs, "nsecs": value.nsecs}
    if is_array(value) or is_array_item(value):
        return value.tolist()
    if isinstance(value, bytes | bytearray | list | tuple):
        return [to_plain(item) for item in value]
    return value


def time_keys(types: Types, now_ns: int, ros_version: RosVersion) -> dict[str, Any]:
    """Return what ``now`` and ``auto`` stand for in `fill`: a time and a header of now."""
    header: Any = types.class_of("std_msgs/msg/Header", ros_version)
    secs, nsecs = divmod(now_ns, _NANO)
    if ros_version is RosVersion.ROS1:
        return {
            "now": Time(secs, nsecs),
            "auto": header(stamp=Time(secs, nsecs)),
        }
    make: Any = types.class_of("builtin_interfaces/msg/Time", ros_version)
    return {"now": make(secs, nsecs), "auto": header(stamp=make(secs, nsecs))}


def fill(msg: MessageBase, values: Any, *, keys: Mapping[str, Any] | None = None) -> None:
    """Set a message's fields from plain values.

    A dict sets the fields it names, a list all fields in order; a list of one dict counts as the
    dict and None as an empty list.

    Args:
        msg: the message that is filled.
        values: what YAML gave.
        keys: words that stand for whole times and messages; `time_keys` makes the usual ones.

    Raises:
        InterfaceError: a field does not exist, the count is wrong or a value does not fit.
    """
    if values is None:
        values = []
    if isinstance(values, list) and len(values) == 1 and isinstance(values[0], dict):
        values = values[0]
    _fill(msg, values, keys or {}, "")
    problem = find_problem(msg)
    if problem:
        raise InterfaceError(problem)


def _fill(msg: Any, values: Any, keys: Mapping[str, Any], prefix: str) -> None:
    fields = {item.name: item for item in msg.FIELDS}
    if isinstance(values, dict):
        for name, value in values.items():
            if name not in fields:
                raise _no_field(msg, prefix, str(name), tuple(fields))
            _set(msg, fields[name], "" if value is None else value, keys, prefix)
    elif isinstance(values, list | tuple):
        _check_count(msg, values, tuple(fields), prefix)
        for item, value in zip(fields.values(), values, strict=True):
            _set(msg, item, value, keys, prefix)
    else:
        raise InterfaceError(
            f"{_where(msg, prefix)} takes a list or a dictionary of its fields "
            f"({', '.join(fields) or 'it has none'}), not {values!r}"
        )


def _set(msg: Any, item: Field, value: Any, keys: Mapping[str, Any], prefix: str) -> None:
    name = attribute_name(item.name)
    path = prefix + item.name
    if item.type.array is not Array.ONE:
        setattr(msg, name, _sequence(msg, item, value, keys, path))
    elif item.type.is_message or item.type.base in _TIMES:
        setattr(msg, name, _one(item.type.base, getattr(msg, name), value, keys, path))
    else:
        setattr(msg, name, _scalar(item, value))


def _one(base: str, present: Any, value: Any, keys: Mapping[str, Any], path: str) -> Any:
    """One nested message or time."""
    if isinstance(value, str) and value:
        if value not in keys:
            known = f"; known here: {', '.join(keys)}" if keys else ""
            raise InterfaceError(
                f"field '{path}' is a {base}; '{value}' does not stand for one{known} "
                f"(ROS: No key named [{value}])"
            )
        return deepcopy(keys[value])
    if value == "":
        value = []
    is_time = base in _TIMES or base in _TIME_MESSAGES
    if is_time and isinstance(value, int) and not isinstance(value, bool):
        secs, nsecs = divmod(value, _NANO)
        value = [secs, nsecs]
    if base in _TIMES:
        return _time(base, value, path)
    if value != [] or not present.FIELDS:
        _fill(present, value, keys, f"{path}.")
    return present


def _time(base: str, value: Any, path: str) -> TVal:
    if isinstance(value, dict):
        wrong = [name for name in value if name not in ("secs", "nsecs")]
        if not wrong:
            return _TIMES[base](value.get("secs", 0), value.get("nsecs", 0))
        raise InterfaceError(
            f"field '{path}' is a {base}: its parts are secs and nsecs, not {wrong[0]} "
            f"(ROS: No field name [{path}.{wrong[0]}])"
        )
    if isinstance(value, list | tuple) and len(value) == 2:
        return _TIMES[base](*value)
    raise InterfaceError(
        f"field '{path}' is a {base}: write {{secs: 1, nsecs: 0}}, [1, 0], nanoseconds as one "
        f"whole number, or 'now'; not {value!r}"
    )


def _sequence(msg: Any, item: Field, value: Any, keys: Mapping[str, Any], path: str) -> Any:
    kind = item.type
    is_ros1 = msg.GENERATION is RosVersion.ROS1
    if isinstance(value, bytes) or is_array(value):
        return value
    if value == "":
        value = []
    if not isinstance(value, list | tuple):
        raise InterfaceError(
            f"field '{path}' must be a list, is {type(value).__name__} {value!r} "
            f"(ROS: Field [{path}] must be a list or tuple)"
        )
    if kind.array is Array.FIXED and len(value) != kind.size:
        raise InterfaceError(
            f"field '{path}' has {kind.size} items, got {len(value)} "
            f"(ROS: Field [{path}] has incorrect number of elements)"
        )
    if kind.is_message or kind.base in _TIMES:
        made = []
        for index, one in enumerate(value):
            fresh = None if kind.base in _TIMES else _fresh(msg, kind.base)
            made.append(_one(kind.base, fresh, one, keys, f"{path}[{index}]"))
        return made
    if kind.base in FORMATS and not is_ros1:
        return _array(msg, item, list(value))
    return [_scalar(item, one) for one in value]


def _scalar(item: Field, value: Any) -> Any:
    """Whole numbers in a field of floats become floats, as they would on the wire."""
    is_whole = isinstance(value, int) and not isinstance(value, bool)
    return float(value) if is_whole and FORMATS.get(item.type.base) in ("f", "d") else value


def _array(msg: Any, item: Field, values: list[Any]) -> Any:
    import numpy as np

    try:
        return np.array(values, NUMPY_NAMES[FORMATS[item.type.base]])
    except (TypeError, ValueError, OverflowError):
        return values  # the check of the whole message names the item at fault


def _fresh(msg: MessageBase, base: str) -> MessageBase:
    return msg._types.class_of(base, msg.GENERATION)()


def _check_count(msg: Any, values: Sequence[Any], names: tuple[str, ...], prefix: str) -> None:
    if len(values) == len(names):
        return
    word = "Too many" if len(values) > len(names) else "Not enough"
    raise InterfaceError(
        f"{_where(msg, prefix)} has {len(names)} fields, {len(values)} values are given "
        f"(ROS: {word} arguments)\n * Given: {list(values)}\n * Expected: {list(names)}"
    )


def _no_field(msg: Any, prefix: str, name: str, names: tuple[str, ...]) -> InterfaceError:
    from gazelle.diagnostics import did_you_mean

    near = did_you_mean(name, names)
    return InterfaceError(
        f"{_where(msg, prefix)} has no field '{name}'"
        + (f"; {near}" if near else ".")
        + f" Its fields are {', '.join(names)} (ROS: No field name [{prefix}{name}])"
    )


def _where(msg: Any, prefix: str) -> str:
    place = f" (field '{prefix.rstrip('.')}')" if prefix else ""
    return f"{msg.TYPE_NAME}{place}"
