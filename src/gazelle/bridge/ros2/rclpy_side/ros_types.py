"""Classes of ROS's message and service types by name."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["MissingTypeError", "class_of"]

_OF_ACTIONS = {
    "SendGoal": "SendGoalService",
    "GetResult": "GetResultService",
    "FeedbackMessage": "FeedbackMessage",
}


class MissingTypeError(Exception):
    """ROS's Python has no such type."""


def class_of(name: str) -> Any:
    """Return the class of ``pkg/msg/Name``, ``pkg/srv/Name`` or a piece of an action.

    The pieces are ``pkg/action/Name_SendGoal``, ``…_GetResult`` and ``…_FeedbackMessage``.

    Raises:
        MissingTypeError: it cannot be imported.
    """
    try:
        package, part, bare = name.split("/")
        module = import_module(f"{package}.{part}")
        if part != "action":
            return getattr(module, bare)
        action, _, piece = bare.rpartition("_")
        return getattr(getattr(module, action).Impl, _OF_ACTIONS[piece])
    except (ImportError, AttributeError, ValueError, KeyError) as error:
        raise MissingTypeError(f"{type(error).__name__}: {error}") from error
