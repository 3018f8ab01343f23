"""Values with types: scalars, lists, and substitutions that become either."""

from __future__ import annotations

import collections.abc
from typing import TYPE_CHECKING, Any, List  # noqa: UP035

from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.utilities.normalization import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "AllowedTypesTuple",
    "AllowedTypesType",
    "AllowedValueType",
    "ListTypesTuple",
    "ListTypesType",
    "ListValueType",
    "NormalizedScalarType",
    "NormalizedSequenceType",
    "NormalizedValueType",
    "ScalarTypesTuple",
    "ScalarTypesType",
    "ScalarValueType",
    "SequenceValueType",
    "SomeScalarType",
    "SomeSequenceType",
    "SomeValueType",
    "StrSomeScalarType",
    "StrSomeSequenceType",
    "StrSomeValueType",
    "coerce_list",
    "coerce_to_type",
    "extract_type",
    "get_typed_value",
    "is_instance_of",
    "is_instance_of_valid_type",
    "is_normalized_substitution",
    "is_substitution",
    "is_typing_list",
    "is_valid_scalar_type",
    "normalize_typed_substitution",
    "perform_typed_substitution",
]

ScalarTypesTuple = (int, float, bool, str)
# Users compare with typing.List, which is not equal to list.
ListTypesTuple = (List[int], List[float], List[bool], List[str])  # noqa: UP006
AllowedTypesTuple = ScalarTypesTuple + ListTypesTuple
ScalarTypesType = Any
AllowedTypesType = Any
ScalarValueType = int | float | bool | str
ListValueType = list[int] | list[float] | list[bool] | list[str]
AllowedValueType = ScalarValueType | ListValueType
SomeValueType = SomeSubstitutionsType | AllowedValueType
NormalizedValueType = Any
StrSomeValueType = Any
ListTypesType = Any
SequenceValueType = ListValueType
SomeScalarType = SomeSubstitutionsType | ScalarValueType
SomeSequenceType = SomeSubstitutionsType | SequenceValueType
StrSomeScalarType = Any
StrSomeSequenceType = Any
NormalizedScalarType = Any
NormalizedSequenceType = Any

# Which types the items of a list may have when another type is asked for.
_FITTING: dict[type, tuple[type, ...]] = {
    str: (str,),
    bool: (bool,),
    int: (int,),
    float: (int, float),
}


def is_typing_list(data_type: Any) -> bool:
    """Return whether a type is ``List`` or ``List[…]``."""
    return data_type is List or getattr(data_type, "__origin__", None) is list  # noqa: UP006


def is_valid_scalar_type(data_type: Any) -> bool:
    """Return whether a type is int, float, bool or str."""
    return data_type in ScalarTypesTuple


def extract_type(data_type: Any) -> tuple[Any, bool]:
    """Return the type of a scalar or of a list's items, and whether it is a list.

    Raises:
        ValueError: the type is not one of `AllowedTypesTuple`.
    """
    is_list = is_typing_list(data_type) and bool(getattr(data_type, "__args__", ()))
    scalar = data_type.__args__[0] if is_list else data_type
    if not is_valid_scalar_type(scalar):
        raise ValueError(f"Unrecognized data type: {data_type}")
    return scalar, is_list


def is_instance_of_valid_type(value: Any, *, can_be_str: bool = False) -> bool:
    """Return whether a value is a scalar or a list of scalars of one type."""
    if not isinstance(value, list):
        return isinstance(value, ScalarTypesTuple)
    member = next((type(item) for item in value if type(item) is not str), str)
    allowed = (member, str) if can_be_str else (member,)
    return member in ScalarTypesTuple and all(isinstance(item, allowed) for item in value)


