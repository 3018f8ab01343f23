"""launch_ros.utilities.to_parameters_list, and the names of types."""

from __future__ import annotations

import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.parameter import Parameter as RosParameter
from gazelle.errors import GraphError
from gazelle.launch.ros2.launch_ros.parameter_descriptions import (
    Parameter,
    ParameterFile,
    ParameterValue,
)
from gazelle.launch.ros2.launch_ros.utilities import parameter_values
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
    Substitution,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "EvaluatedParameterValue",
    "EvaluatedParameters",
    "ParameterFile",
    "ParameterName",
    "ParameterValue",
    "Parameters",
    "ParametersDict",
    "RemapRule",
    "RemapRules",
    "SomeParameterFile",
    "SomeParameterName",
    "SomeParameterValue",
    "SomeParameterValue_types_tuple",
    "SomeParameters",
    "SomeParametersDict",
    "SomeRemapRule",
    "SomeRemapRules",
    "to_parameters_list",
]

SomeParameterFile = SomeSubstitutionsType | pathlib.Path | ParameterFile
SomeParameterName = Sequence[Substitution | str]
SomeParameterValue = Any
SomeParameterValue_types_tuple = (*SomeSubstitutionsType_types_tuple, str, int, float, bool, bytes)
SomeParametersDict = Mapping[SomeParameterName, Any]
SomeParameters = Sequence[SomeParameterFile | Parameter | SomeParametersDict]
ParameterName = Sequence[Substitution]
ParametersDict = dict[ParameterName, Any]
Parameters = Sequence[ParameterFile | ParametersDict | Parameter]
EvaluatedParameterValue = Any
EvaluatedParameters = Sequence[pathlib.Path | Parameter | dict[str, EvaluatedParameterValue]]
SomeRemapRule = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
SomeRemapRules = Iterable[SomeRemapRule]
RemapRule = tuple[tuple[Substitution, ...], tuple[Substitution, ...]]
RemapRules = Iterable[RemapRule]


def to_parameters_list(
    context: LaunchContext, node_name: str, namespace: str | None, evaluated_parameters: Any
) -> list[RosParameter]:
    """Return evaluated parameters as those of rclpy, files read for one node.

    Raises:
        RuntimeError: a value has no type of parameters.
    """
    found = []
    for name, value in parameter_values(context, node_name, namespace, evaluated_parameters):
        plain = list(value) if isinstance(value, tuple) else value
        try:
            found.append(RosParameter(name, RosParameter.Type.from_parameter_value(plain), plain))
        except (GraphError, TypeError) as error:
            raise RuntimeError(f"invalid parameter value {value!r}") from error
    return found
