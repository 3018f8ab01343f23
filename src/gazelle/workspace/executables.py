"""Which files of a package ``rosrun package type`` can mean."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path

from gazelle.documents.files import is_file

__all__ = ["compiled_names", "executable_names", "executables_named"]

_FOLDERS = ("scripts", "nodes", "bin", "src", "script", "test", "")
_SCRIPT_FOLDERS = frozenset({"bin", "nodes", "script", "scripts"})
_PRUNED = frozenset({"__pycache__", "build", "node_modules"})
_SCRIPT_SUFFIXES = frozenset({".py", ".sh", ".bash"})


def executables_named(
    package: str, path: Path, prefix: Path | None, type_name: str
) -> tuple[Path, ...]:
    """Return the candidate files, best first; empty when there is none.

    ``type_name`` is matched as written; a script installed under its name without the suffix
    (as ``CMakeLists.txt`` and ``console_scripts`` do) is found as well, unless a compiler would
    make a program of that name: ``talker`` of ``talker.cpp`` is not the ``talker.py`` beside it.
    """
    found: dict[Path, None] = {}
    if prefix is not None:
        _add(found, prefix / "lib" / package / type_name)
        _add(found, path / type_name)
        return tuple(found)
    from gazelle.workspace.entry_points import console_scripts
    from gazelle.workspace.installed_files import installed_files

    installed = installed_files(path, package)
    spellings = _spellings(type_name)
    if len(spellings) > 1 and type_name in compiled_names(path, package):
        spellings = (type_name,)
    for name in spellings:
        if f"lib/{package}/{name}" in installed:
            _add(found, installed[f"lib/{package}/{name}"])
    target = console_scripts(path).get(type_name)
    if target is not None:
        _add(found, _module_file(path, target))
    for name in spellings:
        for folder in (*_FOLDERS, package):
            _add(found, path / folder / name)
    if not found:
        for name in spellings:
            for file in _files_below(path):
                if file.name == name:
                    _add(found, file)
    return tuple(found)


def executable_names(package: str, path: Path, prefix: Path | None) -> tuple[str, ...]:
    """Return the names ``rosrun`` would offer for a package, sorted."""
    if prefix is not None:
        return tuple(sorted(file.name for file in _files_below(prefix / "lib" / package)))
    from gazelle.workspace.entry_points import console_scripts
    from gazelle.workspace.installed_files import installed_files

    names = {*console_scripts(path), *compiled_names(path, package)}
    start = f"lib/{package}/"
    installed = (target for target in installed_files(path, package) if target.startswith(start))
    names.update(target.removeprefix(start) for target in installed)
    for file in _files_below(path):
        top = file.relative_to(path).parts[0]
        is_script = top in _SCRIPT_FOLDERS and file.suffix in _SCRIPT_SUFFIXES
        if is_script or os.access(file, os.X_OK):
            names.add(file.name)
    return tuple(sorted(names))


def _add(found: dict[Path, None], path: Path) -> None:
    if is_file(path):
        found.setdefault(path)


def _spellings(type_name: str) -> tuple[str, ...]:
    return (type_name,) if Path(type_name).suffix else (type_name, f"{type_name}.py")


def compiled_names(path: Path, package: str) -> frozenset[str]:
    """Return the names of the programs that a compiler makes of a package's sources.

    Args:
        path: source folder of the package.
        package: its name.
    """
    try:
        changed_ns = (path / "CMakeLists.txt").stat().st_mtime_ns
    except OSError:
        return frozenset()
    return _read_compiled_names(path, package, changed_ns)


@lru_cache(maxsize=256)
def _read_compiled_names(path: Path, package: str, _changed_ns: int) -> frozenset[str]:
    from gazelle.workspace.building.cmake_lists import read_cmake_lists

    try:
        lists = read_cmake_lists(path, package)
    except OSError:
        return frozenset()
    names = () if lists is None else lists.executables()
    return frozenset(name for name in names if "${" not in name)


def _module_file(path: Path, target: str) -> Path:
    module = target.partition(":")[0].strip().replace(".", "/")
    for base in (path, path / "src"):
        for name in (f"{module}.py", f"{module}/__init__.py"):
            if is_file(base / name):
                return base / name
    return path / f"{module}.py"


def _files_below(folder: Path) -> list[Path]:
    files: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(
            name for name in folders if name not in _PRUNED and not name.startswith(".")
        )
        files += [Path(root, name) for name in sorted(names)]
    return files
