"""What `rospkg` is in Gazelle: packages of the workspace."""

from __future__ import annotations

import builtins
import os

from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace

__all__ = ["ResourceNotFound", "RosPack", "get_ros_package_path"]


class ResourceNotFound(Exception):  # noqa: N818 - rospkg's name
    """A package does not exist; the text says where it was looked for."""


def get_ros_package_path() -> str:
    """Return ``ROS_PACKAGE_PATH``."""
    return os.environ.get("ROS_PACKAGE_PATH", "")


class RosPack:
    """Answers questions about packages."""

    def __init__(self, ros_paths: list[str] | None = None) -> None:
        environ = dict(os.environ)
        if ros_paths is not None:
            environ["ROS_PACKAGE_PATH"] = os.pathsep.join(ros_paths)
        self._workspace = Workspace.discover(environ=environ)

    def list(self) -> list[str]:
        """Return the names of all packages."""
        return sorted(self._workspace.packages)

    def get_path(self, name: str) -> str:
        """Return a package's folder.

        Raises:
            ResourceNotFound: there is no such package.
        """
        try:
            return str(self._workspace.package(name).path)
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
