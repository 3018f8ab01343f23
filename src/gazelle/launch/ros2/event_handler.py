"""What is done about events."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity, SomeEntitiesType

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["BaseEventHandler", "EventHandler"]


class BaseEventHandler:
    """Something that is told of the events its matcher picks.

    While it is told, and in what it returns, ``context.locals.event`` is the event.
    """

    def __init__(self, *, matcher: Callable[[Any], bool], handle_once: bool = False) -> None:
        self.__matcher = matcher
        self.__handle_once = handle_once

    @property
    def handle_once(self) -> bool:
        """Whether it is forgotten after the first event."""
        return self.__handle_once

    @property
    def handler_description(self) -> str | None:
        """What it does, in words."""
        return None

    @property
    def matcher_description(self) -> str | None:
        """Which events it picks, in words."""
        return None

    def matches(self, event: Event) -> bool:
        """Return whether the event is for it."""
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[SomeEntitiesType]]:
        """Return a text for people, and the entities it is known to yield."""
        kind = type(self).__name__
        text = f"matcher='{self.matcher_description}', handler='{self.handler_description}'"
        return f"{kind}({text}, handle_once={self.handle_once})", []

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Deal with an event; what it returns is visited."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """A handler that yields the same entities for every event."""

    def __init__(
        self,
        *,
        matcher: Callable[[Any], bool],
        entities: SomeEntitiesType | None = None,
        handle_once: bool = False,
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = entities

    @property
    def entities(self) -> SomeEntitiesType | None:
        """What is visited."""
        return self.__entities

    def describe(self) -> tuple[str, list[SomeEntitiesType]]:
        """Return a text for people, and the entities."""
        text, found = super().describe()
        entities = self.entities
        if isinstance(entities, LaunchDescriptionEntity):
            found.append(entities)
        elif entities is not None:
            found.extend(entities)
        return text, found

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities."""
        super().handle(event, context)
        return self.entities
