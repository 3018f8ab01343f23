"""launch_ros.parameter_descriptions: values, rules and files of parameters."""

from __future__ import annotations

import atexit
import os
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile, gettempdir
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import MAX_CHARACTERS, YamlError, load_yaml
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
)
from gazelle.launch.ros2.substitutions import SubstitutionFailure
from gazelle.launch.ros2.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)
from gazelle.user_folders import own_prefix, sweep

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Parameter", "ParameterFile", "ParameterValue", "write_temporary"]

_PREFIX = "launch_params_"


class ParameterValue:
    """A value that is to have a type, whatever its text looks like.

    Attributes:
        value: the value, or what it will be made of.
        value_type: int, float, bool, str, a ``List`` of one of them, or None for YAML's rules.
    """

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.__evaluated: Any = None

    @property
    def value(self) -> Any:
        """The value once it is evaluated, before that what it is made of."""
        return self.__value if self.__evaluated is None else self.__evaluated

    @property
    def value_type(self) -> Any:
        """The type that is asked for."""
        return self.__value_type

    def __str__(self) -> str:
        inner = f"value={self.value}, value_type={self.value_type}"
        return f"launch_ros.description.ParameterValue({inner})"

    def evaluate(self, context: LaunchContext) -> Any:
        """Return the value.

        Raises:
            TypeError: it can never have the type.
            ValueError: its text does not fit the type.
        """
        self.__evaluated = perform_typed_substitution(context, self.value, self.value_type)
        return self.__evaluated


class Parameter:
    """A name and its value, given to a node as ``-p NAME:=VALUE``."""

    def __init__(self, name: SomeSubstitutionsType, value: Any, *, value_type: Any = None) -> None:
        ensure_argument_type(name, SomeSubstitutionsType_types_tuple, "name")
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = ParameterValue(value, value_type=value_type)
        self.__evaluated_name: str | None = None

    @property
    def name(self) -> Any:
        """The name once it is evaluated, before that what it is made of."""
        return self.__name if self.__evaluated_name is None else self.__evaluated_name

    @property
    def value(self) -> Any:
        """The value once it is evaluated, before that what it is made of."""
        return self.__value.value

    @property
    def value_type(self) -> Any:
        """The type that is asked for."""
        return self.__value.value_type

    def __str__(self) -> str:
        inner = f"name={self.name}, value={self.value}, value_type={self.value_type}"
        return f"launch_ros.description.Parameter({inner})"

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Return name and value; they are found out once."""
        if self.__evaluated_name is None:
            name = perform_substitutions(context, self.__name)
            self.__value.evaluate(context)
            self.__evaluated_name = name
        return self.__evaluated_name, self.__value.value


class ParameterFile:
    """A YAML file with parameters; ``$(…)`` in it counts when `allow_substs` says so."""

    def __init__(self, param_file: Any, *, allow_substs: Any = False) -> None:
        self.__evaluated: Path | None = None
        self.__is_temporary = False
        types = (*SomeSubstitutionsType_types_tuple, os.PathLike, bytes)
        ensure_argument_type(param_file, types, "param_file", "ParameterFile()")
        is_text = isinstance(param_file, SomeSubstitutionsType_types_tuple)
        self.__param_file = (
            normalize_to_list_of_substitutions(param_file) if is_text else param_file
        )
        self.__allow_substs = normalize_typed_substitution(allow_substs, bool)

    @property
    def param_file(self) -> Any:
        """The path once it is evaluated, before that what it is made of."""
        return self.__param_file if self.__evaluated is None else self.__evaluated

    @property
    def allow_substs(self) -> Any:
        """Whether ``$(…)`` in the file counts."""
        return self.__allow_substs

    def __str__(self) -> str:
        inner = f"param_file={self.param_file}, allow_substs={self.allow_substs}"
        return f"launch_ros.description.ParameterFile({inner})"

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path of the file, or of a copy in which substitutions are performed.

        Raises:
            SubstitutionFailure: with its substitutions performed it is no YAML.
            OSError: it cannot be read.
        """
        if self.__evaluated is None:
            given = self.__param_file
            text = perform_substitutions(context, given) if isinstance(given, list) else given
            path = Path(os.fsdecode(text))
            if perform_typed_substitution(context, self.__allow_substs, bool):
                path = _substituted(path, context)
                self.__is_temporary = True
            self.__evaluated = path
        return self.__evaluated

    def cleanup(self) -> None:
        """Delete the copy, if one was made."""
        if self.__is_temporary and self.__evaluated is not None:
            self.__evaluated.unlink(missing_ok=True)
            self.__evaluated = None


def write_temporary(text: str) -> Path:
    """Write a file of parameters that is deleted when the launcher ends.

    ROS 2 leaves it behind; a node that is started again reads it again. What a launcher that was
    killed left is deleted by the next one.
    """
    with NamedTemporaryFile(
        mode="w", prefix=own_prefix(_PREFIX), suffix="", delete=False, encoding="utf-8"
    ) as file:
        file.write(text)
    path = Path(file.name)
    _written().append(path)
    return path


@cache
def _written() -> list[Path]:
    files: list[Path] = []
    sweep(Path(gettempdir()), _PREFIX)

    def delete() -> None:
        for path in files:
            path.unlink(missing_ok=True)

    atexit.register(delete)
    return files


def _substituted(path: Path, context: LaunchContext) -> Path:
    from gazelle.launch.ros2.frontend.parse_substitution import parse_substitution
    from gazelle.launch.ros2.frontend.parser import Parser

    Parser.load_launch_extensions()
    parts = parse_substitution(read_text_limited(path, MAX_CHARACTERS))
    text = perform_substitutions(context, parts)
    try:
        load_yaml(text)
    except YamlError as error:
        raise SubstitutionFailure(
            f"The substituted parameter file is not a valid yaml file: {path}: {error}"
        ) from error
    return write_temporary(text)
