"""``moveit_configs_utils.substitutions.Xacro``: a xacro file that a launch expands later."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.compat.moveit_configs.parameter_files import load_xacro
from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

__all__ = ["Xacro"]

_Mappings = Mapping[SomeSubstitutionsType, SomeSubstitutionsType]


@expose_substitution("xacro")
class Xacro(Substitution):
    """The text of an expanded xacro file; path and arguments may be substitutions.

    Attributes:
        file_path: what the path is put together of.
        mappings: arguments by name.
    """

    def __init__(
        self, file_path: SomeSubstitutionsType, *, mappings: _Mappings | None = None
    ) -> None:
        super().__init__()
        self.file_path = normalize_to_list_of_substitutions(file_path)
        self.mappings: _Mappings = {} if mappings is None else mappings

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[Xacro], dict[str, Any]]:
        """Read ``$(xacro FILE)`` of an XML or YAML launch file."""
        if len(data) != 1:
            raise TypeError(
                "xacro takes one argument, the file; use $(command 'xacro FILE NAME:=VALUE') for"
                " arguments"
            )
        return cls, {"file_path": data[0]}

    def describe(self) -> str:
        """Return a text for people."""
        arguments = ", ".join(f"{name!s}:={value!s}" for name, value in self.mappings.items())
        return f"Xacro(file_path = {self.file_path}, mappings = {arguments})"

    def perform(self, context: LaunchContext) -> str:
        """Return the expanded text."""
        arguments = {
            _performed(context, name): _performed(context, value)
            for name, value in self.mappings.items()
        }
        return load_xacro(Path(_performed(context, self.file_path)), mappings=arguments)


def _performed(context: LaunchContext, value: SomeSubstitutionsType) -> str:
    if isinstance(value, bool | int | float | Path):
        return str(value)
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))
