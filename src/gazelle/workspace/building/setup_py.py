"""``setup.py`` and ``setup.cfg`` of Python packages, read without running them.

Building runs ``setup.py`` in ROS as well. Here it runs only when reading it leaves something open,
in a process of its own and with a ``setuptools`` that notes the arguments and does nothing.
"""

from __future__ import annotations

import ast
import configparser
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePath
from typing import Any

from gazelle.diagnostics import SourceSpan
from gazelle.documents.files import names_matching
from gazelle.workspace.building.install_rules import InstallRule
from gazelle.workspace.static_python import UNKNOWN, Call, Evaluator, is_known, parse_python

__all__ = [
    "EmptyGlob",
    "SetupFile",
    "SetupRunError",
    "cfg_arguments",
    "read_setup",
    "setup_arguments",
    "with_arguments",
]

_PATIENCE_S = 60.0
_MARK = "gazelle-setup-arguments:"
_CODE = """
import json, os, runpy, sys, types
from fnmatch import fnmatch

MARK = sys.argv[1]
KEPT = ("name", "version", "packages", "package_dir", "package_data", "py_modules", "data_files",
        "scripts", "entry_points", "install_requires")
given = {}

def setup(**arguments):
    given.update(arguments)

def generate_distutils_setup(**arguments):
    return arguments

def find(where=".", exclude=(), include=("*",), markers=True):
    names = []
    for root, folders, files in os.walk(where):
        folders[:] = sorted(name for name in folders if name.isidentifier())
        name = os.path.relpath(root, where).replace(os.sep, ".")
        if root != where and ("__init__.py" in files or not markers):
            names.append(name)
    chosen = [name for name in names if any(fnmatch(name, item) for item in include)]
    return [name for name in chosen if not any(fnmatch(name, item) for item in exclude)]

def find_namespace(where=".", exclude=(), include=("*",)):
    return find(where, exclude, include, markers=False)

class Anything:
    def __init__(self, *words, **more):
        pass

def module(name, **names):
    made = sys.modules[name] = types.ModuleType(name)
    made.__path__ = []
    made.__dict__.update(names)
    made.__getattr__ = lambda _name: Anything
    return made

tools = {"setup": setup, "find_packages": find, "find_namespace_packages": find_namespace}
for name in ("setuptools", "distutils", "distutils.core"):
    module(name, **tools)
for name in ("setuptools.command", "distutils.command", "catkin_pkg"):
    module(name)
for name in ("build_py", "install", "develop", "build_ext", "egg_info", "install_lib"):
    module("setuptools.command." + name)
module("catkin_pkg.python_setup", generate_distutils_setup=generate_distutils_setup)
sys.argv = ["setup.py", "install"]
sys.path.insert(0, os.getcwd())
runpy.run_path("setup.py", run_name="__main__")
print(MARK + json.dumps({key: given[key] for key in KEPT if key in given}, default=str))
"""
_LISTS = {"py_modules", "scripts", "install_requires"}


class SetupRunError(Exception):
    """A ``setup.py`` cannot be run; the text says why."""


@dataclass(frozen=True, slots=True)
class EmptyGlob:
    """A ``glob(…)`` that finds no file."""

    pattern: str
    span: SourceSpan


@dataclass(slots=True)
class SetupFile:
    """What ``setup()`` is called with.

    Attributes:
        file: ``setup.py``.
        error: why it is no Python, empty when it is.
        is_called: ``setup()`` or catkin's ``generate_distutils_setup()`` is called at all.
        name: of the distribution; None when unknown.
        rules: of ``data_files``.
        has_all_rules: False when a part of ``data_files`` is known at run time only.
        empty_globs: patterns without a file.
        modules: of ``packages``; None when unknown.
        folders: ``package_dir``.
        span: of the call.
        data_files_span: of ``data_files``, None where they are not written in the call.
        scripts_folder: where ``setup.cfg`` puts executables, empty when it says nothing.
        version: of the distribution, empty when it says nothing.
        py_modules: single modules.
        scripts: script files.
        package_data: patterns of data files inside modules, by module.
        entry_points: lines by group, such as ``console_scripts``.
        requires: ``install_requires``.
    """

    file: Path
    error: SyntaxError | None = None
    is_called: bool = False
    name: str | None = None
    rules: list[InstallRule] = field(default_factory=list)
    has_all_rules: bool = True
    empty_globs: list[EmptyGlob] = field(default_factory=list)
    modules: tuple[str, ...] | None = None
    folders: dict[str, str] = field(default_factory=dict)
    span: SourceSpan | None = None
    data_files_span: SourceSpan | None = None
    scripts_folder: str = ""
    version: str = ""
    py_modules: tuple[str, ...] = ()
    scripts: tuple[str, ...] = ()
    package_data: dict[str, tuple[str, ...]] = field(default_factory=dict)
    entry_points: dict[str, tuple[str, ...]] = field(default_factory=dict)
    requires: tuple[str, ...] = ()

    @property
    def is_for_ament(self) -> bool:
        """It puts something below ``share/``, as packages of ROS 2 do."""
        return any(rule.destination.startswith("share") for rule in self.rules)


