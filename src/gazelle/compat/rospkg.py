"""What `rospkg` is in Gazelle: packages of the workspace."""

from __future__ import annotations

import builtins
import os
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar, NamedTuple, Self, cast

from gazelle.errors import NotFoundError
from gazelle.user_folders import ros_home, ros_log_folder
from gazelle.workspace import Workspace
from gazelle.workspace.package_xml import read_manifest

__all__ = [
    "MANIFEST_FILE",
    "PACKAGE_FILE",
    "STACK_FILE",
    "InvalidManifest",
    "Manifest",
    "ResourceNotFound",
    "RosPack",
    "RosStack",
    "get_etc_ros_dir",
    "get_log_dir",
    "get_package_name",
    "get_ros_home",
    "get_ros_package_path",
    "get_ros_paths",
    "get_ros_root",
    "get_test_results_dir",
    "on_ros_path",
]


class ResourceNotFound(Exception):  # noqa: N818 - rospkg's name
    """A package does not exist; the text says where it was looked for."""


Environ = Mapping[str, str] | None
MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"
STACK_FILE = "stack.xml"


def get_ros_package_path(env: Environ = None) -> str:
    """Return ``ROS_PACKAGE_PATH``."""
    return (os.environ if env is None else env).get("ROS_PACKAGE_PATH", "")


class InvalidManifest(Exception):  # noqa: N818 - rospkg's name
    """A package's manifest cannot be read."""


class Manifest(NamedTuple):
    """What a package says about itself."""

    name: str
    version: str
    description: str
    depends: builtins.list[str]
    type: str = "package"


def get_ros_root(env: Environ = None) -> str | None:
    """Return ``ROS_ROOT``."""
    return (os.environ if env is None else env).get("ROS_ROOT")


def get_ros_paths(env: Environ = None) -> list[str]:
    """Return the folders of ``ROS_PACKAGE_PATH``."""
    return [path for path in get_ros_package_path(env).split(os.pathsep) if path]


def get_ros_home(env: Environ = None) -> str:
    """Return ``ROS_HOME``, ``~/.ros`` when it is not set."""
    return str(ros_home(os.environ if env is None else env))


def get_etc_ros_dir(env: Environ = None) -> str:
    """Return ``ROS_ETC_DIR``, ``/etc/ros`` when it is not set."""
    return (os.environ if env is None else env).get("ROS_ETC_DIR") or "/etc/ros"


def get_test_results_dir(env: Environ = None) -> str:
    """Return ``ROS_TEST_RESULTS_DIR``, the folder ``test_results`` of ROS_HOME without it."""
    environ = os.environ if env is None else env
    return environ.get("ROS_TEST_RESULTS_DIR") or str(ros_home(environ) / "test_results")


def get_log_dir(env: Environ = None) -> str:
    """Return ``ROS_LOG_DIR``, the folder ``log`` of ROS_HOME when it is not set."""
    environ = os.environ if env is None else env
    # As it was written, with a slash at its end.
    return environ.get("ROS_LOG_DIR") or str(ros_log_folder(environ))


def on_ros_path(p: str, env: Environ = None) -> bool:
    """Tell whether a path is in one of the folders of ``ROS_PACKAGE_PATH``."""
    here = Path(os.path.realpath(p))
    return any(here.is_relative_to(os.path.realpath(one)) for one in get_ros_paths(env))


def get_package_name(path: str) -> str | None:
    """Return the package that a path is in, None when it is in none."""
    here = Path(os.path.realpath(path))
    for folder in (here, *here.parents):
        manifest = folder / "package.xml"
        if manifest.is_file():
            return read_manifest(manifest).name
    return None


class RosPack:
    """Answers questions about packages."""

    _shared: ClassVar[dict[tuple[str, ...], RosPack]] = {}

    def __init__(self, ros_paths: list[str] | None = None) -> None:
        environ = dict(os.environ)
        if ros_paths is not None:
            environ["ROS_PACKAGE_PATH"] = os.pathsep.join(ros_paths)
        self._workspace = Workspace.discover(environ=environ)

    @classmethod
    def get_instance(cls, ros_paths: builtins.list[str] | None = None) -> Self:
        """Return one for these paths, always the same."""
        key = tuple(ros_paths or get_ros_paths())
        if key not in cls._shared:
            cls._shared[key] = cls(ros_paths)
        return cast(Self, cls._shared[key])

    def get_manifest(self, name: str) -> Manifest:
        """Return what a package says about itself.

        Raises:
            ResourceNotFound: there is no such package.
        """
        self.get_path(name)
        one = self._workspace.package(name)
        return Manifest(one.name, one.version, one.description, [*one.depends])

    def get_depends_on(self, name: str, implicit: bool = True) -> builtins.list[str]:
        """Return the packages that need one, directly or by way of others.

        Raises:
            ResourceNotFound: there is no such package.
        """
        self.get_path(name)
        return [one for one in self.list() if name in self.get_depends(one, implicit)]

    def stack_of(self, package: str) -> str | None:
        """Return the stack of a package: there are none since catkin."""
        self.get_path(package)
        return None

    def list(self) -> list[str]:
        """Return the names of all packages."""
        return sorted(self._workspace.packages)

    def get_path(self, name: str) -> str:
        """Return a package's folder.

        Raises:
            ResourceNotFound: there is no such package.
        """
        try:
            return str(self._workspace.package(name).share)
        except NotFoundError as error:
            raise ResourceNotFound(str(error)) from error

    def get_depends(self, name: str, implicit: bool = True) -> builtins.list[str]:
        """Return what a package needs, with what those need if `implicit`.

        Raises:
            ResourceNotFound: there is no such package.
        """
        self.get_path(name)
        found: dict[str, None] = {}
        waiting = list(self._workspace.package(name).depends)
        while waiting:
            item = waiting.pop(0)
            if item in found or item not in self._workspace.packages:
                continue
            found[item] = None
            if implicit:
                waiting += self._workspace.packages[item].depends
        return sorted(found)


class RosStack(RosPack):
    """Answers questions about stacks: there are none since catkin."""

    def list(self) -> list[str]:
        """Return the names of all stacks."""
        return []
