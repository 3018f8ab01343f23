"""What `roslib` is in Gazelle: classes by name, and files of packages."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from gazelle.compat.rospkg import ResourceNotFound, RosPack
from gazelle.errors import GazelleError
from gazelle.interfaces import ros1_message_type, ros1_service_type
from gazelle.workspace import Workspace

__all__ = [
    "MANIFEST_FILE",
    "PACKAGE_FILE",
    "ROS_PACKAGE_PATH",
    "ROS_ROOT",
    "SRC_DIR",
    "InvalidROSPkgException",
    "MultipleNodesException",
    "ROSPkgException",
    "find_node",
    "find_resource",
    "get_dir_pkg",
    "get_message_class",
    "get_pkg_dir",
    "get_pkg_subdir",
    "get_service_class",
    "list_pkgs_by_path",
    "load_manifest",
    "resource_file",
]


MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"
SRC_DIR = "src"
ROS_PACKAGE_PATH = "ROS_PACKAGE_PATH"
ROS_ROOT = "ROS_ROOT"


class ROSPkgException(Exception):  # noqa: N818 - roslib's name
    """Something about a package is wrong."""


class InvalidROSPkgException(ROSPkgException):
    """There is no such package."""


class MultipleNodesException(ROSPkgException):
    """A package has several programs of one name."""


def load_manifest(package_name: str, bootstrap_version: str = "0.7") -> None:
    """Do nothing: packages of the workspace are importable as they are."""
    del package_name, bootstrap_version


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:
    """Return the class of ``pkg/Name``, None when nothing defines it.

    Raises:
        ValueError: the name has no package.
    """
    del reload_on_error
    return _class_of(message_type, ros1_message_type)


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:
    """Return the class of service ``pkg/Name``, None when nothing defines it.

    Raises:
        ValueError: the name has no package.
    """
    del reload_on_error
    return _class_of(service_type, ros1_service_type)


def get_pkg_dir(package: str, required: bool = True, **_options: Any) -> str | None:
    """Return a package's folder.

    Raises:
        InvalidROSPkgException: there is no such package, and it is required.
    """
    try:
        return RosPack().get_path(package)
    except ResourceNotFound as error:
        if required:
            raise InvalidROSPkgException(str(error)) from error
        return None


def get_pkg_subdir(package: str, subdir: str, required: bool = True, **_options: Any) -> str | None:
    """Return a folder of a package; it is made when it is required.

    Raises:
        InvalidROSPkgException: there is no such package, and it is required.
    """
    folder = get_pkg_dir(package, required)
    if folder is None:
        return None
    found = Path(folder) / subdir
    if required:
        found.mkdir(parents=True, exist_ok=True)
    return str(found) if found.is_dir() else None


def get_dir_pkg(d: str) -> tuple[str | None, str | None]:
    """Return folder and name of the package that a folder is in, or two times None."""
    here = Path(os.path.realpath(d))
    for folder in (here, *here.parents):
        if (folder / "package.xml").is_file() or (folder / "manifest.xml").is_file():
            return str(folder), folder.name
    return None, None


def resource_file(package: str, subdir: str, resource_name: str) -> str:
    """Return the path of a file in a package's folder, there or not.

    Raises:
        InvalidROSPkgException: there is no such package.
    """
    return str(Path(get_pkg_dir(package) or "") / subdir / resource_name)


def find_resource(pkg: str, resource_name: str, **_options: Any) -> list[str]:
    """Return the files of a name anywhere in a package."""
    folder = get_pkg_dir(pkg)
    return sorted(str(file) for file in Path(folder or "").rglob(resource_name) if file.is_file())


def find_node(pkg: str, node_type: str, **_options: Any) -> list[str]:
    """Return the files that ``rosrun PKG TYPE`` could mean."""
    get_pkg_dir(pkg)
    package = Workspace.discover().package(pkg)
    return [str(file) for file in package.find_executables(node_type)]


def list_pkgs_by_path(path: str, packages: list[str] | None = None, **_options: Any) -> list[str]:
    """Return the names of the packages below a folder, after those given."""
    found = [] if packages is None else packages
    environ = {**os.environ, ROS_PACKAGE_PATH: os.path.realpath(path)}
    root = Path(path).resolve()
    for name, package in sorted(Workspace.discover(environ=environ).packages.items()):
        if root in (package.path, *package.path.parents) and name not in found:
            found.append(name)
    return found


def _class_of(name: str, make: Any) -> Any:
    package, _, bare = name.partition("/")
    if not package or not bare:
        raise ValueError(f"message type is missing package name: {name}")
    try:
        return make(name)
    except GazelleError:
        return None
