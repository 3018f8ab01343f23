"""Definitions of messages, services and actions as trees of fields."""

from __future__ import annotations

from typing import Any, NotRequired, TypedDict

from gazelle.errors import NotFoundError
from gazelle.interfaces import Definition, Field, RosVersion, definition, known_types
from gazelle.interfaces.definition import Array
from gazelle.interfaces.type_names import split_name
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params

__all__ = ["TypeConstant", "TypeField", "TypeValue", "field_tree", "get_type", "list_types"]

_KINDS = ("msg", "srv", "action")
_PARTS = {
    "msg": {"": ""},
    "srv": {"request": "_Request", "response": "_Response"},
    "action": {"goal": "_Goal", "result": "_Result", "feedback": "_Feedback"},
}
_RULE = "\n---\n"


class TypeConstant(TypedDict):
    """A constant of a definition."""

    name: str
    type: str
    value: Any


class TypeField(TypedDict):
    """A field of a definition.

    Attributes:
        array: how many of them; `[]` for any number, null for one.
        default: null where the definition has none.
        fields: those of a message inside.
    """

    name: str
    type: str
    array: int | str | None
    default: Any
    fields: NotRequired[list[TypeField]]
    constants: NotRequired[list[TypeConstant]]


class TypeValue(TypedDict):
    """A definition; the fields of a service and of an action are its parts.

    Attributes:
        kind: `msg`, `srv` or `action`.
    """

    type: str
    kind: str
    text: str
    fields: list[TypeField]
    constants: NotRequired[list[TypeConstant]]


def get_type(params: Params) -> TypeValue:
    """``type.get``: text and fields; those of a service are ``request`` and ``response``."""
    name = params.text("type")
    package, part, bare = split_name(name)
    for kind in (part, *_KINDS) if name.count("/") == 1 else (part,):
        try:
            return _described(f"{package}/{kind}/{bare}", kind)
        except NotFoundError as error:
            missing = error
    raise missing


def list_types(params: Params) -> list[str]:
    """``type.list``."""
    kind = params.text("kind", "msg")
    if kind not in _KINDS:
        raise StudioError(f"there is no kind '{kind}' of type", known=_KINDS)
    return list(known_types(kind))


def field_tree(full: str) -> list[TypeField]:
    """Return the fields of a message with those of all messages inside."""
    return [_field(item) for item in definition(full, RosVersion.ROS2).fields]


def _described(full: str, kind: str) -> TypeValue:
    parts = {word: definition(full + end, RosVersion.ROS2) for word, end in _PARTS[kind].items()}
    fields: list[TypeField] = []
    for word, part in parts.items():
        tree = [_field(item) for item in part.fields]
        if not word:
            fields = tree
            continue
        whole: TypeField = {
            "name": word, "type": part.name, "array": None, "default": None, "fields": tree,
        }  # fmt: skip
        if part.constants:
            whole["constants"] = _constants(part)
        fields.append(whole)
    text = _RULE.join(part.text for part in parts.values())
    value: TypeValue = {"type": full, "kind": kind, "text": text, "fields": fields}
    if "" in parts and parts[""].constants:
        value["constants"] = _constants(parts[""])
    return value


def _field(item: Field) -> TypeField:
    array: int | str | None = None
    if item.type.array is not Array.ONE:
        array = item.type.size if item.type.array is Array.FIXED else "[]"
    value: TypeField = {
        "name": item.name,
        "type": item.type.base,
        "array": array,
        "default": item.default,
    }
    if item.type.is_message:
        inner = definition(item.type.base, RosVersion.ROS2)
        value["fields"] = [_field(one) for one in inner.fields]
        if inner.constants:
            value["constants"] = _constants(inner)
    return value


def _constants(part: Definition) -> list[TypeConstant]:
    return [{"name": one.name, "type": one.type, "value": one.value} for one in part.constants]