def is_instance_of(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> bool:
    """Return whether a value has a type; with None, any of the allowed ones."""
    if data_type is None:
        return is_instance_of_valid_type(value, can_be_str=can_be_str)
    scalar, is_list = extract_type(data_type)
    allowed = (scalar, str) if can_be_str else (scalar,)
    if not is_list:
        return isinstance(value, allowed)
    return isinstance(value, list) and all(isinstance(item, allowed) for item in value)


def coerce_to_type(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    """Return a text as a value of a type; with None, as YAML would read it.

    Args:
        value: the text.
        data_type: one of `AllowedTypesTuple`, or None.
        can_be_str: a text that does not fit is returned as it is.

    Raises:
        ValueError: the text does not fit.
        TypeError: `value` is no text.
    """
    ensure_argument_type(value, str, "value", "coerce_to_type")
    if data_type is None:
        return _from_yaml(value, "using yaml rules", can_be_str)
    scalar, is_list = extract_type(data_type)
    if is_list:
        return _list_from_yaml(value, scalar, can_be_str)
    if scalar is str:
        return value
    if scalar is bool:
        return _bool_of(value, can_be_str)
    try:
        return scalar(value)
    except ValueError:
        if can_be_str:
            return value
        raise


def _bool_of(value: str, can_be_str: bool) -> Any:
    text = {"1": "true", "0": "false"}.get(value, value)
    found = _from_yaml(text, "to '<class 'bool'>'", can_be_str)
    if isinstance(found, (bool, str) if can_be_str else bool):
        return found
    raise ValueError(f"Cannot convert value '{value}' to '{bool}'")


def _list_from_yaml(value: str, scalar: Any, can_be_str: bool) -> Any:
    allowed = (str, scalar) if can_be_str else scalar
    found = _from_yaml(value, f"to a list of '{allowed}'", can_be_str)
    if isinstance(found, list) and all(isinstance(item, allowed) for item in found):
        return found
    raise ValueError(f"Cannot convert value '{value}' to a list of '{allowed}', got {found}")


def _from_yaml(value: str, how: str, can_be_str: bool) -> Any:
    if not value:
        return value
    try:
        found = load_yaml(value)
    except YamlError as error:
        if can_be_str:
            return value
        raise ValueError(f"Failed to convert '{value}' {how}: {error}") from error
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(
            f"Failed to convert '{value}' {how}: output type is not allowed, got {type(found)}"
        )
    return found


def coerce_list(value: Any, data_type: Any = None, *, can_be_str: bool = False) -> Any:
    """Return a list of texts as a list of values of one type.

    Raises:
        ValueError: one of them does not fit.
        TypeError: `value` is no list of texts.
    """
    ensure_argument_type(value, list, "value", "coerce_list")
    found = [coerce_to_type(item, data_type, can_be_str=can_be_str) for item in value]
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f"cannot convert value to {data_type}. Got value=`{value}`")
    return found


def get_typed_value(value: Any, data_type: Any, *, can_be_str: bool = False) -> Any:
    """Return a text or a list of texts as a value of a type.

    Raises:
        ValueError: a text does not fit.
        TypeError: a list is given where a scalar is wanted, or something is no text.
    """
    if not isinstance(value, list):
        return coerce_to_type(value, data_type, can_be_str=can_be_str)
    if data_type is not None:
        data_type, is_list = extract_type(data_type)
        if not is_list:
            kind = type(value)
            raise TypeError(f"Cannot convert input '{value}' of type '{kind}' to '{data_type}'")
    return coerce_list(value, data_type, can_be_str=can_be_str)


def is_substitution(value: Any) -> bool:
    """Return whether something is a substitution, or texts and substitutions to be joined."""
    if isinstance(value, Substitution):
        return True
    if isinstance(value, str) or not isinstance(value, collections.abc.Iterable):
        return False
    items = list(value)
    fitting = all(isinstance(item, Substitution | str) for item in items)
    return fitting and any(isinstance(item, Substitution) for item in items)


def is_normalized_substitution(value: Any) -> bool:
    """Return whether something is a list of substitutions."""
    return (
        isinstance(value, list)
        and bool(value)
        and all(isinstance(item, Substitution) for item in value)
    )


def normalize_typed_substitution(value: Any, data_type: Any) -> Any:
    """Return a value, or substitutions that will become one, in a form to perform later.

    ``['a', TextSubstitution(text='b')]`` is one substitution, ``['a', [TextSubstitution(…)]]`` a
    list of two.

    Raises:
        TypeError: it can never become a value of the type.
        ValueError: the type is not one of `AllowedTypesTuple`.
    """
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"value='{value}' is not an instance of {data_type}")
        return value
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not isinstance(value, collections.abc.Iterable):
        raise TypeError(
            "value should be either a scalar, a substitutions, or a mixed list of scalars and "
            f"substitutions. Got `value={value}` of type `{type(value)}`. "
        )
    return _normalized_list(list(value), data_type)


def _normalized_list(items: list[Any], data_type: Any) -> list[Any]:
    for item in items:
        if not isinstance(item, ScalarTypesTuple) and not is_substitution(item):
            raise TypeError(
                "value is a list, and one of the items is not a scalar, a Substitution "
                f"or a list of substitutions. Got value='{items}'"
            )
    scalar, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise TypeError(
            "The provided value resolves to a list, though the required type is a scalar. "
            f"Got value='{items}', data_type='{data_type}'."
        )
    found = {type(item) for item in items if isinstance(item, ScalarTypesTuple)}
    kind = next((one for one, types in _FITTING.items() if found <= set(types)), None)
    if kind is None or (found and scalar not in (None, kind)):
        known = "" if kind is None else f" of '{kind}'"
        raise TypeError(f"Got a list{known}, expected a list of '{scalar}'. value='{items}'")
    return [
        normalize_to_list_of_substitutions(item)
        if is_substitution(item)
        else (float(item) if kind is float else item)
        for item in items
    ]


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any) -> Any:
    """Return the value of what `normalize_typed_substitution` made.

    Raises:
        TypeError: it can never become a value of the type.
        ValueError: its texts do not fit the type.
    """
    if isinstance(value, ScalarTypesTuple):
        if data_type is not None and not is_instance_of(value, data_type):
            raise TypeError(f"value=`{value}` is a scalar and not an instance of `{data_type}`")
        return value
    if is_normalized_substitution(value):
        return coerce_to_type(perform_substitutions(context, value), data_type)
    if not isinstance(value, list):
        raise TypeError(
            f"Input value is not an acceptable 'NormalizedValueType'. Got value='{value}'"
        )
    scalar, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise ValueError(
            "The input value is a list, cannot convert it to a scalar. "
            f"Got value='{value}', expected type {scalar}."
        )
    found = [
        coerce_to_type(perform_substitutions(context, item), scalar)
        if is_normalized_substitution(item)
        else item
        for item in value
    ]
    if not is_instance_of(found, data_type):
        raise ValueError(
            f"The output list does not match the expected type. Got value='{value}', "
            f"expected type {scalar}."
        )
    return found