def setup_arguments(folder: Path) -> dict[str, Any]:
    """Run a package's ``setup.py`` and return the arguments of ``setup()`` that matter here.

    Raises:
        SetupRunError: it fails, takes longer than a minute, or calls no ``setup()``.
    """
    # Most packages are read without running anything.
    import json
    import subprocess

    argv = [sys.executable, "-c", _CODE, _MARK]
    try:
        done = subprocess.run(
            argv, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
            check=False, timeout=_PATIENCE_S, errors="replace",
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired) as error:
        raise SetupRunError(str(error)) from error
    lines = [line for line in done.stdout.splitlines() if line.startswith(_MARK)]
    if not lines:
        last = done.stderr.strip().splitlines()[-1:] or [f"exit code {done.returncode}"]
        raise SetupRunError(last[0])
    found = json.loads(lines[-1].removeprefix(_MARK))
    if not found:
        raise SetupRunError("it calls no setup()")
    return dict(found)


def cfg_arguments(folder: Path, find: Callable[..., Any]) -> dict[str, Any]:
    """Return what ``[metadata]`` and ``[options…]`` of a package's ``setup.cfg`` say.

    Args:
        folder: of the package.
        find: setuptools' ``find_packages``.
    """
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    try:
        parser.read(folder / "setup.cfg", encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError):
        return {}
    found: dict[str, Any] = {}
    for key in ("name", "version"):
        value = parser.get("metadata", key, fallback="")
        # "attr:" and "file:" name places that are not read here.
        if value and ":" not in value:
            found[key] = value
    if not parser.has_section("options"):
        return found
    for key, value in parser.items("options"):
        if key in _LISTS:
            found[key] = _lines(value)
        elif key == "packages":
            is_search = value.strip() in {"find:", "find_namespace:"}
            where = parser.get("options.packages.find", "where", fallback=".").strip()
            exclude = _lines(parser.get("options.packages.find", "exclude", fallback=""))
            found[key] = find(where, exclude) if is_search else _lines(value)
        elif key == "package_dir":
            pairs = (line.partition("=") for line in _lines(value))
            found[key] = {name.strip(): folder.strip() for name, _, folder in pairs}
    for section, key in (("options.package_data", "package_data"),
                         ("options.entry_points", "entry_points")):  # fmt: skip
        if parser.has_section(section):
            rows = parser.items(section)
            found[key] = {name.replace("*", ""): _lines(value) for name, value in rows}
    if parser.has_section("options.data_files"):
        rows = parser.items("options.data_files")
        found["data_files"] = [(name, _files(folder, value)) for name, value in rows]
    return found


def read_setup(folder: Path) -> SetupFile | None:
    """Read a package's ``setup.py``; None when it has none."""
    file = folder / "setup.py"
    if not file.is_file():
        return None
    found = SetupFile(file, scripts_folder=_scripts_folder(folder / "setup.cfg"))
    try:
        tree = parse_python(file.read_text(encoding="utf-8", errors="replace"))
    except SyntaxError as error:
        found.error = error
        return found
    evaluator = Evaluator(file, folder, functions={"find_packages": _packages_of(folder)})
    evaluator.run(tree)
    for call in evaluator.calls:
        if call.name not in {"setup", "generate_distutils_setup"}:
            continue
        found.is_called = True
        # catkin's idiom: setup(**generate_distutils_setup(packages=[…])).
        if call.name != "setup" or call.keywords or found.span is None:
            declared = cfg_arguments(folder, _packages_of(folder)) if call.name == "setup" else {}
            arguments = {**declared, **call.keywords}
            _fill(found, Call(call.function, call.arguments, arguments, call.node))
            _find_globs(found, call.node, evaluator, folder)
    return found


def with_arguments(setup: SetupFile, arguments: Mapping[str, Any]) -> SetupFile:
    """Return what a file says when ``setup()`` is called with these arguments."""
    node = ast.Call(ast.Name("setup"), [], [])
    node.lineno = setup.span.line if setup.span is not None else 1
    node.col_offset = setup.span.column - 1 if setup.span is not None else 0
    found = SetupFile(setup.file, is_called=True, scripts_folder=setup.scripts_folder)
    _fill(found, Call("setup", (), arguments, node))
    return found


def _files(folder: Path, value: str) -> list[str]:
    found = []
    for line in _lines(value):
        names = names_matching(line, folder) if "*" in line else []
        found += names or [line]
    return found


def _lines(value: str) -> list[str]:
    parts = value.splitlines() if "\n" in value.strip() else value.split(",")
    return [part.strip() for part in parts if part.strip()]


