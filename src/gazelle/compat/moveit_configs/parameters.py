"""``launch_param_builder.ParameterBuilder``: parameters out of a package's files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.compat.moveit_configs.files import (
    ParameterValueType,
    load_file,
    load_xacro,
    load_yaml,
)
from gazelle.workspace.ament_index import get_package_share_directory

__all__ = ["ParameterBuilder"]


class ParameterBuilder:
    """Collects parameters; every method returns the builder."""

    def __init__(self, package_name: str) -> None:
        """Start with a package whose files are read.

        Raises:
            PackageNotFoundError: there is no such package.
        """
        self._package_path = Path(get_package_share_directory(package_name))
        self._parameters: dict[str, Any] = {}

    def yaml(self, file_path: str, parameter_namespace: str | None = None) -> ParameterBuilder:
        """Add what a YAML file holds, below a name if there is one."""
        values = load_yaml(self._package_path / file_path)
        if parameter_namespace:
            self._parameters.setdefault(parameter_namespace, {}).update(values)
        else:
            self._parameters.update(values)
        return self

    def file_parameter(self, parameter_name: str, file_path: str) -> ParameterBuilder:
        """Add a parameter with a file's text."""
        self._parameters[parameter_name] = load_file(self._package_path / file_path)
        return self

    def xacro_parameter(
        self, parameter_name: str, file_path: str, mappings: Mapping[str, Any] | None = None
    ) -> ParameterBuilder:
        """Add a parameter with what a xacro file expands to."""
        self._parameters[parameter_name] = load_xacro(self._package_path / file_path, mappings)
        return self

    def parameter(
        self, parameter_name: str, parameter_value: ParameterValueType
    ) -> ParameterBuilder:
        """Add a parameter with a value."""
        self._parameters[parameter_name] = parameter_value
        return self

    def path_parameter(self, parameter_name: str, file_path: str) -> ParameterBuilder:
        """Add a parameter with the path of one of the package's files."""
        self._parameters[parameter_name] = str(self._package_path / file_path)
        return self

    def to_dict(self) -> dict[str, Any]:
        """Return all parameters."""
        return self._parameters
