"""launch.frontend.type_utils."""

from __future__ import annotations

from typing import Any, List  # noqa: UP035

from gazelle.launch.ros2.frontend.entity import Entity
from gazelle.launch.ros2.utilities.type_utils import is_typing_list

__all__ = ["check_is_list_entity", "get_data_type_from_identifier"]

# typing.List, since users compare with it.
_TYPES: dict[str, Any] = {
    "str": str,
    "bool": bool,
    "float": float,
    "int": int,
    "list_of_str": List[str],  # noqa: UP006
    "list_of_bool": List[bool],  # noqa: UP006
    "list_of_float": List[float],  # noqa: UP006
    "list_of_int": List[int],  # noqa: UP006
    "yaml": None,
}


def check_is_list_entity(data_type: Any) -> bool:
    """Return whether a type is ``List[Entity]``."""
    arguments: Any = getattr(data_type, "__args__", ())
    is_class = bool(arguments) and isinstance(arguments[0], type)
    return is_typing_list(data_type) and is_class and issubclass(arguments[0], Entity)


def get_data_type_from_identifier(type_identifier: str) -> Any:
    """Return the type that a word such as ``list_of_int`` stands for.

    Raises:
        ValueError: it stands for none.
    """
    if type_identifier not in _TYPES:
        raise ValueError(f"Got invalid type identifier '{type_identifier}'")
    return _TYPES[type_identifier]
