"""Asking what something is."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import Any

__all__ = ["ensure_argument_type", "is_a", "is_a_subclass", "isclassinstance"]


def isclassinstance(obj: Any) -> bool:
    """Return whether something has a class."""
    return hasattr(obj, "__class__")


def is_a(obj: Any, entity_type: Any) -> bool:
    """Return whether something is an instance of a class.

    Raises:
        RuntimeError: `entity_type` is no class.
    """
    if not inspect.isclass(entity_type):
        raise RuntimeError(f"entity_type '{entity_type}' is not a class")
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: Any) -> bool:
    """Return whether something is an instance or a subclass of a class."""
    if is_a(obj, entity_type):
        return True
    return inspect.isclass(obj) and issubclass(obj, entity_type)


def ensure_argument_type(
    argument: Any,
    types: type | Iterable[type],
    argument_name: str,
    caller: str | None = None,
) -> None:
    """Check the type of an argument.

    Raises:
        TypeError: it is none of `types`; the message names argument and caller.
    """
    allowed = [types] if isinstance(types, type) else list(types)
    if any(isinstance(argument, one) for one in allowed):
        return
    who = "E" if caller is None else f"'{caller}' e"
    known = ", ".join(str(one) for one in allowed)
    raise TypeError(
        f"{who}xpected '{argument_name}' to be one of [{known}], "
        f"but got '{argument}' of type '{type(argument)}'"
    )
