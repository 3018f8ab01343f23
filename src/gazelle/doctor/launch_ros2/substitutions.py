"""Substitutions of ROS 2 launch files, as far as they are known without launching."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any

from gazelle.doctor.launch_ros2.launch_file import Argument
from gazelle.workspace import Workspace
from gazelle.workspace.static_python import Call

__all__ = ["Substitutions"]

_MAX_DEPTH = 20


class Substitutions:
    """Turns substitutions into texts.

    Args:
        file: the launch file they stand in.
        given: launch arguments from outside; None for values that are not known.
        workspace: finds packages.
        declared: what the file itself declares.
    """

    def __init__(
        self,
        file: Path,
        given: Mapping[str, str | None],
        workspace: Workspace,
        declared: Sequence[Argument] = (),
    ) -> None:
        self._file = file
        self._workspace = workspace
        self._arguments: dict[str, str | None] = {item.name: item.default for item in declared}
        self._arguments.update(given)

    def declare(self, argument: Argument) -> None:
        """Take in a declared argument; a value from outside stays."""
        self._arguments.setdefault(argument.name, argument.default)

    def argument(self, name: str) -> str | None:
        """Return a launch argument's value, None when it is not known."""
        return self._arguments.get(name)

    def share(self, package: str) -> str | None:
        """Return a package's share folder: its source folder here."""
        found = self._workspace.packages.get(package)
        return None if found is None else str(found.path)

    def text(self, value: Any, depth: int = 0) -> str | None:
        """Return the text of a value, a list of values or a substitution; None when not known."""
        if depth > _MAX_DEPTH:
            return None
        if isinstance(value, str):
            return value
        if isinstance(value, bool | int | float | PurePath):
            return str(value)
        if isinstance(value, list | tuple):
            parts = [self.text(item, depth + 1) for item in value]
            return None if None in parts else "".join(part for part in parts if part is not None)
        return self._of_call(value, depth + 1) if isinstance(value, Call) else None

    def begin(self, value: Any) -> str:
        """Return the text of a list of values up to the first that is not known."""
        items = value if isinstance(value, list | tuple) else [value]
        begin = ""
        for item in items:
            text = self.text(item)
            if text is None:
                return begin
            begin += text
        return begin

    def _of_call(self, call: Call, depth: int) -> str | None:
        first = call.get("variable_name", 0)
        match call.name:
            case "LaunchConfiguration":
                found = self.argument(first) if isinstance(first, str) else None
                known = isinstance(first, str) and first in self._arguments
                return found if known else self.text(call.get("default", 1), depth)
            case "FindPackageShare":
                name = self.text(call.get("package", 0), depth)
                return None if name is None else self.share(name)
            case "PathJoinSubstitution":
                return self._joined(call.get("substitutions", 0), depth)
            case "TextSubstitution":
                return self.text(call.get("text", 0), depth)
            case "ThisLaunchFileDir":
                return str(self._file.parent)
            case "ThisLaunchFile":
                return str(self._file)
            case "FindExecutable":
                return self.text(call.get("name", 0), depth)
            case "EnvironmentVariable" | "EnvVar":
                name = self.text(call.get("name", 0), depth)
                value = os.environ.get(name or "")
                return value if value is not None else self.text(call.get("default_value"), depth)
            case "ParameterValue" | "perform" | "str" | "fspath":
                inner = call.owner if call.name == "perform" else call.get("value", 0)
                return self.text(inner, depth)
        return None

    def _joined(self, parts: Any, depth: int) -> str | None:
        texts = (
            [self.text(part, depth) for part in parts] if isinstance(parts, list | tuple) else []
        )
        if not texts or None in texts:
            return None
        return os.path.join(*(text for text in texts if text is not None))  # noqa: PTH118
