"""A definition of one ROS generation in the words of the other."""

from __future__ import annotations

from gazelle.interfaces.definition import (
    Array,
    Constant,
    Definition,
    Field,
    FieldType,
    Generation,
)

__all__ = ["as_generation", "definition_text"]

_TO_ROS2 = {
    "time": "builtin_interfaces/msg/Time",
    "duration": "builtin_interfaces/msg/Duration",
    "byte": "int8",
    "char": "uint8",
}
_TO_ROS1 = {
    "builtin_interfaces/msg/Time": "time",
    "builtin_interfaces/msg/Duration": "duration",
    "wstring": "string",
}


def as_generation(definition: Definition, generation: Generation) -> Definition:
    """Return the definition by the rules of a generation; the same object when it has them.

    Field names stay. ROS 1 ``byte`` is signed and ``char`` unsigned; ROS 1 has no bounds, no
    defaults and no wide strings.
    """
    if definition.generation is generation:
        return definition
    table = _TO_ROS2 if generation is Generation.ROS2 else _TO_ROS1
    fields = tuple(_field(item, table, generation) for item in definition.fields)
    constants = tuple(
        item._replace(type=table.get(item.type, item.type)) for item in definition.constants
    )
    text = definition_text(constants, fields, generation)
    return Definition(definition.name, generation, constants, fields, text, native=False)


def definition_text(
    constants: tuple[Constant, ...], fields: tuple[Field, ...], generation: Generation
) -> str:
    """Return the lines that define these constants and fields, constants first."""
    lines = [f"{item.type} {item.name}={item.text}" for item in constants]
    lines += [f"{item.type.text(generation)} {item.name}" for item in fields]
    return "\n".join(lines)


def _field(item: Field, table: dict[str, str], generation: Generation) -> Field:
    kind = item.type
    base = table.get(kind.base, kind.base)
    if generation is Generation.ROS2:
        return Field(item.name, kind._replace(base=base), item.default)
    size = kind.size if kind.array is Array.FIXED else 0
    return Field(item.name, FieldType(base, kind.array, size))
