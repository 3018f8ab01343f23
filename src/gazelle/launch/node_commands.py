"""Which command a ``(package, type)`` means."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.errors import NotFoundError
from gazelle.extensions import ExtensionError
from gazelle.node_specs.registry import builtin_executables, command_of, node_spec
from gazelle.node_specs.spec import NodeSpec
from gazelle.workspace import Package, Workspace
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.entry_points import console_scripts

__all__ = ["Executable", "executables_of", "find_executable", "script_command"]

_COMPILED = (".cpp", ".cc", ".cxx", ".c", ".rs")


@dataclass(frozen=True, slots=True)
class Executable:
    """How to run a node.

    Attributes:
        command: words to execute, the node's own arguments follow.
        builtin: the built-in node, None for a file.
        folder: folder of the file, for ``cwd="node"``.
        script: the user's Python file that is run, None for anything else.
        takes_ros_args: ``__name:=`` and the like follow too.
    """

    command: tuple[str, ...]
    builtin: NodeSpec | None = None
    folder: Path | None = None
    script: Path | None = None
    takes_ros_args: bool = True


def find_executable(
    package: str,
    type_name: str,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None = None,
    environ: Mapping[str, str] | None = None,
    ros_version: int = 1,
) -> Executable | None:
    """Return what runs a node; None (and a diagnostic) when nothing does.

    The order is: a file of the user's package, a built-in node, an executable of an installed
    ROS (``lib/<package>`` below its prefixes). The diagnostic names commands of `ros_version`.
    """
    found = _in_workspace(package, type_name, workspace, diagnostics, span)
    if found is not None:
        return found
    command = command_of(package, type_name)
    if command:
        argv = (sys.executable, "-m", "gazelle.cli", *command)
        return Executable(argv)
    try:
        builtin = node_spec(package, type_name)
    except ExtensionError as error:
        message = f"Cannot locate node of type [{type_name}] in package [{package}]: {error}"
        diagnostics.report("launch.executable-missing", message, span)
        return None
    if builtin is not None:
        argv = (sys.executable, "-m", "gazelle.nodes", f"{package}/{type_name}")
        return Executable(argv, builtin)
    native = _native(package, type_name, os.environ if environ is None else environ)
    if native is not None:
        return Executable((str(native),), folder=native.parent)
    _report_missing(package, type_name, workspace, diagnostics, span, ros_version)
    return None


def executables_of(package: str, workspace: Workspace) -> tuple[str, ...]:
    """Return the names of what a package has to run, sorted: its own and those of Gazelle's."""
    existing = set(builtin_executables(package))
    try:
        found = workspace.package(package)
    except NotFoundError:
        return tuple(sorted(existing))
    return tuple(sorted({*existing, *_scripts(found), *console_scripts(found.path)}))


def script_command(path: Path) -> tuple[str, ...]:
    """Return the words that run a file: Python goes through our runner, the rest as it is."""
    if path.suffix == ".py" or _is_python(path):
        return (sys.executable, "-m", "gazelle.compat.script_runner", str(path))
    return (str(path),)


def _in_workspace(
    package: str,
    type_name: str,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None,
) -> Executable | None:
    try:
        found = workspace.package(package)
    except NotFoundError:
        return None
    files = found.find_executables(type_name)
    if not files:
        return None
    path = files[0]
    may_run = os.access(path, os.X_OK) or found.is_builtin
    if not may_run and type_name not in console_scripts(found.path):
        message = f"'{path}' is not executable; it runs here, real ROS would not find it"
        diagnostics.report("launch.not-executable", message, span, fix=f"chmod +x {path}")
    command = script_command(path)
    function = _function(found, type_name, path)
    if function:
        command = (*command[:-1], "--entry", function, command[-1])
    script = path if command[0] == sys.executable else None
    return Executable(command, folder=path.parent, script=script)


def _function(package: Package, type_name: str, path: Path) -> str:
    """Return the function that a console script calls, empty where its file has but one."""
    scripts = console_scripts(package.path)
    module, _, function = scripts.get(type_name, "").partition(":")
    others = [one for one in scripts.values() if one.partition(":")[0].strip() == module.strip()]
    is_file = path.stem in {module.strip().rpartition(".")[2], "__init__"}
    return function.strip() if len(others) > 1 and is_file else ""


def _is_python(path: Path) -> bool:
    try:
        with path.open("rb") as stream:
            first = stream.readline(200)
    except OSError:
        return False
    return first.startswith(b"#!") and b"python" in first


def _native(package: str, type_name: str, environ: Mapping[str, str]) -> Path | None:
    for variable in ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        for prefix in filter(None, environ.get(variable, "").split(os.pathsep)):
            candidate = Path(prefix) / "lib" / package / type_name
            if candidate.is_file() and os.access(candidate, os.X_OK):
                return candidate
    return None


def _report_missing(
    package: str,
    type_name: str,
    workspace: Workspace,
    diagnostics: Diagnostics,
    span: SourceSpan | None,
    ros_version: int,
) -> None:
    from gazelle.node_specs.unavailable_packages import missing_node, missing_package

    found = None
    try:
        found = workspace.package(package)
    except NotFoundError as error:
        if not builtin_executables(package):
            message, fix = missing_package(error, ros_version)
            diagnostics.report("launch.package-missing", message, span, fix=fix)
            return
    source = _compiled_source(found, type_name) if found is not None else None
    if source is not None:
        message = (
            f"Cannot locate node of type [{type_name}] in package [{package}]: it is compiled "
            f"code ('{source}') that is not built here"
        )
        diagnostics.report("launch.compiled-node", message, span)
        return
    existing = set(executables_of(package, workspace))
    known = (
        f"the package has: {', '.join(sorted(existing))}"
        if existing
        else "the package has no nodes"
    )
    message = f"Cannot locate node of type [{type_name}] in package [{package}]; {known}"
    fix = missing_node(package, type_name) or did_you_mean(type_name, sorted(existing))
    diagnostics.report("launch.executable-missing", message, span, fix=fix)


def _compiled_source(package: Package, type_name: str) -> Path | None:
    """Return the C++ file that an executable of this name is most likely made from."""
    for path in sorted(package.path.rglob("*")):
        if path.suffix in _COMPILED and path.stem == type_name:
            return path
    lists = read_cmake_lists(package.path, package.name)
    return lists.file if lists is not None and type_name in lists.executables() else None


def _scripts(package: Package) -> list[str]:
    folders = [package.path / name for name in ("scripts", "nodes", "bin", "src")]
    files = [path for folder in folders if folder.is_dir() for path in folder.iterdir()]
    return [path.name for path in files if path.suffix == ".py" or shutil.which(str(path))]
