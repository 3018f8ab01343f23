"""Parameters and remaps as launch files write them, and what they come to in a running launch."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import Writer, YamlError, YamlStyle, dump_yaml, load_yaml
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
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "evaluate_parameter_dict",
    "evaluate_parameters",
    "normalize_parameter_dict",
    "normalize_parameters",
    "normalize_remap_rule",
    "normalize_remap_rules",
    "parameter_values",
]

_Rule = tuple[tuple[Substitution, ...], tuple[Substitution, ...]]
_SCALARS = (bool, int, float, str)
_VALUE_HINT = (
    "If the parameter is meant to be a string, try wrapping it in "
    "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
)
_ROOT = "ros__parameters"


def normalize_parameters(parameters: Any) -> tuple[Any, ...]:
    """Return files as `ParameterFile`, mappings flat, rules as they are.

    Raises:
        TypeError: it is no list, or a value has no type of parameters.
    """
    if isinstance(parameters, str | Mapping) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting list of parameters, got {parameters}")
    return tuple(_normalized(one) for one in parameters)


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


def evaluate_parameters(context: LaunchContext, parameters: Iterable[Any]) -> tuple[Any, ...]:
    """Return paths, rules (`Parameter`) and flat dictionaries of what was normalized.

    Raises:
        TypeError: a value has no type of parameters.
        ValueError: a text does not fit the type asked for.
    """
    found: list[Any] = []
    for one in parameters:
        if isinstance(one, ParameterFile):
            found.append(one.evaluate(context))
        elif isinstance(one, Parameter):
            found.append(one)
        elif isinstance(one, Mapping):
            found.append(evaluate_parameter_dict(context, one))
    return tuple(found)


def evaluate_parameter_dict(
    context: LaunchContext, parameters: Mapping[Any, Any]
) -> dict[str, Any]:
    """Return names and values of a normalized mapping.

    Raises:
        TypeError: it is not normalized, or a value has no type of parameters.
        ValueError: a text does not fit the type asked for.
    """
    if not isinstance(parameters, Mapping):
        raise TypeError("expected dict")
    found: dict[str, Any] = {}
    for key, value in parameters.items():
        if not isinstance(key, tuple):
            raise TypeError(f"Expecting tuple of substitutions got {key!r}")
        name = perform_substitutions(context, list(key))
        found[name] = _value(context, name, value)
    return found


def parameter_values(
    context: LaunchContext,
    node_name: str,
    namespace: str | None,
    evaluated_parameters: Iterable[Any],
) -> list[tuple[str, Any]]:
    """Return names and values for one node, in the order they are set; files are read.

    Args:
        context: of the launch.
        node_name: name of the node, which says which parts of a file count.
        namespace: of the node.
        evaluated_parameters: of `evaluate_parameters`.

    Raises:
        OSError: a file cannot be read.
        RuntimeError: something is neither file, rule nor dictionary.
    """
    space = (namespace or "").strip("/")
    full = "/".join(filter(None, (space, node_name.lstrip("/"))))
    found: list[tuple[str, Any]] = []
    for one in evaluated_parameters:
        if isinstance(one, Path):
            values = _from_file(context, one, full)
        elif isinstance(one, Parameter):
            values = dict([one.evaluate(context)])
        elif isinstance(one, dict):
            values = one
        else:
            raise RuntimeError(f"invalid evaluated parameters {one!r}")
        found += values.items()
    return found


def _normalized(given: Any) -> Any:
    if isinstance(given, Mapping):
        return normalize_parameter_dict(given)
    return given if isinstance(given, Parameter | ParameterFile) else ParameterFile(given)


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


def _value(context: LaunchContext, name: str, value: Any) -> Any:
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if not isinstance(value, tuple) or not value:
        ensure_argument_type(value, (float, int, str, bool, bytes), "value")
        return value
    if isinstance(value[0], Substitution):
        return _typed(name, perform_substitutions(context, value))
    if isinstance(value[0], Sequence):
        texts = [perform_substitutions(context, list(one)) for one in value]
        return _uniform(name, [_loaded(name, text) for text in texts])
    return tuple(type(value[0])(one) for one in value)


def _typed(name: str, text: str) -> Any:
    """Return a text as YAML reads it."""
    found = _loaded(name, text) if text else ""
    if isinstance(found, (*_SCALARS, bytes)):
        return found
    if isinstance(found, Sequence):
        return _uniform(name, found)
    raise TypeError(
        "Allowed value types are bytes, bool, int, float, str, Sequence[bool], Sequence[int], "
        f'Sequence[float], Sequence[str]. Got {type(found)} for "{name}". {_VALUE_HINT}'
    )


def _loaded(name: str, text: str) -> Any:
    try:
        return load_yaml(text)
    except YamlError as error:
        message = f"Unable to parse the value of parameter {name} as yaml. {_VALUE_HINT}"
        raise TypeError(message) from error


def _uniform(name: str, values: Sequence[Any]) -> tuple[Any, ...]:
    kind = type(values[0]) if values else None
    if kind not in _SCALARS or not all(isinstance(one, kind) for one in values):
        raise TypeError(
            "Expected a non-empty sequence, with items of uniform type. Allowed sequence item "
            f'types are bool, int, float, str. Got inconsistent input for "{name}"'
        )
    return tuple(values)


def _from_file(context: LaunchContext, path: Path, full_name: str) -> dict[str, Any]:
    data = load_yaml(read_text_limited(path)) or {}
    by_node: dict[str, dict[str, Any]] = {}
    _collect(data, (), by_node)
    # A file without the key is what some hand to components.
    mine = {**by_node.get("**", {}), **by_node.get(full_name, {})} if by_node else data
    return evaluate_parameter_dict(context, normalize_parameter_dict(mine))


def _collect(
    data: Mapping[Any, Any], keys: tuple[str, ...], found: dict[str, dict[str, Any]]
) -> None:
    for key, value in data.items():
        if key == _ROOT:
            found.setdefault("/".join(keys), {}).update(value or {})
        elif isinstance(value, Mapping):
            _collect(value, (*keys, str(key).lstrip("/")), found)
