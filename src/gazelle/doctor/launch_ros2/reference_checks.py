"""Packages, files and commands that launch files name."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.description.xacro import expand_xacro, parse_xacro_arguments
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.launch_ros2.launch_file import Command, RobotSource, Use
from gazelle.doctor.launch_ros2.launch_tree import Followed, located, package_of
from gazelle.doctor.packages.dependency_checks import is_slip, known_packages
from gazelle.doctor.packages.source import SourcePackage
from gazelle.documents.files import is_file, is_folder
from gazelle.workspace import Package, Workspace

__all__ = ["check_commands", "check_packages", "check_paths", "paths_of", "robots_of"]

_ENDINGS = (".urdf", ".xacro")
_COLON = ": "


def check_commands(
    files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report commands whose words run into each other, and outputs that are read as YAML."""
    for item in files:
        for command in item.file.commands:
            if command.is_substitution:
                _check_blanks(command, diagnostics)
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
        found += [
            RobotSource(located(name) or Path(name))
            for name in sorted(item.file.opened)
            if name.endswith(_ENDINGS)
        ]
        for robot in found:
            if is_file(robot.path) and robot.path not in seen:
                seen.add(robot.path)
                yield robot


def check_packages(
    files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics
) -> None:
    """Report packages that are not here: mistyped ones one by one, others in one notice."""
    missing: dict[str, SourceSpan] = {}
    seen: set[str] = set()
    for use in _package_uses(files):
        if use.name in workspace.packages or use.name in seen:
            continue
        seen.add(use.name)
        near = nearest_names(use.name, [*workspace.packages, *known_packages()], count=1)
        if use.name not in known_packages() and near and is_slip(use.name, near[0]):
            text = f"there is no package '{use.name}' (PackageNotFoundError: \"package "
            text += f"'{use.name}' not found, searching: …\")"
            hint = did_you_mean(use.name, near)
            diagnostics.report("launch_ros2.package-missing", text, use.span, fix=hint)
        else:
            missing.setdefault(use.name, use.span)
    if missing:
        names = ", ".join(sorted(missing))
        text = f"packages that are not in this workspace: {names}; what the launch takes from them "
        text += "cannot be looked at"
        span = next(iter(missing.values()))
        diagnostics.report("launch_ros2.packages-elsewhere", text, span)


def check_paths(files: Sequence[Followed], workspace: Workspace, diagnostics: Diagnostics) -> None:
    """Report files of packages that do not exist, and those that installing leaves out."""
    left_out: dict[str, list[str]] = {}
    first: dict[str, SourceSpan] = {}
    seen: set[str] = set()
    for use in paths_of(files):
        package = package_of(Path(use.name), workspace)
        if package is None or use.name in seen:
            continue
        seen.add(use.name)
        if package.is_builtin:
            _check_builtin(package, Path(use.name), use, diagnostics)
            continue
        inside = Path(use.name).relative_to(package.path).as_posix()
        if located(use.name) is None:
            is_made = is_file(Path(f"{use.name}.in"))  # by configure_file() of its CMakeLists.txt
            if is_made or not any(item.file.uses_path(use.name) for item in files):
                continue
            _report_missing(package, inside, use, diagnostics)
        elif is_file(Path(use.name)) and not _is_installed(package, inside):
            left_out.setdefault(package.name, []).append(inside)
            first.setdefault(package.name, use.span)
    for name, items in left_out.items():
        shown = ", ".join(f"'{item}'" for item in items)
        text = (
            f"{shown} of package '{name}' found in its source folder, not installed by its build "
        )
        text += "files (file was not found in the share directory of package)"
        fix = f"install {'it' if len(items) == 1 else 'them'} in the build file of '{name}'"
        diagnostics.report("launch_ros2.not-installed", text, first[name], fix=fix)


def paths_of(files: Sequence[Followed]) -> Iterator[Use]:
    """Yield every file that a launch names, as far as it is known."""
    for item in files:
        file = item.file
        yield from file.paths
        yield from (Use(inc.path, inc.span) for inc in file.includes if inc.path is not None)
        for node in file.nodes:
            yield from (Use(path, node.place_of(path)) for path in node.parameters.files)
        for argument in file.arguments:
            value = argument.default or ""
            if value.startswith("/") and Path(value).suffix:
                yield Use(value, argument.span)


def _robot(command: Command) -> RobotSource | None:
    name, _, rest = command.text.strip().partition(" ")
    if Path(name).name not in {"xacro", "xacro.py"}:
        return None
    try:
        words = _known_words(rest)
        parsed = parse_xacro_arguments(words)
    except ValueError:
        return None
    path = located(parsed.file) or Path(parsed.file)
    return RobotSource(path, parsed.mappings, command.span)


def _known_words(text: str) -> list[str]:
    """Return the words that Command makes of a text, without those that are not known.

    What follows the first word that is not known may be an argument's half.

    Raises:
        ValueError: a quote is left open.
    """
    quoted = shlex.split(text, posix=False)
    known = (word for word in quoted if "…" not in word and not word.endswith(":="))
    return [" ".join(shlex.split(word)) for word in known]


def _check_blanks(command: Command, diagnostics: Diagnostics) -> None:
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


def _package_uses(files: Sequence[Followed]) -> Iterator[Use]:
    for item in files:
        yield from item.file.packages
        for node in item.file.nodes:
            if node.package:
                yield Use(node.package, node.place_of(node.package))


def _check_builtin(package: Package, path: Path, use: Use, diagnostics: Diagnostics) -> None:
    """Report a file whose name is a slip for one of ours; the real package may have others."""
    if is_file(path) or not is_folder(path.parent):
        return
    names = [item.name for item in path.parent.iterdir()]
    if any(is_slip(path.name, name) for name in names):
        _report_missing(package, path.relative_to(package.path).as_posix(), use, diagnostics)


def _report_missing(package: Package, inside: str, use: Use, diagnostics: Diagnostics) -> None:
    path = package.path / inside
    parent = path.parent
    names = sorted(item.name for item in parent.iterdir()) if is_folder(parent) else []
    source = SourcePackage(package)
    everywhere = [name for name in source.files if Path(name).name == path.name]
    text = f"package '{package.name}' has no '{inside}' ([Errno 2] No such file or directory: "
    text += f"'…/share/{package.name}/{inside}')"
    hint = f"it is '{everywhere[0]}'" if everywhere else did_you_mean(path.name, names)
    if not hint and names:
        hint = f"the folder has {', '.join(names[:8])}"
    diagnostics.report("launch_ros2.file-missing", text, use.span, fix=hint)


def _is_installed(package: Package, inside: str) -> bool:
    if package.prefix is not None:
        return True
    source = SourcePackage(package)
    rules = source.rules
    if rules is None or rules.unread or not source.is_ros2:
        return True
    return bool(rules.targets(inside)) or rules.may_install(inside)
