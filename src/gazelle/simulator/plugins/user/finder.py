"""Finds the Python file, or the C++ source, that the filename of a plug-in means."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gazelle.extensions import ExtensionGroup, find_entry_point

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

    from gazelle.workspace import Package, Workspace

__all__ = [
    "CompiledPlugin",
    "PythonPlugin",
    "compiled_plugin",
    "installed_plugin",
    "python_plugin",
    "python_plugin_names",
    "remembering_folders",
    "stems",
]

_VARIABLES = ("GAZEBO_PLUGIN_PATH", "GZ_SIM_SYSTEM_PLUGIN_PATH", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH")
_LIBRARY_ENDINGS = (".so", ".dylib", ".dll")
_SKIPPED = frozenset({"build", "devel", "install", "log", "node_modules", "__pycache__"})
_SOURCE_ENDINGS = (".cpp", ".cc", ".cxx", ".c")
_PLUGIN_IMPORT = "gazelle.simulator.plugins.user"
_PROJECT = re.compile(r"\bproject\s*\(\s*([\w-]+)")


_Folders = dict[tuple[Path, tuple[str, ...]], Sequence[Path]]
_remembered: ContextVar[_Folders | None] = ContextVar("_remembered", default=None)


@contextmanager
def remembering_folders() -> Iterator[None]:
    """Walk through each package once within a ``with`` block, whose files do not change."""
    token = _remembered.set({})
    try:
        yield
    finally:
        _remembered.reset(token)


class PythonPlugin(NamedTuple):
    """A Python file and the folder of the user's code it belongs to."""

    path: Path
    folder: Path


class CompiledPlugin(NamedTuple):
    """A plug-in whose C++ source is there.

    Attributes:
        package: that builds it.
        lists: the CMakeLists.txt.
        line: of its ``add_library``.
        source: the first source file, None when the list names none that exists.
    """

    package: Package
    lists: Path
    line: int
    source: Path | None


def stems(filename: str) -> tuple[str, ...]:
    """Return what a file of the plug-in may be called, without its ending, the likeliest first."""
    name = filename.strip().rsplit("/", 1)[-1]
    if name.endswith(".py"):
        return (name.removesuffix(".py"),)
    for ending in _LIBRARY_ENDINGS:
        name = name.removesuffix(ending)
    return tuple(dict.fromkeys((name.removeprefix("lib"), name)))


def python_plugin(
    filename: str,
    workspace: Workspace | None,
    beside: Path | None,
    environ: Mapping[str, str] | None = None,
) -> PythonPlugin | None:
    """Return the Python file of a plug-in, None when there is none.

    Looked for in the folders of ``GAZEBO_PLUGIN_PATH``, ``GZ_SIM_SYSTEM_PLUGIN_PATH`` and
    ``IGN_GAZEBO_SYSTEM_PLUGIN_PATH``, then beside the model's file, then in the packages of the
    workspace.

    Args:
        filename: as the ``<plugin>`` has it: ``libmy_plugin.so``, ``my_plugin`` or
            ``my_plugin.py``.
        workspace: whose packages are searched.
        beside: the model's or world's file.
        environ: the process's own when None.
    """
    names = [f"{stem}.py" for stem in stems(filename) if stem]
    variables = os.environ if environ is None else environ
    paths = [variables.get(key, "").split(os.pathsep) for key in _VARIABLES]
    folders = [Path(part) for path in paths for part in path if part]
    folders += [] if beside is None else [beside.parent]
    for folder in folders:
        found = next((folder / name for name in names if (folder / name).is_file()), None)
        if found is not None:
            return PythonPlugin(found, folder)
    for package in _own_packages(workspace):
        for path in _files(package.path, (".py",)):
            if path.name in names:
                return PythonPlugin(path, package.path)
    return None


def python_plugin_names(workspace: Workspace | None) -> tuple[str, ...]:
    """Return the names of the Python files in a workspace that hold a plug-in."""
    return tuple(
        path.stem for package in _own_packages(workspace) for path in _plugin_files(package.path)
    )


def installed_plugin(filename: str) -> EntryPoint | None:
    """Return the entry point that an installed pip package has for a plug-in.

    Its group is ``gazelle.plugins`` and its name that of the library, with or without ``lib``.
    """
    points = (find_entry_point(ExtensionGroup.PLUGINS, stem) for stem in stems(filename))
    return next((point for point in points if point is not None), None)


def compiled_plugin(filename: str, workspace: Workspace | None) -> CompiledPlugin | None:
    """Return where a plug-in's C++ source is, None when no package builds it."""
    names = "|".join(re.escape(stem) for stem in stems(filename) if stem)
    if not names:
        return None
    wanted = re.compile(rf"add_library\s*\(\s*({names})\b([^)]*)")
    for package in _own_packages(workspace):
        for lists in _files(package.path, ("CMakeLists.txt",)):
            text = lists.read_text(encoding="utf-8", errors="replace")
            project = _PROJECT.search(text)
            if project is not None:
                text = text.replace("${PROJECT_NAME}", project[1])
            match = wanted.search(text)
            if match is not None:
                line = text.count("\n", 0, match.start()) + 1
                source = _first_source(lists.parent, match[2])
                return CompiledPlugin(package, lists, line, source)
    return None


def _own_packages(workspace: Workspace | None) -> Iterator[Package]:
    if workspace is not None:
        yield from workspace.user_packages


def _files(folder: Path, endings: tuple[str, ...]) -> Sequence[Path]:
    remembered = _remembered.get()
    if remembered is None:
        return tuple(_walked(folder, endings))
    if (folder, endings) not in remembered:
        remembered[folder, endings] = tuple(_walked(folder, endings))
    return remembered[folder, endings]


def _plugin_files(folder: Path) -> Sequence[Path]:
    remembered, key = _remembered.get(), (folder, ("plugins",))
    if remembered is not None and key in remembered:
        return remembered[key]
    found = tuple(path for path in _files(folder, (".py",)) if _PLUGIN_IMPORT in _text(path))
    if remembered is not None:
        remembered[key] = found
    return found


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _walked(folder: Path, endings: tuple[str, ...]) -> Iterator[Path]:
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in _SKIPPED and name[0] != ".")
        yield from (Path(root) / name for name in sorted(names) if name.endswith(endings))


def _first_source(folder: Path, sources: str) -> Path | None:
    for source in sources.split():
        path = folder / source.strip('"').replace("${CMAKE_CURRENT_SOURCE_DIR}/", "")
        if path.suffix in _SOURCE_ENDINGS and path.is_file():
            return path
    return None
