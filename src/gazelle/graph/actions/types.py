"""The message classes of an action, by its type in any spelling and of either generation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from gazelle.errors import GraphError
from gazelle.interfaces import (
    action_type,
    fill,
    message_type,
    ros1_message_type,
    service_type,
    to_plain,
)

__all__ = ["ActionTypes", "RosVersion", "action_name", "action_types", "as_message"]

RosVersion = Literal[1, 2]

_SUFFIX = "Action"


@dataclass(frozen=True, slots=True)
class ActionTypes:
    """What an action's messages are made of.

    Attributes:
        name: ``pkg/action/Name``.
        ros_version: 1 for actionlib, 2 for ROS 2.
        Goal, Result, Feedback: the user's three messages.
        SendGoal, CancelGoal, GetResult: ROS 2's services, None in actionlib.
        Envelope: by part (``goal``, ``result``, ``feedback``) the message of its topic; in ROS 2
            there is only ``feedback``.
        StatusArray, Status: the messages of the status topic and of one goal in it.
        GoalId: ``actionlib_msgs/GoalID``, or ``unique_identifier_msgs/msg/UUID``.
    """

    name: str
    ros_version: RosVersion
    Goal: Any
    Result: Any
    Feedback: Any
    SendGoal: Any
    CancelGoal: Any
    GetResult: Any
    Envelope: dict[str, Any]
    StatusArray: Any
    Status: Any
    GoalId: Any


def action_name(kind: Any) -> str:
    """Return ``pkg/action/Name`` of an action's type in any spelling.

    Args:
        kind: ``pkg/Name``, ``pkg/action/Name``, ``pkg/NameAction``, an `ActionType`, or the
            message class ``NameAction`` of actionlib.

    Raises:
        GraphError: it is none of these.
    """
    text = kind if isinstance(kind, str) else getattr(kind, "TYPE_NAME", "")
    text = text or getattr(kind, "name", "")
    parts = str(text).split("/")
    is_class = not isinstance(kind, str) and bool(getattr(kind, "TYPE_NAME", ""))
    if len(parts) not in (2, 3) or (is_class and not parts[-1].endswith(_SUFFIX)):
        raise GraphError(
            f"{kind!r} is no action type\n"
            "  fix: give package/Name, or the class NameAction of package.msg (ROS 1), or the "
            "class Name of package.action (ROS 2)\n  ROS says: Type is not an action spec"
        )
    return f"{parts[0]}/action/{parts[-1].removesuffix(_SUFFIX)}"


def action_types(kind: Any, ros_version: RosVersion) -> ActionTypes:
    """Return the classes of an action; those of actionlib have ROS 1's form if `kind` has it.

    Raises:
        NotFoundError: nothing defines the action.
        GraphError: `kind` is no action's type.
    """
    name = action_name(kind)
    if ros_version == 2:
        return _ros2(name)
    return _actionlib(name, ros1_message_type if hasattr(kind, "_slot_types") else message_type)


def as_message(value: Any, message_class: Any) -> Any:
    """Return a value as a message: itself, a default for None, or filled from mapping or message.

    Controllers serve both generations with one result: fields that the class lacks are left out.

    Raises:
        InterfaceError: a value does not fit its field.
    """
    if isinstance(value, message_class):
        return value
    made = message_class()
    if value is not None:
        plain = to_plain(value)
        if not isinstance(value, dict):
            plain = {key: one for key, one in plain.items() if hasattr(made, key)}
        fill(made, plain)
    return made


def _actionlib(name: str, make: Any) -> ActionTypes:
    package, _, bare = name.split("/")
    parts = {part: make(f"{package}/{bare}{part}") for part in ("Goal", "Result", "Feedback")}
    envelopes = {part.lower(): make(f"{package}/{bare}{_SUFFIX}{part}") for part in parts}
    return ActionTypes(
        name,
        1,
        parts["Goal"],
        parts["Result"],
        parts["Feedback"],
        None,
        None,
        None,
        envelopes,
        make("actionlib_msgs/GoalStatusArray"),
        make("actionlib_msgs/GoalStatus"),
        make("actionlib_msgs/GoalID"),
    )


def _ros2(name: str) -> ActionTypes:
    found = action_type(name)
    return ActionTypes(
        name,
        2,
        found.Goal,
        found.Result,
        found.Feedback,
        found.SendGoal,
        service_type("action_msgs/srv/CancelGoal"),
        found.GetResult,
        {"feedback": found.FeedbackMessage},
        message_type("action_msgs/msg/GoalStatusArray"),
        message_type("action_msgs/msg/GoalStatus"),
        message_type("unique_identifier_msgs/msg/UUID"),
    )