def _fill(found: SetupFile, call: Call) -> None:
    found.span = SourceSpan(str(found.file), call.node.lineno, call.node.col_offset + 1)
    rows_node = next((item for item in call.node.keywords if item.arg == "data_files"), None)
    if rows_node is not None:
        place = SourceSpan(str(found.file), rows_node.lineno, rows_node.col_offset + 1)
        found.data_files_span = place
    name = call.get("name")
    found.name = name if isinstance(name, str) else None
    modules = call.get("packages", default=[])
    if isinstance(modules, list | tuple) and is_known(modules):
        found.modules = tuple(str(item) for item in modules)
    version = call.get("version")
    found.version = version if isinstance(version, str) else ""
    found.py_modules = _texts(call.get("py_modules"))
    found.scripts = _texts(call.get("scripts"))
    found.requires = _texts(call.get("install_requires"))
    found.package_data = _lists_of(call.get("package_data"))
    found.entry_points = _lists_of(call.get("entry_points"))
    folders = call.get("package_dir", default={})
    found.folders = folders if isinstance(folders, dict) and is_known(folders) else {}
    rows = call.get("data_files", default=[])
    if not isinstance(rows, list | tuple):
        found.has_all_rules = False
        return
    for row in rows:
        _add_row(found, row)


def _texts(value: Any) -> tuple[str, ...]:
    if isinstance(value, str):
        return tuple(line.strip() for line in value.splitlines() if line.strip())
    items = value if isinstance(value, list | tuple) else ()
    return tuple(str(item) for item in items if isinstance(item, str | PurePath))


def _lists_of(value: Any) -> dict[str, tuple[str, ...]]:
    items = value.items() if isinstance(value, dict) else ()
    return {key: _texts(item) for key, item in items if isinstance(key, str)}


def _add_row(found: SetupFile, row: Any) -> None:
    if not isinstance(row, list | tuple) or len(row) != 2:
        found.has_all_rules = False
        return
    destination, files = row
    if not isinstance(destination, str | PurePath) or not isinstance(files, list | tuple):
        found.has_all_rules = False
        return
    for item in files:
        if not isinstance(item, str | PurePath):
            found.has_all_rules = False
            continue
        source = PurePath(item).as_posix()
        span = found.span or SourceSpan(str(found.file))
        span = _place_of(found.file, str(item)) or span
        found.rules.append(InstallRule(source, str(destination).strip("/"), False, span))


def _place_of(file: Path, text: str) -> SourceSpan | None:
    """Return where a name stands in a file, None when it is computed."""
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    for number, line in enumerate(lines, 1):
        for quote in ("'", '"'):
            column = line.find(f"{quote}{text}{quote}")
            if column >= 0:
                return SourceSpan(str(file), number, column + 2, len(text))
    return None


def _find_globs(found: SetupFile, node: ast.Call, evaluator: Evaluator, folder: Path) -> None:
    """Note the globs of ``data_files`` that find nothing."""
    wanted = next((item.value for item in node.keywords if item.arg == "data_files"), None)
    tree = parse_python(found.file.read_text(encoding="utf-8", errors="replace"))
    inside = ast.walk(wanted) if isinstance(wanted, ast.List) else ast.walk(tree)
    for item in inside:
        if not isinstance(item, ast.Call) or not item.args:
            continue
        name = item.func.id if isinstance(item.func, ast.Name) else getattr(item.func, "attr", "")
        if name not in {"glob", "iglob"}:
            continue
        pattern = evaluator.value(item.args[0], evaluator.names)
        if isinstance(pattern, str) and evaluator.value(item, evaluator.names) == []:
            argument = item.args[0]
            length = (argument.end_col_offset or 0) - argument.col_offset
            span = SourceSpan(str(found.file), argument.lineno, argument.col_offset + 1, length)
            found.empty_globs.append(EmptyGlob(pattern, span))


def _packages_of(folder: Path) -> Any:
    """Return setuptools' ``find_packages`` over names of folders."""

    def find(where: str = ".", exclude: Any = (), include: Any = ("*",)) -> Any:
        from fnmatch import fnmatch

        base = folder / where
        names = sorted(
            ".".join(file.parent.relative_to(base).parts) for file in base.rglob("__init__.py")
        )
        outside = [name for name in names if any(fnmatch(name, item) for item in exclude)]
        inside = [name for name in names if any(fnmatch(name, item) for item in include)]
        return [name for name in inside if name and name not in outside] or UNKNOWN

    return find


def _scripts_folder(file: Path) -> str:
    parser = configparser.ConfigParser(interpolation=None)
    try:
        parser.read(file, encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError):
        return ""
    for key in ("install_scripts", "install-scripts"):
        value = parser.get("install", key, fallback="")
        if value:
            return value.strip()
    return ""
