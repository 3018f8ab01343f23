"""Groups of actions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions.environment_variables import (
    PopEnvironment,
    PushEnvironment,
    ResetEnvironment,
)
from gazelle.launch.ros2.actions.launch_configurations import (
    PopLaunchConfigurations,
    PushLaunchConfigurations,
    ResetLaunchConfigurations,
    SetLaunchConfiguration,
    kept_configurations,
)
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["GroupAction"]


@expose_action("group")
class GroupAction(Action):
    """Actions that share a condition, and configurations and environment of their own."""

    def __init__(
        self,
        actions: Iterable[Action],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[Any, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        self.__actions = actions
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__launch_configurations = dict(launch_configurations or {})
        self.__all: list[LaunchDescriptionEntity] | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<group>``."""
        _, kwargs = super().parse(entity, parser)
        for name in ("scoped", "forwarding"):
            value = entity.get_attr(name, data_type=bool, optional=True)
            if value is not None:
                kwargs[name] = value
        kept = kept_configurations(entity, parser)
        if kept is not None:
            kwargs["launch_configurations"] = kept
        children = [child for child in entity.children if child.type_name != "keep"]
        kwargs["actions"] = [parser.parse_action(child) for child in children]
        return cls, kwargs

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return its actions between those that make and end its scope."""
        if self.__all is None:
            self.__all = self.__with_scope(list(self.__actions))
        return self.__all

    def __with_scope(self, actions: list[Any]) -> list[LaunchDescriptionEntity]:
        given = self.__launch_configurations
        settings = [SetLaunchConfiguration(name, value) for name, value in given.items()]
        if not self.__scoped:
            return [*settings, *actions]
        begin: list[Any] = [PushLaunchConfigurations(), PushEnvironment()]
        end = [PopEnvironment(), PopLaunchConfigurations()]
        if self.__forwarding:
            begin += settings
        else:
            begin += [ResetEnvironment(), ResetLaunchConfigurations(given)]
        return [*begin, *actions, *end]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Return its actions."""
        return self.get_sub_entities()
