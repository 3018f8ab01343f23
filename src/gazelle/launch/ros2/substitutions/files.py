"""Files and folders: filename, dirname, find-exec, file-content, log_dir, joined paths."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import did_you_mean
from gazelle.launch.environment import ROS_COMMANDS
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import (
    SubstitutionFailure,
    counted,
    described,
)
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "FileContent",
    "FindExecutable",
    "LaunchLogDir",
    "PathJoinSubstitution",
    "PathSubstitution",
    "ThisLaunchFile",
    "ThisLaunchFileDir",
]


class PathJoinSubstitution(Substitution):
    """A path of parts.

    Attributes:
        substitutions: the parts; each may be several substitutions that are joined first.
    """

    def __init__(self, substitutions: Any) -> None:
        super().__init__()
        self.substitutions = [normalize_to_list_of_substitutions(part) for part in substitutions]

    def describe(self) -> str:
        """Return a text for people."""
        return f"PathJoin('{' + '.join(described(part) for part in self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        parts = [perform_substitutions(context, part) for part in self.substitutions]
        # Not Path: it would take a trailing slash away.
        return os.path.join(*parts)  # noqa: PTH118

    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return the path with one more part."""
        return PathJoinSubstitution([*self.substitutions, additional_path])


class PathSubstitution(PathJoinSubstitution):
    """A path to which parts are added with ``/``, as to a `pathlib.Path`."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        """Begin a path.

        Args:
            path: its first part, or several parts.
        """
        super().__init__(normalize_to_list_of_substitutions(path))


@expose_substitution("find-exec")
class FindExecutable(Substitution):
    """The path of a program on ``PATH``.

    Attributes:
        name: of the program.
    """

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[FindExecutable], dict[str, Any]]:
        """Return class and arguments of a ``$(find-exec name)``."""
        return cls, {"name": counted(data, 1, 1, "find-exec")[0]}

    def describe(self) -> str:
        """Return a text for people."""
        return f"FindExec({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path.

        Raises:
            SubstitutionFailure: it is not on the path.
        """
        name = perform_substitutions(context, self.name)
        found = shutil.which(name)
        if found is None:
            hint = did_you_mean(name, ROS_COMMANDS)
            message = f"executable '{name}' not found on the PATH"
            raise SubstitutionFailure(f"{message}; {hint}" if hint else message)
        return found


@expose_substitution("file-content")
class FileContent(Substitution):
    """The text of a file.

    Attributes:
        path: of the file.
    """

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__()
        self.path = normalize_to_list_of_substitutions(path)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[FileContent], dict[str, Any]]:
        """Return class and arguments of a ``$(file-content path)``."""
        return cls, {"path": counted(data, 1, 1, "file-content")[0]}

    def describe(self) -> str:
        """Return a text for people."""
        return f"FileContent({described(self.path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text.

        Raises:
            SubstitutionFailure: the file does not exist.
        """
        path = perform_substitutions(context, self.path)
        try:
            return Path(path).read_text(encoding="utf-8")
        except FileNotFoundError as error:
            raise SubstitutionFailure(f"File not found: {path}") from error


@expose_substitution("launch_log_dir")
@expose_substitution("log_dir")
class LaunchLogDir(Substitution):
    """The folder of this run's log files."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[LaunchLogDir], dict[str, Any]]:
        """Return class and arguments of a ``$(log_dir)``."""
        counted(data, 0, 0, "launch_log_dir/log_dir")
        return cls, {}

    def describe(self) -> str:
        """Return a text for people."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return launch_logging.launch_config.log_dir


class _OfThisFile(Substitution):
    def describe(self) -> str:
        """Return a text for people."""
        return f"{type(self).__name__}()"

    def _local(self, context: LaunchContext, name: str) -> str:
        found: str | None = context.get_locals_as_dict().get(name)
        if found is None:
            kind = type(self).__name__
            raise SubstitutionFailure(f"{kind} used outside of a launch file (in a script)")
        return found


@expose_substitution("filename")
class ThisLaunchFile(_OfThisFile):
    """The path of the launch file."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[ThisLaunchFile], dict[str, Any]]:
        """Return class and arguments of a ``$(filename)``."""
        counted(data, 0, 0, "filename")
        return cls, {}

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        return self._local(context, "current_launch_file_path")


@expose_substitution("dirname")
class ThisLaunchFileDir(_OfThisFile):
    """The folder of the launch file."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[ThisLaunchFileDir], dict[str, Any]]:
        """Return class and arguments of a ``$(dirname)``."""
        counted(data, 0, 0, "dirname")
        return cls, {}

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return self._local(context, "current_launch_file_directory")
