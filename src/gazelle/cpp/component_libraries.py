"""Components of C++: which a package registers, and the libraries that hold them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import read_text_limited
from gazelle.errors import GazelleError
from gazelle.workspace import Package, Workspace

__all__ = ["INDEX", "ComponentLibrary", "may_register", "registered_components"]

INDEX = "rclcpp_components"
"""The part of ament's index in which components are."""

_FOLDER = "share/ament_index/resource_index"
_CMAKE = "CMakeLists.txt"
_CALLS = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")


class ComponentLibrary(NamedTuple):
    """A component and where it is.

    Attributes:
        plugin: its class, such as ``composition::Talker``.
        library: the file that holds it.
    """

    plugin: str
    library: Path


def may_register(package: Package) -> bool:
    """Tell, without compiling anything, whether a package's CMake registers components."""
    if any(_index_files(_prefixes(package), package.name, INDEX)):
        return True
    try:
        text = read_text_limited(package.path / _CMAKE)
    except (GazelleError, OSError):
        return False
    return any(call in text for call in _CALLS)


def registered_components(
    package: Package,
    *,
    workspace: Workspace,
    diagnostics: Diagnostics,
    index: str = INDEX,
    environ: Mapping[str, str] | None = None,
) -> tuple[ComponentLibrary, ...]:
    """Return the components that a package registers, compiled first where it is source.

    Args:
        package: whose they are.
        workspace: where the packages are that it needs.
        diagnostics: receives why it cannot be compiled.
        index: part of ament's index; packages may have ones of their own.
        environ: environment variables; the process's own when None.
    """
    prefixes = list(_prefixes(package))
    if package.prefix is None and not package.is_builtin:
        from gazelle.cpp.building.build import ensure_installed

        made = ensure_installed(
            package, workspace=workspace, diagnostics=diagnostics, environ=environ
        )
        if made is None:
            return ()
        prefixes = [made]
    found: dict[str, ComponentLibrary] = {}
    for prefix, file in _index_files(prefixes, package.name, index):
        for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
            plugin, _, library = line.strip().partition(";")
            if plugin and library:
                found.setdefault(plugin, ComponentLibrary(plugin, prefix / library))
    return tuple(found.values())


def _prefixes(package: Package) -> Iterator[Path]:
    if package.prefix is not None:
        yield Path(package.prefix)
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        yield Path(prefix)


def _index_files(
    prefixes: Iterator[Path] | list[Path], package: str, index: str
) -> Iterator[tuple[Path, Path]]:
    for prefix in prefixes:
        file = prefix / _FOLDER / index / package
        if file.is_file():
            yield prefix, file
