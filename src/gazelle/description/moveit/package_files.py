"""The files of a MoveIt config package, of ROS 1 and of ROS 2.

Which there are, and YAML files as values with the place where each key stands.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.files import is_file, is_folder
from gazelle.documents.yaml import YamlError, YamlNode, entries
from gazelle.documents.yaml import read_yaml as read_document
from gazelle.workspace import Workspace
from gazelle.workspace.environment_paths import BUILTIN

__all__ = ["DEFAULT_CONFIGS", "PackageFiles", "find_package_files", "read_yaml"]

_ARGUMENT = re.compile(r"\$\(arg\s+([^)\s]+)\s*\)")
DEFAULT_CONFIGS = BUILTIN / "packages" / "moveit_configs_utils" / "default_configs"
"""Files that every package has unless it brings its own, by the names MoveIt gives them."""
_SETUP = ".setup_assistant"
_SRDF = (".srdf", ".srdf.xacro")
_URDF = (".urdf.xacro", ".urdf", ".xacro")
# What the controllers' files are called, the likeliest first.
_CONTROLLERS = ("moveit", "moveit2", "simple_moveit", "gazebo_moveit", "ros", "fake")


@dataclass(frozen=True)
class PackageFiles:
    """Where a package has what; None for files that it has not.

    Attributes:
        folder: of the package.
        urdf: the robot, a URDF or a xacro.
        srdf: its groups.
        arguments: values of xacro arguments by name, as the Setup Assistant kept them.
        pipelines: files of pipelines by name, the package's own before MoveIt's.
        cartesian_limits: of Pilz' planner.
    """

    folder: Path
    urdf: Path | None = None
    srdf: Path | None = None
    arguments: Mapping[str, str] = field(default_factory=dict)
    kinematics: Path | None = None
    joint_limits: Path | None = None
    cartesian_limits: Path | None = None
    controllers: Path | None = None
    sensors: Path | None = None
    pipelines: Mapping[str, Path] = field(default_factory=dict)


def read_yaml(
    file: Path, diagnostics: Diagnostics, arguments: Mapping[str, str] | None = None
) -> tuple[dict[str, Any], dict[tuple[str, ...], SourceSpan]]:
    """Return the mapping in a file and where its keys stand; both empty (reported) if unusable.

    Args:
        file: the file.
        diagnostics: receives ``moveit.bad-yaml`` and what arguments are missing.
        arguments: values of ROS 1's ``$(arg NAME)``, as ``rosparam subst_value`` puts them in.
    """
    try:
        text = read_text_limited(file)
    except (OSError, UnicodeDecodeError) as error:
        message = f"'{file}' cannot be read: {error}"
        diagnostics.report("moveit.bad-yaml", message, SourceSpan(str(file)))
        return {}, {}
    text = _substituted(text, file, arguments or {}, diagnostics)
    document = read_document(text, str(file))
    try:
        value = document.value
    except YamlError as error:
        problem = error.problem
        diagnostics.report("moveit.bad-yaml", f"not YAML: {problem.what}", problem.span)
        return {}, {}
    if document.root is None or value is None:
        return {}, {}
    if not isinstance(value, dict):
        message = "the file holds no mapping of names to values"
        diagnostics.report("moveit.bad-yaml", message, SourceSpan(str(file), 1, 1))
        return {}, {}
    return value, _places(document.root, diagnostics)


def find_package_files(
    folder: Path,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    robot_name: str = "",
) -> PackageFiles:
    """Look for the files of a MoveIt config package.

    Args:
        folder: of the package.
        workspace: finds the package that the robot is in.
        diagnostics: receives what is missing or not unique.
        robot_name: decides where a package has several robots; the ``NAME.srdf``.
    """
    config = folder / "config"
    setup = _setup(folder / _SETUP, diagnostics)
    srdf = _srdf(folder, config, setup, robot_name, diagnostics)
    name = robot_name or ("" if srdf is None else srdf.name.split(".")[0])
    urdf, arguments = _urdf(folder, config, setup, name, workspace, diagnostics)
    return PackageFiles(
        folder,
        urdf,
        srdf,
        arguments,
        _existing(config / "kinematics.yaml"),
        _existing(config / "joint_limits.yaml"),
        _existing(config / "pilz_cartesian_limits.yaml", config / "cartesian_limits.yaml"),
        _controllers(config, name),
        _existing(config / "sensors_3d.yaml"),
        _pipelines(config),
    )


def _substituted(
    text: str, file: Path, arguments: Mapping[str, str], diagnostics: Diagnostics
) -> str:
    def value(match: re.Match[str]) -> str:
        name = match[1]
        if name in arguments:
            return arguments[name]
        line = text.count("\n", 0, match.start()) + 1
        column = match.start() - text.rfind("\n", 0, match.start())
        message = f"$(arg {name}) has no value here; a launch file would give it one"
        span = SourceSpan(str(file), line, column, len(match[0]))
        diagnostics.report("moveit.no-argument", message, span)
        return match[0]

    return _ARGUMENT.sub(value, text)


def _places(root: YamlNode, diagnostics: Diagnostics) -> dict[tuple[str, ...], SourceSpan]:
    spans: dict[tuple[str, ...], SourceSpan] = {}
    for path, key, _, first in entries(root, lists=True):
        if first is not None:
            message = f"'{key.text}' is there twice; the last one counts"
            diagnostics.report("moveit.double-key", message, key.span)
        spans[path] = key.span
    return spans


def _existing(*files: Path) -> Path | None:
    return next((file for file in files if is_file(file)), None)


def _setup(file: Path, diagnostics: Diagnostics) -> dict[str, Any]:
    if not is_file(file):
        return {}
    values, _ = read_yaml(file, diagnostics)
    inner = values.get("moveit_setup_assistant_config")
    return inner if isinstance(inner, dict) else {}


def _part(setup: Mapping[str, Any], name: str) -> dict[str, Any]:
    part = setup.get(name.lower(), setup.get(name.upper()))
    return part if isinstance(part, dict) else {}


def _srdf(
    folder: Path, config: Path, setup: Mapping[str, Any], name: str, diagnostics: Diagnostics
) -> Path | None:
    relative = _part(setup, "srdf").get("relative_path")
    named = [folder / str(relative)] if relative and not name else []
    named += [config / f"{name}{ending}" for ending in _SRDF] if name else []
    found = _existing(*named)
    if found is not None:
        return found
    candidates = [] if name else _with_endings(config, _SRDF) or _with_endings(folder, _SRDF)
    if not candidates:
        message = f"'{folder}' has no SRDF: neither the package's config folder nor"
        message += f" {_SETUP} names one" if not name else f" a file '{name}.srdf'"
        present = [file.name.split(".")[0] for file in _with_endings(config, _SRDF)]
        fix = did_you_mean(name, present) or "run the MoveIt Setup Assistant, or write NAME.srdf"
        diagnostics.report("moveit.no-srdf", message, SourceSpan(str(folder)), fix=fix)
        return None
    if len(candidates) > 1:
        names = ", ".join(f"'{file.name}'" for file in candidates)
        message = f"the package has several SRDFs ({names}); '{candidates[0].name}' is used"
        fix = "name the robot that is meant: robot_name='…'"
        diagnostics.report("moveit.several-files", message, SourceSpan(str(config)), fix=fix)
    return candidates[0]


def _urdf(
    folder: Path,
    config: Path,
    setup: Mapping[str, Any],
    name: str,
    workspace: Workspace,
    diagnostics: Diagnostics,
) -> tuple[Path | None, dict[str, str]]:
    part = _part(setup, "urdf")
    words = str(part.get("xacro_args") or "").split()
    arguments = dict(word.split(":=", 1) for word in words if ":=" in word)
    own = _existing(*(config / f"{name}{ending}" for ending in _URDF)) if name else None
    if own is not None:
        return own, arguments
    package, relative = part.get("package"), part.get("relative_path")
    if relative:
        base = workspace.package(str(package)).share if package else folder
        return base / str(relative), arguments
    candidates = [*_with_endings(config, _URDF[:2]), *_with_endings(folder / "urdf", _URDF)]
    if candidates:
        return candidates[0], arguments
    message = f"'{folder}' does not say which robot it is for: there is neither {_SETUP} nor"
    message += f" config/{name or 'NAME'}.urdf.xacro (Cannot infer URDF)"
    diagnostics.report("moveit.no-description", message, SourceSpan(str(folder)))
    return None, arguments


def _with_endings(folder: Path, endings: tuple[str, ...]) -> list[Path]:
    if not is_folder(folder):
        return []
    return [file for file in sorted(folder.iterdir()) if file.name.endswith(endings)]


def _controllers(config: Path, name: str) -> Path | None:
    files = {file.name: file for file in _with_endings(config, ("controllers.yaml",))}
    # ros2_controllers.yaml and its like are for the controller manager, not for MoveIt.
    names = [f"{word}_controllers.yaml" for word in (*_CONTROLLERS[:4], name, *_CONTROLLERS[4:])]
    return next((files[item] for item in (*names, "controllers.yaml") if item in files), None)


def _pipelines(config: Path) -> dict[str, Path]:
    ending = "_planning.yaml"
    found: dict[str, Path] = {}
    for folder in (config, DEFAULT_CONFIGS):
        for file in _with_endings(folder, (ending,)):
            found.setdefault(file.name.removesuffix(ending), file)
    return found
