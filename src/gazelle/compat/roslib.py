"""What `roslib` is in Gazelle: classes by name, files of packages, and names of types.

Names of messages and services are ``package/Name``; `roslib.names` takes them apart.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from gazelle.compat.rosgraph.names import is_legal_base_name
from gazelle.compat.rospkg import ResourceNotFound, RosPack
from gazelle.errors import GazelleError
from gazelle.interfaces import ros1_message_type, ros1_service_type
from gazelle.workspace import Workspace

__all__ = [
    "BASE_RESOURCE_NAME_LEGAL_CHARS_P",
    "MANIFEST_FILE",
    "PACKAGE_FILE",
    "PRN_SEPARATOR",
    "RESOURCE_NAME_LEGAL_CHARS_P",
    "ROS_PACKAGE_PATH",
    "ROS_ROOT",
    "SRC_DIR",
    "TYPE_SEPARATOR",
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
    "is_legal_resource_base_name",
    "is_legal_resource_name",
    "list_pkgs_by_path",
    "load_manifest",
    "package_resource_name",
    "resource_file",
    "resource_name",
    "resource_name_base",
    "resource_name_package",
]

PRN_SEPARATOR = TYPE_SEPARATOR = "/"
RESOURCE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z][\w/]*$")
BASE_RESOURCE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z]\w*$")
is_legal_resource_base_name = is_legal_base_name
MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"
SRC_DIR = "src"
ROS_PACKAGE_PATH = "ROS_PACKAGE_PATH"
ROS_ROOT = "ROS_ROOT"


def is_legal_resource_name(name: str | None) -> bool:
    """Tell whether a name may be a resource's: letters, digits, ``_`` and single slashes."""
    if name is None or "//" in name:
        return False
    return RESOURCE_NAME_LEGAL_CHARS_P.fullmatch(name) is not None


def resource_name(res_pkg_name: str, name: str, my_pkg: str | None = None) -> str:
    """Return ``package/Name``, only the name inside of the package itself."""
    return name if res_pkg_name == my_pkg else f"{res_pkg_name}/{name}"


def resource_name_base(name: str) -> str:
    """Return the name without its package."""
    return name.rpartition("/")[2]


def resource_name_package(name: str) -> str | None:
    """Return the package of a name, None without one."""
    return name.partition("/")[0] if "/" in name else None


def package_resource_name(name: str) -> tuple[str, str]:
    """Return package and name; the package is empty without one.

    Raises:
        ValueError: the name has more than one slash.
    """
    package, _, base = name.rpartition("/")
    if "/" in package:
        raise ValueError(f"invalid name [{name}]")
    return package, base


class ROSPkgException(Exception):  # noqa: N818 - roslib's name
    """Something about a package is wrong."""


class InvalidROSPkgException(ROSPkgException):
    """There is no such package."""


class MultipleNodesException(ROSPkgException):
    """A package has several programs of one name."""


def load_manifest(package_name: str, bootstrap_version: str = "0.7") -> None:
    """Do nothing: packages of the workspace are importable as they are."""


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:
    """Return the class of ``pkg/Name``, None when nothing defines it.

    Args:
        message_type: the name.
        reload_on_error: without effect: classes are made from definitions, not from modules.

    Raises:
        ValueError: the name has no package.
    """
    return _class_of(message_type, ros1_message_type)


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:
    """Return the class of service ``pkg/Name``, None when nothing defines it.

    Args:
        service_type: the name.
        reload_on_error: as in `get_message_class`.

    Raises:
        ValueError: the name has no package.
    """
    return _class_of(service_type, ros1_service_type)


