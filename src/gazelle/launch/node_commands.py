"""Which command a ``(package, type)`` means."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from gazelle.cpp.lookup import (
    CPP_VARIABLE,
    CppProgram,
    built_file,
    cpp_program,
    cpp_programs,
    host_command,
    is_node_file,
    prefers_cpp,
)
from gazelle.cpp.provided_programs import (
    PROVIDED_PROGRAMS,
    ProvidedProgram,
    provided_program,
)
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.errors import NotFoundError
from gazelle.extensions import ExtensionError
from gazelle.node_specs.registry import builtin_executables, command_of, node_spec
from gazelle.node_specs.spec import NodeSpec
from gazelle.workspace import Package, Workspace
from gazelle.workspace.entry_points import console_scripts

__all__ = [
    "Executable",
    "compiled_executable",
    "executables_of",
    "find_executable",
    "script_command",
]

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
        is_of_cpp: it is C++ of the user.
        cpp: the C++ that has to be compiled first, None for what can run at once; the command does
            that when it starts, and `gazelle.launch.cpp_nodes` does it for many before.
        provided: C++ of Gazelle that is compiled on the user's machine, as `cpp` is.
    """

    command: tuple[str, ...]
    builtin: NodeSpec | None = None
    folder: Path | None = None
    script: Path | None = None
    takes_ros_args: bool = True
    is_of_cpp: bool = False
    cpp: CppProgram | None = None
    provided: ProvidedProgram | None = None


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

    The order is: a script of the user's package, a built-in node, C++ of the user's package, an
    executable of an installed ROS (``lib/<package>`` below its prefixes). ``GAZELLE_CPP=1`` puts
    the user's C++ before built-in nodes. The diagnostic names commands of `ros_version`.
    """
    environ = os.environ if environ is None else environ
    found = _in_workspace(package, type_name, workspace, diagnostics, span)
    is_of_cpp = found is not None and found.is_of_cpp
    if found is not None and (not is_of_cpp or prefers_cpp(environ)):
        return found
    try:
        builtin = _builtin(package, type_name)
    except ExtensionError as error:
        if found is None:
            message = f"Cannot locate node of type [{type_name}] in package [{package}]: {error}"
            diagnostics.report("launch.executable-missing", message, span)
        return found
    if builtin is not None:
        if found is not None:
            _tell_of_precedence(package, type_name, diagnostics, span)
        return builtin
    if found is not None:
        return found
    native = _native(package, type_name, environ)
    if native is not None:
        return Executable((str(native),), folder=native.parent)
    _report_missing(package, type_name, workspace, diagnostics, span, ros_version)
    return None


def executables_of(package: str, workspace: Workspace) -> tuple[str, ...]:
    """Return the names of what a package has to run, sorted: its own and those of Gazelle's."""
    existing = set(builtin_executables(package))
    existing |= {name for owner, name in PROVIDED_PROGRAMS if owner == package}
    try:
        found = workspace.package(package)
    except NotFoundError:
        return tuple(sorted(existing))
    own = {*_scripts(found), *console_scripts(found.path), *cpp_programs(found)}
    return tuple(sorted({*existing, *own}))


def script_command(path: Path) -> tuple[str, ...]:
    """Return the words that run a file.

    Python goes through our runner, nodes that Gazelle compiled through their host, the rest as it
    is.
    """
    if path.suffix == ".py" or _is_python(path):
        return (sys.executable, "-m", "gazelle.compat.script_runner", str(path))
    return host_command(path) if is_node_file(path) else (str(path),)


def compiled_executable(file: Path) -> Executable:
    """Return how a node is run that was compiled to a file."""
    return Executable(host_command(file), folder=file.parent, is_of_cpp=True)


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
        program = cpp_program(found, type_name, span)
        return None if program is None else _of_program(program)
    path = files[0]
    if is_node_file(path):
        return compiled_executable(path)
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


def _of_program(program: CppProgram) -> Executable:
    """Return how C++ is run; what a build of the workspace has made of it is taken as it is."""
    file = built_file(program)
    if file is not None:
        return compiled_executable(file)
    command = (sys.executable, "-m", "gazelle.cpp.compile_and_run", *program.words)
    return Executable(command, folder=program.package.path, is_of_cpp=True, cpp=program)


def _builtin(package: str, type_name: str) -> Executable | None:
    """Return Gazelle's own program behind a name, None when there is none.

    Raises:
        ExtensionError: an installed package names a node that cannot be had.
    """
    command = command_of(package, type_name)
    if command:
        return Executable((sys.executable, "-m", "gazelle.cli", *command))
    builtin = node_spec(package, type_name)
    if builtin is not None:
        words = (sys.executable, "-m", "gazelle.nodes", f"{package}/{type_name}")
        return Executable(words, builtin)
    provided = provided_program(package, type_name)
    if provided is None:
        return None
    words = (sys.executable, "-m", "gazelle.cpp.compile_and_run", f"{package}/{type_name}")
    return Executable(words, provided=provided)


def _tell_of_precedence(
    package: str, type_name: str, diagnostics: Diagnostics, span: SourceSpan | None
) -> None:
    text = f"Gazelle's own {package}/{type_name} runs, not the C++ of your package"
    fix = f"--cpp, or {CPP_VARIABLE}=1, compiles and runs yours"
    diagnostics.report("launch.builtin-instead", text, span, fix=fix)


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
        if not executables_of(package, workspace):
            message, fix = missing_package(error, ros_version)
            diagnostics.report("launch.package-missing", message, span, fix=fix)
            return
    source = _compiled_source(found, type_name) if found is not None else None
    if source is not None:
        message = (
            f"Cannot locate node of type [{type_name}] in package [{package}]: it is compiled "
            f"code ('{source}') that no add_executable() makes"
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
    return None


def _scripts(package: Package) -> list[str]:
    folders = [package.path / name for name in ("scripts", "nodes", "bin", "src")]
    files = [path for folder in folders if folder.is_dir() for path in folder.iterdir()]
    return [path.name for path in files if path.suffix == ".py" or shutil.which(str(path))]
