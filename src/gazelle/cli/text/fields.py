"""Paths to fields below a topic, such as ``/pose/position/x`` and ``/ranges[0:3]``."""

from __future__ import annotations

from typing import Any, NamedTuple

from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.ros_types import topic_class

__all__ = ["FieldError", "Step", "field_type", "field_value", "has_field", "parse_path"]


class FieldError(ToolError):
    """A message does not have what the path asks for."""


class Step(NamedTuple):
    """One part of a path: a field, and which of its items (None for the whole field)."""

    name: str
    items: int | slice | None = None


def parse_path(text: str) -> tuple[Step, ...]:
    """Return the steps of a path, none for an empty one.

    Raises:
        ToolError: what stands in brackets is neither an index nor a slice.
    """
    return tuple(_step(part) for part in text.split("/") if part)


def field_value(message: Any, steps: tuple[Step, ...]) -> Any:
    """Return what a path leads to; behind a slice of messages, a list.

    Raises:
        FieldError: there is no such field or item.
    """
    value = message
    for number, step in enumerate(steps):
        if not hasattr(value, step.name):
            raise _no_field(step.name, value)
        value = getattr(value, step.name)
        if step.items is None:
            continue
        try:
            value = value[step.items]
        except (IndexError, TypeError) as error:
            raise FieldError(f"{error}: {_text(steps)}") from None
        if isinstance(value, list):
            return [field_value(item, steps[number + 1 :]) for item in value]
    return value


def has_field(message: Any, steps: tuple[Step, ...]) -> bool:
    """Return whether messages of this kind have the fields up to the first index."""
    value = message
    for step in steps:
        if not hasattr(value, step.name):
            return False
        if step.items is not None:
            return True
        value = getattr(value, step.name)
    return True


def field_type(type_name: str, steps: tuple[Step, ...]) -> str:
    """Return the type of a field as definitions write it, ``float32[]`` for instance.

    Raises:
        FieldError: there is no such field.
    """
    found = type_name
    for step in steps:
        if "/" not in found:
            raise FieldError(f"no field named {step.name} in {found}")
        owner = topic_class(found.partition("[")[0])
        if step.name not in owner._names:
            raise _no_field(step.name, owner())
        found = owner._slot_types[owner._names.index(step.name)]
    return found


def _step(part: str) -> Step:
    name, bracket, rest = part.partition("[")
    if not bracket:
        return Step(name)
    if not rest.endswith("]"):
        raise ToolError(f"missing closing ']' in slice spec '{part}'")
    parts = rest[:-1].split(":")
    try:
        numbers = [int(word) if word else None for word in parts]
    except ValueError:
        numbers = []
    if not 1 <= len(numbers) <= 3 or numbers == [None]:
        raise ToolError(
            f"field '{name}' has invalid slice argument '{rest[:-1]}': "
            "write an index [2] or a slice [0:3]"
        )
    return Step(name, numbers[0] if len(numbers) == 1 else slice(*numbers))


def _no_field(name: str, value: Any) -> FieldError:
    names = getattr(value, "_names", ())
    owner = getattr(value, "_type", type(value).__name__)
    return FieldError(f"no field named {name} in {owner}{hint(name, names)}")


def _text(steps: tuple[Step, ...]) -> str:
    return "".join(f"/{step.name}{'' if step.items is None else '[]'}" for step in steps)