def get_pkg_dir(
    package: str,
    required: bool = True,
    ros_root: str | None = None,
    ros_package_path: str | None = None,
) -> str | None:
    """Return a package's folder.

    Args:
        package: its name.
        required: it has to be there.
        ros_root: searched after the paths, in place of ``ROS_ROOT``.
        ros_package_path: where to search, in place of ``ROS_PACKAGE_PATH``.

    Raises:
        InvalidROSPkgException: there is no such package, and it is required.
    """
    try:
        return RosPack(_search_paths(ros_root, ros_package_path)).get_path(package)
    except ResourceNotFound as error:
        if required:
            raise InvalidROSPkgException(str(error)) from error
        return None


def get_pkg_subdir(
    package: str, subdir: str, required: bool = True, env: Mapping[str, str] | None = None
) -> str | None:
    """Return a folder of a package; it is made when it is required.

    Args:
        package: name of the package.
        subdir: name of the folder.
        required: it has to be there.
        env: its ``ROS_ROOT`` counts in place of the environment's.

    Raises:
        InvalidROSPkgException: there is no such package, and it is required.
    """
    folder = get_pkg_dir(package, required, ros_root=(env or {}).get(ROS_ROOT))
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


def find_resource(
    pkg: str,
    resource_name: str,
    filter_fn: Callable[[str], object] | None = None,
    rospack: RosPack | None = None,
) -> list[str]:
    """Return the files of a name anywhere in a package.

    Args:
        pkg: name of the package.
        resource_name: name of the file.
        filter_fn: takes a path, and tells whether it is wanted.
        rospack: knows the package, the workspace's own when None.

    Raises:
        InvalidROSPkgException: there is no such package.
    """
    folder = Path(get_pkg_dir(pkg) or "" if rospack is None else rospack.get_path(pkg))
    found = sorted(str(file) for file in folder.rglob(resource_name) if file.is_file())
    return [file for file in found if filter_fn is None or filter_fn(file)]


def find_node(pkg: str, node_type: str, rospack: RosPack | None = None) -> list[str]:
    """Return the files that ``rosrun PKG TYPE`` could mean.

    Args:
        pkg: name of the package.
        node_type: name of the program.
        rospack: knows the package, the workspace's own when None.

    Raises:
        InvalidROSPkgException: there is no such package.
    """
    if rospack is None:
        get_pkg_dir(pkg)
    workspace = Workspace.discover() if rospack is None else rospack._workspace
    return [str(file) for file in workspace.package(pkg).find_executables(node_type)]


def list_pkgs_by_path(
    path: str,
    packages: list[str] | None = None,
    cache: dict[str, Any] | None = None,
    env: Mapping[str, str] | None = None,
) -> list[str]:
    """Return the names of the packages below a folder, after those given.

    Args:
        path: the folder.
        packages: names that are known already; is extended.
        cache: gets the folder of each new one, with ``ROS_ROOT`` and ``ROS_PACKAGE_PATH``.
        env: the environment, that of the process when None.
    """
    found = [] if packages is None else packages
    given = os.environ if env is None else env
    environ = {**given, ROS_PACKAGE_PATH: os.path.realpath(path)}
    root = Path(path).resolve()
    for name, package in sorted(Workspace.discover(environ=environ).packages.items()):
        if root in (package.path, *package.path.parents) and name not in found:
            found.append(name)
            if cache is not None:
                cache[name] = (
                    str(package.path),
                    given.get(ROS_ROOT),
                    given.get(ROS_PACKAGE_PATH, ""),
                )
    return found


def _search_paths(ros_root: str | None, ros_package_path: str | None) -> list[str] | None:
    """Return the folders that are searched, None for those of the environment."""
    if ros_root is None and ros_package_path is None:
        return None
    given = os.environ.get(ROS_PACKAGE_PATH, "") if ros_package_path is None else ros_package_path
    return [path for path in (*given.split(os.pathsep), ros_root) if path]


def _class_of(name: str, make: Any) -> Any:
    package, _, bare = name.partition("/")
    if not package or not bare:
        raise ValueError(f"message type is missing package name: {name}")
    try:
        return make(name)
    except GazelleError:
        return None
