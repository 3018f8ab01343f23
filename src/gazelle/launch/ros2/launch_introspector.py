"""A launch description as a tree for people."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from gazelle.launch.ros2.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.substitutions.substitution_failure import described
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_entities,
    normalize_to_list_of_substitutions,
)

__all__ = [
    "LaunchIntrospector",
    "format_action",
    "format_entities",
    "format_event_handler",
    "format_substitutions",
]


class LaunchIntrospector:
    """Writes launch descriptions as trees."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """Return a description as a tree."""
        lines = [str(launch_description)]
        branches = [_lines_of(entity) for entity in launch_description.entities]
        for branch in branches:
            is_last = branch is branches[-1]
            lines.append(("└── " if is_last else "├── ") + branch[0])
            lines += [("    " if is_last else "│   ") + line for line in branch[1:]]
        return "\n".join(lines)


def format_substitutions(substitutions: Any) -> str:
    """Return substitutions as a text for people."""
    return described(normalize_to_list_of_substitutions(substitutions))


def format_entities(entities: Iterable[LaunchDescriptionEntity]) -> list[str]:
    """Return the lines of several entities."""
    return [line for entity in entities for line in _lines_of(entity)]


def format_event_handler(event_handler: Any) -> list[str]:
    """Return the lines of a handler and of what it is known to yield."""
    text, entities = event_handler.describe()
    inner = format_entities(normalize_to_list_of_entities(entities))
    return [text, *(f"└── {line}" for line in inner)]


def format_action(action: Any) -> list[str]:
    """Return the lines of an action."""
    if isinstance(action, LogInfo):
        return [f"LogInfo({format_substitutions(action.msg)})"]
    if isinstance(action, EmitEvent):
        return [f"EmitEvent(event='{action.event.name}')"]
    if isinstance(action, ExecuteProcess):
        return [_process_line(action)]
    if isinstance(action, RegisterEventHandler):
        lines = format_event_handler(action.event_handler)
        return [
            f"RegisterEventHandler('{action.event_handler}'):",
            *(f"    {one}" for one in lines),
        ]
    return [f"Action('{action}')"]


def _lines_of(entity: LaunchDescriptionEntity) -> list[str]:
    from gazelle.launch.ros2.action import Action

    if isinstance(entity, Action):
        return format_action(entity)
    return [f"Unknown entity('{entity}')"]


def _process_line(action: ExecuteProcess) -> str:
    cmd = ", ".join(format_substitutions(word) for word in action.cmd)
    cwd = None if action.cwd is None else f"'{format_substitutions(action.cwd)}'"
    env = None
    if action.process_description.env is not None:
        pairs = action.process_description.env
        inner = ", ".join(f"{described(key)}: {described(value)}" for key, value in pairs)
        env = f"{{{inner}}}"
    return f"ExecuteProcess(cmd=[{cmd}], cwd={cwd}, env={env}, shell={action.shell})"
