"""REP-2016 type hashes (``RIHS01_…``): SHA-256 over a canonical description of a type."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from gazelle.interfaces.definition import Array, Field, FieldType, RosVersion
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.type_names import canonical_name, split_name

__all__ = ["type_description", "type_hash"]

_IDS = {
    "int8": 2,
    "uint8": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float32": 10,
    "float64": 11,
    "char": 3,
    "bool": 15,
    "byte": 16,
    "string": 17,
    "wstring": 18,
}
_NESTED = 1
_BOUNDED_STRING = 4  # above the unbounded one's number
_BLOCKS = {Array.ONE: 0, Array.FIXED: 48, Array.SEQUENCE: 144}
_BOUNDED_SEQUENCE = 96
_EMPTY = Field("structure_needs_at_least_one_member", FieldType("uint8"))
_EVENT_INFO = "service_msgs/msg/ServiceEventInfo"


def type_hash(types: Types, name: str, part: str = "msg") -> str:
    """Return the hash of a message, service or action in the form of ROS 2.

    Args:
        types: where definitions come from.
        name: ``std_msgs/String``, ``std_srvs/srv/SetBool`` …
        part: what a name of two words means: ``msg``, ``srv`` or ``action``.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = canonical_name(name, part)
    return types.remembered(("RIHS01", full), lambda: _hash(type_description(types, full)))


def type_description(types: Types, name: str) -> dict[str, Any]:
    """Return what is hashed: ``type_description_interfaces/msg/TypeDescription`` as dictionaries.

    Args:
        types: where definitions come from.
        name: full name of a message, service or action, or of a part of these two.

    Raises:
        NotFoundError: nothing defines it.
    """
    referenced: dict[str, Any] = {}
    main = _description(types, name, referenced)
    referenced.pop(name, None)
    return {
        "type_description": main,
        "referenced_type_descriptions": [referenced[key] for key in sorted(referenced)],
    }


def _hash(described: dict[str, Any]) -> str:
    text = json.dumps(described, ensure_ascii=True, separators=(", ", ": "))
    return "RIHS01_" + hashlib.sha256(text.encode()).hexdigest()


def _description(types: Types, name: str, referenced: dict[str, Any]) -> dict[str, Any]:
    fields = _fields(types, name) or (_EMPTY,)
    found = {
        "type_name": name,
        "fields": [{"name": item.name, "type": _type(item.type)} for item in fields],
    }
    referenced[name] = found
    for item in fields:
        if item.type.is_message and item.type.base not in referenced:
            _description(types, item.type.base, referenced)
    return found


def _type(kind: FieldType) -> dict[str, Any]:
    number = _NESTED if kind.is_message else _IDS[kind.base]
    if kind.string_bound:
        number += _BOUNDED_STRING
    is_bounded = kind.array is Array.SEQUENCE and kind.size
    number += _BOUNDED_SEQUENCE if is_bounded else _BLOCKS[kind.array]
    return {
        "type_id": number,
        "capacity": kind.size,
        "string_capacity": kind.string_bound,
        "nested_type_name": kind.base if kind.is_message else "",
    }


def _fields(types: Types, name: str) -> tuple[Field, ...]:
    _, part, bare = split_name(name)
    if part == "srv" or bare.endswith(("_SendGoal", "_GetResult", "_Event")):
        if bare.endswith("_Event"):
            return _event_fields(name.removesuffix("_Event"))
        if not bare.endswith(("_Request", "_Response")):
            return (
                Field("request_message", FieldType(f"{name}_Request")),
                Field("response_message", FieldType(f"{name}_Response")),
                Field("event_message", FieldType(f"{name}_Event")),
            )
    if part == "action" and "_" not in bare:
        return (
            Field("goal", FieldType(f"{name}_Goal")),
            Field("result", FieldType(f"{name}_Result")),
            Field("feedback", FieldType(f"{name}_Feedback")),
            Field("send_goal_service", FieldType(f"{name}_SendGoal")),
            Field("get_result_service", FieldType(f"{name}_GetResult")),
            Field("feedback_message", FieldType(f"{name}_FeedbackMessage")),
        )
    return types.definition(name, RosVersion.ROS2).fields


def _event_fields(service: str) -> tuple[Field, ...]:
    return (
        Field("info", FieldType(_EVENT_INFO)),
        Field("request", FieldType(f"{service}_Request", Array.SEQUENCE, 1)),
        Field("response", FieldType(f"{service}_Response", Array.SEQUENCE, 1)),
    )
