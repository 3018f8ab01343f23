"""The `launch` package of ROS 2, Foxy to Jazzy: its classes under their names.

User code imports them as ``launch`` (`gazelle.compat.modules`); everything of Gazelle imports
them from here.
"""

from __future__ import annotations

from gazelle.launch.ros2 import (
    actions,
    conditions,
    descriptions,
    event_handlers,
    events,
    frontend,
    launch_description_sources,
    logging,
    substitutions,
    utilities,
)
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.condition import Condition
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import BaseEventHandler, EventHandler
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_entity import (
    LaunchDescriptionEntity,
    SomeActionsType,
    SomeActionsType_types_tuple,
    SomeEntitiesType,
    SomeEntitiesType_types_tuple,
)
from gazelle.launch.ros2.launch_description_source import LaunchDescriptionSource
from gazelle.launch.ros2.launch_introspector import LaunchIntrospector
from gazelle.launch.ros2.launch_service import LaunchService
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
    Substitution,
)

__all__ = [
    "Action",
    "BaseEventHandler",
    "Condition",
    "Event",
    "EventHandler",
    "InvalidLaunchFileError",
    "LaunchContext",
    "LaunchDescription",
    "LaunchDescriptionEntity",
    "LaunchDescriptionSource",
    "LaunchIntrospector",
    "LaunchService",
    "SomeActionsType",
    "SomeActionsType_types_tuple",
    "SomeEntitiesType",
    "SomeEntitiesType_types_tuple",
    "SomeSubstitutionsType",
    "SomeSubstitutionsType_types_tuple",
    "Substitution",
    "actions",
    "conditions",
    "descriptions",
    "event_handlers",
    "events",
    "frontend",
    "launch_description_sources",
    "logging",
    "substitutions",
    "utilities",
]
