"""What `rosgraph` is in Gazelle: a master's answers from the graph."""

from __future__ import annotations

import os
from typing import Any

from gazelle.compat.rospy.client import Master as _Answers
from gazelle.compat.rospy.errors import ROSException
from gazelle.errors import GraphError
from gazelle.graph import Graph

__all__ = ["Master", "MasterException", "get_master_uri", "is_master_online"]


class MasterException(Exception):  # noqa: N818 - rosgraph's name
    """There is no graph to ask."""


def get_master_uri() -> str:
    """Return ``ROS_MASTER_URI``."""
    return os.environ.get("ROS_MASTER_URI", "http://localhost:11311")


def is_master_online(master_uri: str | None = None) -> bool:
    """Return whether a graph is running."""
    del master_uri
    try:
        Graph.open(role="client").close()
    except GraphError:
        return False
    return True


class Master:
    """Answers without the status that the XML-RPC calls carry."""

    def __init__(self, caller_id: str = "", master_uri: str | None = None) -> None:
        del caller_id
        self.master_uri = master_uri or get_master_uri()
        self._answers = _Answers()

    def getSystemState(self) -> list[Any]:
        """Return publishers, subscribers and services by name.

        Raises:
            MasterException: no graph is running.
        """
        return list(self._checked(self._answers.getSystemState))

    def getPublishedTopics(self, subgraph: str = "/") -> list[list[str]]:
        """Return ``[topic, type]`` of all published topics.

        Raises:
            MasterException: no graph is running.
        """
        return list(self._checked(lambda: self._answers.getPublishedTopics(subgraph)))

    def getPid(self) -> int:
        """Return this process's number.

        Raises:
            MasterException: no graph is running.
        """
        return int(self._checked(self._answers.getPid))

    def is_online(self) -> bool:
        """Return whether a graph is running."""
        return is_master_online()

    def _checked(self, call: Any) -> Any:
        try:
            return call()[2]
        except ROSException as error:
            raise MasterException(str(error)) from error
