"""Parameters of a node (rclpy.parameter)."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from gazelle.errors import GraphError
from gazelle.graph.ros2_parameter_values import ParameterType, value_from_message, value_message
from gazelle.interfaces import message_type

__all__ = [
    "PARAMETER_SEPARATOR_STRING",
    "AllowableParameterValueT",
    "Parameter",
    "get_parameter_value",
    "parameter_dict_from_yaml_file",
    "parameter_value_to_python",
]

AllowableParameterValueT = TypeVar("AllowableParameterValueT")

PARAMETER_SEPARATOR_STRING = "."


class Parameter:
    """A name with a value.

    Args:
        name: not empty; parts are separated by dots.
        type_: found from the value by default.
        value: the value.

    Raises:
        TypeError: the type is no `Parameter.Type`.
        ValueError: value and type do not fit.
    """

    Type: TypeAlias = ParameterType

    def __init__(self, name: str, type_: ParameterType | None = None, value: Any = None) -> None:
        if type_ is None:
            type_ = Parameter.Type.from_parameter_value(value)
        if not isinstance(type_, ParameterType):
            raise TypeError("type must be an instance of Parameter.Type")
        if not type_.check(value):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")
        self._name = name
        self._type = type_
        self._value = value

    @property
    def name(self) -> str:
        """Its name."""
        return self._name

    @property
    def type_(self) -> Parameter.Type:
        """Its kind."""
        return self._type

    @property
    def value(self) -> Any:
        """Its value, None when it is not set."""
        return self._value

    @classmethod
    def from_parameter_msg(cls, param_msg: Any) -> Parameter:
        """Return the parameter of a ``rcl_interfaces/msg/Parameter``."""
        kind = Parameter.Type(param_msg.value.type)
        return cls(param_msg.name, kind, value_from_message(param_msg.value))

    def get_parameter_value(self) -> Any:
        """Return ``rcl_interfaces/msg/ParameterValue``."""
        return value_message(self._value)

    def to_parameter_msg(self) -> Any:
        """Return ``rcl_interfaces/msg/Parameter``."""
        make = message_type("rcl_interfaces/msg/Parameter")
        return make(name=self._name, value=self.get_parameter_value())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Parameter):
            return NotImplemented
        return (self._name, self._type, self._value) == (other.name, other.type_, other.value)

    def __hash__(self) -> int:
        return hash((self._name, self._type))

    def __repr__(self) -> str:
        return f"Parameter(name={self._name!r}, type_={self._type!s}, value={self._value!r})"


def parameter_value_to_python(parameter_value: Any) -> Any:
    """Return the Python value of a ``rcl_interfaces/msg/ParameterValue``."""
    return value_from_message(parameter_value)


def get_parameter_value(string_value: str) -> Any:
    """Return ``ParameterValue`` of a text as the command line takes it: YAML, or the text."""
    from gazelle.documents.yaml import YamlError, load_yaml

    try:
        return value_message(load_yaml(string_value))
    except (YamlError, GraphError):
        return value_message(string_value)


def parameter_dict_from_yaml_file(
    parameter_file: str,
    use_wildcard: bool = False,
    target_nodes: list[str] | None = None,
    namespace: str = "",
) -> dict[str, Any]:
    """Return the parameters of a file as messages, by name with dots.

    Args:
        parameter_file: ``node: ros__parameters: …``.
        use_wildcard: take what is said about ``/**`` as well.
        target_nodes: nodes to take; all when None.
        namespace: put before each name.

    Raises:
        RuntimeError: nothing is said about the nodes.
        UserFileError: the file has errors.
    """
    from gazelle.control.parameter_sources.ros2_parameter_file import read_parameter_file
    from gazelle.diagnostics import Diagnostics
    from gazelle.parameters.trees import flattened, values_only

    diagnostics = Diagnostics()
    sections = read_parameter_file(Path(parameter_file), diagnostics)
    diagnostics.raise_if_errors()
    wanted = None if target_nodes is None else [f"/{name.lstrip('/')}" for name in target_nodes]
    found: dict[str, Any] = {}
    for section in sections:
        is_wild = "*" in section.node
        if use_wildcard if is_wild else wanted is None or section.node in wanted:
            found |= {
                f"{namespace}{name}": value
                for name, value in values_only(flattened(section.values))
            }
    if not found:
        nodes = ", ".join(section.node for section in sections) or "no nodes"
        raise RuntimeError(f"Param file does not contain any valid parameters (it has {nodes})")
    return {name: Parameter(name, value=value).to_parameter_msg() for name, value in found.items()}
