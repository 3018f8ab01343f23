"""Parameters and remaps as launch files write them, in one form each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from gazelle.documents.yaml import Writer, YamlStyle, dump_yaml
from gazelle.launch.ros2.launch_ros.parameter_descriptions import (
    Parameter,
    ParameterFile,
    ParameterValue,
)
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType_types_tuple,
    Substitution,
    TextSubstitution,
)
from gazelle.launch.ros2.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
)

__all__ = [
    "normalize_parameter_dict",
    "normalize_parameters",
    "normalize_remap_rule",
    "normalize_remap_rules",
]

_Rule = tuple[tuple[Substitution, ...], tuple[Substitution, ...]]


def normalize_parameters(parameters: Any) -> tuple[Any, ...]:
    """Return files as `ParameterFile`, mappings flat, rules as they are.

    Raises:
        TypeError: it is no list, or a value has no type of parameters.
    """
    if isinstance(parameters, str | Mapping) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting list of parameters, got {parameters}")
    return tuple(_normalized(one) for one in parameters)


def _normalized(given: Any) -> Any:
    if isinstance(given, Mapping):
        return normalize_parameter_dict(given)
    return given if isinstance(given, Parameter | ParameterFile) else ParameterFile(given)


def normalize_parameter_dict(
    parameters: Mapping[Any, Any], *, _prefix: Sequence[Substitution] = ()
) -> dict[tuple[Substitution, ...], Any]:
    """Return one level of names, parts joined with dots, and values with one type each.

    Names are tuples of substitutions. A text becomes substitutions whose text is its YAML, so it
    stays a text; a substitution is read as YAML when it is evaluated.

    Raises:
        TypeError: it is no mapping, or a value has no type of parameters.
    """
    if not isinstance(parameters, Mapping):
        raise TypeError("expected dict")
    found: dict[tuple[Substitution, ...], Any] = {}
    for key, value in parameters.items():
        name = normalize_to_list_of_substitutions(key)
        if _prefix:
            name = [*_prefix, TextSubstitution(text="."), *name]
        if isinstance(value, Mapping):
            found |= normalize_parameter_dict(value, _prefix=name)
        else:
            found[tuple(name)] = _normalized_value(value, key)
    return found


def _normalized_value(value: Any, name: Any) -> Any:
    if isinstance(value, str):
        return tuple(normalize_to_list_of_substitutions(_as_yaml(value)))
    if isinstance(value, Substitution):
        return (value,)
    if isinstance(value, ParameterValue | float | bool | int | bytes):
        return value
    if isinstance(value, Sequence):
        return _normalized_list(value)
    raise TypeError(
        f"parameter {name!r} has an unexpected type for parameter value {value!r}; allowed are "
        "bool, int, float, str, bytes, substitutions and lists of them"
    )


def _normalized_list(values: Sequence[Any]) -> tuple[Any, ...]:
    for one in values:
        allowed = (float, int, str, bool, *SomeSubstitutionsType_types_tuple)
        ensure_argument_type(one, allowed, "subvalue")
    kinds = {_kind(one) for one in values}
    if kinds in ({int}, {bool}):
        return tuple(values)
    if kinds in ({float}, {int, float}):
        return tuple(float(one) for one in values)
    if Substitution in kinds and kinds <= {str, Substitution}:
        # Texts and substitutions side by side are one text.
        return tuple(normalize_to_list_of_substitutions(values))
    return tuple(normalize_to_list_of_substitutions(_item(one)) for one in values)


def _kind(value: Any) -> type:
    kinds: tuple[type, ...] = (Substitution, str, bool, int, float)
    return next((kind for kind in kinds if isinstance(value, kind)), tuple)


def _item(value: Any) -> Any:
    return _as_yaml(value) if isinstance(value, float | int | bool | str) else value


def _as_yaml(value: Any) -> str:
    return dump_yaml(value, YamlStyle(Writer.LIBYAML, allow_unicode=True))


def normalize_remap_rule(remap_rule: Any) -> _Rule:
    """Return both sides of a remap as substitutions.

    Raises:
        TypeError: it is no pair.
    """
    ensure_argument_type(remap_rule, tuple, "remap_rule")
    if len(remap_rule) != 2:
        raise TypeError(f"remap_rule must be a tuple of length 2, got length {len(remap_rule)}")
    source, target = (tuple(normalize_to_list_of_substitutions(one)) for one in remap_rule)
    return source, target


def normalize_remap_rules(remap_rules: Iterable[Any]) -> Iterator[_Rule]:
    """Yield `normalize_remap_rule` of each."""
    return map(normalize_remap_rule, remap_rules)
