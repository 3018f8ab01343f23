"""What parameters come to in a running launch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.launch.ros2.launch_ros.parameter_descriptions import (
    Parameter,
    ParameterFile,
    ParameterValue,
)
from gazelle.launch.ros2.launch_ros.utilities.normalizing import normalize_parameter_dict
from gazelle.launch.ros2.substitution import Substitution
from gazelle.launch.ros2.utilities import ensure_argument_type, perform_substitutions

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["evaluate_parameter_dict", "evaluate_parameters", "parameter_values"]

_SCALARS = (bool, int, float, str)
_VALUE_HINT = (
    "If the parameter is meant to be a string, try wrapping it in "
    "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
)
_ROOT = "ros__parameters"


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
