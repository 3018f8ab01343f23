"""Commands whose output becomes a robot description."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.description.xacro import expand_xacro, parse_xacro_arguments
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.launch_ros2.launch_file import Command, RobotSource
from gazelle.doctor.launch_ros2.launch_tree import Followed
from gazelle.doctor.launch_ros2.locating import located
from gazelle.documents.files import is_file
from gazelle.workspace import Workspace

__all__ = ["check_commands", "robots_of"]

_ENDINGS = (".urdf", ".xacro")
_COLON = ": "


def check_commands(
    files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report commands whose words run into each other, and outputs that are read as YAML."""
    for item in files:
        for command in item.file.commands:
            if command.is_substitution:
                _check_words(command, diagnostics)
                _check_wrapped(command, workspace, diagnostics)


def robots_of(files: Sequence[Followed]) -> Iterator[RobotSource]:
    """Yield the descriptions that a launch expands or reads, each once."""
    seen: set[Path] = set()
    for item in files:
        found = [robot for robot in map(_robot, item.file.commands) if robot is not None]
        found += [
            RobotSource(located(use.name) or Path(use.name), {}, use.span)
            for use in item.file.paths
            if use.name.endswith(_ENDINGS)
        ]
        for robot in found:
            if is_file(robot.path) and robot.path not in seen:
                seen.add(robot.path)
                yield robot


def _robot(command: Command) -> RobotSource | None:
    name, _, rest = command.text.strip().partition(" ")
    if Path(name).name not in {"xacro", "xacro.py"}:
        return None
    # What follows the first word that is not known may be an argument's half.
    words = [word for word in rest.split() if "…" not in word and not word.endswith(":=")]
    try:
        parsed = parse_xacro_arguments(words)
    except ValueError:
        return None
    path = located(parsed.file) or Path(parsed.file)
    return RobotSource(path, parsed.mappings, command.span)


def _check_words(command: Command, diagnostics: Diagnostics) -> None:
    if command.text.startswith(("xacro/", "xacro$", "cat/")):
        word = command.text.partition("/")[0]
        shown = command.text if len(command.text) < 60 else f"{command.text[:57]}…"
        text = f"Command joins its parts without blanks: '{shown}' (executed command failed. "
        text += f"[Errno 2] No such file or directory: '{shown}')"
        fix = f"write '{word} ' with a blank at its end"
        diagnostics.report("launch_ros2.command-words", text, command.span, fix=fix)


def _check_wrapped(command: Command, workspace: Workspace, diagnostics: Diagnostics) -> None:
    robot = _robot(command)
    if command.is_wrapped or robot is None or not is_file(robot.path):
        return
    expanded = expand_xacro(
        robot.path, mappings=robot.mappings, workspace=workspace, diagnostics=Diagnostics()
    )
    if expanded is None or _COLON not in expanded.text:
        return
    number = next(n for n, line in enumerate(expanded.text.splitlines(), 1) if _COLON in line)
    text = f"the output of '{robot.path.name}' is a parameter without ParameterValue(…, "
    text += f"value_type=str) and has a colon before a space in its line {number} (Unable to parse "
    text += "the value of parameter robot_description as yaml)"
    diagnostics.report("launch_ros2.unwrapped-command", text, command.span)
