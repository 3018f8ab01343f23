"""ament_index_python: where packages are, answered by Gazelle's workspace."""

from __future__ import annotations

import os
import re
from functools import lru_cache
from pathlib import Path

from gazelle.diagnostics import did_you_mean
from gazelle.workspace.package import Package
from gazelle.workspace.workspace import Workspace

__all__ = [
    "AMENT_PREFIX_PATH_ENV_VAR",
    "RESOURCE_INDEX_SUBFOLDER",
    "InvalidResourceNameError",
    "InvalidResourceTypeNameError",
    "PackageNotFoundError",
    "get_package_prefix",
    "get_package_share_directory",
    "get_package_share_path",
    "get_packages_with_prefixes",
    "get_resource",
    "get_resource_types",
    "get_resources",
    "get_search_paths",
    "has_resource",
    "known_workspace",
]

AMENT_PREFIX_PATH_ENV_VAR = "AMENT_PREFIX_PATH"
RESOURCE_INDEX_SUBFOLDER = "share/ament_index/resource_index"
_LEGAL = re.compile(r"[a-zA-Z0-9][a-zA-Z0-9_-]+", re.ASCII)


class PackageNotFoundError(KeyError):
    """There is no such package."""

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidResourceTypeNameError(ValueError):
    """A kind of entries is a folder's name and holds no ``/``."""


class InvalidResourceNameError(ValueError):
    """An entry is a file's name and holds no ``/``."""


def get_search_paths() -> list[str]:
    """Return the install prefixes of ``AMENT_PREFIX_PATH`` that exist."""
    paths = os.environ.get(AMENT_PREFIX_PATH_ENV_VAR, "").split(os.pathsep)
    return [path for path in paths if path and Path(path).is_dir()]


def get_packages_with_prefixes() -> dict[str, str]:
    """Return the prefixes of all packages by name."""
    return {name: _prefix(one) for name, one in known_workspace().packages.items()}


def get_package_prefix(package_name: str) -> str:
    """Return a package's install prefix; in a source tree, the package's own folder.

    Raises:
        PackageNotFoundError: there is no such package.
        ValueError: the name is not legal.
    """
    return _prefix(_package(package_name))


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return the folder of a package's data: ``share/NAME``, or what stands for it.

    Raises:
        PackageNotFoundError: there is no such package.
        ValueError: the name is not legal.
    """
    del print_warning
    return str(_package(package_name).share)


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Return `get_package_share_directory` as a path."""
    return Path(get_package_share_directory(package_name, print_warning))


def get_resources(resource_type: str) -> dict[str, str]:
    """Return prefixes by name of what packages registered in the index.

    Packages in source trees are in it as ``packages`` without being installed.

    Raises:
        InvalidResourceTypeNameError: the kind holds a ``/``.
    """
    _check(InvalidResourceTypeNameError, "Resource type", resource_type)
    found: dict[str, str] = {}
    for prefix in reversed(get_search_paths()):
        folder = _index(prefix) / resource_type
        if folder.is_dir():
            files = [one.name for one in folder.iterdir() if one.is_file()]
            found |= {name: prefix for name in files if not name.startswith(".")}
    if resource_type == "packages":
        found = get_packages_with_prefixes() | found
    return found


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return what a package registered, and its prefix.

    Raises:
        InvalidResourceNameError: the name holds a ``/``.
        InvalidResourceTypeNameError: the kind does.
        LookupError: there is no such entry.
    """
    _check(InvalidResourceNameError, "Resource name", resource_name)
    prefix = get_resources(resource_type).get(resource_name)
    if prefix is None:
        hint = did_you_mean(resource_name, get_resources(resource_type))
        text = f"Could not find the resource '{resource_name}' of type '{resource_type}'"
        raise LookupError(f"{text}; {hint}".rstrip("; "))
    file = _index(prefix) / resource_type / resource_name
    return (file.read_text(encoding="utf-8") if file.is_file() else ""), prefix


def has_resource(resource_type: str, resource_name: str) -> str | bool:
    """Return the prefix of an entry, False when there is none.

    Raises:
        InvalidResourceNameError: the name holds a ``/``.
        InvalidResourceTypeNameError: the kind does.
    """
    _check(InvalidResourceNameError, "Resource name", resource_name)
    return get_resources(resource_type).get(resource_name, False)


def get_resource_types() -> set[str]:
    """Return the kinds of entries that there are."""
    folders = [_index(prefix) for prefix in get_search_paths()]
    there = [one for folder in folders if folder.is_dir() for one in folder.iterdir()]
    found = {one.name for one in there if one.is_dir() and not one.name.startswith(".")}
    return found | {"packages"}


@lru_cache(maxsize=1)
def known_workspace() -> Workspace:
    """Return the workspace that all of this looks into, crawled once for the process."""
    return Workspace.discover()


def _package(name: str) -> Package:
    if _LEGAL.fullmatch(name) is None:
        raise ValueError(f"'{name}' is not a valid package name")
    found = known_workspace().packages.get(name)
    if found is None:
        hint = did_you_mean(name, list(known_workspace().packages))
        places = list(known_workspace().package_places)
        text = f"package '{name}' not found, searching: {places}"
        raise PackageNotFoundError(f"{text}; {hint}".rstrip("; "))
    return found


def _prefix(package: Package) -> str:
    return str(package.prefix or package.path)


def _index(prefix: str) -> Path:
    return Path(prefix) / RESOURCE_INDEX_SUBFOLDER


def _check(error: type[ValueError], what: str, name: str) -> None:
    if "/" in name or "\\" in name:
        raise error(f"{what} '{name}' is invalid")
