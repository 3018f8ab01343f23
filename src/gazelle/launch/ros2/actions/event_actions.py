"""Events and their handlers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import BaseEventHandler
from gazelle.launch.ros2.events import Shutdown as ShutdownEvent
from gazelle.launch.ros2.events.process import ProcessExited
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.substitution import Substitution
from gazelle.launch.ros2.utilities import (
    is_a_subclass,
    normalize_to_list_of_entities,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["EmitEvent", "RegisterEventHandler", "Shutdown", "UnregisterEventHandler"]


class EmitEvent(Action):
    """Queues an event.

    Attributes:
        event: the event.
    """

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not is_a_subclass(event, Event):
            raise RuntimeError(f"EmitEvent() expected an event instance, got '{event}'.")
        self.event = event

    def execute(self, context: LaunchContext) -> None:
        """Queue it."""
        context.emit_event_sync(self.event)


@expose_action("shutdown")
class Shutdown(EmitEvent):
    """Ends the launch."""

    def __init__(self, *, reason: Any = "reason not given", **kwargs: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<shutdown>``."""
        _, kwargs = super().parse(entity, parser)
        reason = entity.get_attr("reason", optional=True)
        if reason:
            kwargs["reason"] = parser.parse_substitution(reason)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Queue the event; as an ``on_exit`` it says which process was required."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            name = event.process_name
            launch_logging.get_logger("launch").info(
                f"process[{name}] was required: shutting down launched system"
            )
        assert isinstance(self.event, ShutdownEvent)
        reason = self.event.reason
        if isinstance(reason, Substitution | list):
            substitutions = normalize_to_list_of_substitutions(reason)
            self.event.reason = perform_substitutions(context, substitutions)
        super().execute(context)


class RegisterEventHandler(Action):
    """Lets a handler be told of events from now on.

    Attributes:
        event_handler: the handler.
    """

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> None:
        """Register it."""
        context.register_event_handler(self.event_handler)

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return what it is known to yield."""
        text, entities = self.event_handler.describe()
        return [(text, normalize_to_list_of_entities(entities))] if entities else []


class UnregisterEventHandler(Action):
    """Lets a handler be told of no more events.

    Attributes:
        event_handler: the handler.
    """

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.event_handler = event_handler

    def execute(self, context: LaunchContext) -> None:
        """Unregister it.

        Raises:
            ValueError: it is not registered.
        """
        context.unregister_event_handler(self.event_handler)
