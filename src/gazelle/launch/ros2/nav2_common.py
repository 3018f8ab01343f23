"""nav2_common.launch: what launch files of Nav2 do to files of parameters."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import dump_yaml, load_yaml
from gazelle.launch.ros2.condition import Condition
from gazelle.launch.ros2.launch_ros.parameter_descriptions import write_temporary
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions import LaunchConfiguration
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "HasNodeParams",
    "LaunchConfigAsBool",
    "ParseMultiRobotPose",
    "ReplaceString",
    "RewrittenYaml",
]

_TRUE = frozenset({"true", "1", "yes", "on"})
_POSE = {"x": 0.0, "y": 0.0, "z": 0.0, "roll": 0.0, "pitch": 0.0, "yaw": 0.0}
_PARAMETERS = "ros__parameters"


class RewrittenYaml(Substitution):
    """The path of a changed copy of a file of parameters.

    A key of `param_rewrites` is the name of a parameter wherever it stands, or a path with dots,
    which is added when it leads through ``ros__parameters``.
    """

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        param_rewrites: Mapping[str, SomeSubstitutionsType],
        root_key: SomeSubstitutionsType | None = None,
        key_rewrites: Mapping[str, SomeSubstitutionsType] | None = None,
        convert_types: bool = False,
    ) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(source_file)
        self.__values = _substitutions(param_rewrites)
        self.__keys = _substitutions(key_rewrites or {})
        self.__root = None if root_key is None else normalize_to_list_of_substitutions(root_key)
        self.__convert_types = convert_types

    def describe(self) -> str:
        """Return a text for people."""
        return f"RewrittenYaml({' + '.join(one.describe() for one in self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Write the copy, which is deleted with the launch, and return its path.

        Raises:
            OSError: the file cannot be read.
            YamlError: it is no YAML.
        """
        data = load_yaml(read_text_limited(perform_substitutions(context, self.name))) or {}
        values = {
            key: self.__typed(perform_substitutions(context, subs))
            for key, subs in self.__values.items()
        }
        _rewrite_leaves(data, values)
        for path, value in values.items():
            _rewrite_path(data, path.split("."), value, may_add=_PARAMETERS in path.split("."))
        keys = {key: perform_substitutions(context, subs) for key, subs in self.__keys.items()}
        data = _renamed(data, keys)
        root = perform_substitutions(context, self.__root) if self.__root else ""
        return str(write_temporary(dump_yaml({root: data} if root else data)))

    def __typed(self, text: str) -> Any:
        if self.__convert_types:
            for kind in (int, float):
                try:
                    return kind(text)
                except ValueError:
                    continue
        return {"true": True, "false": False}.get(text.lower(), text)


class ReplaceString(Substitution):
    """The path of a copy of a file with texts replaced; of the file itself unless `condition`."""

    def __init__(
        self,
        source_file: SomeSubstitutionsType,
        replacements: Mapping[str, SomeSubstitutionsType],
        condition: Condition | None = None,
    ) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(source_file)
        self.condition = condition
        self.__replacements = _substitutions(replacements)

    def describe(self) -> str:
        """Return a text for people."""
        return f"ReplaceString({' + '.join(one.describe() for one in self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Write the copy, which is deleted with the launch, and return its path.

        Raises:
            OSError: the file cannot be read.
        """
        path = perform_substitutions(context, self.name)
        if self.condition is not None and not self.condition.evaluate(context):
            return path
        text = read_text_limited(path)
        for old, subs in self.__replacements.items():
            text = text.replace(old, perform_substitutions(context, subs))
        return str(write_temporary(text))


class HasNodeParams(Substitution):
    """``True`` or ``False``: whether a file of parameters has some for a node."""

    def __init__(self, source_file: SomeSubstitutionsType, node_name: str) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(source_file)
        self.__node_name = node_name

    def describe(self) -> str:
        """Return a text for people."""
        return f"HasNodeParams({self.__node_name})"

    def perform(self, context: LaunchContext) -> str:
        """Read the file.

        Raises:
            OSError: the file cannot be read.
        """
        data = load_yaml(read_text_limited(perform_substitutions(context, self.name))) or {}
        return str(self.__node_name in data)


class LaunchConfigAsBool(Substitution):
    """``True`` or ``False`` for what people write, such as ``yes`` and ``1``."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.__configuration = LaunchConfiguration(name)

    def describe(self) -> str:
        """Return a text for people."""
        return f"LaunchConfigAsBool({self.__configuration.describe()})"

    def perform(self, context: LaunchContext) -> str:
        """Look it up."""
        value = perform_substitutions(context, [self.__configuration])
        return str(value.strip().lower() in _TRUE)


class ParseMultiRobotPose(Substitution):
    """Poses by robot: ``robots:="r1={x: 1.0, yaw: 1.57}; r2={x: 2.0}"``.

    Given a name, as up to Iron, it reads the command line, and `value` returns the poses; given a
    substitution, as since Jazzy, `perform` does.
    """

    def __init__(self, robots_argument: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__given = robots_argument

    def describe(self) -> str:
        """Return a text for people."""
        return "ParseMultiRobotPose()"

    def value(self) -> dict[str, dict[str, Any]]:
        """Return the poses that the command line gives."""
        sign = f"{self.__given}:="
        given = [word.removeprefix(sign) for word in sys.argv if word.startswith(sign)]
        return _poses(given[-1] if given else "")

    def perform(self, context: LaunchContext) -> Any:
        """Return the poses."""
        subs = normalize_to_list_of_substitutions(self.__given)
        return _poses(perform_substitutions(context, subs))


def _poses(text: str) -> dict[str, dict[str, Any]]:
    found = {}
    for entry in text.split(";"):
        robot, sign, pose = entry.partition("=")
        if sign:
            found[robot.strip()] = {**_POSE, **(load_yaml(pose) or {})}
    return found


def _substitutions(given: Mapping[str, SomeSubstitutionsType]) -> dict[str, Any]:
    return {name: normalize_to_list_of_substitutions(value) for name, value in given.items()}


def _rewrite_leaves(data: Any, values: Mapping[str, Any]) -> None:
    """Put values at all keys of their names, whatever stands there."""
    if not isinstance(data, dict):
        return
    for key in data:
        _rewrite_leaves(data[key], values)
        if key in values:
            data[key] = values[key]


def _rewrite_path(data: Any, path: list[str], value: Any, *, may_add: bool) -> None:
    """Put a value at the end of a path through mappings and lists."""
    *way, last = path
    for key in way:
        if isinstance(data, list):
            data = data[int(key)] if key.isdigit() and int(key) < len(data) else None
        elif isinstance(data, dict):
            data = data.setdefault(key, {}) if may_add else data.get(key)
    if isinstance(data, list) and last.isdigit() and int(last) < len(data):
        data[int(last)] = value
    elif isinstance(data, dict) and (may_add or last in data):
        data[last] = value


def _renamed(data: Any, keys: Mapping[str, str]) -> Any:
    if not isinstance(data, dict):
        return data
    return {keys.get(key, key): _renamed(value, keys) for key, value in data.items()}
