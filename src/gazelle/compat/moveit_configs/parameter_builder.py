"""``launch_param_builder.ParameterBuilder``: parameters out of a package's files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gazelle.compat.moveit_configs.parameter_files import (
    ParameterValueType,
    load_file,
    load_xacro,
    load_yaml,
    raise_if_file_not_found,
)
from gazelle.workspace.ament_index import get_package_share_directory

__all__ = ["ParameterBuilder", "expanded_parameter"]


def expanded_parameter(file: Path, mappings: Mapping[Any, Any] | None) -> Any:
    """Return a file's expanded text, or a parameter that will be it when the launch runs.

    Raises:
        ParameterBuilderFileNotFoundError: the file is not there.
    """
    plain = (str, int, float, Path)
    if all(isinstance(one, plain) for pair in (mappings or {}).items() for one in pair):
        return load_xacro(file, mappings)
    # Programs without a launch build their parameters here too, and have no use for it.
    from gazelle.compat.moveit_configs.xacro_substitution import Xacro
    from gazelle.launch.ros2.launch_ros.parameter_descriptions import ParameterValue

    raise_if_file_not_found(file)
    return ParameterValue(Xacro(str(file), mappings=mappings), value_type=str)


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
        values = load_yaml(self._file(file_path, "yaml"))
        if parameter_namespace:
            self._parameters.setdefault(parameter_namespace, {}).update(values)
        else:
            self._parameters.update(values)
        return self

    def file_parameter(self, parameter_name: str, file_path: str) -> ParameterBuilder:
        """Add a parameter with a file's text."""
        self._parameters[parameter_name] = load_file(self._file(file_path, "file_parameter"))
        return self

    def xacro_parameter(
        self, parameter_name: str, file_path: str, mappings: Mapping[str, Any] | None = None
    ) -> ParameterBuilder:
        """Add a parameter with what a xacro file expands to.

        `mappings` are texts or substitutions; with these, the launch expands the file.
        """
        file = self._file(file_path, "xacro_parameter")
        self._parameters[parameter_name] = expanded_parameter(file, mappings)
        return self

    def parameter(
        self, parameter_name: str, parameter_value: ParameterValueType
    ) -> ParameterBuilder:
        """Add a parameter with a value."""
        self._parameters[parameter_name] = parameter_value
        return self

    def path_parameter(self, parameter_name: str, file_path: str) -> ParameterBuilder:
        """Add a parameter with the path of one of the package's files."""
        self._parameters[parameter_name] = str(self._file(file_path, "path_parameter"))
        return self

    def to_dict(self) -> dict[str, Any]:
        """Return all parameters."""
        return self._parameters

    def _file(self, file_path: str | Path, method: str) -> Path:
        """Return the path of a file that is written absolute or relative to the package.

        Raises:
            TypeError: it is a substitution or something else, and the file is read at once.
        """
        if not isinstance(file_path, str | Path):
            raise TypeError(
                f"{method}: the file's path is a {type(file_path).__name__}, and the file is read"
                " before any substitution has a value (unsupported operand type(s) for /:"
                " 'PosixPath'); write the path, or build the parameters in an OpaqueFunction"
                " with LaunchConfiguration(...).perform(context)"
            )
        return self._package_path / file_path
